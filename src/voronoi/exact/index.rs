//! Generators by place: what comes near a place, and what is nearest to it.

use std::ops::ControlFlow;

use bitvec::vec::BitVec;
use rayon::prelude::*;

use super::form::Form;
use super::generator::Generators;
use crate::geometry::{BoxTree, Region};
use crate::voronoi::plane::Spot;

/// A corner so near to an edge lies on it, in nanometres. Chosen: more than rounding, less than
/// what shaking leaves.
const ON: f64 = 1e-3;

/// Generators by place.
pub(super) struct Index {
    /// A long slanted line and a large arc are known by pieces, for a box round all of one would
    /// lie over much that they are far from.
    tree: BoxTree,
    /// The generator of each box.
    items: Vec<u32>,
    /// Whether nothing has its foot on generator `i` alone.
    hidden: BitVec,
}

impl Index {
    pub(super) fn new(generators: &Generators) -> Self {
        let (mut boxes, mut items) = (Vec::new(), Vec::new());
        for (generator, form) in (0_u32..).zip(&generators.forms) {
            form.add_bounds(&mut boxes);
            items.resize(boxes.len(), generator);
        }
        let tree = BoxTree::new(boxes.iter().copied());
        let hidden = BitVec::repeat(false, generators.len());
        let mut index = Self { tree, items, hidden };
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
        generators.forms.par_iter().enumerate().map(is_hidden).collect::<Vec<bool>>().into_iter().collect()
    }

    /// Shows the generators of which a box meets a box, left, bottom, right, top, some more than
    /// once.
    pub(super) fn visit(&self, within: [f64; 4], show: impl FnMut(u32)) {
        self.visit_region(&self.tree.window(within), show);
    }

    /// Shows the generators of which a box comes within `reach` of `p`, some more than once.
    pub(super) fn visit_round(&self, p: Spot, reach: f64, show: impl FnMut(u32)) {
        self.visit_region(&self.tree.round((p.x, p.y), reach), show);
    }

    /// Shows the generators of which a box comes within `reach` of a chord, and others, some more
    /// than once, for as long as `show` goes on.
    pub(super) fn visit_along(
        &self,
        chord: [Spot; 2],
        reach: f64,
        show: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.visit_while(&self.tree.along(chord.map(|p| (p.x, p.y)), reach), show)
    }

    fn visit_region(&self, region: &impl Region, mut show: impl FnMut(u32)) {
        let _: ControlFlow<()> = self.visit_while(region, |generator| {
            show(generator);
            ControlFlow::Continue(())
        });
    }

    fn visit_while(
        &self,
        region: &impl Region,
        mut show: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.tree.visit(region, |number| {
            let generator = self.items[number];
            if self.hidden[generator as usize] { ControlFlow::Continue(()) } else { show(generator) }
        })
    }

    /// Shows generators within `reach` of `p`, some more than once, the nearer boxes first but for
    /// those together in one node of the tree, until all that are left are farther than `show` says
    /// that anything still matters.
    pub(super) fn visit_nearest(&self, p: Spot, reach: f64, mut show: impl FnMut(u32) -> f64) {
        let mut limit = reach;
        self.tree.visit_nearest((p.x, p.y), reach, |number| {
            let generator = self.items[number];
            if !self.hidden[generator as usize] {
                limit = show(generator);
            }
            limit
        });
    }

    /// The box round all generators: left, bottom, right, top.
    pub(super) const fn bounds(&self) -> [f64; 4] {
        self.tree.bounds()
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
            index.visit_nearest(p, f64::INFINITY, |i| {
                nearest = nearest.min(off(&generators.forms[i as usize]));
                nearest
            });
            assert!((nearest - brute).abs() < 1e-6, "{nearest} is not {brute} at {p:?}");
        }
    }

    #[test]
    fn what_comes_near_is_shown() {
        let generators = generators();
        let index = Index::new(&generators);
        for (p, reach) in places().zip([3e5, 3e6, 3e7].into_iter().cycle()) {
            let mut shown = vec![0; generators.len()];
            index.visit_round(p, reach, |i| shown[i as usize] += 1);
            for (form, &count) in generators.forms.iter().zip(&shown) {
                assert!(count > 0 || form.off(p) > reach, "overlooked at {p:?}");
            }
        }
    }
}
