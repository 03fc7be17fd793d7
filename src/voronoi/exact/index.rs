//! Generators by place: what comes near a place, what is nearest to it, and the breaks of discs.

use std::ops::ControlFlow;

use bitvec::vec::BitVec;
use static_aabb2d_index::StaticAABB2DIndex;

use super::form::{Form, Place};
use super::generator::Generators;
use super::tolerances::SLAB;
use crate::geometry;
use crate::voronoi::plane::Spot;

/// So far from a foot its normal is looked at, in nanometres. Chosen.
const AHEAD: f64 = 1_000.0;

/// A corner so near to an edge lies on it, in nanometres. Chosen: more than rounding, less than
/// what shaking leaves.
const ON: f64 = 1e-3;

/// A box is so much nearer than what lies in it by rounding at most, in nanometres. Chosen.
const NEARER: f64 = 1.0;

/// An arc has no more pieces. Derived: eighths, and what is left of one.
const OF_ARC: usize = 9;

/// How far a box is from a place, squared.
#[inline]
fn squared([left, bottom, right, top]: [f64; 4], p: Spot) -> f64 {
    let out = |low: f64, high: f64, at: f64| {
        if at < low {
            low - at
        } else if at > high {
            at - high
        } else {
            0.0
        }
    };
    let (x, y) = (out(left, right, p.x), out(bottom, top, p.y));
    x * x + y * y
}

/// Whether two boxes meet.
#[inline]
fn overlap([a, b, c, d]: [f64; 4], [left, bottom, right, top]: [f64; 4]) -> bool {
    a <= right && c >= left && b <= top && d >= bottom
}

/// Generators by place, with the breaks of discs.
///
/// A long slanted line and a large arc are known by pieces, for a box round all of one would lie
/// over much that they are far from.
pub(super) struct Index {
    boxes: Vec<[f64; 4]>,
    /// Of each box the generator, and how many boxes of it came before.
    pieces: Vec<(u32, u32)>,
    tree: Option<StaticAABB2DIndex<f64>>,
    /// Whether nothing has its foot on generator `i` alone.
    hidden: BitVec,
    /// The breaks of generator `i`: `breaks[starts[i]..starts[i + 1]]`.
    breaks: Vec<Place>,
    starts: Vec<u32>,
}

impl Index {
    pub(super) fn new(generators: &Generators) -> Self {
        let (mut boxes, mut pieces) = (Vec::new(), Vec::new());
        for (number, form) in (0_u32..).zip(&generators.forms) {
            for (before, piece) in (0_u32..).zip(form.pieces()) {
                boxes.push(piece.bounds());
                pieces.push((number, before));
            }
        }
        let tree = geometry::boxes(boxes.iter().copied());
        let hidden = BitVec::repeat(false, generators.len());
        let mut index = Self { boxes, pieces, tree, hidden, breaks: Vec::new(), starts: Vec::new() };
        index.hidden = index.hidden_corners(generators);
        index
    }

    /// Which corners lie on the edge of other copper of their owner: that edge is no farther from
    /// anywhere. Two of them a nanometre apart, as pads leave that overlap by so little, would have
    /// an axis between them that leads into the copper.
    fn hidden_corners(&self, generators: &Generators) -> BitVec {
        let is_hidden = |(i, form): (usize, &Form)| {
            let Form::Circle { center, radius: 0.0, .. } = *form else { return false };
            let mut is_hidden = false;
            self.visit_round(center, ON, |other| {
                let (edge, owner) = (&generators.forms[other as usize], generators.owners[other as usize]);
                let is_corner = matches!(edge, Form::Circle { radius: 0.0, .. });
                is_hidden |= !is_corner
                    && owner == generators.owners[i]
                    && edge.distance(center).abs() <= ON
                    && edge.slack(center) > ON;
            });
            is_hidden
        };
        generators.forms.iter().enumerate().map(is_hidden).collect()
    }

    /// Finds all breaks where distances that differ by less than `tie` are equal.
    pub(super) fn find_breaks(&mut self, generators: &Generators, tie: f64) {
        let mut found = self.touching_ends(generators, tie);
        found.sort_by_key(|(generator, _)| *generator);
        let starts = (0_u32..).take(generators.len() + 1).map(|i| found.partition_point(|&(of, _)| of < i));
        self.starts = starts.map(|at| u32::try_from(at).expect("below 2³² breaks")).collect();
        self.breaks = found.into_iter().map(|(_, place)| place).collect();
    }

