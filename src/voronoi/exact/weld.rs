//! Points that all but meet: what rounding leaves of one.
//!
//! Files round to whole nanometres, or to tens of them, so that the end of a line and the start of
//! the arc that goes on from it may lie next to each other, and two strokes one beside the other.
//! Distances to what they are the ends of then differ by less than anybody can tell, over areas as
//! large as the board. No cut shows so little: the two are one.

use std::collections::{BTreeSet, VecDeque};

use rustc_hash::FxHashMap;

use crate::geometry::{Nm, Point};

/// Points nearer to each other than this along both axes are one, in nanometres. Chosen: twice what
/// five decimals of a millimetre leave, a hundredth of what a cut may be off.
pub(in crate::voronoi) const NEAR: i64 = 20;

/// Where points that lie nearer to another than `near` nanometres along both axes are moved to: the
/// first of these, in the order of x and y.
pub(super) fn welded(mut points: Vec<Point>, near: i64) -> FxHashMap<Point, Point> {
    points.sort_unstable();
    points.dedup();
    // Those that stay where they are, as far as they may be near what comes: in order, and by y.
    let mut firsts: VecDeque<Point> = VecDeque::new();
    let mut by_y: BTreeSet<(Nm, Nm)> = BTreeSet::new();
    let mut moved = FxHashMap::default();
    let near = Nm::new(near - 1);
    for p in points {
        while let Some(first) = firsts.pop_front_if(|first| p.x - first.x > near) {
            by_y.remove(&(first.y, first.x));
        }
        let beside = by_y.range((p.y - near, p.x - near)..=(p.y + near, p.x));
        match beside.map(|&(y, x)| Point::new(x, y)).min() {
            Some(first) => drop(moved.insert(p, first)),
            None => {
                firsts.push_back(p);
                by_y.insert((p.y, p.x));
            }
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::random;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::new(x), Nm::new(y))
    }

    #[test]
    fn what_all_but_meets_is_one_and_nothing_moves_far() {
        let points = vec![at(15, 0), at(0, 0), at(30, 0), at(1_000, 0), at(1_000, 14), at(1_000, 35)];
        let moved = welded(points, NEAR);
        assert_eq!(moved.get(&at(15, 0)), Some(&at(0, 0)), "to the first");
        assert_eq!(moved.get(&at(30, 0)), None, "30 nm from the first, whatever lies between");
        assert_eq!(moved.get(&at(1_000, 14)), Some(&at(1_000, 0)), "across cells");
        assert_eq!(moved.len(), 2, "the others stay: {moved:?}");
    }

    #[test]
    fn each_is_moved_to_the_first_of_all_before_it_that_stay_and_are_near() {
        let mut next = random();
        let mut points: Vec<Point> = (0..2000).map(|_| at(next(600), next(600))).collect();
        let moved = welded(points.clone(), NEAR);
        points.sort_unstable();
        points.dedup();
        let mut firsts: Vec<Point> = Vec::new();
        for p in points {
            let off = |first: &Point| (first.x - p.x).abs().max((first.y - p.y).abs());
            let first = firsts.iter().filter(|first| off(first) < Nm::new(NEAR)).min().copied();
            assert_eq!(moved.get(&p), first.as_ref(), "{p:?}");
            firsts.extend(first.is_none().then_some(p));
        }
    }
}
