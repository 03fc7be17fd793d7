//! Chords finer than those that curves are flattened into.
//!
//! ```text
//!     •─•─•─•─•              ╭───────╮
//!   •╱         ╲•     →     ╱         ╲    a circle of thousands of chords:
//!  •             •         •           •   as many are one as all lie near it
//! ```
//!
//! All edges of a circle meet in its middle, so that each bisector looks at each edge there. Of a
//! circle that is flattened here there are a thousand; of one that a file has as chords there may
//! be any number, and the work grows with its square.

use crate::board::FLATTEN;
use crate::geometry::{Point, Polygon};
use crate::voronoi::plane::Spot;

/// One chord stands for so many or more. Chosen: of [flattened](FLATTEN) curves it never does, for
/// already two of their chords leave them four times as far as one.
const FEWEST: usize = 4;

/// The polygon with one edge for as many as are within [`FLATTEN`] of it, where those are at least
/// [`FEWEST`]. Its vertices are some of those of the polygon.
pub(super) fn thinned(polygon: &Polygon) -> Polygon {
    let rings = polygon.contours().iter().map(|ring| thin(ring)).collect();
    Polygon::new(rings).map_or_else(|| polygon.clone(), |thin| thin.of_circles(polygon.circles().to_vec()))
}

fn thin(ring: &[Point]) -> Vec<Point> {
    let mut kept = Vec::new();
    let mut at = 0;
    while at < ring.len() {
        let end = longest(ring, at);
        let next = if end < at + FEWEST { at + 1 } else { end };
        kept.push(ring[at]);
        at = next;
    }
    // A sliver stays what it is.
    if kept.len() > 2 { kept } else { ring.to_vec() }
}

/// The point of the ring, behind its last one the first, to which one edge from the point `at`
/// stands for all between: steps grow while that is so, and shrink when it is not.
fn longest(ring: &[Point], at: usize) -> usize {
    let (mut end, mut step) = (at + 1, 1);
    while step > 0 {
        if end + step <= ring.len() && is_one(ring, at, end + step) {
            end += step;
            step *= 2;
        } else {
            step /= 2;
        }
    }
    end
}

/// Whether the edges from the point `at` to the point `end` all go one way and stay within
/// [`FLATTEN`] of the chord.
fn is_one(ring: &[Point], at: usize, end: usize) -> bool {
    let [from, to] = [ring[at], ring[end % ring.len()]];
    let is_onward = |i: usize| (ring[(i + 1) % ring.len()] - ring[i]).dot(to - from) > 0;
    let is_near = |p: &Point| Spot::from(*p).distance_to_chord(from.into(), to.into()) <= FLATTEN.to_f64();
    (at..end).all(is_onward) && ring[at + 1..end].iter().all(is_near)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    /// A regular polygon with a radius of 40 mm.
    fn regular(corners: u32) -> Polygon {
        let corner = |i: u32| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(corners));
            Point::from_f64(4e7 * cos, 4e7 * sin)
        };
        Polygon::new(vec![(0..corners).map(corner).collect()]).expect("corners")
    }

    #[test]
    fn a_circle_of_any_number_of_chords_has_as_many_as_one_that_is_flattened() {
        for corners in [8_000, 16_000, 100_000] {
            let circle = regular(corners);
            let thin = thinned(&circle);
            let left = thin.contours()[0].len();
            assert!((800..2_000).contains(&left), "{left} chords of {corners}");
            for p in &circle.contours()[0] {
                let off = thin.edges().map(|(a, b)| Spot::from(*p).distance_to_chord(a.into(), b.into()));
                let off = off.fold(f64::INFINITY, f64::min);
                assert!(off <= FLATTEN.to_f64(), "{p:?} is {off} nm off");
            }
        }
    }

    #[test]
    fn corners_and_flattened_curves_stay() {
        let disc = Polygon::disc(Point::default(), Nm::from_mm(20), FLATTEN).expect("a disc");
        for polygon in [regular(6), regular(60), regular(1_000), disc] {
            assert_eq!(thinned(&polygon), polygon, "{} corners", polygon.contours()[0].len());
        }
    }
}
