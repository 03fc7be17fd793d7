//! Places along boundaries.

use super::plane::Spot;

/// How far chords may leave a curve, in nanometres. Chosen: less than a tenth of the default
/// fitting tolerance, so that fitting has the rest.
pub(super) const CHORD: f64 = 150.0;
/// How far the clearance may leave its chord between two samples, in nanometres. Chosen.
pub(super) const CLEARANCE_CHORD: f64 = 1_000.0;

/// A place on a boundary, in nanometres, with its clearance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    pub(super) at: Spot,
    pub(super) clearance: f64,
}

impl Sample {
    /// The place so far, from 0 to 1, on the way to another.
    pub(super) fn toward(&self, other: &Self, part: f64) -> Self {
        let between = |a: f64, b: f64| a + (b - a) * part;
        Self {
            at: self.at + (other.at - self.at) * part,
            clearance: between(self.clearance, other.clearance),
        }
    }
}

/// How long the way along samples is, in nanometres.
pub(super) fn length(samples: &[Sample]) -> f64 {
    samples.windows(2).map(|pair| (pair[1].at - pair[0].at).length()).sum()
}
