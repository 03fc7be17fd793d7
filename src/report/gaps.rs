//! Gaps that the kerf does not fit: one entry a side, and none for what verification tells anyway.
//!
//! The planner warns of each gap. A board of fine pitch has a hundred of them, all alike; and what
//! the cuts take there `verify` finds again, measured on the programs themselves. A person wants to
//! know how bad it is at worst, how often, and where: one entry, with all places in the JSON.

use crate::board::diagnostic::planning;
use crate::geometry::Nm;
use crate::verify::{Settings, check};

use super::document::{Document, WarningEntry};
use super::quantity::Millimetres;

/// Copper that nobody misses: so much, or this part of the kerf. Chosen: no mill is as true.
const SLIGHT: Nm = Nm::from_um(1);
const SLIGHT_PART: i64 = 100;
/// How much less verification may measure: paths are rounded, and boundaries fitted.
const FIT: Nm = Nm::from_um(3);

impl Document {
    /// Makes one entry a side of all gaps that the finest `kerf` does not fit, and only counts
    /// those that it all but fits.
    #[must_use]
    pub fn with_gaps_merged(mut self, kerf: Nm) -> Self {
        let limit = Settings::default().gouge;
        let slight = SLIGHT.max(kerf / SLIGHT_PART);
        let lost = |entry: &WarningEntry| {
            entry.size_mm.filter(|_| *entry.kind == planning::GAP_NARROWER_THAN_TOOL).map(|lost| lost.0)
        };
        for layer in &mut self.layers {
            let is_slight = |entry: &WarningEntry| {
                entry.side == Some(layer.side) && lost(entry).is_some_and(|lost| lost <= slight)
            };
            layer.negligible_gaps = self.warnings.iter().filter(|entry| is_slight(entry)).count();
            self.warnings.retain(|entry| !is_slight(entry));
            // What verification tells of apart from what it does not.
            for deep in [true, false] {
                let is_same = |entry: &WarningEntry| {
                    entry.side == Some(layer.side) && lost(entry).is_some_and(|lost| (lost > limit) == deep)
                };
                merge(&mut self.warnings, is_same);
            }
        }
        self
    }

    /// Leaves out the gaps whose places are among what verification found: they are its
    /// explanation.
    pub fn leave_out_explained_gaps(&mut self) {
        let limit = Settings::default().gouge;
        let Some(verdict) = &self.verification else { return };
        let is_found = |entry: &WarningEntry, lost: Nm| {
            let mut gouges =
                verdict.findings.iter().filter(|f| f.code == check::GOUGE.code && f.side == entry.side);
            gouges.any(|gouge| gouge.size_mm.is_some_and(|Millimetres(depth)| depth + FIT >= lost))
        };
        self.warnings.retain(|entry| {
            let lost = entry
                .size_mm
                .filter(|lost| *entry.kind == planning::GAP_NARROWER_THAN_TOOL && lost.0 > limit);
            lost.is_none_or(|lost| !is_found(entry, lost.0))
        });
    }
}

/// Leaves of all entries that are the same the worst, where the first was, with the places of the
/// others.
fn merge(entries: &mut Vec<WarningEntry>, is_same: impl Fn(&WarningEntry) -> bool) {
    let same: Vec<WarningEntry> = entries.iter().filter(|entry| is_same(entry)).cloned().collect();
    let Some(first) = entries.iter().position(&is_same).filter(|_| same.len() > 1) else { return };
    let size = |entry: &WarningEntry| entry.size_mm.map(|size| size.0);
    let worst = (0..same.len()).reduce(|a, b| if size(&same[b]) > size(&same[a]) { b } else { a });
    let worst = worst.expect("there are some");
    let others = same.iter().enumerate().filter(|(at, _)| *at != worst);
    let places = others.filter_map(|(_, entry)| entry.at).collect();
    let message =
        format!("{} gaps are narrower than the kerf; where it is worst {}", same.len(), same[worst].message);
    entries.retain(|entry| !is_same(entry));
    entries.insert(first, WarningEntry { message, places, ..same[worst].clone() });
}
