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

use super::{Check, Run, Severity, area};
use crate::board::Shape;
use crate::geometry::{Nm, Point, Rect};
use crate::topology::{Near, NetId};
use crate::verify::Settings;
use crate::verify::machining::with_radius;
use crate::verify::report::Finding;
use crate::verify::sheet::{CUT, Cut, NETS, Sheet, Show, places};

pub(super) const CHECK: Check =
    Check { name: NAME, about: "copper of the design cut away", run: Run::Isolation(check) };

const NAME: &str = "gouge";

/// A piece of a cut that takes copper of a net.
#[derive(Clone, Copy, Debug)]
struct Hit {
    cut: usize,
    net: NetId,
    /// In nanometres; where the cutter's middle goes through copper, half the kerf.
    depth: f64,
    at: Point,
    /// Whether the cutter's middle goes through copper.
    through: bool,
    /// Whether the gap is narrower than the kerf.
    forced: bool,
}

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let cuts = sheet.cuts.par_iter().enumerate();
    let mut hits: Vec<Hit> = cuts.flat_map_iter(|(index, cut)| hits(sheet, index, cut, settings)).collect();
    hits.sort_by_key(|hit| (hit.net, hit.forced, hit.cut));
    let together = |a: &Hit, b: &Hit| {
        let near = b.cut - a.cut.min(b.cut) <= 2 || a.at.distance(b.at) <= TOGETHER.to_f64();
        (a.net, a.forced) == (b.net, b.forced) && near
    };
    hits.chunk_by(together)
        .collect::<Vec<_>>()
        .into_par_iter()
        .map(|hits| finding(sheet, hits, settings))
        .collect()
}

/// Hits this near to each other are one finding. Chosen: what one looks at at once.
const TOGETHER: Nm = Nm::from_um(500);

/// The nets that a piece of a cut takes copper of, each once, at its deepest.
fn hits(sheet: &Sheet<'_>, index: usize, cut: &Cut<'_>, settings: &Settings) -> Vec<Hit> {
    let half = cut.swept.half();
    let mut hits: Vec<Hit> = Vec::new();
    for near in sheet.proximity.near(&cut.swept.axis(), half - settings.gouge) {
        if near.width >= (half - settings.gouge).to_f64() || !sheet.holds(near.at) {
            continue;
        }
        let net = sheet.nets.of(near.feature);
        let depth = half.to_f64() - near.width;
        let hit = Hit { cut: index, net, depth, at: near.at, through: near.width <= 0.0, forced: false };
        match hits.iter_mut().find(|other| other.net == net) {
            Some(other) if other.depth >= depth => {}
            Some(other) => *other = hit,
            None => hits.push(hit),
        }
    }
    for hit in &mut hits {
        hit.forced = forced(sheet, cut, hit, settings);
    }
    hits
}

/// Whether the gap between the net and the next one is narrower than the kerf, and the cut goes through its middle as far as
/// it can.
fn forced(sheet: &Sheet<'_>, cut: &Cut<'_>, hit: &Hit, settings: &Settings) -> bool {
    let kerf = cut.swept.half().to_f64() * 2.0;
    let own = cut.swept.half().to_f64() - hit.depth;
    let middle = Shape::Disc { center: on_axis(&cut.swept.axis(), hit.at), radius: Nm::ZERO };
    let others = sheet.proximity.near(&middle, Nm::from_f64(kerf));
    let others = others.iter().filter(|near| sheet.nets.of(near.feature) != hit.net);
    let Some(other) = others.map(|near: &Near| near.width).reduce(f64::min) else { return false };
    let gap = own + other;
    gap < kerf && hit.depth <= (kerf - gap) / 2.0 + settings.gouge.to_f64()
}

/// The point of an axis nearest to `p`.
fn on_axis(axis: &Shape, p: Point) -> Point {
    let (px, py) = p.to_f64();
    match axis {
        Shape::Stroke { from, to, .. } => {
            let ((x, y), way) = (from.to_f64(), *to - *from);
            let (ux, uy) = (way.x.to_f64(), way.y.to_f64());
            let along = (((px - x) * ux + (py - y) * uy) / (ux * ux + uy * uy)).clamp(0.0, 1.0);
            Point::from_f64(x + ux * along, y + uy * along)
        }
        Shape::Arc { arc, .. } => {
            let ((x, y), radius) = (arc.center.to_f64(), arc.radius());
            let away = arc.center.distance(p).max(1.0);
            Point::from_f64(x + (px - x) / away * radius, y + (py - y) / away * radius)
        }
        Shape::Disc { center, .. } => *center,
        Shape::Polygon(_) => p,
    }
}

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

/// Where the cutter's middle goes through copper: the point of its way that lies deepest inside, of a few on every piece.
fn inside(sheet: &Sheet<'_>, hits: &[Hit], deepest: Hit) -> Hit {
    let through: Vec<&Hit> = hits.iter().filter(|hit| hit.through).collect();
    let step = through.len().div_ceil(SAMPLED);
    let mut best = deepest;
    for hit in through.into_iter().step_by(step) {
        let cut = &sheet.cuts[hit.cut].swept;
        for at in along(&cut.axis()).into_iter().chain([hit.at]) {
            let depth = cut.half().to_f64() + in_copper(sheet, hit.net, at, cut.half());
            if depth > best.depth {
                best = Hit { depth, at, forced: hit.forced, ..*hit };
            }
        }
    }
    best
}

/// Pieces that are looked at, at most. Chosen: a finding of more is bad enough.
const SAMPLED: usize = 12;

/// A few points of an axis.
fn along(axis: &Shape) -> Vec<Point> {
    let points = |at: &dyn Fn(f64) -> (f64, f64)| {
        (0..=8_u8).map(|step| at(f64::from(step) / 8.0)).map(|(x, y)| Point::from_f64(x, y)).collect()
    };
    match with_radius(axis, Nm::ZERO) {
        Shape::Stroke { from, to, .. } => {
            let ((x, y), way) = (from.to_f64(), to - from);
            points(&|f| (x + way.x.to_f64() * f, y + way.y.to_f64() * f))
        }
        Shape::Arc { arc, .. } => points(&|f| arc.at(f)),
        Shape::Disc { center, .. } => vec![center],
        Shape::Polygon(_) => Vec::new(),
    }
}

/// How deep a point lies in a net, in nanometres: the distance to the nearest pixel of anything else, within twice the kerf; 0
/// outside.
fn in_copper(sheet: &Sheet<'_>, net: NetId, p: Point, half: Nm) -> f64 {
    let reach = half * 4;
    let (grid, pictures) = sheet.window(Rect::new(p, p).inflate(reach), Nm::from_um(2), 300, &[Show::Design]);
    let label = net.0 + NETS;
    let others = places(&grid).zip(pictures[0].labels()).filter(|(_, own)| **own != label);
    let nearest =
        others.map(|((column, row), _)| grid.center(column, row).distance(p)).fold(reach.to_f64(), f64::min);
    (nearest - grid.pitch().to_f64() / 2.0).max(0.0)
}
