//! Slivers of background: two nets are nearer to each other than the limit says but for a hair, and
//! what two boundaries leave between them is less than fitting may be off.
//!
//! ```text
//!     ╲   A   ╱          ╲   A   ╱
//!      ●━━━━━●     ─▶     ●─────●
//!     ╱   B   ╲          ╱   B   ╲
//! ```
//!
//! One boundary of A and B stands for the two.

use std::collections::BTreeMap;

use super::BACKGROUND;
use super::clip::{Node, Piece};
use super::plane::Spot;
use super::sample::Sample;

/// Makes one piece of every two with background between them that are nowhere farther apart than
/// `size` nanometres.
pub(super) fn close_slivers(pieces: &mut Vec<Piece>, size: f64) {
    let mut beside: BTreeMap<[Node; 2], Vec<usize>> = BTreeMap::new();
    for (number, piece) in pieces.iter().enumerate() {
        let is_open = (piece.left == BACKGROUND) != (piece.right == BACKGROUND) && !piece.is_border();
        let Some([from, to]) = piece.ends.filter(|[from, to]| is_open && from != to) else { continue };
        beside.entry([from.min(to), from.max(to)]).or_default().push(number);
    }
    let mut is_kept = vec![true; pieces.len()];
    let pairs = beside.values().flat_map(|group| {
        group.iter().enumerate().flat_map(|(i, &one)| group[i + 1..].iter().map(move |&other| (one, other)))
    });
    for (one, other) in pairs {
        if !(is_kept[one] && is_kept[other]) {
            continue;
        }
        let Some((left, right)) = closed(&pieces[one], &pieces[other], size) else { continue };
        is_kept[other] = false;
        is_kept[one] = left != right;
        (pieces[one].left, pieces[one].right) = (left, right);
    }
    let mut kept = is_kept.into_iter();
    pieces.retain(|_| kept.next().unwrap_or(true));
}

/// What lies on either hand of a piece once the background between it and another, which has the
/// same ends, is closed; none where it is wider.
fn closed(one: &Piece, other: &Piece, size: f64) -> Option<(u32, u32)> {
    let (left, right) =
        if one.ends == other.ends { (other.left, other.right) } else { (other.right, other.left) };
    let hands = match (one.left, right, one.right, left) {
        (BACKGROUND, BACKGROUND, right, left) | (left, right, BACKGROUND, BACKGROUND) => (left, right),
        _ => return None,
    };
    (is_along(&one.samples, &other.samples, size) && is_along(&other.samples, &one.samples, size))
        .then_some(hands)
}

/// Whether all samples lie within `size` of the way along others.
fn is_along(samples: &[Sample], others: &[Sample], size: f64) -> bool {
    let off = |p: Spot| {
        let chords = others.windows(2).map(|pair| p.distance_to_chord(pair[0].at, pair[1].at));
        chords.fold(f64::INFINITY, f64::min)
    };
    samples.iter().all(|sample| off(sample.at) <= size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From (0, 0) to (100, 0), `high` at half way.
    fn piece([left, right]: [u32; 2], high: f64) -> Piece {
        let sample = |x: f64, y: f64| Sample { at: Spot::new(x, y), clearance: 1.0 };
        let samples = vec![sample(0.0, 0.0), sample(50.0, high), sample(100.0, 0.0)];
        Piece { left, right, samples, ends: Some([1, 2].map(Node::Vertex)) }
    }

    fn backwards(piece: &Piece) -> Piece {
        let mut samples = piece.samples.clone();
        samples.reverse();
        let ends = piece.ends.map(|[from, to]| [to, from]);
        Piece { left: piece.right, right: piece.left, samples, ends }
    }

    #[test]
    fn a_sliver_closes_to_the_boundary_of_its_neighbours() {
        let [above, below] = [piece([7, BACKGROUND], 2.0), piece([BACKGROUND, 9], -2.0)];
        for lower in [below.clone(), backwards(&below)] {
            let mut pieces = vec![above.clone(), lower.clone()];
            close_slivers(&mut pieces, 5.0);
            assert_eq!(pieces, [piece([7, 9], 2.0)], "one of both");
            let mut pieces = vec![above.clone(), lower];
            close_slivers(&mut pieces, 3.0);
            assert_eq!(pieces.len(), 2, "what is wider stays");
        }
        let mut pieces = vec![above, piece([BACKGROUND, 7], -2.0)];
        close_slivers(&mut pieces, 5.0);
        assert_eq!(pieces, [], "within one net nothing is left");
    }

    #[test]
    fn what_is_not_between_two_stays() {
        let mut pieces = vec![piece([7, BACKGROUND], 2.0), piece([9, BACKGROUND], -2.0), piece([7, 9], 0.0)];
        let before = pieces.clone();
        close_slivers(&mut pieces, 5.0);
        assert_eq!(pieces, before, "background beyond both, and no background");
    }
}
