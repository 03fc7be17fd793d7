//! Distances to the edges of areas, by an index of boxes.

use static_aabb2d_index::StaticAABB2DIndex;

use crate::geometry::{Polygon, between, part_nearest, spanned};

use super::boxes::boxes;

/// A point in nanometres.
type Spot = (f64, f64);

/// The edges of areas.
pub(super) struct Edges {
    edges: Vec<(Spot, Spot)>,
    tree: Option<StaticAABB2DIndex<f64>>,
}

/// A search begins with this, in nanometres, and doubles. Chosen.
const FIRST: f64 = 50_000.0;

/// Places nearer to each other than this lie side by side, in nanometres. Chosen: the resolution of
/// coordinates.
const NEXT: f64 = 0.5;

/// No place is so far from an edge. In nanometres: ten metres. Chosen.
const FAR: f64 = 1e10;

impl Edges {
    pub(super) fn new(areas: &[Polygon]) -> Self {
        let edges: Vec<(Spot, Spot)> =
            areas.iter().flat_map(Polygon::edges).map(|(a, b)| (a.to_f64(), b.to_f64())).collect();
        let tree = boxes(edges.iter().map(|&(a, b)| spanned(a, b)));
        Self { edges, tree }
    }

    /// Where the horizontal line at `y` crosses edges.
    pub(super) fn crossings(&self, y: f64) -> Vec<f64> {
        let mut found = Vec::new();
        self.visit([-FAR, y, FAR, y], |(a, b)| {
            if (a.1 > y) != (b.1 > y) {
                found.push(a.0 + (y - a.1) / (b.1 - a.1) * (b.0 - a.0));
            }
        });
        found
    }

    fn visit(&self, [left, bottom, right, top]: [f64; 4], mut show: impl FnMut((Spot, Spot))) {
        if let Some(tree) = &self.tree {
            tree.visit_query(left, bottom, right, top, &mut |i: usize| show(self.edges[i]));
        }
    }

    /// Whether a place lies within the areas.
    pub(super) fn hold(&self, p: Spot) -> bool {
        self.crossings(p.1).into_iter().filter(|&x| x < p.0).count() % 2 == 1
    }

    /// How near a straight way comes to an edge, if nearer than `reach`; zero where it crosses one.
    pub(super) fn nearest_to_way(&self, [a, b]: [Spot; 2], reach: f64) -> Option<f64> {
        let mut best = reach;
        let (left, right) = (a.0.min(b.0) - reach, a.0.max(b.0) + reach);
        let (bottom, top) = (a.1.min(b.1) - reach, a.1.max(b.1) + reach);
        self.visit([left, bottom, right, top], |(c, d)| {
            let off = |p: Spot, a: Spot, b: Spot| {
                let foot = foot(p, a, b);
                length((p.0 - foot.0, p.1 - foot.1))
            };
            let ends = off(a, c, d).min(off(b, c, d)).min(off(c, a, b)).min(off(d, a, b));
            best = best.min(if cross([a, b], [c, d]) { 0.0 } else { ends });
        });
        (best < reach).then_some(best)
    }

    /// The distance to the nearest edge, and its nearest point.
    pub(super) fn nearest(&self, p: Spot) -> (f64, Spot) {
        let mut reach = FIRST;
        loop {
            let best = self.within(p, reach);
            if best.0 <= reach || reach > FAR {
                return best;
            }
            reach *= 2.0;
        }
    }

    /// The same among the edges within `reach`.
    fn within(&self, p: Spot, reach: f64) -> (f64, Spot) {
        let mut best = (f64::INFINITY, p);
        self.visit([p.0 - reach, p.1 - reach, p.0 + reach, p.1 + reach], |(a, b)| {
            let foot = foot(p, a, b);
            let distance = length((p.0 - foot.0, p.1 - foot.1));
            if distance < best.0 {
                best = (distance, foot);
            }
        });
        best
    }

    /// How far one can go from `foot` through `p` while nothing else is nearer than it by more than
    /// `slack`; as far as `p` where that is next to it.
    pub(super) fn farthest(&self, p: Spot, distance: f64, foot: Spot, slack: f64) -> f64 {
        if distance < NEXT {
            return distance;
        }
        let way = ((p.0 - foot.0) / distance, (p.1 - foot.1) / distance);
        let is_free = |far: f64| {
            let at = (foot.0 + way.0 * far, foot.1 + way.1 * far);
            self.within(at, far).0 >= far - slack
        };
        let (mut free, mut blocked) = (distance, 2.0 * distance);
        while is_free(blocked) {
            if blocked > FAR {
                return free;
            }
            (free, blocked) = (blocked, 2.0 * blocked);
        }
        while blocked - free > NEXT {
            let middle = f64::midpoint(free, blocked);
            if is_free(middle) { free = middle } else { blocked = middle }
        }
        free
    }
}

/// The point of a line from `a` to `b` nearest to `p`.
fn foot(p: Spot, a: Spot, b: Spot) -> Spot {
    between(a, b, part_nearest(p, a, b))
}

/// Whether two lines cross between their ends.
fn cross([a, b]: [Spot; 2], [c, d]: [Spot; 2]) -> bool {
    let side = |p: Spot, q: Spot, r: Spot| (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

pub(super) fn length((x, y): Spot) -> f64 {
    (x * x + y * y).sqrt()
}
