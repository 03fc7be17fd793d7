//! Which contours are the board, and which are lettering beside it or lines drawn twice.

use super::area_mm2;
use super::notes::Notes;
use crate::board::FLATTEN;
use crate::geometry::{Nm, Path, Point, Polygon, Rect, distance_to_segment};
use crate::import::diagnostic;

/// The smallest area of a contour, in mm²: below lie letters' eyes and doubled lines, which nothing
/// is cut along. Chosen.
const SMALLEST: f64 = 0.05;

/// Of the largest board's area, what a board beside it has at least. Chosen: letters of a title
/// block stay below, and no panel mixes boards of such different sizes.
const SHARE: f64 = 0.02;

/// The most contours that are compared with each other; a layer of more is taken as it is. Chosen.
pub(super) const MOST: usize = 2_000;

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

/// The widest line as whose two sides an edge is drawn. Chosen: wider than programs draw edges, and
/// no board is a ring so narrow.
const WIDEST_LINE: f64 = 0.5e6;

/// The contours without those that come nearer than `gap` to one around them: an edge drawn twice,
/// each time rounded otherwise, or a line within the board that touches its edge. Nor are there
/// those that follow one around them all along: the inner side of a line, as KiCad's DXF has it.
pub(super) fn without_doubles(contours: Vec<Path>, gap: Nm, notes: &mut Notes<'_>) -> Vec<Path> {
    if contours.len() < 2 || contours.len() > MOST {
        return contours;
    }
    let rings: Vec<Option<Polygon>> = contours.iter().map(ring).collect();
    // Those around another one are larger.
    let mut order: Vec<usize> = (0..contours.len()).collect();
    let area = |i: usize| rings[i].as_ref().map_or(0.0, |ring| ring.area_mm2().abs());
    order.sort_by(|&a, &b| area(b).total_cmp(&area(a)).then(a.cmp(&b)));
    let (mut kept, mut dropped): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    for i in order {
        let is_double = |&outer: &usize| {
            rings[outer].as_ref().zip(rings[i].as_ref()).is_some_and(|(outer, inner)| {
                outer.contains(contours[i].start)
                    && (come_near(&outer.contours()[0], &inner.contours()[0], gap)
                        || strip(outer, inner) < WIDEST_LINE)
            })
        };
        if kept.iter().any(is_double) { dropped.push(i) } else { kept.push(i) }
    }
    if let Some(&first) = dropped.first() {
        let message = format!(
            "lines come nearer than {gap:.3} mm to the outline around them, or are the inner side of it; only the outer ones are used"
        );
        notes.add(&diagnostic::OUTLINE_PARTED, message, notes.place(contours[first].start));
    }
    kept.sort_unstable();
    kept.into_iter().map(|i| contours[i].clone()).collect()
}

/// How far copies of one contour lie apart. Chosen: what rounding leaves, and nothing that anybody
/// draws or mills.
const COPIED: Nm = Nm::from_um(3);

/// The contours, sorted by their lower left corners, without those that are copies of another,
/// rounded otherwise.
pub(super) fn without_copies(contours: Vec<Path>) -> Vec<Path> {
    let mut kept: Vec<(Rect, f64, Path)> = Vec::with_capacity(contours.len());
    for contour in contours {
        let (bounds, area) = (contour.bounds(), area_mm2(&contour).abs());
        let room = 1e-12 * COPIED.to_f64() * contour.length();
        let mut before = kept.iter().rev().take_while(|(other, ..)| bounds.min().x - other.min().x <= COPIED);
        let is_copy = before.any(|(other, of, _)| is_same(bounds, *other) && (area - of).abs() <= room);
        if !is_copy {
            kept.push((bounds, area, contour));
        }
    }
    kept.into_iter().map(|(.., contour)| contour).collect()
}

/// Whether two rectangles are no farther apart on any side than copies are.
fn is_same(a: Rect, b: Rect) -> bool {
    let off = [a.min() - b.min(), a.max() - b.max()];
    off.iter().all(|way| way.x.abs().max(way.y.abs()) <= COPIED)
}

/// How wide what lies between a ring and one inside it is on average, in nanometres.
fn strip(outer: &Polygon, inner: &Polygon) -> f64 {
    let between = 1e12 * (outer.area_mm2().abs() - inner.area_mm2().abs());
    between / f64::midpoint(outer.perimeter(), inner.perimeter())
}

/// Whether two rings that do not cross come nearer to each other than `gap`: where they do, a
/// corner of one of them does.
fn come_near(a: &[Point], b: &[Point], gap: Nm) -> bool {
    let corner_near = |corners: &[Point], ring: &[Point]| {
        let Some(around) = Rect::around(corners.iter().copied()).map(|bounds| bounds.inflate(gap)) else {
            return false;
        };
        let mut sorted = corners.to_vec();
        sorted.sort_unstable();
        let mut sides = ring.iter().zip(ring.iter().cycle().skip(1));
        sides.any(|(&from, &to)| {
            let near = Rect::new(from, to).inflate(gap);
            let first = sorted.partition_point(|p| p.x < near.min().x);
            let mut beside = sorted[first..].iter().take_while(|p| p.x <= near.max().x);
            around.touches(Rect::new(from, to))
                && beside.any(|&p| distance_to_segment(p, (from, to)) < gap.to_f64())
        })
    };
    corner_near(a, b) || corner_near(b, a)
}

/// The area inside a closed path.
pub(super) fn ring(contour: &Path) -> Option<Polygon> {
    let mut points = contour.flatten(FLATTEN);
    points.pop();
    Polygon::new(vec![points])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As [`come_near`], the obvious way: every corner and every side of the other ring.
    fn obvious(a: &[Point], b: &[Point], gap: Nm) -> bool {
        let near = |corners: &[Point], ring: &[Point]| {
            let sides = || ring.iter().zip(ring.iter().cycle().skip(1));
            corners
                .iter()
                .any(|&p| sides().any(|(&from, &to)| distance_to_segment(p, (from, to)) < gap.to_f64()))
        };
        near(a, b) || near(b, a)
    }

    #[test]
    fn rings_come_near_as_if_every_corner_was_looked_at() {
        let rhomb = |reach: i64, x: i64| {
            let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
            [at(x + reach, 0), at(x, reach), at(x - reach, 0), at(x, -reach)]
        };
        let outer = rhomb(10_000, 0);
        let mut found = [0, 0];
        for x in (-9_000..9_000).step_by(13) {
            let (inner, gap) = (rhomb(1_000, x), Nm::from_um(100));
            let is_near = come_near(&outer, &inner, gap);
            assert_eq!(is_near, obvious(&outer, &inner, gap), "moved by {x} µm");
            found[usize::from(is_near)] += 1;
        }
        assert!(found.iter().all(|&count| count > 10), "both answers: {found:?}");
    }
}
