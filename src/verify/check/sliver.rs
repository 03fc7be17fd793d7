//! # What it checks
//!
//! No strip of clad between two cuts, or between a cut and the board's edge, is thinner than given,
//! along half a millimetre: at the copper's bottom, where it is held. Copper of nets is not clad:
//! how thin that is the design says, and `minimum-width`.
//!
//! # Why
//!
//! A strip so thin comes off the board sooner or later, and lies across a groove.
//!
//! # What it can miss
//!
//! Shorter ones: where two cuts meet at a sharp angle there always is one, and its end
//! holds it. Those beside cuts that hundreds of others run near; `not-judged` counts these.

use rayon::prelude::*;

use super::{Check, Diagnostic, Run, Severity, Stage, Words, along};
use crate::board::Shape;
use crate::geometry::{Nm, Point, Rect};
use crate::verify::Settings;
use crate::verify::hit::FAINT;
use crate::verify::outcome::Outcome;
use crate::verify::report::Finding;
use crate::verify::sheet::Sheet;
use crate::verify::walls::{Neck, Wall};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a sliver: a thin strip of copper left between two cuts, or at the edge"),
    effect: Words::of("a thin strip of copper may come loose and join two nets"),
    advice: Words::of("clear it away with {width}, {passes} or {clear}, or scrape it off"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Isolation(check) };

const NAME: &str = "sliver";

/// A cut beside which strips are thin.
#[derive(Clone, Copy, Debug)]
struct Thin {
    cut: usize,
    /// Where they are thinnest.
    neck: Neck,
    /// Along how much of the cut there is one without a break, in nanometres.
    length: f64,
}

/// A shorter strip is held by its ends, in nanometres. Chosen.
const LONG: f64 = 500_000.0;
/// In how many steps that length is measured, and in how many the longest way is. Chosen.
const STEPS: (f64, u32) = (16.0, 4096);

fn check(sheet: &Outcome<'_>, settings: &Settings) -> Vec<Finding> {
    let cuts = (0..sheet.cuts.len()).into_par_iter().filter(|cut| !sheet.crowded[*cut]);
    let thin: Vec<Thin> = cuts.filter_map(|cut| beside(sheet, cut, settings.sliver)).collect();
    let together = |a: &Thin, b: &Thin| {
        b.cut - a.cut <= 2 || a.neck.at.distance(b.neck.at) <= settings.sliver.to_f64() * 3.0
    };
    let strips = thin.chunk_by(together);
    let long = strips.filter(|strip| strip.iter().map(|thin| thin.length).sum::<f64>() >= LONG);
    long.map(|strip| finding(sheet, strip)).collect()
}

/// What is thin between a cut and those before it, or the board's edge.
fn beside(sheet: &Sheet<'_>, cut: usize, sliver: Nm) -> Option<Thin> {
    // Of ways that follow one another one touches the other: what is between the first and the
    // third is no strip.
    let own = ends(&sheet.cuts[cut].swept.shape);
    let follows = |other: usize| ends(&sheet.cuts[other].swept.shape).iter().any(|end| own.contains(end));
    let count = sheet.cuts.len();
    let near = sheet.walls.beside(cut, sliver, |other| (other < cut && !follows(other)) || other >= count);
    let apart = near.into_iter().filter(|(_, neck)| neck.width > FAINT);
    let is_clad = |neck: &Neck| {
        let spot = Shape::Disc { center: neck.at, radius: Nm::ZERO };
        let covered = sheet.walls.any(neck.at, Nm::ZERO, usize::MAX, |wall| wall.distance < 0.0);
        !covered && sheet.holds(neck.at) && sheet.proximity.near(&spot, Nm::ZERO).is_empty()
    };
    let edge = |(other, neck): (usize, Neck)| {
        let is_edge = other >= sheet.cuts.len();
        let neck = if is_edge { at_edge(sheet, cut, other, neck, sliver)? } else { neck };
        Some((other, neck))
    };
    let mut strips: Vec<(usize, Neck)> = apart.filter_map(edge).filter(|(_, neck)| is_clad(neck)).collect();
    if strips.is_empty() {
        return None;
    }
    strips.sort_unstable_by_key(|&(other, _)| other);
    let (stretch, length) = longest(sheet, cut, &strips, sliver)?;
    let there = strips.into_iter().map(|(_, neck)| neck).filter(|neck| stretch.contains(neck.at));
    let neck = there.reduce(|a, b| if b.width < a.width { b } else { a })?;
    Some(Thin { cut, neck, length })
}

/// Where a cut begins and ends.
fn ends(way: &Shape) -> [Point; 2] {
    match way {
        Shape::Disc { center, .. } => [*center; 2],
        Shape::Stroke { from, to, .. } => [*from, *to],
        Shape::Arc { arc, .. } => [arc.start, arc.end],
        Shape::Polygon(_) => [way.anchor(); 2],
    }
}

/// The middle of what is left between a cut and the edge: the middle between the edge and the
/// cutter's way lies in the kerf.
fn at_edge(sheet: &Sheet<'_>, cut: usize, edge: usize, neck: Neck, sliver: Nm) -> Option<Neck> {
    let reach = sheet.cuts[cut].swept.floor + sliver;
    let foot = sheet.walls.one(edge, neck.at, reach)?.foot;
    let length = neck.at.distance(foot);
    (length > 0.0).then(|| Neck { at: foot.toward(neck.at, neck.width / 2.0 / length), ..neck })
}

/// The longest stretch of a cut along which there is a wall of `strips` so near all the way: round
/// what it lies, and its length in nanometres.
fn longest(sheet: &Sheet<'_>, cut: usize, strips: &[(usize, Neck)], sliver: Nm) -> Option<(Rect, f64)> {
    let swept = sheet.cuts[cut].swept;
    let total: f64 = along(&swept.shape, 1).iter().map(|(_, length)| length).sum();
    let (steps, most) = STEPS;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let count = (total * steps / LONG).ceil().clamp(steps, f64::from(most)) as u32;
    let places = along(&swept.shape, count);
    let is_strip = |wall: &Wall| strips.binary_search_by_key(&wall.index, |&(other, _)| other).is_ok();
    let is_near = |at: Point| sheet.walls.any(at, swept.floor + sliver, usize::MAX, is_strip);
    let judged: Vec<(Point, f64, bool)> = places.into_iter().map(|(at, l)| (at, l, is_near(at))).collect();
    let runs = judged.chunk_by(|a, b| a.2 == b.2).filter(|run| run[0].2);
    let stretch = |run: &[(Point, f64, bool)]| {
        let bounds = Rect::around(run.iter().map(|&(at, ..)| at))?.inflate(swept.floor + sliver);
        Some((bounds, run.iter().map(|&(_, length, _)| length).sum::<f64>()))
    };
    runs.filter_map(stretch).reduce(|a, b| if b.1 > a.1 { b } else { a })
}

fn finding(sheet: &Sheet<'_>, strip: &[Thin]) -> Finding {
    let thinnest = strip.iter().copied().reduce(|a, b| if b.neck.width < a.neck.width { b } else { a });
    let thinnest = thinnest.expect("a strip has places");
    let (cut, at): (_, Point) = (sheet.cuts[thinnest.cut], thinnest.neck.at);
    let width = Nm::from_f64(thinnest.neck.width);
    Finding {
        at: Some(at),
        size: Some(width),
        program: Some(cut.program.followed.file.clone()),
        line: Some(cut.swept.line),
        ..Finding::new(NAME, Severity::Warning, format!("a sliver of copper {width:.3} mm wide is left"))
    }
}
