//! # What it checks
//!
//! How far the cutter reaches into the copper of the design, measured on the exact shapes: half the kerf less the distance from the
//! cutter's way to the copper, or where the way goes through copper, half the kerf and the distance to its edge. Where the design's gap is narrower than the kerf, a cut in its middle must take copper:
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

use super::{Check, Run, Severity};
use crate::geometry::{Nm, Rect};
use crate::verify::Settings;
use crate::verify::hit::{Hit, clusters};
use crate::verify::interior::{Deepest, Interior};
use crate::verify::loss::lost;
use crate::verify::remains::designed;
use crate::verify::report::Finding;
use crate::verify::sheet::Sheet;

pub(super) const CHECK: Check =
    Check { name: NAME, about: "copper of the design cut away", run: Run::Isolation(check) };

const NAME: &str = "gouge";

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let nets: Vec<&[Hit]> = sheet.hits.chunk_by(|a, b| a.net == b.net).collect();
    nets.into_par_iter().flat_map(|hits| of_net(sheet, hits, settings)).collect()
}

/// What is cut away of a net.
fn of_net(sheet: &Sheet<'_>, hits: &[Hit], settings: &Settings) -> Vec<Finding> {
    let net = hits[0].net;
    let through = hits.iter().any(|hit| hit.through);
    let rest = sheet.remains.nets.get(&net).filter(|_| through);
    let interior = rest.map(|rest| Interior::new(sheet, net, &rest.designed));
    let clusters: Vec<&[Hit]> = clusters(hits).collect();
    clusters.into_par_iter().map(|hits| finding(sheet, interior.as_ref(), hits, settings)).collect()
}

/// What belongs together, at its deepest.
fn finding(sheet: &Sheet<'_>, interior: Option<&Interior<'_>>, hits: &[Hit], settings: &Settings) -> Finding {
    let deepest = hits.iter().copied().reduce(|a, b| if b.depth > a.depth { b } else { a });
    let mut deepest = deepest.expect("a finding has hits");
    if let Some(interior) = interior {
        deepest = inside(sheet, interior, hits, deepest);
    } else if let Some(around) = around(sheet, hits) {
        deepest = nearby(sheet, around, hits, deepest);
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

/// What bounds the cuts whose middle goes through copper, where there are any.
fn around(sheet: &Sheet<'_>, hits: &[Hit]) -> Option<Rect> {
    let through = hits.iter().filter(|hit| hit.through);
    through.map(|hit| sheet.cuts[hit.cut].swept.shape.bounds()).reduce(Rect::union)
}

/// How far copper is looked at around cuts, at first. Chosen: few cuts go through copper wider than twice that.
const NEARBY: Nm = Nm::from_mm(1);

/// The same as [`inside`] by the copper near these cuts: what is cut off there is no edge, but none of it is nearer than `reach`.
fn nearby(sheet: &Sheet<'_>, around: Rect, hits: &[Hit], deepest: Hit) -> Hit {
    let mut reach = NEARBY;
    loop {
        let rect = around.inflate(reach);
        let interior = Interior::new(sheet, deepest.net, &designed(sheet, deepest.net, rect));
        let found = inside(sheet, &interior, hits, deepest);
        let whole =
            sheet.extent(deepest.net).is_none_or(|all| rect.contains(all.min()) && rect.contains(all.max()));
        if whole || found.depth < reach.to_f64() {
            return found;
        }
        reach = reach * 4;
    }
}

/// Where the cutter's middle goes through copper: the place of its way that lies deepest inside.
fn inside(sheet: &Sheet<'_>, interior: &Interior<'_>, hits: &[Hit], mut deepest: Hit) -> Hit {
    for hit in hits.iter().filter(|hit| hit.through) {
        let cut = sheet.cuts[hit.cut].swept;
        let half = cut.half().to_f64();
        if let Some(Deepest { at, depth }) = interior.deepest(&cut.shape, deepest.depth - half) {
            deepest = Hit { at, depth: half + depth, ..*hit };
        }
    }
    deepest
}
