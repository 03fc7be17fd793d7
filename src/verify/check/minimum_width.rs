//! # What it checks
//!
//! How wide what is left of a net is at its narrowest, against the design: at every place where a cut reaches into it, straight
//! across. Told where less than half is left.
//!
//! # Why
//!
//! A trace of half the width carries half the current, and breaks where it narrows.
//!
//! # What it can miss
//!
//! It looks straight across at the deepest place of each cut, no farther than 0.6 mm: what was wider than that is not narrow. Where the cutter's middle goes through a net, `gouge` and `open` tell of it.

use std::borrow::Borrow;
use std::collections::BTreeMap;

use rayon::prelude::*;

use super::{Check, Run, Severity};
use crate::board::Shape;
use crate::geometry::{Nm, Point, Rect};
use crate::topology::NetId;
use crate::verify::hit::Hit;
use crate::verify::report::Finding;
use crate::verify::ruling::Ruling;
use crate::verify::sheet::Sheet;

pub(super) const CHECK: Check = Check {
    name: NAME,
    about: "a net left with less than half its width",
    run: Run::Isolation(|sheet, _| check(sheet)),
};

const NAME: &str = "minimum-width";

/// How far it looks. Chosen: wider than most traces.
const AROUND: Nm = Nm::from_um(600);
/// So much further in than a face is, in nanometres, is behind it: places are whole nanometres. Chosen.
const BEHIND: f64 = 1_000.0;
/// Places of a net that are looked at, the deepest first. Chosen: a net so often cut has other findings.
const PLACES: usize = 8;

/// What is left across a place, and what was designed.
#[derive(Clone, Copy, Debug)]
struct Width {
    hit: Hit,
    left: Nm,
    designed: Nm,
}

fn check(sheet: &Sheet<'_>) -> Vec<Finding> {
    let mut nets: BTreeMap<NetId, Vec<Hit>> = BTreeMap::new();
    for hit in &sheet.hits {
        nets.entry(hit.net).or_default().push(*hit);
    }
    let nets: Vec<Vec<Hit>> = nets.into_values().collect();
    nets.into_par_iter()
        .filter_map(|hits| narrowest(sheet, hits))
        .map(|width| finding(sheet, &width))
        .collect()
}

/// The place of a net where the smallest share of its width is left, where that is less than half.
fn narrowest(sheet: &Sheet<'_>, mut hits: Vec<Hit>) -> Option<Width> {
    hits.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.cut.cmp(&b.cut)));
    let widths = hits.iter().take(PLACES).filter_map(|hit| across(sheet, hit));
    let narrow = widths.filter(|width| width.left * 2 < width.designed);
    let share = |width: &Width| width.left.to_f64() / width.designed.to_f64();
    narrow.reduce(|a, b| if share(&b) < share(&a) { b } else { a })
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
    let left = end(&copper, reached + BEHIND).map_or(0.0, |end| end.min(next).min(brink) - reached);
    (designed < AROUND.to_f64()).then(|| Width {
        hit: *hit,
        left: Nm::from_f64(left),
        designed: Nm::from_f64(designed),
    })
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

fn finding(sheet: &Sheet<'_>, width: &Width) -> Finding {
    let Width { hit, left, designed } = *width;
    let cut = sheet.cuts[hit.cut];
    let name = sheet.nets.label(hit.net);
    let message = format!("{name} is {left:.3} mm wide where the design has {designed:.3} mm");
    Finding {
        nets: vec![name],
        at: Some(hit.at),
        size: Some(left),
        program: Some(cut.program.file.clone()),
        line: Some(cut.swept.line),
        ..Finding::new(NAME, Severity::Warning, message)
    }
}
