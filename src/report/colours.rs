//! How Algorithm 2 looked at a layer, and how likely its colours were to be confused.

use serde::Serialize;

use crate::topology::{Odds, Translucency};

use super::quantity::Millimetres;
use crate::board::diagnostic::count;

/// What the paper's translucent picture was and how far it is to be trusted (§III-A.2).
#[derive(Clone, Debug, Serialize)]
pub struct ColoursEntry {
    /// The side of a pixel of the picture.
    pub pixel_mm: Millimetres,
    /// Where its random colours began.
    pub seed: u64,
    /// Pixels at which traces were picked and merged.
    pub picks: usize,
    /// The most traces on one pixel.
    pub most_on_a_pixel: usize,
    /// How likely it was to miss an overlap by a confusion of colours.
    pub odds: Odds,
}

impl ColoursEntry {
    /// What is to be said of `found`.
    #[must_use]
    pub const fn new(found: &Translucency) -> Self {
        Self {
            pixel_mm: Millimetres(found.sampling.pitch),
            seed: found.sampling.seed,
            picks: found.overlaps.len(),
            most_on_a_pixel: found.deepest,
            odds: found.odds,
        }
    }

    /// As a person reads it, in one line.
    pub(super) fn to_text(&self) -> String {
        let Odds { base, mixed } = self.odds;
        format!(
            "  seed {}, at most {} on a pixel; odds of a confusion with one trace's colour {base:.1e}, of two mixes {mixed:.1e}\n",
            self.seed,
            count(self.most_on_a_pixel, "trace")
        )
    }
}
