//! Pixels that differ, gathered: what hangs together is one region, however little of each differs.

use std::collections::BTreeMap;

use crate::grid::Grid;
use crate::verify::pieces::{Joiner, Part, Run};

use super::{Change, Region};

/// Pixels that are looked at together. Chosen.
const SOME: usize = 32;

/// Neighbouring pixels of a row that differ.
#[derive(Clone, Copy)]
pub(super) struct Strip {
    run: Run,
    /// Of how many pixels' area.
    area: f64,
    /// The column where most differs, and how much.
    most: (f32, u32),
}

/// What differs in a row of pixels, of which the first is in this column.
pub(super) fn strips(column: u32, shares: &[f32]) -> Vec<Strip> {
    let mut strips: Vec<Strip> = Vec::new();
    for (first, some) in (column..).step_by(SOME).zip(shares.chunks(SOME)) {
        // Most do not differ, which is told of all at a time.
        if some.iter().fold(false, |any, &share| any | (share > 0.0)) {
            for (at, &share) in (first..).zip(some).filter(|(_, share)| **share > 0.0) {
                match strips.last_mut().filter(|strip| strip.run.end == at) {
                    Some(strip) => {
                        strip.run.end += 1;
                        strip.area += f64::from(share);
                        if share > strip.most.0 {
                            strip.most = (share, at);
                        }
                    }
                    None => {
                        let run = Run { start: at, end: at + 1, label: 0 };
                        strips.push(Strip { run, area: share.into(), most: (share, at) });
                    }
                }
            }
        }
    }
    strips
}

/// What is known of a region.
#[derive(Clone, Copy, Default)]
struct Sum {
    /// Of how many pixels' area it is.
    area: f64,
    /// The column and row where most differs, and how much.
    most: (f32, (u32, u32)),
}

impl Sum {
    fn add(&mut self, other: Self) {
        self.area += other.area;
        if other.most.0 > self.most.0 {
            self.most = other.most;
        }
    }
}

/// Differences of one kind, joined row by row.
pub(super) struct Joined {
    change: Change,
    joiner: Joiner,
    /// Of each of the joiner's regions.
    sums: Vec<Sum>,
}

impl Joined {
    pub(super) fn new(change: Change) -> Self {
        Self { change, joiner: Joiner::default(), sums: Vec::new() }
    }

    pub(super) fn row(&mut self, row: u32, strips: impl Iterator<Item = Strip>) {
        let strips: Vec<Strip> = strips.collect();
        let runs: Vec<Run> = strips.iter().map(|strip| strip.run).collect();
        self.joiner.row(row, &runs);
        for ((_, region), strip) in self.joiner.last().iter().zip(strips) {
            let region = *region as usize;
            self.sums.resize(self.sums.len().max(region + 1), Sum::default());
            let (share, column) = strip.most;
            self.sums[region].add(Sum { area: strip.area, most: (share, (column, row)) });
        }
    }

    /// All regions, each with the column and row of a pixel where it differs most.
    pub(super) fn regions(mut self, grid: &Grid) -> Vec<(Region, (u32, u32))> {
        let mut sums: BTreeMap<u32, Sum> = BTreeMap::new();
        for (region, sum) in (0..).zip(&self.sums) {
            sums.entry(self.joiner.find(region)).or_default().add(*sum);
        }
        let mm2 = grid.pitch().to_mm() * grid.pitch().to_mm();
        let region = |part: Part| {
            let sum = sums.get(&part.piece).copied().unwrap_or_default();
            let rect = part.extent.rect(grid);
            (Region { change: self.change, rect, area: sum.area * mm2, depths: None }, sum.most.1)
        };
        self.joiner.parts().into_iter().map(region).collect()
    }
}
