//! Which contours are the board, and which are lettering beside it.

use super::{Notes, area_mm2};
use crate::board::FLATTEN;
use crate::geometry::{Path, Polygon};
use crate::import::diagnostic;

/// The smallest area of a contour, in mm²: below lie letters' eyes and doubled lines, which nothing
/// is cut along. Chosen.
const SMALLEST: f64 = 0.05;

/// Of the largest board's area, what a board beside it has at least. Chosen: letters of a title
/// block stay below, and no panel mixes boards of such different sizes.
const SHARE: f64 = 0.02;

/// The most contours that are compared with each other; a layer of more is taken as it is. Chosen.
const MOST: usize = 2_000;

/// The contours without tiny ones, and without small ones that lie outside every board.
pub(super) fn without_decoration(mut contours: Vec<Path>, notes: &mut Notes<'_>) -> Vec<Path> {
    let tiny = |contour: &mut Path| area_mm2(contour).abs() < SMALLEST;
    let dropped: Vec<Path> = contours.extract_if(.., tiny).collect();
    if let Some(first) = dropped.first() {
        let message = format!("{} contours below {SMALLEST} mm² are ignored in the outline", dropped.len());
        notes.add(&diagnostic::OUTLINE_TINY, message, notes.place(first.start));
    }
    if contours.len() < 2 || contours.len() > MOST {
        return contours;
    }
    let rings: Vec<Polygon> = contours.iter().filter_map(ring).collect();
    if rings.len() != contours.len() {
        return contours;
    }
    let around = |i: usize| -> Vec<usize> {
        let start = contours[i].start;
        let holds = |j: &usize| *j != i && rings[*j].bounds().contains(start) && rings[*j].contains(start);
        (0..rings.len()).filter(holds).collect()
    };
    let nests: Vec<Vec<usize>> = (0..rings.len()).map(around).collect();
    let area = |i: usize| rings[i].area_mm2().abs();
    let boards = || (0..rings.len()).filter(|&i| nests[i].is_empty());
    let largest = boards().map(area).fold(0.0, f64::max);
    let beside: Vec<usize> = boards().filter(|&i| area(i) < SHARE * largest).collect();
    if let Some(&first) = beside.first() {
        let message =
            format!("{} small contours beside the board look like text and are ignored", beside.len());
        notes.add(&diagnostic::OUTLINE_LETTERING, message, notes.place(contours[first].start));
    }
    let kept = |i: usize| !beside.contains(&i) && !nests[i].iter().any(|outer| beside.contains(outer));
    let kept: Vec<bool> = (0..rings.len()).map(kept).collect();
    contours.into_iter().zip(kept).filter_map(|(contour, keep)| keep.then_some(contour)).collect()
}

/// The area inside a closed path.
pub(super) fn ring(contour: &Path) -> Option<Polygon> {
    let mut points = contour.flatten(FLATTEN);
    points.pop();
    Polygon::new(vec![points])
}
