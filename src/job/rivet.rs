//! Room for rivets and tubes: what a fab plates, a person at home rivets, and a rivet is thicker
//! than its hole.

use crate::board::{Board, Plating};
use crate::geometry::Nm;

/// Widens the holes of `board` that are plated, or that nobody calls unplated, by `wider`; returns
/// how many.
pub fn rivet(board: &mut Board, wider: Nm) -> usize {
    let mut count = 0;
    for hole in &mut board.holes {
        match hole.plating {
            Plating::Plated | Plating::Unknown => {
                hole.diameter += wider;
                count += 1;
            }
            Plating::NonPlated => {}
        }
    }
    count
}