    /// The places on generators where a line or an arc ends with the same foot and normal. A disc
    /// on its own has two all the same, so that no loop round it is without a vertex.
    fn touching_ends(&self, generators: &Generators, tie: f64) -> Vec<(u32, Place)> {
        let mut found: Vec<(u32, Place)> = Vec::new();
        let mut counts = vec![0_u32; generators.len()];
        for (i, form) in (0_u32..).zip(&generators.forms) {
            for place in form.ends().into_iter().flatten() {
                let (foot, normal) = form.foot(place);
                // A disc of no radius has its normal a little way off.
                let ahead = foot + normal * AHEAD;
                self.visit_round(foot, tie, |other| {
                    let touched = &generators.forms[other as usize];
                    let touches = touched.distance(foot).abs() <= tie
                        && touched.slack(ahead) >= -SLAB
                        && touched.away(ahead).dot(normal) > 1.0 - 1e-9;
                    if other != i && touches {
                        found.push((other, touched.place(ahead)));
                        counts[other as usize] += 1;
                    }
                });
            }
        }
        for (i, (form, &count)) in (0_u32..).zip(generators.forms.iter().zip(&counts)) {
            if count < 2 && matches!(form, Form::Circle { sector: None, .. }) {
                found.extend([1.0, -1.0].map(|x| (i, Place::Toward(Spot::new(x, 0.0)))));
            }
        }
        found
    }

    /// Shows the generators of which a box meets a box, left, bottom, right, top, each once.
    pub(super) fn visit(&self, within: [f64; 4], mut show: impl FnMut(u32)) {
        let _: ControlFlow<()> = self.visit_where(
            |bounds| overlap(bounds, within),
            |generator| {
                show(generator);
                ControlFlow::Continue(())
            },
        );
    }

    /// Shows the generators of which a box comes within `reach` of `p`, each once.
    pub(super) fn visit_round(&self, p: Spot, reach: f64, mut show: impl FnMut(u32)) {
        let within = [p.x - reach, p.y - reach, p.x + reach, p.y + reach];
        // Most boxes are told by the square round the circle.
        let _: ControlFlow<()> = self.visit_where(
            |bounds| overlap(bounds, within) && squared(bounds, p) <= reach * reach,
            |generator| {
                show(generator);
                ControlFlow::Continue(())
            },
        );
    }

