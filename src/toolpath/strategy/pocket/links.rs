//! The ways between neighbouring loops, and the shortest one through what is milled.
//!
//! ```text
//!   ─────────●───────── level 0      A *spoke* leads from a place of a loop straight to the edge: as far as the levels are apart it lies
//!            │ spoke                 within what the mill clears along the loop. Across the axis, where two loops of a level have
//!   ─────────●───────── level 1      no loop between them, the shortest way joins them.
//!     milled already
//! ```

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::geometry::{BoxTree, between, part_nearest, spanned};
use crate::toolpath::ordered::Ordered;
use crate::voronoi::medial::nest::Nest;

use super::course::{Course, Spot, distance};

/// A way from a place of a loop to a place of another, straight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hop {
    from: f64,
    to: usize,
    at: f64,
    length: f64,
}

/// How far a spoke may miss the loop it leads to, in nanometres. Chosen: chords and rounding take a
/// tenth of it.
const MISS: f64 = 2_000.0;

/// So many spokes of a loop are kept. Chosen: the way along the loop to the next one is short.
const SPOKES: f64 = 64.0;

/// One part of a route: along a loop from one place to another, and then straight to the next.
pub(super) type Leg = (usize, f64, f64);

/// The loops and what links them.
pub(super) struct Links {
    pub(super) courses: Vec<Course>,
    /// From each loop.
    hops: Vec<Vec<Hop>>,
    /// How far each loop's level is from the one below it, and from the one above.
    gaps: Vec<[f64; 2]>,
    levels: Vec<Level>,
}

/// The segments of the loops of a level, by place.
#[derive(Default)]
struct Level {
    segments: Vec<(usize, usize)>,
    tree: BoxTree,
}

impl Level {
    fn new(segments: Vec<(usize, usize)>, courses: &[Course]) -> Self {
        let ends = |&(number, i): &(usize, usize)| courses[number].segment(i);
        let tree = BoxTree::new(segments.iter().map(ends).map(|[a, b]| spanned(a, b)));
        Self { segments, tree }
    }

    /// Shows the segments within a box of `reach` round `p`.
    fn visit(&self, [p, q]: [Spot; 2], reach: f64, mut show: impl FnMut(usize, usize)) {
        let [left, bottom, right, top] = spanned(p, q);
        self.tree.visit_window([left - reach, bottom - reach, right + reach, top + reach], |found| {
            let (number, i) = self.segments[found];
            show(number, i);
        });
    }

    /// The loop that passes `p`, and how far along it that is.
    fn at(&self, p: Spot, courses: &[Course]) -> Option<(usize, f64)> {
        let mut best: Option<(Ordered, usize, Ordered)> = None;
        self.visit([p, p], MISS, |number, i| {
            let [a, b] = courses[number].segment(i);
            let part = part_nearest(p, a, b);
            let off = distance(p, between(a, b, part));
            let key = (Ordered(off), number, Ordered(courses[number].along(i, part)));
            if off <= MISS && best.is_none_or(|best| key < best) {
                best = Some(key);
            }
        });
        best.map(|(_, number, Ordered(along))| (number, along))
    }
}

impl Links {
    pub(super) fn new(nest: &Nest, level: impl Fn(usize) -> f64) -> Self {
        let courses: Vec<Course> = nest.loops.iter().map(|one| Course::new(one.ring.clone())).collect();
        let count = nest.loops.iter().map(|one| one.level + 1).max().unwrap_or(0);
        let mut segments: Vec<Vec<(usize, usize)>> = vec![Vec::new(); count];
        for (number, one) in nest.loops.iter().enumerate() {
            segments[one.level].extend((0..courses[number].len()).map(|i| (number, i)));
        }
        let levels: Vec<Level> = segments.into_iter().map(|found| Level::new(found, &courses)).collect();
        let gap = |i: usize| level(i + 1) - level(i);
        let gaps = nest.loops.iter().map(|one| {
            let below = one.level.checked_sub(1).map_or(0.0, gap);
            [below, gap(one.level)]
        });
        let gaps = gaps.collect();
        let hops = vec![Vec::new(); courses.len()];
        let mut links = Self { courses, hops, gaps, levels };
        for (number, one) in nest.loops.iter().enumerate().filter(|(_, one)| one.level > 0) {
            links.add_spokes(number, one.level);
        }
        links
    }

    /// Adds the spokes from a loop to those of the level below.
    fn add_spokes(&mut self, number: usize, level: usize) {
        let course = &self.courses[number];
        let apart = course.length() / SPOKES;
        let mut seen: Vec<(usize, f64)> = Vec::new();
        for i in 0..course.len() {
            let along = course.along(i, 0.5);
            let Some((to, at)) = self.spoke(number, level, along, false) else { continue };
            match seen.iter_mut().find(|(loop_seen, _)| *loop_seen == to) {
                Some((_, last)) if along - *last < apart => continue,
                Some((_, last)) => *last = along,
                None => seen.push((to, along)),
            }
            let length = self.gaps[number][0];
            self.hops[number].push(Hop { from: along, to, at, length });
            self.hops[to].push(Hop { from: at, to: number, at: along, length });
        }
    }

