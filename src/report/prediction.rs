//! How long toolpaths will be, as data and as text.

use serde::Serialize;

use crate::board::{Copper, Outline};
use crate::geometry::Nm;
use crate::prediction::{ERRORS, Known};
use crate::topology::{Nets, extents};

use super::quantity::Millimetres;

/// The length of toolpaths by a model, before they are found; frame cuts are left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PredictionEntry {
    /// Between Voronoi regions.
    pub voronoi_mm: Millimetres,
    /// Round every net.
    pub outline_mm: Millimetres,
    /// How much shorter the former are, in percent of the latter; negative where longer.
    pub decrease_percent: f64,
}

impl PredictionEntry {
    /// The prediction for a side whose outlines keep `radius` off; none where it has one net or
    /// less.
    #[must_use]
    pub fn new(copper: &Copper, nets: &Nets, outline: Option<&Outline>, radius: Nm) -> Option<Self> {
        // With nothing to part, how large the nets are need not be worked out.
        if nets.nets().len() < 2 {
            return None;
        }
        let known = Known::new(copper, nets, &extents(copper, nets), outline)?;
        let (voronoi, outline) = (known.voronoi(), known.outline(radius));
        let length = |mm: f64| Millimetres(Nm::from_f64((mm * 1e6).round()));
        let decrease_percent = ((1.0 - voronoi / outline) * 1000.0).round() / 10.0;
        Some(Self { voronoi_mm: length(voronoi), outline_mm: length(outline), decrease_percent })
    }

    /// As a person reads it.
    pub(super) fn to_text(&self) -> String {
        let [usual, most] = ERRORS.map(|error| error * 100.0);
        let (way, percent) = match self.decrease_percent {
            percent if percent < 0.0 => ("longer", -percent),
            percent => ("shorter", percent),
        };
        format!(
            "  predicted: Voronoi {:.0} mm, outlines {:.0} mm, {percent:.0} % {way}; for Voronoi off by less than {usual:.0} % on half of other boards, {most:.0} % on nine in ten\n",
            self.voronoi_mm.0.to_mm(),
            self.outline_mm.0.to_mm(),
        )
    }
}
