//! The place of a segment that is nearest to another place, in floats, for searches and measures
//! whose places lie between whole nanometres.
//!
//! ```text
//!             · p
//!             ┆
//!   a ────────┴───── b      part 0 at a, 1 at b; beyond the ends, the end
//! ```

use super::Point;

/// What part of the way from `a` to `b` the place nearest to `p` is, from 0 to 1; 0 for a segment
/// of no length.
pub(crate) fn part_nearest(p: (f64, f64), a: (f64, f64), b: (f64, f64)) -> f64 {
    let way = (b.0 - a.0, b.1 - a.1);
    let squared = way.0 * way.0 + way.1 * way.1;
    let along = (p.0 - a.0) * way.0 + (p.1 - a.1) * way.1;
    if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// The place that is this part of the way from `a` to `b`.
pub(crate) fn between(a: (f64, f64), b: (f64, f64), part: f64) -> (f64, f64) {
    (a.0 + (b.0 - a.0) * part, a.1 + (b.1 - a.1) * part)
}

/// The way to `p` from the place of the segment nearest to it.
pub(crate) fn off_segment(p: (f64, f64), a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let part = part_nearest(p, a, b);
    (p.0 - a.0 - (b.0 - a.0) * part, p.1 - a.1 - (b.1 - a.1) * part)
}

/// How far a point is from a segment, in nanometres.
pub(crate) fn distance_to_segment(p: Point, (a, b): (Point, Point)) -> f64 {
    let (x, y) = off_segment(p.to_f64(), a.to_f64(), b.to_f64());
    libm::hypot(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_place_lies_between_the_ends() {
        let (a, b) = ((0.0, 0.0), (8.0, 4.0));
        for (p, nearest) in [((2.0, 6.0), (4.0, 2.0)), ((-3.0, 1.0), a), ((9.0, 9.0), b)] {
            assert_eq!(between(a, b, part_nearest(p, a, b)), nearest, "{p:?}");
            assert_eq!(off_segment(p, a, b), (p.0 - nearest.0, p.1 - nearest.1), "from there to {p:?}");
        }
        assert_eq!(between(a, b, part_nearest((5.0, 5.0), a, a)), a, "of no length");
    }
}