    /// Where the spoke at a place of a loop leads: to the loop of the level below, or inwards to
    /// that of the level above, if one passes there.
    pub(super) fn spoke(
        &self,
        number: usize,
        level: usize,
        along: f64,
        inwards: bool,
    ) -> Option<(usize, f64)> {
        let course = &self.courses[number];
        let (p, out) = (course.at(along), course.toward_edge(along)?);
        let [below, above] = self.gaps[number];
        let (far, level) = if inwards { (-above, level + 1) } else { (below, level.checked_sub(1)?) };
        self.levels.get(level)?.at((p.0 + out.0 * far, p.1 + out.1 * far), &self.courses)
    }

    /// Joins the nearest of loops of a level that are milled and of some that are not, no farther
    /// apart than `reach`; whether there are such.
    pub(super) fn join(
        &mut self,
        level: usize,
        reach: f64,
        is_cut: impl Fn(usize) -> bool,
        open: &[usize],
    ) -> bool {
        let mut best: Option<(f64, [(usize, f64); 2])> = None;
        for &number in open {
            for i in 0..self.courses[number].len() {
                let [a, b] = self.courses[number].segment(i);
                self.levels[level].visit([a, b], reach, |other, j| {
                    if !is_cut(other) {
                        return;
                    }
                    let [c, d] = self.courses[other].segment(j);
                    for (p, ours, theirs) in [
                        (a, Some(0.0), None),
                        (b, Some(1.0), None),
                        (c, None, Some(0.0)),
                        (d, None, Some(1.0)),
                    ] {
                        let ours = ours.unwrap_or_else(|| part_nearest(p, a, b));
                        let theirs = theirs.unwrap_or_else(|| part_nearest(p, c, d));
                        let far = distance(between(a, b, ours), between(c, d, theirs));
                        let ends = [
                            (other, self.courses[other].along(j, theirs)),
                            (number, self.courses[number].along(i, ours)),
                        ];
                        if far <= reach && best.is_none_or(|(least, _)| far < least) {
                            best = Some((far, ends));
                        }
                    }
                });
            }
        }
        let Some((length, [(from, leaves), (to, arrives)])) = best else { return false };
        self.hops[from].push(Hop { from: leaves, to, at: arrives, length });
        self.hops[to].push(Hop { from: arrives, to: from, at: leaves, length });
        true
    }

    /// The shortest way from a place of a loop, along loops that are milled and what links them, to
    /// one that is `wanted`: the legs, and where on that loop it ends.
    pub(super) fn route(
        &self,
        (number, along): (usize, f64),
        is_cut: impl Fn(usize) -> bool,
        wanted: impl Fn(usize) -> bool,
    ) -> Option<(Vec<Leg>, (usize, f64))> {
        let mut best: Vec<Option<Reached>> = vec![None; self.courses.len()];
        // By cost, then by loop and place: where each is left from, on which other, comes last.
        let mut open = BinaryHeap::from([Reverse((Ordered(0.0), number, Ordered(along), None))]);
        while let Some(Reverse((Ordered(cost), here, Ordered(along), from))) = open.pop() {
            if best[here].is_some() {
                continue;
            }
            best[here] = Some(Reached { along, from: from.map(|(before, Ordered(left))| (before, left)) });
            if wanted(here) {
                return Some((legs(&best, here), (here, along)));
            }
            for hop in &self.hops[here] {
                if best[hop.to].is_none() && (is_cut(hop.to) || wanted(hop.to)) {
                    let cost = cost + self.courses[here].shorter(along, hop.from).0 + hop.length;
                    let from = Some((here, Ordered(hop.from)));
                    open.push(Reverse((Ordered(cost), hop.to, Ordered(hop.at), from)));
                }
            }
        }
        None
    }
}

/// A loop that is reached: where, and from where on which other.
#[derive(Clone, Copy, Debug)]
struct Reached {
    along: f64,
    from: Option<(usize, f64)>,
}

/// The legs of the way to a loop.
fn legs(best: &[Option<Reached>], mut here: usize) -> Vec<Leg> {
    let mut legs = Vec::new();
    while let Some(Reached { from: Some((before, leaves)), .. }) = best[here] {
        let entered = best[before].map_or(leaves, |reached| reached.along);
        legs.push((before, entered, leaves));
        here = before;
    }
    legs.reverse();
    legs
}
