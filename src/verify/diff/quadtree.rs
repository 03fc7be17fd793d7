//! Where one program cuts and the other does not, however narrow: squares that are quartered until
//! each is settled.
//!
//! A square that no cut comes near, or that the other program cuts all of as deep, is nothing. One
//! that a cut is all of, and that no edge comes near, is all a difference: of copper, or of depth.
//! Others are quartered, with what comes near to them alone; of pixels a share differs, by how far
//! the edges of either are from the middle.
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

/// Cuts are looked for in others where there are no more pairs, and in squares of so many pixels
/// along a side at least. Chosen: half and twice as many make hardly a difference.
const PAIRS: usize = 4096;
const SIDE: u32 = 16;
/// Into so many parts a side of a pixel is divided at most where cuts are narrower. Chosen.
const FINE: f64 = 8.0;
/// Of less than this share of a pixel places are looked at, not edges. Chosen.
const LITTLE: f64 = 0.125;
/// The tangent of the angle up to which edges run alike. Chosen: over a pixel it is a hundredth of
/// what is tolerated.
const ALIKE: f64 = 1e-3;

/// How much of each pixel of a grid, row by row, `cuts` are and all `others` are farther away from
/// than `tolerance`; and how much where others are, but none as deep: from 0 to 1. The latter is
/// empty where none is deeper than any other.
pub(super) fn shares(grid: &Grid, cuts: &[Capsule], others: &[Capsule], tolerance: f64) -> [Vec<f32>; 2] {
    let (first, all) = (cuts.len(), cuts.len() + others.len());
    let pitch = grid.pitch().to_f64();
    let narrowest = cuts.iter().chain(others).map(Capsule::kerf).fold(f64::INFINITY, f64::min);
    let deepest = cuts.iter().map(|cut| cut.depth).fold(0.0, f64::max);
    let may_be_deeper = others.iter().any(|other| other.depth < deepest);
    let pixels = grid.width() as usize * grid.height() as usize;
    let mut tree = Quadtree {
        corner: grid.corner(0, 0).to_f64(),
        pitch,
        finest: (pitch / 4.0).min(narrowest / 16.0),
        size: (grid.width(), grid.height()),
        tolerance,
        deepest,
        near: [cuts, others].concat(),
        missing: vec![0.0; pixels],
        deeper: vec![0.0; if may_be_deeper { pixels } else { 0 }],
    };
    let side = grid.width().max(grid.height()).next_power_of_two();
    let near = Near { cuts: 0..first, others: first..all, depth: f64::NEG_INFINITY };
    tree.quarter((0, 0), side, &near);
    [tree.missing, tree.deeper]
}

