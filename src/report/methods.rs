//! How the three ways to find nets compare on a layer, as data and as text.

use std::fmt::Write as _;

use serde::Serialize;

use crate::board::Copper;
use crate::topology::{Differences, Method, Missed, Reason};

use super::colours::ColoursEntry;
use super::quantity::Place;
use crate::board::diagnostic::count;

/// All three methods on one layer.
#[derive(Clone, Debug, Serialize)]
pub struct MethodsEntry {
    /// Nets that shared vertices alone leave (the paper's Algorithm 1).
    pub coincidence: usize,
    /// Nets that overlaps in a picture leave of these (Algorithm 2).
    pub translucency: usize,
    /// Nets by exact contact.
    pub contact: usize,
    /// How the picture was made.
    #[serde(flatten)]
    pub colours: ColoursEntry,
    /// Where copper touches that a method took for two nets.
    pub missed: Vec<MissedEntry>,
}

/// A place where copper touches that a method took for two nets.
#[derive(Clone, Debug, Serialize)]
pub struct MissedEntry {
    /// The method.
    pub by: Method,
    /// Why.
    pub reason: Reason,
    /// The lines of the file that drew the two features.
    pub lines: [u32; 2],
    /// Where they touch.
    pub at: Place,
}

impl MethodsEntry {
    /// The comparison of a layer.
    #[must_use]
    pub fn new(copper: &Copper, differences: &Differences) -> Self {
        let found = &differences.translucency;
        let line = |feature: u32| copper.features[feature as usize].line;
        let missed = |missed: &Missed| MissedEntry {
            by: missed.by,
            reason: missed.reason,
            lines: [line(missed.features.0), line(missed.features.1)],
            at: missed.at.into(),
        };
        Self {
            coincidence: differences.coincidence.nets().len(),
            translucency: found.nets.nets().len(),
            contact: differences.contact.nets().len(),
            colours: ColoursEntry::new(found),
            missed: differences.missed.iter().map(missed).collect(),
        }
    }

    /// As a person reads it; every place and the odds where `verbose`.
    pub(super) fn to_text(&self, verbose: bool) -> String {
        let mut text = format!(
            "  nets by shared vertices {}, by translucency {} (pixels of {:.4} mm, {}), by contact {}\n",
            self.coincidence,
            self.translucency,
            self.colours.pixel_mm.0,
            count(self.colours.picks, "pick"),
            self.contact
        );
        if verbose {
            text.push_str(&self.colours.to_text());
        }
        for (reason, what) in [
            (Reason::NoCommonVertex, "without a common vertex"),
            (Reason::ThinnerThanPixel, "thinner than a pixel"),
            (Reason::ColourCollision, "in a colour seen before"),
        ] {
            let places: Vec<_> = self.missed.iter().filter(|missed| missed.reason == reason).collect();
            if places.is_empty() {
                continue;
            }
            let more = if verbose { "" } else { "; -v lists them" };
            let _ = writeln!(text, "  {} {what}{more}", count(places.len(), "contact"));
            for missed in places.into_iter().filter(|_| verbose) {
                let ([a, b], Place { x_mm, y_mm }) = (missed.lines, &missed.at);
                let _ = writeln!(text, "    lines {a} and {b}, at {:.3}, {:.3} mm", x_mm.0, y_mm.0);
            }
        }
        text
    }
}
