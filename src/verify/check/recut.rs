//! # What it checks
//!
//! How much of the way of the cutter lies where it has cut before, at least as deep: within a
//! quarter of the kerf beside an earlier way. Told where it is more than a quarter.
//!
//! # Why
//!
//! It takes time, and a groove cut twice is wider than one cut once. Some is wise: cutting a short
//! piece again is quicker than a retract.
//!
//! # What it can miss
//!
//! Passes that overlap by less than three quarters, as wide isolation does. Of a very long program
//! it looks at some of its cuts, evenly.

use rayon::prelude::*;

use super::{Check, Diagnostic, Run, Severity, Stage, Words, along};
use crate::board::Shape;
use crate::geometry::{Nm, Point};
use crate::verify::cut::Cut;
use crate::verify::outcome::Outcome;
use crate::verify::report::Finding;
use crate::verify::sheet::Sheet;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Info,
    what: Words::of("much of the path is cut twice"),
    effect: Words::of("nothing but time"),
    advice: Words::of("nothing; boundaries that are cut once, as by {strategy} voronoi, take less time"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Isolation(|sheet, _| check(sheet)) };

const NAME: &str = "recut";

/// The share that is told. Chosen: retracts that are saved by recutting cost up to a sixth on the
/// boards that were tried.
const SHARE: f64 = 0.25;
/// How much deeper a second cut in the same place is a pass of its own.
const PASS: Nm = Nm::from_um(5);
/// How near to the end of an earlier way a point is no longer on it, in nanometres: ways that
/// follow one another share an end.
const END: f64 = 1_000.0;

fn check(sheet: &Outcome<'_>) -> Vec<Finding> {
    let every = every(sheet);
    let cuts: Vec<usize> = (0..sheet.cuts.len()).step_by(every).collect();
    let looked_at: Vec<Vec<(Point, f64, bool)>> = cuts.par_iter().map(|&index| look(sheet, index)).collect();
    let (mut all, mut again, mut first) = (0.0, 0.0, None);
    for (&index, samples) in cuts.iter().zip(&looked_at) {
        for &(at, length, is_again) in samples {
            all += length;
            if is_again {
                again += length;
                first = first.or(Some((at, sheet.cuts[index])));
            }
        }
    }
    let Some((at, cut)) = first.filter(|_| again > all * SHARE) else { return Vec::new() };
    #[expect(clippy::cast_precision_loss, reason = "a display figure")]
    let (share, again) = (again / all, again * every as f64);
    let about = if every > 1 { "about " } else { "" };
    let message = format!("{about}{:.0} % of the path is recut: {about}{:.1} mm", share * 100.0, again / 1e6);
    vec![Finding {
        at: Some(at),
        size: Some(Nm::from_f64(again)),
        program: Some(cut.program.followed.file.clone()),
        line: Some(cut.swept.line),
        ..Finding::new(NAME, Severity::Info, message)
    }]
}

/// With more points than the first not all are looked at, but about as many as the second. Both
/// chosen: below a second of work each.
const POINTS: usize = 300_000;
const SAMPLE: usize = 30_000;

/// Of how many cuts one is looked at.
fn every(sheet: &Sheet<'_>) -> usize {
    let all: usize = sheet.cuts.par_iter().map(|cut| count(cut) as usize).sum();
    if all > POINTS { all / SAMPLE } else { 1 }
}

/// Points along a cut, each with the length that it stands for, and whether it is cut again.
fn look(sheet: &Sheet<'_>, index: usize) -> Vec<(Point, f64, bool)> {
    let cut = &sheet.cuts[index];
    samples(cut).into_iter().map(|(at, length)| (at, length, is_cut(sheet, index, cut, at))).collect()
}

/// Points along a cut about a kerf apart, each with the length that it stands for, in nanometres.
fn samples(cut: &Cut<'_>) -> Vec<(Point, f64)> {
    along(&cut.swept.shape, count(cut))
}

/// How many they are.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
fn count(cut: &Cut<'_>) -> u32 {
    let length: f64 = along(&cut.swept.shape, 1).iter().map(|(_, length)| length).sum();
    let kerf = cut.swept.half().to_f64() * 2.0;
    // Not all from the first: a long cut has hundreds.
    let first = ((length / kerf) as u32).clamp(2, 1000) - 1;
    (first..1000).find(|&count| length <= kerf * f64::from(count)).unwrap_or(1000)
}

/// Whether an earlier cut, at least as deep, passes beside a point.
fn is_cut(sheet: &Sheet<'_>, index: usize, cut: &Cut<'_>, at: Point) -> bool {
    let half = cut.swept.half();
    // As far from the face as a quarter of the kerf beside the middle is.
    let reach = half / 2 - cut.swept.floor;
    sheet.walls.any(at, reach, index, |wall| {
        let swept = sheet.cuts[wall.index].swept;
        let near = wall.distance <= (half / 2 - swept.floor).to_f64();
        near && swept.depth >= cut.swept.depth - PASS && is_inside(&swept.shape, wall.foot)
    })
}

/// Whether a point of a way is none of its ends.
fn is_inside(way: &Shape, foot: Point) -> bool {
    let off = |end: Point| end.distance(foot) > END;
    match way {
        Shape::Stroke { from, to, .. } => off(*from) && off(*to),
        Shape::Arc { arc, .. } => arc.start == arc.end || (off(arc.start) && off(arc.end)),
        Shape::Disc { .. } | Shape::Polygon(_) => false,
    }
}
