//! Cracks that the library's offset leaves: closed.
//!
//! ```text
//!    ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓        Where two edges go on all but straight, what either is grown by leaves a wedge at their corner
//!    ▓▓ grown ▓│▓▓▓▓▓▓▓▓        that is less than a nanometre wide. The library fills none so narrow, and a contour runs down
//!    ▓▓▓▓▓▓▓▓▓▓│▓▓▓▓▓▓▓▓        to the corner and back: a cutter that follows it cuts into what it should go round.
//!    ──────────●────────  corner
//! ```

use crate::geometry::Point;

/// No wider, in nanometres, is a crack. Chosen: five times what rounding leaves of a wedge.
const WIDEST: i128 = 5;

/// A ring without the tips of cracks; fewer than three points where it is nothing else.
pub(super) fn without_cracks(ring: Vec<Point>) -> Vec<Point> {
    let n = ring.len();
    if !(0..n).any(|i| is_tip([ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]])) {
        return ring;
    }
    let mut kept: Vec<Point> = Vec::with_capacity(n);
    for p in ring {
        kept.push(p);
        while let [.., a, b, c] = kept[..]
            && is_tip([a, b, c])
        {
            kept.truncate(kept.len() - 2);
            kept.push(c);
        }
    }
    // Across the place where it begins.
    let mut first = 0;
    while let [a, .., y, z] = kept[first..] {
        let b = kept[first + 1];
        if is_tip([y, z, a]) {
            kept.pop();
        } else if is_tip([z, a, b]) {
            first += 1;
        } else {
            break;
        }
    }
    kept.split_off(first)
}

/// Whether a ring turns back at the second of three points, and leaves next to nothing between its
/// way there and its way back.
fn is_tip([a, b, c]: [Point; 3]) -> bool {
    let (there, back) = (b - a, c - b);
    if there.dot(back) >= 0 {
        return false;
    }
    let [cross, longer] =
        [there.cross(back), there.length_squared().max(back.length_squared())].map(i128::from);
    cross * cross <= WIDEST * WIDEST * longer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    fn ring(places: &[(i64, i64)]) -> Vec<Point> {
        places.iter().map(|&(x, y)| Point::new(Nm::new(x), Nm::new(y))).collect()
    }

    #[test]
    fn cracks_are_closed_wherever_a_ring_begins() {
        let whole = ring(&[(0, 0), (900_000, 0), (900_000, 500_000), (400_001, 500_000), (0, 500_000)]);
        // Down a nanometre wide, and up in two parts.
        let mut cracked = whole.clone();
        cracked.splice(
            3..4,
            ring(&[(400_001, 500_000), (400_100, 7_000), (400_050, 260_000), (400_000, 500_000)]),
        );
        for first in 0..cracked.len() {
            let mut turned = cracked.clone();
            turned.rotate_left(first);
            let closed = without_cracks(turned);
            assert!((5..=6).contains(&closed.len()), "from {first}: {closed:?}");
            assert!(closed.iter().all(|p| p.y.get() % 500_000 == 0), "from {first}: {closed:?}");
        }
    }

    #[test]
    fn corners_however_sharp_stay_and_what_is_a_crack_alone_goes() {
        let sharp = ring(&[(0, 0), (1_000_000, 300), (1_000_000, -300)]);
        assert_eq!(without_cracks(sharp.clone()), sharp, "a thousandth of a rad");
        assert!(without_cracks(ring(&[(0, 0), (500, 270_000), (1, 0)])).len() < 3, "a crack");
    }
}