    /// Shows the generators of which a box meets another, and comes within `reach` of `p`, each
    /// once, for as long as `show` goes on.
    pub(super) fn visit_both<B>(
        &self,
        within: [f64; 4],
        (p, reach): (Spot, f64),
        show: impl FnMut(u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        self.visit_where(|bounds| overlap(bounds, within) && squared(bounds, p) <= reach * reach, show)
    }

    /// Shows the generators of which a box meets a condition, each once, for as long as `show` goes
    /// on. What holds two boxes meets it if either does; and of boxes in a straight row those that
    /// meet it are in a row, as with all that is convex.
    fn visit_where<B>(
        &self,
        meets: impl Fn([f64; 4]) -> bool,
        mut show: impl FnMut(u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let Some(tree) = &self.tree else { return ControlFlow::Continue(()) };
        let (boxes, numbers, levels) = (tree.all_boxes(), tree.all_box_indices(), tree.level_bounds());
        let leaves = levels[0];
        let mut open = Vec::with_capacity(64);
        let mut next = Some((numbers[boxes.len() - 1], levels.len() - 2));
        while let Some((first, level)) = next {
            let end = (first + tree.node_size()).min(levels[level]);
            let numbers = &numbers[first..end];
            for (i, bounds) in boxes[first..end].iter().enumerate() {
                if !meets([bounds.min_x, bounds.min_y, bounds.max_x, bounds.max_y]) {
                    continue;
                }
                if first >= leaves {
                    open.push((numbers[i], level - 1));
                } else if let Some(generator) = self.shown(numbers[i], &meets) {
                    show(generator)?;
                }
            }
            next = open.pop();
        }
        ControlFlow::Continue(())
    }

    /// The generator of a box that meets a condition, if no box of it did before.
    fn shown(&self, number: usize, meets: impl Fn([f64; 4]) -> bool) -> Option<u32> {
        let (generator, before) = self.pieces[number];
        let before = before as usize;
        if before == 0 {
            return (!self.hidden[generator as usize]).then_some(generator);
        }
        // The pieces of a line are in a straight row.
        let first = number - if before < OF_ARC { before } else { 1 };
        let is_first = !self.boxes[first..number].iter().any(|&bounds| meets(bounds));
        (is_first && !self.hidden[generator as usize]).then_some(generator)
    }

    /// Shows generators, some more than once, the nearer boxes first but for those together in one
    /// of the tree, until all that are left are farther from `p` than `show` says that anything
    /// still matters.
    pub(super) fn visit_nearest(&self, p: Spot, mut show: impl FnMut(u32) -> f64) {
        let Some(tree) = &self.tree else { return };
        let (boxes, numbers, levels) = (tree.all_boxes(), tree.all_box_indices(), tree.level_bounds());
        let leaves = levels[0];
        // Farther squared than this nothing matters.
        let mut limit = f64::INFINITY;
        let mut open = Vec::with_capacity(64);
        open.push((0.0, numbers[boxes.len() - 1], levels.len() - 2));
        while let Some((off, first, level)) = open.pop() {
            if off > limit {
                continue;
            }
            let end = (first + tree.node_size()).min(levels[level]);
            let before = open.len();
            for (bounds, &number) in boxes[first..end].iter().zip(&numbers[first..end]) {
                let off = squared([bounds.min_x, bounds.min_y, bounds.max_x, bounds.max_y], p);
                if off > limit {
                    continue;
                }
                if first >= leaves {
                    open.push((off, number, level - 1));
                    continue;
                }
                let (generator, _) = self.pieces[number];
                if !self.hidden[generator as usize] {
                    let reach = show(generator) + NEARER;
                    limit = reach * reach;
                }
            }
            open[before..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
    }

    /// The box round all generators.
    pub(super) fn bounds(&self) -> [f64; 4] {
        let far = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        self.boxes.iter().fold(far, |[a, b, c, d], [left, bottom, right, top]| {
            [a.min(*left), b.min(*bottom), c.max(*right), d.max(*top)]
        })
    }

    /// The places on a generator where another one begins or ends.
    pub(super) fn breaks(&self, generator: u32) -> &[Place] {
        let i = generator as usize;
        &self.breaks[self.starts[i] as usize..self.starts[i + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::Shape;
    use crate::geometry::{Nm, Point};

    /// Traces at all angles, up to 60 mm long, some arcs of circles among their ends.
    fn generators() -> Generators {
        let mut generators = Generators::default();
        let mut state = 24;
        let mut below = |bound: u64| {
            state = crate::topology::splitmix(state);
            Nm::new(i64::try_from(state % bound).expect("small"))
        };
        for owner in 0..40 {
            let mut point = || Point::new(below(60_000_000), below(60_000_000));
            let (from, to) = (point(), point());
            let radius = Nm::new(if owner % 2 == 0 { 100_000 } else { 3_000_000 });
            generators.add(&Shape::Stroke { from, to, radius }, owner);
        }
        generators
    }

    fn places() -> impl Iterator<Item = Spot> {
        (0..400_i32).map(|i| Spot::new(f64::from(i % 20) * 4e6 - 1e7, f64::from(i / 20) * 4e6 - 1e7))
    }

    #[test]
    fn what_is_nearest_is_found_among_long_slanted_pieces() {
        let generators = generators();
        let index = Index::new(&generators);
        for p in places() {
            let off = |form: &Form| form.off(p);
            let brute = generators.forms.iter().map(off).fold(f64::INFINITY, f64::min);
            let mut nearest = f64::INFINITY;
            index.visit_nearest(p, |i| {
                nearest = nearest.min(off(&generators.forms[i as usize]));
                nearest
            });
            assert!((nearest - brute).abs() < 1e-6, "{nearest} is not {brute} at {p:?}");
        }
    }

    #[test]
    fn what_comes_near_is_shown_once() {
        let generators = generators();
        let index = Index::new(&generators);
        for (p, reach) in places().zip([3e5, 3e6, 3e7].into_iter().cycle()) {
            let mut shown = vec![0; generators.len()];
            index.visit_round(p, reach, |i| shown[i as usize] += 1);
            for (form, &count) in generators.forms.iter().zip(&shown) {
                assert!(count <= 1, "shown {count} times");
                assert!(count == 1 || form.off(p) > reach, "overlooked at {p:?}");
            }
        }
    }
}
