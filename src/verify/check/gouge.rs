//! # What it checks
//!
//! How far the cutter reaches into the copper of the design, measured on the exact shapes: half the kerf less the distance from the
//! cutter's way to the copper. Where the design's gap is narrower than the kerf, a cut in its middle must take copper:
//! that is a warning, any other an error.
//!
//! # Why
//!
//! Traces get narrower, pads smaller.
//!
//! # What it can miss
//!
//! Less than the tolerance. What the tool takes when it bends or runs out.

use rayon::prelude::*;

use super::{Check, Run, Severity, along, area};
use crate::geometry::{Nm, Point, Rect};
use crate::topology::NetId;
use crate::verify::Settings;
use crate::verify::hit::Hit;
use crate::verify::report::Finding;
use crate::verify::sheet::{CUT, NETS, Sheet, Show, places};

pub(super) const CHECK: Check =
    Check { name: NAME, about: "copper of the design cut away", run: Run::Isolation(check) };

const NAME: &str = "gouge";

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let together = |a: &Hit, b: &Hit| {
        let near = b.cut - a.cut.min(b.cut) <= 2 || a.at.distance(b.at) <= TOGETHER.to_f64();
        (a.net, a.forced) == (b.net, b.forced) && near
    };
    let hits = &sheet.hits;
    hits.chunk_by(together)
        .collect::<Vec<_>>()
        .into_par_iter()
        .map(|hits| finding(sheet, hits, settings))
        .collect()
}

/// Hits this near to each other are one finding. Chosen: what one looks at at once.
const TOGETHER: Nm = Nm::from_um(500);

/// What belongs together, at its deepest.
fn finding(sheet: &Sheet<'_>, hits: &[Hit], settings: &Settings) -> Finding {
    let deepest = hits.iter().copied().reduce(|a, b| if b.depth > a.depth { b } else { a });
    let mut deepest = deepest.expect("a finding has hits");
    if hits.iter().any(|hit| hit.through) {
        deepest = inside(sheet, hits, deepest);
    }
    let cut = sheet.cuts[deepest.cut];
    let depth = Nm::from_f64(deepest.depth);
    let name = sheet.nets.label(deepest.net);
    let area = lost(sheet, hits);
    let why = if deepest.forced { ": the gap is narrower than the kerf" } else { "" };
    let message = format!("{:.0} µm of {name} are cut away, {area:.4} mm²{why}", deepest.depth / 1000.0);
    let severity = if deepest.forced { Severity::Warning } else { Severity::Error };
    debug_assert!(depth > settings.gouge, "shallow hits are left out");
    Finding {
        nets: vec![name],
        at: Some(deepest.at),
        size: Some(depth),
        area: Some(area),
        program: Some(cut.program.file.clone()),
        line: Some(cut.swept.line),
        ..Finding::new(NAME, severity, message)
    }
}

/// The copper lost to these cuts, in mm².
fn lost(sheet: &Sheet<'_>, hits: &[Hit]) -> f64 {
    let bounds = hits.iter().map(|hit| sheet.cuts[hit.cut].swept.shape.bounds()).reduce(Rect::union);
    let bounds = bounds.expect("a finding has hits");
    let (grid, pictures) = sheet.window(bounds, Nm::from_um(2), 600, &[Show::Design, Show::Cuts]);
    let label = hits[0].net.0 + NETS;
    let both = pictures[0].labels().iter().zip(pictures[1].labels());
    area(both.filter(|(net, cut)| **net == label && **cut == CUT).count(), grid.pitch())
}

/// Where the cutter's middle goes through copper: the point of its way that lies deepest inside, of a few on every piece, looked at
/// roughly; the deepest of them is measured.
fn inside(sheet: &Sheet<'_>, hits: &[Hit], deepest: Hit) -> Hit {
    let through: Vec<&Hit> = hits.iter().filter(|hit| hit.through).collect();
    let step = through.len().div_ceil(SAMPLED);
    let mut best = (deepest.depth, deepest);
    for hit in through.into_iter().step_by(step) {
        let cut = &sheet.cuts[hit.cut].swept;
        for at in along(&cut.shape, 8).into_iter().map(|(at, _)| at).chain([hit.at]) {
            let depth = cut.half().to_f64() + in_copper(sheet, hit.net, at, cut.half(), ROUGHLY);
            if depth > best.0 {
                best = (depth, Hit { at, ..*hit });
            }
        }
    }
    let half = sheet.cuts[best.1.cut].swept.half();
    let depth = half.to_f64() + in_copper(sheet, best.1.net, best.1.at, half, MEASURED);
    if depth > deepest.depth { Hit { depth, ..best.1 } } else { deepest }
}

/// Pixels across of a picture to look at.
const ROUGHLY: u32 = 48;
/// Pixels across of a picture to measure in. Chosen: a hundredth of the kerf.
const MEASURED: u32 = 400;

/// Pieces that are looked at, at most. Chosen: a finding of more is bad enough.
const SAMPLED: usize = 12;

/// How deep a point lies in a net, in nanometres: the distance to the nearest pixel of anything else, within twice the kerf; 0
/// outside.
fn in_copper(sheet: &Sheet<'_>, net: NetId, p: Point, half: Nm, most: u32) -> f64 {
    let reach = half * 4;
    let (grid, pictures) =
        sheet.window(Rect::new(p, p).inflate(reach), Nm::from_um(2), most, &[Show::Design]);
    let label = net.0 + NETS;
    let others = places(&grid).zip(pictures[0].labels()).filter(|(_, own)| **own != label);
    let nearest =
        others.map(|((column, row), _)| grid.center(column, row).distance(p)).fold(reach.to_f64(), f64::min);
    (nearest - grid.pitch().to_f64() / 2.0).max(0.0)
}
