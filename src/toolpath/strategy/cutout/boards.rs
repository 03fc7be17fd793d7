//! Which boards a way goes round: several where they lie closer together than the cutter is wide.

use crate::geometry::{Nm, Point, Polygon, distance_to_segment};

use super::ring::Ring;
use super::tabs;

/// What a way goes round: for each of its boards, the distances along it of places beside that.
pub(super) type Stretches = Vec<Vec<f64>>;

/// Of the ways round `boards`, what each goes round; a board that none does has a place at none.
///
/// A way round one board only goes round it, and most do; the others are measured.
pub(super) fn stretches(ways: &[Ring], boards: &[Polygon], radius: Nm) -> Vec<Stretches> {
    if ways.len() == boards.len() {
        return ways.iter().map(|way| vec![tabs::places(way).collect()]).collect();
    }
    ways.iter().map(|way| beside(way, boards, radius)).collect()
}

fn beside(way: &Ring, boards: &[Polygon], radius: Nm) -> Stretches {
    let mut found = vec![Vec::new(); boards.len()];
    for place in tabs::places(way) {
        let p = way.at(place);
        let near = (0..boards.len()).filter(|&i| boards[i].bounds().inflate(radius * 2).contains(p));
        let measured = near.map(|i| (distance(&boards[i], p), i));
        if let Some((_, nearest)) = measured.min_by(|a, b| a.0.total_cmp(&b.0)) {
            found[nearest].push(place);
        }
    }
    found.retain(|places| !places.is_empty());
    found
}

/// How far a point is from the edge of a board, in nanometres.
fn distance(board: &Polygon, p: Point) -> f64 {
    board.edges().map(|edge| distance_to_segment(p, edge)).fold(f64::INFINITY, f64::min)
}
