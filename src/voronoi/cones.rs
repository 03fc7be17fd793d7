//! What a picture of the regions is drawn from: cones and curtains, labelled by whose they are.
//!
//! A polygon's ring is drawn coarser than it is, by edges that stay within a sixteenth of a pixel
//! of it. So a pad whose corners were flattened into a hundred edges costs a dozen.

use crate::board::{Copper, FLATTEN, Feature, Shape};
use crate::geometry::{Nm, Point, Polygon, coarse};
use crate::grid::Grid;
use crate::raster::{Caps, FillRule, Label, Scene, Sides, Surface};
use crate::topology::{Nets, grown};

use super::certified::core;
use super::edge::Border;
use super::{OUTSIDE, Owner, Settings, SiteKind};

/// The border lies above everything.
const OUTSIDE_DEPTH: f32 = -1.0;

/// How much the two radii of an arc may differ and still be one, in nanometres: what rounding three
/// points leaves. Chosen.
const ROUNDING: f64 = 1_000.0;

/// How far a ring that is drawn may be off, as a part of a pixel. Chosen: it cannot be seen.
const COARSE: f64 = 1.0 / 16.0;

/// The features whose net `keep` accepts as the rasterizer draws them on `grid`, within `border`.
/// Labels are the numbers of owners.
pub(super) fn scene(
    copper: &Copper,
    nets: &Nets,
    keep: impl Fn(usize) -> bool,
    (settings, border): (&Settings, &Border),
    grid: &Grid,
) -> Scene {
    let band = settings.min_width.filter(|_| settings.sites == SiteKind::Core).unwrap_or(Nm::ZERO);
    let mut cones = Cones {
        scene: Scene::new(grid.width(), grid.height()),
        grid,
        band: grid.pixels(band),
        limit: settings.limit.map(|limit| grid.pixels(limit)),
    };
    let ring = |ring: &Vec<Point>| ring.iter().map(|&p| grid.pixel(p)).collect();
    let contours = border.outside().iter().map(ring).collect();
    let outside = Surface::Polygon { contours, rule: FillRule::EvenOdd, depth: OUTSIDE_DEPTH };
    cones.scene.add(Label(OUTSIDE), outside);
    for (i, feature) in copper.features.iter().enumerate().filter(|(i, _)| keep(*i)) {
        let owner = Label(Owner::Net(nets.of(i)).number());
        match settings.sites {
            SiteKind::Copper => cones.copper(&feature.shape, owner, false),
            SiteKind::Core => cones.core(feature, owner, settings.min_width.is_some()),
        }
    }
    cones.scene
}

struct Cones<'a> {
    scene: Scene,
    grid: &'a Grid,
    /// How far flat copper is fattened, in pixels.
    band: f32,
    limit: Option<f32>,
}

impl Cones<'_> {
    /// The true edge of a feature; depth 0 inside.
    ///
    /// A trace's own copper, drawn `flat` above its cones (the paper's minimum width, §III-D.2),
    /// has a depth of its own as far as its band reaches; the cones begin where that ends.
    fn copper(&mut self, shape: &Shape, owner: Label, flat: bool) {
        let (before, limit) = self.reach(flat);
        match shape {
            Shape::Arc { arc, radius } if arc.drift() > ROUNDING => {
                // Its ends lie at different distances from its centre, as in sloppy files.
                let points: Vec<Point> = std::iter::once(arc.start).chain(arc.flatten(FLATTEN)).collect();
                for pair in points.windows(2) {
                    let chord = Shape::Stroke { from: pair[0], to: pair[1], radius: *radius };
                    self.scene.add(owner, grown(&chord, self.grid, before, limit));
                }
            }
            Shape::Polygon(polygon) => {
                self.scene.add(owner, grown(shape, self.grid, before, limit));
                if !flat || self.band > 0.0 {
                    self.edges(polygon, owner, before, limit);
                }
            }
            Shape::Disc { .. } | Shape::Stroke { .. } | Shape::Arc { .. } => {
                self.scene.add(owner, grown(shape, self.grid, before, limit));
            }
        }
    }

    /// By how much what is drawn begins farther out than copper, and where it ends, in pixels.
    fn reach(&self, flat: bool) -> (f32, Option<f32>) {
        if flat { (0.0, Some(self.band)) } else { (-self.band, self.limit.map(|limit| limit + self.band)) }
    }

    /// The paper's approximate core medial axis (§III-D), its copper above it where asked
    /// (§III-D.2).
    fn core(&mut self, feature: &Feature, owner: Label, min_width: bool) {
        self.copper(&core(feature), owner, false);
        if min_width {
            self.copper(&feature.shape, owner, true);
        }
    }

    fn edges(&mut self, polygon: &Polygon, owner: Label, offset: f32, limit: Option<f32>) {
        for ring in polygon.contours() {
            let coarse = coarse(ring, self.grid.pitch().to_f64() * COARSE);
            let next = coarse.iter().cycle().skip(1);
            for (&from, &to) in coarse.iter().zip(next) {
                let [from, to] = [from, to].map(|i| self.grid.pixel(ring[i]));
                let curtain =
                    Surface::Curtain { from, to, caps: Caps::Start, sides: Sides::Both, offset, limit };
                self.scene.add(owner, curtain);
            }
        }
    }
}
