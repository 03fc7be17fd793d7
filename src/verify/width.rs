//! How wide a net is where a cut reaches into it, straight across the cut: as designed, and what is
//! left.

use std::borrow::Borrow;

use crate::board::Shape;
use crate::geometry::{Nm, Point, Rect};

use super::hit::Hit;
use super::ruling::Ruling;
use super::sheet::Sheet;

/// How far it looks. Chosen: wider than most traces.
const AROUND: Nm = Nm::from_um(600);
/// So much further in than a face is, in nanometres, is behind it: places are whole nanometres.
/// Chosen.
const BEHIND: f64 = 1_000.0;
/// What is left across a place, and what was designed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Width {
    pub(super) hit: Hit,
    /// Above zero.
    pub(super) left: Nm,
    pub(super) designed: Nm,
}

impl Width {
    /// The part that is left.
    pub(super) fn share(&self) -> f64 {
        self.left.to_f64() / self.designed.to_f64()
    }
}

/// Places that are looked at, the deepest first. Chosen: a net so often cut has other findings.
const PLACES: usize = 8;

/// The place where the smallest part of a net's width is left, of the deepest ones of these; none
/// where it is wide at all.
pub(super) fn narrowest(sheet: &Sheet<'_>, hits: &[Hit]) -> Option<Width> {
    let mut hits = hits.to_vec();
    hits.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.cut.cmp(&b.cut)));
    let widths = hits.iter().take(PLACES).filter_map(|hit| across(sheet, hit));
    widths.reduce(|a, b| if b.share() < a.share() { b } else { a })
}

/// The widths across a net where a cut reaches into it, at a right angle to the cut.
fn across(sheet: &Sheet<'_>, hit: &Hit) -> Option<Width> {
    let swept = sheet.cuts[hit.cut].swept;
    let foot = sheet.walls.foot(hit.cut, hit.at);
    let (dx, dy) = (hit.at.x - foot.x, hit.at.y - foot.y);
    let length = foot.distance(hit.at);
    if length < 1.0 {
        return None;
    }
    let (share, (x, y)) = ((AROUND + swept.half()).to_f64() / length, foot.to_f64());
    let far = Point::from_f64(x + dx.to_f64() * share, y + dy.to_f64() * share);
    let ruling = Ruling::line(foot, far);
    let near = Rect::new(foot, far).inflate(Nm::from_um(10));
    let kerfs = sheet.places.cuts.touching(near).into_iter().map(|cut| &sheet.cuts[cut].swept.shape);
    let (cut, copper) = (ruled(&ruling, kerfs), ruled(&ruling, sheet.within(hit.net, near)));
    let board = sheet.outline.as_ref().and_then(|outline| outline.clipped(near)).map(Shape::Polygon);
    let face = swept.half().to_f64();
    let edge = face - hit.depth;
    let brink = end(&ruled(&ruling, board.into_iter()), edge + BEHIND).unwrap_or(f64::INFINITY);
    let designed = end(&copper, edge + BEHIND)?.min(brink) - edge;
    let reached = end(&cut, face - BEHIND).unwrap_or(face);
    let next = cut.iter().map(|(from, _)| *from).find(|from| *from > reached).unwrap_or(brink);
    // Where nothing is left straight behind the cut, an end or a corner of the net is gone, or it
    // is parted there: `gouge` and `open` tell of that. It has no width that anybody could measure.
    let left = end(&copper, reached + BEHIND)?.min(next).min(brink) - reached;
    let measured = left > BEHIND && designed < AROUND.to_f64();
    measured.then(|| Width { hit: *hit, left: Nm::from_f64(left), designed: Nm::from_f64(designed) })
}

/// Where a line runs through shapes, from the first stretch to the last, none touching another.
fn ruled(ruling: &Ruling, shapes: impl Iterator<Item = impl Borrow<Shape>>) -> Vec<(f64, f64)> {
    let mut stretches = Vec::new();
    shapes.for_each(|shape| ruling.rule(shape.borrow(), 0..1, &mut |_, from, to| stretches.push((from, to))));
    stretches.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    // What is less than a micrometre apart touches.
    stretches.dedup_by(|next, last| {
        let touch = next.0 <= last.1 + BEHIND;
        if touch {
            last.1 = last.1.max(next.1);
        }
        touch
    });
    stretches
}

/// Where the stretch ends that holds a place.
fn end(stretches: &[(f64, f64)], place: f64) -> Option<f64> {
    stretches.iter().find(|(from, to)| *from <= place && place <= *to).map(|(_, to)| *to)
}
