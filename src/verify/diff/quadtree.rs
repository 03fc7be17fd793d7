//! Where one program cuts and the other does not, however narrow: squares that are quartered until
//! each is settled.
//!
//! A square that no cut comes near, or that the other program cuts all of, is nothing. One that a
//! cut is all of, and that nothing else comes near, is all a difference. Others are quartered, with
//! what comes near to them alone; of pixels a share differs, by how far the edges of either are
//! from the middle. By depth, squares that only the cuts come near are nothing, and others that are
//! less deep count for nothing but for being there.
//!
//! ```text
//!   ┌───────┬───┬───┐
//!   │       │   │ ╱ │
//!   │       ├─┬─┼╱──┤
//!   │       │ │╱│   │
//!   └───────┴─┴─┴───┘
//! ```

use std::cmp::Ordering;
use std::f64::consts::SQRT_2;
use std::ops::Range;

use crate::grid::Grid;
use crate::verify::edges::{Spot, length};

use super::capsule::Capsule;
use super::cuts::By;

/// Cuts are looked for in others where there are no more pairs, and in squares of so many pixels
/// along a side at least. Chosen: half and twice as many make hardly a difference.
const PAIRS: usize = 4096;
const SIDE: u32 = 16;
/// Into so many parts a side of a pixel is divided at most where cuts are narrower. Chosen.
const FINE: f64 = 8.0;

/// How much of each pixel of a grid, row by row, `cuts` are and all `others` are farther away from
/// than `tolerance`; or `by` depth where others are, but none as deep: from 0 to 1.
pub(super) fn shares(grid: &Grid, by: By, cuts: &[Capsule], others: &[Capsule], tolerance: f64) -> Vec<f32> {
    let (first, all) = (cuts.len(), cuts.len() + others.len());
    let pitch = grid.pitch().to_f64();
    let narrowest = cuts.iter().chain(others).map(Capsule::kerf).fold(f64::INFINITY, f64::min);
    let mut tree = Quadtree {
        by,
        corner: grid.corner(0, 0).to_f64(),
        pitch,
        finest: (pitch / 4.0).min(narrowest / 16.0),
        size: (grid.width(), grid.height()),
        tolerance,
        deepest: cuts.iter().map(|cut| cut.depth).fold(0.0, f64::max),
        near: [cuts, others].concat(),
        shares: vec![0.0; grid.width() as usize * grid.height() as usize],
    };
    let side = grid.width().max(grid.height()).next_power_of_two();
    let near = Near { cuts: 0..first, others: first..all, depth: f64::NEG_INFINITY };
    tree.quarter((0, 0), side, &near);
    tree.shares
}

struct Quadtree {
    by: By,
    /// The upper left corner.
    corner: Spot,
    pitch: f64,
    /// Of squares so wide the middle tells how deep they are cut. Chosen.
    finest: f64,
    /// Columns and rows.
    size: (u32, u32),
    tolerance: f64,
    /// How deep the deepest cut is.
    deepest: f64,
    /// What comes near to a square, behind what comes near to those that it is a quarter of.
    near: Vec<Capsule>,
    shares: Vec<f32>,
}

/// What comes near to a square: where they are among all that are near.
struct Near {
    cuts: Range<usize>,
    others: Range<usize>,
    /// How deep others that are none of these cut all of it; less than any where there are none.
    depth: f64,
}

/// What is known of a square.
enum Verdict {
    /// Nothing differs.
    Same,
    /// All of it does.
    Differs,
    Open(Near),
}

impl Quadtree {
    /// Settles `side` by `side` pixels from one on.
    fn quarter(&mut self, (column, row): (u32, u32), side: u32, near: &Near) {
        if column >= self.size.0 || row >= self.size.1 {
            return;
        }
        let half = f64::from(side) * self.pitch / 2.0;
        let (left, top) = (f64::from(column) * self.pitch, f64::from(row) * self.pitch);
        let center = (self.corner.0 + left + half, self.corner.1 - top - half);
        if side == 1 {
            let share = match self.by {
                By::Copper => self.share(center, self.pitch, near),
                By::Depth => self.deeper(center, self.pitch, near),
            };
            self.fill((column, row), side, share);
            return;
        }
        let before = self.near.len();
        match self.verdict(center, half * SQRT_2, near, side >= SIDE) {
            Verdict::Same => {}
            Verdict::Differs => self.fill((column, row), side, 1.0),
            Verdict::Open(near) => {
                let half = side / 2;
                for (right, down) in [(0, 0), (half, 0), (0, half), (half, half)] {
                    self.quarter((column + right, row + down), half, &near);
                }
            }
        }
        self.near.truncate(before);
    }

    fn fill(&mut self, (column, row): (u32, u32), side: u32, share: f32) {
        let (right, bottom) = ((column + side).min(self.size.0), (row + side).min(self.size.1));
        for row in row..bottom {
            let start = row as usize * self.size.0 as usize;
            self.shares[start + column as usize..start + right as usize].fill(share);
        }
    }

