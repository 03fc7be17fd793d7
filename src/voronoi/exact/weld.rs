//! Points that all but meet: what rounding leaves of one.
//!
//! Files round to whole nanometres, or to tens of them, so that the end of a line and the start of
//! the arc that goes on from it may lie next to each other, and two strokes one beside the other.
//! Distances to what they are the ends of then differ by less than anybody can tell, over areas as
//! large as the board. No cut shows so little: the two are one.

use rustc_hash::FxHashMap;

use crate::geometry::Point;

/// Points nearer to each other than this along both axes are one, in nanometres. Chosen: twice what
/// five decimals of a millimetre leave, a hundredth of what a cut may be off.
const NEAR: i64 = 20;

/// Where points that lie near another are moved to: the first of these, in the order of x and y.
pub(super) fn welded(mut points: Vec<Point>) -> FxHashMap<Point, Point> {
    points.sort_unstable();
    points.dedup();
    let cell = |p: Point| [p.x, p.y].map(|nm| nm.get().div_euclid(NEAR));
    let mut firsts: FxHashMap<[i64; 2], Point> = FxHashMap::default();
    let mut moved = FxHashMap::default();
    for p in points {
        let [x, y] = cell(p);
        let near = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        let near = near.filter_map(|cell| firsts.get(&cell).copied());
        let is_near = |first: &Point| [first.x - p.x, first.y - p.y].iter().all(|off| off.abs().get() < NEAR);
        // A cell holds one at most, for any two in it are near.
        match near.filter(is_near).min() {
            Some(first) => drop(moved.insert(p, first)),
            None => drop(firsts.insert([x, y], p)),
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::new(x), Nm::new(y))
    }

    #[test]
    fn what_all_but_meets_is_one_and_nothing_moves_far() {
        let points = vec![at(15, 0), at(0, 0), at(30, 0), at(1_000, 0), at(1_000, 14), at(1_000, 35)];
        let moved = welded(points);
        assert_eq!(moved.get(&at(15, 0)), Some(&at(0, 0)), "to the first");
        assert_eq!(moved.get(&at(30, 0)), None, "30 nm from the first, whatever lies between");
        assert_eq!(moved.get(&at(1_000, 14)), Some(&at(1_000, 0)), "across cells");
        assert_eq!(moved.len(), 2, "the others stay: {moved:?}");
    }
}
