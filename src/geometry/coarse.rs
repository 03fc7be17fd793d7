//! Rings with fewer vertices.

use super::Point;
use super::nearest::off_segment;

/// So many edges become one at most, so that looking does not take the square of them. Chosen.
const LONGEST_RUN: usize = 64;

/// Those vertices of a ring, by number, whose chords all others are within `tolerance` nanometres
/// of.
pub(crate) fn coarse(ring: &[Point], tolerance: f64) -> Vec<usize> {
    let n = ring.len();
    // Three chords at least: a chord must not stand for a whole ring.
    let most = (n / 3).clamp(1, LONGEST_RUN);
    let vertex = |i: usize| ring[i % n].to_f64();
    let is_chord = |first: usize, count: usize| {
        let (a, b) = (vertex(first), vertex(first + count));
        (1..count).all(|i| {
            let (x, y) = off_segment(vertex(first + i), a, b);
            x * x + y * y <= tolerance * tolerance
        })
    };
    let mut kept = Vec::new();
    let mut first = 0;
    while first < n {
        let mut count = 1;
        while count < most && first + count < n && is_chord(first, count + 1) {
            count += 1;
        }
        kept.push(first);
        first += count;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Nm, Polygon};

    #[test]
    fn what_is_left_of_a_circle_stays_within_the_tolerance() {
        let disc = Polygon::disc(Point::default(), Nm::from_mm(1), Nm::new(250)).expect("a disc");
        let ring = &disc.contours()[0];
        for tolerance in [1_000.0, 4_000.0, 16_000.0] {
            let kept: Vec<(f64, f64)> =
                coarse(ring, tolerance).into_iter().map(|i| ring[i].to_f64()).collect();
            // As many chords as an inscribed polygon of that tolerance has, or one in six more.
            let fewest = std::f64::consts::PI / libm::acos(1.0 - tolerance / 1e6);
            let count = Nm::new(i64::try_from(kept.len()).expect("few")).to_f64();
            assert!((fewest.floor()..fewest * 1.2 + 2.0).contains(&count), "{count} chords, of {fewest}");
            let chords = || kept.iter().zip(kept.iter().cycle().skip(1));
            let off = |p: (f64, f64)| {
                let away = chords().map(|(&a, &b)| off_segment(p, a, b)).map(|(x, y)| libm::hypot(x, y));
                away.fold(f64::MAX, f64::min)
            };
            assert!(ring.iter().all(|&p| off(p.to_f64()) <= tolerance), "within {tolerance} nm");
        }
    }

    #[test]
    fn corners_stay() {
        let at = |x: i64, y: i64| Point::new(Nm::new(x), Nm::new(y));
        let ring = [at(0, 0), at(500, 2), at(1000, 0), at(1000, 600), at(1000, 1000), at(0, 1000)];
        assert_eq!(coarse(&ring, 10.0), [0, 2, 4, 5]);
    }
}