    /// What there is to say of all that is within `reach` of a place; where `thoroughly`, cuts are
    /// looked for in others, too.
    fn verdict(&mut self, center: Spot, reach: f64, near: &Near, thoroughly: bool) -> Verdict {
        let (start, mut depth) = (self.near.len(), near.depth);
        for other in near.others.clone() {
            let other = self.near[other];
            match other.side(center, reach, self.tolerance) {
                Ordering::Less if other.depth >= self.deepest => return Verdict::Same,
                Ordering::Less => depth = depth.max(other.depth),
                Ordering::Equal => self.near.push(other),
                Ordering::Greater => {}
            }
        }
        let end = self.near.len();
        if self.by == By::Depth && depth == f64::NEG_INFINITY && start == end {
            return Verdict::Same;
        }
        for cut in near.cuts.clone() {
            let cut = self.near[cut];
            match cut.side(center, reach, 0.0) {
                _ if cut.depth <= depth => {}
                Ordering::Less if start == end => return Verdict::Differs,
                Ordering::Less | Ordering::Equal => self.near.push(cut),
                Ordering::Greater => {}
            }
        }
        let pairs = (end - start) * (self.near.len() - end);
        if thoroughly && (1..=PAIRS).contains(&pairs) {
            let (others, cuts) = self.near[start..].split_at(end - start);
            let is_covered = |cut: &Capsule| cut.is_covered(center, reach, others, self.tolerance);
            let open: Vec<Capsule> = cuts.iter().filter(|cut| !is_covered(cut)).copied().collect();
            self.near.truncate(end);
            self.near.extend(open);
        }
        if self.near.len() == end {
            return Verdict::Same;
        }
        Verdict::Open(Near { cuts: end..self.near.len(), others: start..end, depth })
    }

    /// How much of a square is cut by others, but less deep.
    fn deeper(&mut self, center: Spot, side: f64, near: &Near) -> f32 {
        if side <= self.finest {
            return if self.is_deeper(center, near) { 1.0 } else { 0.0 };
        }
        let before = self.near.len();
        let share = match self.verdict(center, side / SQRT_2, near, false) {
            Verdict::Same => 0.0,
            Verdict::Differs => 1.0,
            Verdict::Open(near) => {
                let shares = quarters(center, side).map(|place| self.deeper(place, side / 2.0, &near));
                shares.into_iter().sum::<f32>() / 4.0
            }
        };
        self.near.truncate(before);
        share
    }

    fn is_deeper(&self, place: Spot, near: &Near) -> bool {
        let deepest = |all: &Range<usize>, more: f64| {
            let there = self.near[all.clone()].iter().filter(|capsule| capsule.beyond(place) <= more);
            there.map(|capsule| capsule.depth).fold(f64::NEG_INFINITY, f64::max)
        };
        let others = near.depth.max(deepest(&near.others, self.tolerance));
        others > f64::NEG_INFINITY && deepest(&near.cuts, 0.0) > others
    }

    /// How much of a square the cuts are and others are not, if no more than one straight edge of
    /// either crosses it; it is quartered where it is wider than a cut. Both edges are as far from
    /// the middle as is measured there; one that another cut lies across is none.
    ///
    /// ```text
    ///   ┌──────────╱─────╱┐
    ///   │ others  ╱ ▒▒▒▒╱ │
    ///   │        ╱ ▒▒▒▒╱  │
    ///   └───────╱─────╱───┘
    /// ```
    #[expect(clippy::cast_possible_truncation, reason = "a share needs no more digits")]
    fn share(&self, center: Spot, side: f64, near: &Near) -> f32 {
        let (cuts, others) = (&self.near[near.cuts.clone()], &self.near[near.others.clone()]);
        let is_narrow = |cut: &Capsule| cut.kerf() < side;
        if side > self.pitch / FINE && cuts.iter().chain(others).any(is_narrow) {
            let shares = quarters(center, side).map(|place| self.share(place, side / 2.0, near));
            return shares.into_iter().sum::<f32>() / 4.0;
        }
        let Some((cut, beyond)) = nearest(center, cuts) else { return 0.0 };
        let out = cut.off(center);
        let cut_share = within(beyond, out, side);
        if cut_share <= 0.0 {
            return 0.0;
        }
        let Some((other, beyond)) = nearest(center, others) else { return cut_share as f32 };
        let beyond = beyond - self.tolerance;
        let other_out = other.off(center);
        let other_share = within(beyond, other_out, side);
        if beyond < 0.0 && (other_share >= 1.0 || !self.is_edge(center, other, others)) {
            return 0.0;
        }
        let is_same_way = out.0 * other_out.0 + out.1 * other_out.1 > 0.0;
        let share = if is_same_way { cut_share - other_share } else { cut_share.min(1.0 - other_share) };
        share.max(0.0) as f32
    }

    /// Whether the nearest place to `place` where `deepest` ends is cut by no other.
    fn is_edge(&self, place: Spot, deepest: &Capsule, others: &[Capsule]) -> bool {
        let out = deepest.outwards(place, self.tolerance + 1.0);
        others.iter().all(|other| other.beyond(out) > self.tolerance)
    }
}

/// The middles of the quarters of a square.
fn quarters((x, y): Spot, side: f64) -> [Spot; 4] {
    let off = side / 4.0;
    [(x - off, y + off), (x + off, y + off), (x - off, y - off), (x + off, y - off)]
}

/// How much of a square, so wide, lies within an edge that its middle is so far beyond; `out` is
/// the way across the edge.
fn within(beyond: f64, out: Spot, side: f64) -> f64 {
    let length = length(out);
    // As wide as the square is, seen along the edge.
    let width = if length > 0.0 { side * (out.0.abs() + out.1.abs()) / length } else { side };
    (0.5 - beyond / width).clamp(0.0, 1.0)
}

/// The capsule that a place is least beyond, and how far.
fn nearest(place: Spot, all: &[Capsule]) -> Option<(&Capsule, f64)> {
    let mut nearest: Option<(&Capsule, f64)> = None;
    for capsule in all {
        let most = nearest.map_or(f64::INFINITY, |(_, beyond)| beyond);
        if capsule.is_within(place, most) {
            nearest = Some((capsule, capsule.beyond(place)));
        }
    }
    nearest
}
