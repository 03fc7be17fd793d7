//! Straight motions of tools below the surface, by place and by how deep they mill.

use crate::geometry::{Point, spanned};

use super::Placement;
use super::boxes::Tree;
use super::cutter::Cone;
use super::edges::{Spot, length};

/// A straight motion of a tool below the surface, in nanometres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep {
    pub(super) from: Spot,
    pub(super) to: Spot,
    /// How deep the tip is at either end, downwards.
    pub(super) depths: [f64; 2],
    pub(super) cone: Cone,
}

/// Sweeps by place, round the ways of their tips.
pub(super) struct Sweeps {
    sweeps: Vec<Sweep>,
    /// Each box knows the deepest tip in it, and a cone as wide as all.
    tree: Option<Tree<(f64, Cone)>>,
}

impl Sweeps {
    /// Sweeps, numbered as they come.
    pub(super) fn new(sweeps: Vec<Sweep>) -> Self {
        let known = |sweep: &Sweep| (sweep.deepest(), sweep.cone);
        let boxes = sweeps.iter().map(|sweep| (spanned(sweep.from, sweep.to), known(sweep)));
        let tree = Tree::new(boxes, |a, b| (a.0.max(b.0), a.1.and(b.1)));
        Self { sweeps, tree }
    }

    /// All of them, in order.
    pub(super) fn all(&self) -> &[Sweep] {
        &self.sweeps
    }

    /// Shows every sweep that may mill a place of a window (left, bottom, right, top) deeper than
    /// `depth`, with its number. What `show` says is the depth from then on.
    pub(super) fn deeper_than(
        &self,
        mut depth: f64,
        window: [f64; 4],
        mut show: impl FnMut(usize, &Sweep) -> f64,
    ) {
        let Some(tree) = &self.tree else { return };
        tree.visit(|tips, &(deepest, cone), number| {
            let across = (tips[0] - window[2]).max(window[0] - tips[2]).max(0.0);
            let along = (tips[1] - window[3]).max(window[1] - tips[3]).max(0.0);
            let may_be_deeper = cone.below(deepest, length((across, along))) > depth;
            if let Some(number) = number.filter(|_| may_be_deeper) {
                depth = show(number, &self.sweeps[number]);
            }
            may_be_deeper
        });
    }
}

impl Sweep {
    /// Takes it from the machine to the board.
    pub(super) fn lay(&mut self, placement: &Placement) {
        let undo = |(x, y): Spot| placement.undo(Point::from_f64(x, y)).to_f64();
        [self.from, self.to] = [self.from, self.to].map(undo);
    }

    /// How deep the deeper of its ends is.
    const fn deepest(&self) -> f64 {
        self.depths[0].max(self.depths[1])
    }

    /// Left, bottom, right, top of what it mills at the surface.
    pub(super) fn bounds(&self) -> [f64; 4] {
        let reach = self.cone.blunt + self.deepest().max(0.0) * self.cone.flank;
        [
            self.from.0.min(self.to.0) - reach,
            self.from.1.min(self.to.1) - reach,
            self.from.0.max(self.to.0) + reach,
            self.from.1.max(self.to.1) + reach,
        ]
    }

    /// How deep it mills at a place; less than zero where it does not.
    ///
    /// With the tip a way s along, that is D + k s − max(ρ − blunt, 0) / flank, ρ being how far off
    /// the place is: concave in s, so it is greatest at an end, where ρ is the tip's radius, or
    /// where the slope of the cone is that of the way.
    pub(super) fn depth(&self, p: Spot) -> f64 {
        let way = (self.to.0 - self.from.0, self.to.1 - self.from.1);
        let whole = length(way);
        let off = (p.0 - self.from.0, p.1 - self.from.1);
        if whole <= 0.0 {
            return self.cone.below(self.deepest(), length(off));
        }
        let along = (off.0 * way.0 + off.1 * way.1) / whole;
        let across = (off.0 * way.1 - off.1 * way.0).abs() / whole;
        if (self.depths[1] - self.depths[0]).abs() <= 0.0 {
            return self.cone.below(self.depths[0], length((along - along.clamp(0.0, whole), across)));
        }
        let rise = (self.depths[1] - self.depths[0]) / whole;
        let blunt = self.cone.blunt;
        let flat = (blunt * blunt - across * across).max(0.0).sqrt();
        let steep = rise * self.cone.flank;
        let slope = if steep.abs() < 1.0 { across * steep / (1.0 - steep * steep).sqrt() } else { 0.0 };
        [0.0, whole, along, along - flat, along + flat, along + slope]
            .into_iter()
            .map(|s| {
                let s = s.clamp(0.0, whole);
                let off = length((along - s, across));
                self.cone.below(self.depths[0] + rise * s, off)
            })
            .fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;
    use crate::topology::random;

    /// The closed form beside many places along the way.
    #[test]
    fn a_sweep_mills_what_its_places_mill() {
        for (depths, blunt, flank) in
            [([1e5, 4e5], 5e4, 0.5), ([4e5, 1e5], 0.0, 0.3), ([2e5, 2e5], 1e5, 1.0), ([0.0, 9e5], 2e4, 1.5)]
        {
            let sweep = Sweep { from: (0.0, 0.0), to: (3e5, 4e5), depths, cone: Cone { blunt, flank } };
            for i in 0..40_i32 {
                let p = (f64::from(i * 7919 % 61) * 1e4 - 1e5, f64::from(i * 104_729 % 67) * 1e4 - 1e5);
                let one = |t: f64| {
                    let off = length((p.0 - 3e5 * t, p.1 - 4e5 * t));
                    sweep.cone.below(depths[0] + (depths[1] - depths[0]) * t, off)
                };
                let brute = (0..=20_000_i32).map(|t| one(f64::from(t) / 20_000.0)).fold(f64::MIN, f64::max);
                let exact = sweep.depth(p);
                assert!(exact >= brute - 1e-6 && exact - brute < 60.0, "{p:?}: {exact} and {brute} nm");
            }
        }
    }

    /// Among few and many sweeps of several tools, from a place to the next, beside asking each.
    #[test]
    fn the_deepest_sweep_of_a_place_is_found() {
        let mut random = random();
        for count in [0, 1, 15, 16, 17, 300, 5_000] {
            let mut number = |below: i64| Nm::new(random(below)).to_f64();
            let mut sweep = || Sweep {
                from: (number(50_000_000), number(50_000_000)),
                to: (number(50_000_000), number(50_000_000)),
                depths: [number(4_000_000) - 1e6, number(4_000_000) - 1e6],
                cone: Cone { blunt: number(2) * 3e5, flank: number(3) * 0.7 },
            };
            let sweeps: Vec<Sweep> = (0..count).map(|_| sweep()).collect();
            let sweeps = Sweeps::new(sweeps);
            let mut looked_at = 0;
            for _ in 0..100 {
                let p = (number(50_000_000), number(50_000_000));
                let (mut found, mut shown) = (0.0_f64, 0);
                sweeps.deeper_than(0.0, [p.0, p.1, p.0, p.1], |_, sweep| {
                    shown += 1;
                    found = found.max(sweep.depth(p));
                    found
                });
                let brute = sweeps.all().iter().map(|sweep| sweep.depth(p)).fold(0.0, f64::max);
                assert!((found - brute).abs() < 1e-6, "{count} sweeps: {found} and {brute} nm");
                looked_at += shown;
            }
            assert!(looked_at <= 100 * count.min(1_000), "{looked_at} of {count} sweeps");
        }
    }
}
