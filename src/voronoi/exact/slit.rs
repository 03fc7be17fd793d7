//! Slits: where the edge of a polygon comes back along itself.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//!   ▓▓▓▓▓╭───╮▓▓▓▓▓▓▓▓▓
//!   ▓▓▓▓▓│   ├──────────
//!   ▓▓▓▓▓╰───╯▓▓▓▓▓▓▓▓▓
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//! ```
//!
//! Programs that draw holes as part of one ring lead it in and out again along a slit, which is as
//! wide as their rounding: nothing, or a few nanometres. No cutter goes there, and to either side
//! of its mouth distances differ by less than anybody can tell. So the two sides are one, and none.
//!
//! Vertices that all but meet become one, edges are parted where they all but run through one, and
//! what then runs both ways is left out. A polygon without slits stays as it is.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use crate::geometry::{BoxTree, Point};
use crate::voronoi::plane::{Spot, spanned};

/// Slits are no wider, in nanometres. Chosen: several times what six decimals of a millimetre
/// leave, a fiftieth of a micrometre.
const WIDE: f64 = 20.0;

/// An edge: where from, where to, and which of the polygon's own it is part of.
type Part = (Point, Point, u32);

/// `rings` with copper on the left, without their slits.
pub(super) fn without_slits(rings: Vec<Vec<Point>>) -> Vec<Vec<Point>> {
    let edges = Edges::new(&rings);
    if !edges.any_meet() {
        return rings;
    }
    let (kept, left_out) = cancelled(edges.parted());
    if left_out.is_empty() || kept.is_empty() {
        return rings;
    }
    traced(kept, &left_out)
}

/// The edges of rings by place.
struct Edges {
    ends: Vec<[Point; 2]>,
    tree: BoxTree,
}

