//! How long Voronoi toolpaths and outlines will be, from what is known before anything is drawn:
//! what the paper's §V asks for.
//!
//! An outline is the edge of the copper, and a turn of the cutter round each piece more (Steiner's
//! formula): that needs no model, and errs only where loops meet in gaps as narrow as the cut.
//!
//! Boundaries of n random points on an area A are 2√(nA) long. Nets are no points: what is fitted
//! is the logarithm of length ÷ √(nA), as a sum over features of the nets (their number, the
//! edge of the copper and how it is divided), the area, and the pads. Where copper fills the board,
//! boundaries run in its gaps, and are half its edge; the products of fill with the others turn the
//! one law into the other.
//!
//! `cargo run --release --example strategies -- fit` makes the coefficients from 200 random boards
//! and all layers of the corpus, which together weigh as much, by least squares with a ridge, and
//! states the error on boards that took no part (ten parts of the random ones, and each board of
//! the corpus by itself).

use crate::board::{Axis, Copper, FLATTEN, Outline};
use crate::geometry::Nm;
use crate::topology::{Extent, Nets};

/// What is known of a layer before it is drawn. Lengths are in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// Islands of copper.
    pub nets: f64,
    /// Flashes.
    pub pads: f64,
    /// The area of the board, or where it has no outline, of the box round its copper.
    pub area: f64,
    /// The area of that box.
    pub bounds: f64,
    /// The area of the copper.
    pub copper: f64,
    /// The length of its edge.
    pub perimeter: f64,
    /// Pieces of copper less holes in them.
    pub turns: f64,
}

/// Numbers that the model multiplies. As many as [`Known::features`] returns.
pub const FEATURES: usize = 10;

/// What [`Known::features`] are multiplied with. From `examples/strategies`; not to be tuned by
/// hand.
const COEFFICIENTS: [f64; FEATURES] =
    [0.2204, 0.0621, 0.0507, -0.4848, -1.1701, 1.0351, 0.0987, -1.7170, 0.1671, -0.1621];

/// Half of the corpus' boards that were not fitted are off by less than this, and nine in ten by
/// less than that, as parts of the length. Measured by `examples/strategies`.
pub const ERRORS: [f64; 2] = [0.10, 0.26];

impl Known {
    /// What is known of `copper`, whose nets have these `extents`; none where there is nothing to
    /// part.
    #[must_use]
    pub fn new(copper: &Copper, nets: &Nets, extents: &[Extent], outline: Option<&Outline>) -> Option<Self> {
        let bounds = copper.bounds().filter(|_| nets.nets().len() > 1)?;
        let bounds = bounds.width().to_mm() * bounds.height().to_mm();
        let sum = |figure: fn(&Extent) -> f64| extents.iter().map(figure).sum::<f64>();
        let count = |number: usize| f64::from(u32::try_from(number).unwrap_or(u32::MAX));
        let pads = copper.features.iter().filter(|feature| matches!(feature.axis, Axis::Flash(_))).count();
        Some(Self {
            nets: count(nets.nets().len()),
            pads: count(pads),
            area: outline.map_or(bounds, |outline| outline.polygon(FLATTEN).area_mm2()),
            bounds,
            copper: sum(|extent| extent.area) / 1e12,
            perimeter: sum(|extent| extent.perimeter) / 1e6,
            turns: sum(|extent| extent.turns),
        })
        .filter(|known| known.area > 0.0 && known.bounds > 0.0 && known.perimeter > 0.0)
    }

    /// The numbers that the model multiplies.
    #[must_use]
    pub fn features(&self) -> [f64; FEATURES] {
        let density = libm::log(self.perimeter / self.unit());
        let fill = (self.copper / self.bounds).min(1.0);
        let holes = (self.nets - self.turns).max(0.0);
        [
            1.0,
            libm::log(self.nets),
            density,
            fill,
            fill * fill,
            fill * density,
            libm::log(1.0 + self.pads / self.nets),
            1.0 / self.nets,
            libm::log((self.area / self.bounds).max(1.0)),
            libm::log(1.0 + holes / self.nets),
        ]
    }

    /// What boundaries are measured in, √(nA).
    #[must_use]
    pub fn unit(&self) -> f64 {
        (self.nets * self.area).sqrt()
    }

    /// How long the boundaries of Voronoi regions will be.
    #[must_use]
    pub fn voronoi(&self) -> f64 {
        let sum: f64 = self.features().iter().zip(COEFFICIENTS).map(|(a, b)| a * b).sum();
        self.unit() * libm::exp(sum)
    }

    /// How long loops at `radius` from all copper will be.
    #[must_use]
    pub fn outline(&self, radius: Nm) -> f64 {
        self.perimeter + 2.0 * std::f64::consts::PI * radius.to_mm() * self.turns
    }
}
