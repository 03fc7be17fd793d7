//! The edges of an area, which the tool keeps off on ways between cuts.
//!
//! What is cleared is known as discs, and how much of the tool meets what is not. Of a sharp tip of
//! an island it meets next to nothing, however deep it cuts into it: so ways are held against the
//! edges themselves.

use crate::geometry::{BoxTree, Polygon, between, part_nearest, spanned};
use crate::toolpath::strategy::pocket::course::{Spot, distance};

/// So much nearer than it may the tool comes to an edge, in nanometres: what fitting and rounding
/// leave of the places where ways begin and end. Chosen.
const NEARER: f64 = 1_000.0;

/// The edges of an area by place.
pub(super) struct Wall {
    edges: Vec<[Spot; 2]>,
    tree: BoxTree,
    /// How far the tool's middle keeps off them, in nanometres.
    distance: f64,
}

impl Wall {
    pub(super) fn new(area: &Polygon, distance: f64) -> Self {
        let edges: Vec<[Spot; 2]> = area.edges().map(|(a, b)| [a.to_f64(), b.to_f64()]).collect();
        let tree = BoxTree::new(edges.iter().map(|&[a, b]| spanned(a, b)));
        Self { edges, tree, distance: distance - NEARER }
    }

    /// Whether the tool's middle keeps off all edges on a straight way.
    pub(super) fn is_free(&self, from: Spot, to: Spot) -> bool {
        let [left, bottom, right, top] = spanned(from, to);
        let by = self.distance;
        let near = self.tree.within([left - by, bottom - by, right + by, top + by]);
        near.into_iter().all(|i| apart([from, to], self.edges[i]) >= by)
    }
}

/// How far apart two straight lines are.
fn apart([a, b]: [Spot; 2], [c, d]: [Spot; 2]) -> f64 {
    if is_parted([a, b], [c, d]) && is_parted([c, d], [a, b]) {
        return 0.0;
    }
    let off = |p: Spot, from: Spot, to: Spot| distance(p, between(from, to, part_nearest(p, from, to)));
    off(a, c, d).min(off(b, c, d)).min(off(c, a, b)).min(off(d, a, b))
}

/// Whether the ends of a line lie on either side of another.
fn is_parted([a, b]: [Spot; 2], [c, d]: [Spot; 2]) -> bool {
    let is_left = |p: Spot| (d.0 - c.0) * (p.1 - c.1) > (d.1 - c.1) * (p.0 - c.0);
    is_left(a) != is_left(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Nm, Point};

    #[test]
    fn a_way_beside_a_sharp_tip_keeps_off_it() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        // Two degrees wide.
        let tip = Polygon::new(vec![vec![at(0, 0), at(10_000, -175), at(10_000, 175)]]).expect("a spike");
        let wall = Wall::new(&tip, 250_000.0);
        let way = |x: f64| wall.is_free((x, -3e6), (x, 3e6));
        assert!(way(-250_000.0) && way(-249_500.0), "beside it");
        assert!(!way(-248_000.0) && !way(0.0) && !way(5e6), "too near, and across it");
        assert!(wall.is_free((0.0, 500_000.0), (1e7, 500_000.0)), "along it");
    }
}