impl Edges {
    fn new(rings: &[Vec<Point>]) -> Self {
        let ring = |ring: &Vec<Point>| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(&from, &to)| [from, to]).collect::<Vec<_>>()
        };
        let ends: Vec<[Point; 2]> = rings.iter().flat_map(ring).collect();
        let tree = BoxTree::new(ends.iter().map(|&[a, b]| {
            let [left, bottom, right, top] = spanned(a.into(), b.into());
            [left - WIDE, bottom - WIDE, right + WIDE, top + WIDE]
        }));
        Self { ends, tree }
    }

    /// The edges that all but run through `p`.
    fn near(&self, p: Point) -> impl Iterator<Item = usize> {
        let at = Spot::from(p);
        let mut found = self.tree.within([at.x, at.y, at.x, at.y]);
        found.retain(|&i| self.is_near(i, at));
        found.into_iter()
    }

    fn is_near(&self, edge: usize, at: Spot) -> bool {
        let [a, b] = self.ends[edge].map(Spot::from);
        at.distance_to_chord(a, b) <= WIDE
    }

    /// Whether the edge comes near itself anywhere but at its corners.
    fn any_meet(&self) -> bool {
        let is_met = |&[p, _]: &[Point; 2]| {
            let (at, mut near) = (Spot::from(p), 0);
            self.tree.visit_window([at.x, at.y, at.x, at.y], |i| near += u32::from(self.is_near(i, at)));
            near > 2
        };
        self.ends.iter().any(is_met)
    }

    /// The edges between vertices that are apart, parted where they run through others.
    fn parted(&self) -> Vec<Part> {
        // The first vertex in order is the place of all that all but meet it.
        let mut vertices: Vec<Point> = self.ends.iter().map(|ends| ends[0]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut place: FxHashMap<Point, Point> = FxHashMap::default();
        for &vertex in &vertices {
            let near = self.near(vertex).flat_map(|i| self.ends[i]);
            let meets = |other: &Point| {
                *other < vertex && place.contains_key(other) && vertex.distance(*other) <= WIDE
            };
            let first = near.filter(meets).min().map_or(vertex, |other| place[&other]);
            place.insert(vertex, first);
        }
        let mut through: Vec<Vec<Point>> = vec![Vec::new(); self.ends.len()];
        for &vertex in &vertices {
            self.near(vertex).for_each(|i| through[i].push(place[&vertex]));
        }
        let mut parts = Vec::with_capacity(self.ends.len());
        for ((number, ends), mut through) in (0_u32..).zip(&self.ends).zip(through) {
            let [from, to] = ends.map(|end| place[&end]);
            let (begin, way) = (Spot::from(from), Spot::from(to) - Spot::from(from));
            let along = |at: &Point| (Spot::from(*at) - begin).dot(way);
            through.retain(|at| *at != from && *at != to && (0.0..way.dot(way)).contains(&along(at)));
            through.sort_by(|a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
            through.dedup();
            let mut last = from;
            for next in through.into_iter().chain([to]).filter(|&next| next != from) {
                parts.push((last, next, number));
                last = next;
            }
        }
        parts
    }
}

/// What is left when edges that run both ways are left out, and the ends of these.
fn cancelled(parts: Vec<Part>) -> (Vec<Part>, Vec<Point>) {
    let mut ways: FxHashMap<(Point, Point), i32> = FxHashMap::default();
    let key = |&(from, to, _): &Part| (from.min(to), from.max(to));
    let way = |&(from, to, _): &Part| if from < to { 1 } else { -1 };
    parts.iter().for_each(|part| *ways.entry(key(part)).or_default() += way(part));
    let (mut kept, mut left_out) = (Vec::with_capacity(parts.len()), Vec::new());
    for part in parts {
        let more = ways.entry(key(&part)).or_default();
        if *more * way(&part) > 0 {
            *more -= way(&part);
            kept.push(part);
        } else {
            left_out.extend([part.0, part.1]);
        }
    }
    left_out.sort_unstable();
    left_out.dedup();
    (kept, left_out)
}

/// The rings of edges. Where more than two meet, the next is the first counter-clockwise of where
/// one came from: no edge lies in the free space between the two.
fn traced(parts: Vec<Part>, mouths: &[Point]) -> Vec<Vec<Point>> {
    let mut leaving: BTreeMap<Point, Vec<usize>> = BTreeMap::new();
    for (i, part) in parts.iter().enumerate() {
        leaving.entry(part.0).or_default().push(i);
    }
    let mut rings = Vec::new();
    let mut is_used = bitvec::bitvec![0; parts.len()];
    for first in 0..parts.len() {
        let mut ring: Vec<Part> = Vec::new();
        let mut next = Some(first);
        while let Some(i) = next.filter(|&i| !is_used[i]) {
            is_used.set(i, true);
            ring.push(parts[i]);
            let back = Spot::from(parts[i].0) - Spot::from(parts[i].1);
            let onward = leaving.get(&parts[i].1).into_iter().flatten().copied();
            let turn = |&i: &usize| {
                let way = Spot::from(parts[i].1) - Spot::from(parts[i].0);
                let angle = super::form::turn(back, way);
                // Straight back is last.
                if angle > 0.0 { angle } else { 4.0 }
            };
            let open = onward.filter(|&i| !is_used[i]);
            next = open.min_by(|a, b| turn(a).total_cmp(&turn(b)).then(a.cmp(b)));
        }
        if ring.len() > 1 {
            rings.push(smooth(&ring, mouths));
        }
    }
    rings
}

/// The corners of a ring, without those that parted an edge and those at the mouth of a slit that
/// are none.
fn smooth(ring: &[Part], mouths: &[Point]) -> Vec<Point> {
    let n = ring.len();
    let is_corner = |&i: &usize| {
        let (before, part) = (ring[(i + n - 1) % n], ring[i]);
        let is_mouth = mouths.binary_search(&part.0).is_ok();
        let off = || Spot::from(part.0).distance_to_chord(before.0.into(), part.1.into());
        before.2 != part.2 && !(is_mouth && off() <= WIDE)
    };
    (0..n).filter(is_corner).map(|i| ring[i].0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    fn ring(points: &[(i64, i64)]) -> Vec<Point> {
        points.iter().map(|&(x, y)| Point::new(Nm::new(x), Nm::new(y))).collect()
    }

    /// From the lowest point on, the lowest ring first.
    fn sorted(mut rings: Vec<Vec<Point>>) -> Vec<Vec<Point>> {
        for ring in &mut rings {
            let lowest = (0..ring.len()).min_by_key(|&i| ring[i]).unwrap();
            ring.rotate_left(lowest);
        }
        rings.sort();
        rings
    }

    /// A square with a square hole, and a slit to it that is `up` wide and begins so far from its
    /// place.
    fn keyhole(up: i64, off: i64) -> Vec<Vec<Point>> {
        vec![ring(&[
            (0, 0),
            (9_000, 0),
            (9_000 + off, 4_000),
            (6_000, 4_000),
            (6_000, 3_000),
            (3_000, 3_000),
            (3_000, 6_000),
            (6_000, 6_000),
            (6_000, 4_000 + up),
            (9_000, 4_000 + up),
            (9_000, 9_000),
            (0, 9_000),
        ])]
    }

    #[test]
    fn a_hole_in_one_ring_with_its_outside_becomes_a_ring() {
        let outside = ring(&[(0, 0), (9_000, 0), (9_000, 9_000), (0, 9_000)]);
        let hole = ring(&[(3_000, 3_000), (3_000, 6_000), (6_000, 6_000), (6_000, 3_000)]);
        for (up, off) in [(0, 0), (2, 0), (-2, 0), (2, 1), (0, -1)] {
            let found = sorted(without_slits(keyhole(up, off)));
            assert_eq!(found, sorted(vec![outside.clone(), hole.clone()]), "{up} nm wide, {off} nm off");
        }
    }

    #[test]
    fn what_has_no_slit_stays_as_it_is() {
        // Two squares that meet at a corner, and a notch that is wide enough.
        let pinched = ring(&[
            (0, 0),
            (5_000, 0),
            (5_000, 5_000),
            (9_000, 5_000),
            (9_000, 9_000),
            (5_000, 9_000),
            (5_000, 5_000),
            (0, 5_000),
        ]);
        for rings in [keyhole(100, 0), vec![pinched]] {
            assert_eq!(without_slits(rings.clone()), rings);
        }
    }

    #[test]
    fn a_notch_without_a_mouth_is_none() {
        let notched = ring(&[
            (0, 0),
            (9_000, 0),
            (9_000, 9_000),
            (5_003, 9_000),
            (5_001, 2_000),
            (5_000, 9_001),
            (0, 9_000),
        ]);
        let found = without_slits(vec![notched]);
        assert_eq!(sorted(found), vec![ring(&[(0, 0), (9_000, 0), (9_000, 9_000), (0, 9_000)])]);
    }
}
