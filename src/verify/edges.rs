//! Distances to the edges of areas, by an index of boxes.

use static_aabb2d_index::{Control, StaticAABB2DIndex};

use crate::geometry::{Polygon, between, part_nearest, spanned};

use super::boxes::boxes;

/// A point in nanometres.
pub(super) type Spot = (f64, f64);

/// The edges of areas.
pub(super) struct Edges {
    edges: Vec<(Spot, Spot)>,
    tree: Option<StaticAABB2DIndex<f64>>,
}

/// What is nearer is found by a window, in nanometres. Chosen.
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

    /// All of them, each from where to where, the areas on its left.
    pub(super) fn all(&self) -> impl Iterator<Item = [Spot; 2]> + Clone {
        self.edges.iter().map(|&(a, b)| [a, b])
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
        self.nearer(p, FIRST).unwrap_or_else(|| self.nearest_of_all(p))
    }

    /// The same, where none is near: of a wide disc a window has all edges, of which few are the
    /// nearest.
    fn nearest_of_all(&self, p: Spot) -> (f64, Spot) {
        let mut best = (f64::INFINITY, p);
        if let Some(tree) = &self.tree {
            tree.visit_neighbors(p.0, p.1, &mut |edge: usize, squared: f64| {
                if squared >= best.0 {
                    return Control::Break(());
                }
                let (a, b) = self.edges[edge];
                let foot = foot(p, a, b);
                let (x, y) = (p.0 - foot.0, p.1 - foot.1);
                if x * x + y * y < best.0 {
                    best = (x * x + y * y, foot);
                }
                Control::Continue
            });
        }
        (best.0.sqrt(), best.1)
    }

    /// The same of an edge nearer than `reach`, if one is.
    fn nearer(&self, p: Spot, reach: f64) -> Option<(f64, Spot)> {
        let mut best = (reach * reach, None);
        self.visit([p.0 - reach, p.1 - reach, p.0 + reach, p.1 + reach], |(a, b)| {
            let foot = foot(p, a, b);
            let (x, y) = (p.0 - foot.0, p.1 - foot.1);
            let squared = x * x + y * y;
            if squared < best.0 {
                best = (squared, Some(foot));
            }
        });
        best.1.map(|foot| (best.0.sqrt(), foot))
    }

    /// How far one can go from `foot` through `p` while nothing else is nearer than it, and no
    /// farther than `most`; as far as `p` where that is next to it. `last` is how far that was from
    /// a place nearby, and what ended it there, which often ends it here.
    ///
    /// What is nearer to the centre of a disc through `foot` says how small it must be; that one is
    /// looked at next, until nothing is. J. Ma, S. W. Bae, S. Choi, *3D medial axis point
    /// approximation using nearest neighbors and the normal field*, The Visual Computer 28 (2012).
    pub(super) fn farthest(
        &self,
        p: Spot,
        (distance, foot): (f64, Spot),
        most: f64,
        last: &mut Option<(f64, Spot)>,
    ) -> f64 {
        if distance < NEXT {
            return distance;
        }
        let way = ((p.0 - foot.0) / distance, (p.1 - foot.1) / distance);
        // The largest disc that has a place no deeper in it than what is the same.
        let largest = |at: Spot| {
            let (x, y) = (at.0 - foot.0, at.1 - foot.1);
            let ahead = way.0 * x + way.1 * y - NEXT;
            if ahead > 0.0 { (x * x + y * y - NEXT * NEXT) / (2.0 * ahead) } else { f64::INFINITY }
        };
        let (mut far, mut most) = (2.0 * distance, most);
        if let Some((before, at)) = *last {
            (far, most) = (far.max(2.0 * before), most.min(largest(at)));
        }
        let mut ended = None;
        loop {
            far = far.min(most);
            if far <= distance {
                far = distance;
                break;
            }
            let center = (foot.0 + way.0 * far, foot.1 + way.1 * far);
            match self.nearer(center, far - NEXT) {
                None if far >= most || far > FAR => break,
                None => far *= 2.0,
                Some((_, at)) => {
                    // Rounding may leave it where it was.
                    most = largest(at).min(far - NEXT);
                    ended = Some(at);
                }
            }
        }
        *last = ended.or(last.map(|(_, at)| at)).map(|at| (far, at));
        far
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::polarity::union;
    use crate::geometry::{Nm, Point};
    use crate::topology::random;

    /// In areas of random discs, from places in a row, beside going on by halves among all edges.
    #[test]
    fn the_way_from_an_edge_is_as_long_as_halving_finds_it() {
        let mut random = random();
        let mut looked_at = 0;
        for _ in 0..2 {
            let disc = |random: &mut dyn FnMut(i64) -> i64| {
                let center = Point::new(Nm::from_um(random(9_000)), Nm::from_um(random(9_000)));
                Polygon::disc(center, Nm::from_um(800 + random(2_500)), Nm::from_um(1))
            };
            let discs: Vec<Polygon> = (0..9).filter_map(|_| disc(&mut random)).collect();
            let edges = Edges::new(&union(&discs));
            let mut last = None;
            for step in 0..400_i32 {
                let p = (f64::from(step) * 21_017.0, 4_500_123.0);
                if !edges.hold(p) {
                    continue;
                }
                let (distance, nearest) = edges.nearest(p);
                let way = ((p.0 - nearest.0) / distance, (p.1 - nearest.1) / distance);
                let is_free = |far: f64| {
                    let at = (nearest.0 + way.0 * far, nearest.1 + way.1 * far);
                    edges.edges.iter().all(|&(a, b)| {
                        let foot = foot(at, a, b);
                        length((at.0 - foot.0, at.1 - foot.1)) >= far - NEXT
                    })
                };
                let (mut free, mut blocked) = (distance, 2.0 * distance);
                while is_free(blocked) {
                    (free, blocked) = (blocked, 2.0 * blocked);
                }
                while blocked - free > NEXT {
                    let middle = f64::midpoint(free, blocked);
                    if is_free(middle) { free = middle } else { blocked = middle }
                }
                let far = edges.farthest(p, (distance, nearest), f64::INFINITY, &mut last);
                assert!((far - free).abs() <= 2.0 * NEXT, "at {p:?}: {far}, by halves {free}");
                looked_at += 1;
            }
        }
        assert!(looked_at > 400, "{looked_at} places");
    }
}
