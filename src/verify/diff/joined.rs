//! Pixels that differ, gathered: what hangs together is one region, however little of each differs.

use std::collections::BTreeMap;

use crate::grid::Grid;
use crate::verify::pieces::{Joiner, Part, Run};

use super::{Change, Region};

/// Pixels that are looked at together. Chosen.
const SOME: usize = 32;

/// Neighbouring pixels of a row that differ, and of how many pixels' area.
pub(super) type Strip = (Run, f64);

/// What differs in a row of pixels, of which the first is in this column.
pub(super) fn strips(column: u32, shares: &[f32]) -> Vec<Strip> {
    let mut strips: Vec<Strip> = Vec::new();
    for (first, some) in (column..).step_by(SOME).zip(shares.chunks(SOME)) {
        // Most do not differ, which is told of all at a time.
        if some.iter().fold(false, |any, &share| any | (share > 0.0)) {
            for (at, &share) in (first..).zip(some).filter(|(_, share)| **share > 0.0) {
                match strips.last_mut().filter(|(run, _)| run.end == at) {
                    Some((run, area)) => {
                        run.end += 1;
                        *area += f64::from(share);
                    }
                    None => strips.push((Run { start: at, end: at + 1, label: 0 }, share.into())),
                }
            }
        }
    }
    strips
}

/// Differences of one kind, joined row by row.
pub(super) struct Joined {
    change: Change,
    joiner: Joiner,
    /// Of how many pixels' area each of the joiner's regions is.
    areas: Vec<f64>,
}

impl Joined {
    pub(super) fn new(change: Change) -> Self {
        Self { change, joiner: Joiner::default(), areas: Vec::new() }
    }

    pub(super) fn row(&mut self, row: u32, strips: impl Iterator<Item = Strip>) {
        let (runs, areas): (Vec<Run>, Vec<f64>) = strips.unzip();
        self.joiner.row(row, &runs);
        for ((_, region), area) in self.joiner.last().iter().zip(areas) {
            let region = *region as usize;
            self.areas.resize(self.areas.len().max(region + 1), 0.0);
            self.areas[region] += area;
        }
    }

    pub(super) fn regions(mut self, grid: &Grid) -> Vec<Region> {
        let mut areas: BTreeMap<u32, f64> = BTreeMap::new();
        for (region, area) in (0..).zip(&self.areas) {
            *areas.entry(self.joiner.find(region)).or_default() += area;
        }
        let mm2 = grid.pitch().to_mm() * grid.pitch().to_mm();
        let region = |part: Part| Region {
            change: self.change,
            rect: part.extent.rect(grid),
            area: areas.get(&part.piece).map_or(0.0, |area| area * mm2),
        };
        self.joiner.parts().into_iter().map(region).collect()
    }
}