struct Quadtree {
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
    missing: Vec<f32>,
    /// Empty where nothing can be.
    deeper: Vec<f32>,
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
    /// Others cut nothing of it.
    Missing,
    /// Others cut all of it less deep.
    Deeper,
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
            self.settle((column, row), center, near);
            return;
        }
        let before = self.near.len();
        match self.verdict(center, half * SQRT_2, near, side >= SIDE) {
            Verdict::Same => {}
            Verdict::Missing => fill(&mut self.missing, self.size, (column, row), side),
            Verdict::Deeper => fill(&mut self.deeper, self.size, (column, row), side),
            Verdict::Open(near) => {
                let half = side / 2;
                for (right, down) in [(0, 0), (half, 0), (0, half), (half, half)] {
                    self.quarter((column + right, row + down), half, &near);
                }
            }
        }
        self.near.truncate(before);
    }

    /// Settles a pixel.
    #[expect(clippy::cast_possible_truncation, reason = "a share needs no more digits")]
    fn settle(&mut self, (column, row): (u32, u32), center: Spot, near: &Near) {
        let at = row as usize * self.size.0 as usize + column as usize;
        let [missing, both] = self.straight(center, self.pitch, near);
        self.missing[at] = missing as f32;
        if !self.deeper.is_empty() {
            let depths = |all: &Range<usize>| self.near[all.clone()].iter().map(|capsule| capsule.depth);
            let (cuts, others) = (depths(&near.cuts), depths(&near.others));
            let all_are = cuts.fold(f64::INFINITY, f64::min) > others.fold(near.depth, f64::max);
            // Two edges that do not quite meet have a little in common if they were straight.
            let is_plain = all_are && (both <= 0.0 || both > LITTLE);
            let share = if is_plain { both } else { self.deeper(center, self.pitch, near) };
            self.deeper[at] = share as f32;
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
        for cut in near.cuts.clone() {
            let cut = self.near[cut];
            match cut.side(center, reach, 0.0) {
                _ if cut.depth <= depth => {}
                Ordering::Less if start == end && depth == f64::NEG_INFINITY => return Verdict::Missing,
                Ordering::Less if start == end => return Verdict::Deeper,
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
    fn deeper(&mut self, center: Spot, side: f64, near: &Near) -> f64 {
        if side <= self.finest {
            return if self.is_deeper(center, near) { 1.0 } else { 0.0 };
        }
        let before = self.near.len();
        let share = match self.verdict(center, side / SQRT_2, near, false) {
            Verdict::Same | Verdict::Missing => 0.0,
            Verdict::Deeper => 1.0,
            Verdict::Open(near) => {
                let shares = quarters(center, side).map(|place| self.deeper(place, side / 2.0, &near));
                shares.into_iter().sum::<f64>() / 4.0
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

    /// How much of a square the cuts are and others are not, and how much both, if no more than one
    /// straight edge of either crosses it; it is quartered where it is wider than a cut.
    fn straight(&self, center: Spot, side: f64, near: &Near) -> [f64; 2] {
        let (cuts, others) = (&self.near[near.cuts.clone()], &self.near[near.others.clone()]);
        let is_narrow = |cut: &Capsule| cut.kerf() < side;
        if side > self.pitch / FINE && cuts.iter().chain(others).any(is_narrow) {
            let quarters = quarters(center, side).map(|place| self.straight(place, side / 2.0, near));
            return [0, 1].map(|which| quarters.iter().map(|share| share[which]).sum::<f64>() / 4.0);
        }
        let Some(cut) = nearest(center, cuts) else { return [0.0, 0.0] };
        let edge = Edge::of(cut, center, 0.0);
        let all = edge.within(side);
        let is_cut = near.depth > f64::NEG_INFINITY;
        let missing = if is_cut || all <= 0.0 { 0.0 } else { self.missing(center, side, edge, others) };
        [missing, all - missing]
    }

    /// How much of a square is within an edge and not within that of others. All edges are as far
    /// from the middle as is measured there; one that another cut lies across is none.
    ///
    /// ```text
    ///   ┌──────────╱─────╱┐
    ///   │ others  ╱ ▒▒▒▒╱ │
    ///   │        ╱ ▒▒▒▒╱  │
    ///   └───────╱─────╱───┘
    /// ```
    fn missing(&self, center: Spot, side: f64, edge: Edge, others: &[Capsule]) -> f64 {
        let all = edge.within(side);
        let edge_of = |other: &Capsule| Edge::of(other, center, self.tolerance);
        let Some(innermost) = nearest(center, others) else { return all };
        let inner = edge_of(innermost);
        if inner.beyond < 0.0 && (inner.within(side) >= 1.0 || !self.is_edge(center, innermost, others)) {
            return 0.0;
        }
        // Of edges that run alike the middle tells exactly which lies within which.
        let near = others.iter().filter(|other| other.is_within(center, self.tolerance + side));
        let alike = near.map(edge_of).filter(|other| other.runs_as(edge));
        let missing = alike.chain([inner]).map(|other| {
            let is_same_way = edge.out.0 * other.out.0 + edge.out.1 * other.out.1 > 0.0;
            let share = other.within(side);
            if is_same_way { all - share } else { all.min(1.0 - share) }
        });
        missing.fold(all, f64::min).max(0.0)
    }

    /// Whether the nearest place to `place` where `innermost` ends is cut by no other.
    fn is_edge(&self, place: Spot, innermost: &Capsule, others: &[Capsule]) -> bool {
        let out = innermost.outwards(place, self.tolerance + 1.0);
        others.iter().all(|other| other.beyond(out) > self.tolerance)
    }
}

/// Marks `side` by `side` pixels from one on.
fn fill(shares: &mut [f32], (width, height): (u32, u32), (column, row): (u32, u32), side: u32) {
    let (right, bottom) = ((column + side).min(width), (row + side).min(height));
    for row in row..bottom {
        let start = row as usize * width as usize;
        shares[start + column as usize..start + right as usize].fill(1.0);
    }
}

/// The middles of the quarters of a square.
fn quarters((x, y): Spot, side: f64) -> [Spot; 4] {
    let off = side / 4.0;
    [(x - off, y + off), (x + off, y + off), (x - off, y - off), (x + off, y - off)]
}

/// The edge of a cut, as it is seen from the middle of a square.
#[derive(Clone, Copy)]
struct Edge {
    /// How far the middle is beyond it.
    beyond: f64,
    /// The way across it.
    out: Spot,
}

impl Edge {
    /// The edge of what is within so much `more` of a cut.
    fn of(cut: &Capsule, center: Spot, more: f64) -> Self {
        let out = cut.off(center);
        Self { beyond: length(out) - cut.kerf() / 2.0 - more, out }
    }

    /// Whether both run along each other, with what is within on the same side.
    fn runs_as(self, other: Self) -> bool {
        let (a, b) = (self.out, other.out);
        let (dot, cross) = (a.0 * b.0 + a.1 * b.1, a.0 * b.1 - a.1 * b.0);
        cross.abs() <= dot * ALIKE
    }

    /// How much of the square, so wide, lies within.
    fn within(self, side: f64) -> f64 {
        let length = length(self.out);
        // As wide as the square is, seen along the edge.
        let width = if length > 0.0 { side * (self.out.0.abs() + self.out.1.abs()) / length } else { side };
        (0.5 - self.beyond / width).clamp(0.0, 1.0)
    }
}

/// The capsule that a place is least beyond.
fn nearest(place: Spot, all: &[Capsule]) -> Option<&Capsule> {
    let mut nearest: Option<(&Capsule, f64)> = None;
    for capsule in all {
        let most = nearest.map_or(f64::INFINITY, |(_, beyond)| beyond);
        if capsule.is_within(place, most) {
            nearest = Some((capsule, capsule.beyond(place)));
        }
    }
    nearest.map(|(capsule, _)| capsule)
}
