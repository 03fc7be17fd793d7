//! # What it checks
//!
//! How far the cutter reaches into the copper of the design, measured on the exact shapes: half the
//! kerf less the distance from the cutter's way to the copper, or where the way goes through
//! copper, half the kerf and the distance to its edge. How bad that is follows from what it costs,
//! not from its cause: it is an error where the cutter's middle goes through copper, where less
//! than a stated part of the net's width is left, or where it is deeper than stated; else a
//! warning. That the design's gap is narrower than the kerf explains it.
//!
//! One place is one finding, of all nets that lose copper there. Shallow ones of one cause are one
//! finding of a side, at the deepest, with the other places beside it; what is less than a
//! micrometre or a hundredth of the kerf is only counted.
//!
//! # Why
//!
//! Traces get narrower, pads smaller.
//!
//! # What it can miss
//!
//! Less than the tolerance. What the tool takes when it bends or runs out. The width is looked at
//! straight across, no farther than 0.6 mm.

use rayon::prelude::*;

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::geometry::{Nm, Point, Rect};
use crate::topology::NetId;
use crate::verify::Settings;
use crate::verify::exact::{FINE, designed};
use crate::verify::hit::{Hit, TOGETHER, clusters};
use crate::verify::interior::{Deepest, Interior};
use crate::verify::loss::lost;
use crate::verify::outcome::Outcome;
use crate::verify::report::Finding;
use crate::verify::sheet::Sheet;
use crate::verify::width::{Width, narrowest};

/// Copper that is milled though it should stay.
pub const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("copper of the design cut away"),
    effect: Words::of(
        "a trace or pad loses copper: it carries less current, and may come off when it is soldered",
    ),
    advice: Words::of(
        "use a narrower tool, or with a V-bit the {kerf} that fits; {narrow} skip leaves such a gap uncut, and its nets joined",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Isolation(check) };

const NAME: &str = "gouge";

/// Less deep places of one cause are told of together. Chosen: half of what is an error everywhere.
const SHALLOW: f64 = 50_000.0;

/// A place where copper is cut away.
#[derive(Clone, Debug)]
struct Gouge {
    severity: Severity,
    /// At its deepest.
    deepest: Hit,
    nets: Vec<NetId>,
    /// In mm².
    area: f64,
    /// The part of a net's width that is left, where it is that which makes it an error.
    narrow: Option<Width>,
    /// Where else it is the same cut.
    places: Vec<Point>,
}

impl Gouge {
    fn is_shallow(&self) -> bool {
        self.severity < Severity::Error && self.deepest.depth <= SHALLOW
    }
}

fn check(sheet: &Outcome<'_>, settings: &Settings) -> Vec<Finding> {
    // Of a net that is lost to many cuts `destroyed` tells.
    let is_left = |hits: &&[Hit]| {
        let rest = sheet.remains.nets.get(&hits[0].net);
        !sheet.hits.many.contains_key(&hits[0].net) || rest.is_none_or(|rest| !rest.parts.is_empty())
    };
    let nets: Vec<&[Hit]> = sheet.hits.all.chunk_by(|a, b| a.net == b.net).filter(is_left).collect();
    let gouges = nets.into_par_iter().flat_map(|hits| of_net(sheet, hits, settings)).collect();
    let (shallow, deep): (Vec<Gouge>, Vec<Gouge>) =
        one_for_each_place(sheet, gouges).into_iter().partition(Gouge::is_shallow);
    let (forced, others): (Vec<Gouge>, Vec<Gouge>) =
        shallow.into_iter().partition(|gouge| gouge.deepest.forced);
    let together = [forced, others].into_iter().filter_map(|gouges| together(sheet, &gouges));
    deep.iter().map(|gouge| finding(sheet, gouge)).chain(together).chain(faint(sheet)).collect()
}

/// What is cut away of a net.
fn of_net(sheet: &Outcome<'_>, hits: &[Hit], settings: &Settings) -> Vec<Gouge> {
    let net = hits[0].net;
    let through = hits.iter().any(|hit| hit.through);
    let rest = sheet.remains.nets.get(&net).filter(|_| through);
    let interior = rest.map(|rest| Interior::new(sheet, net, &rest.designed));
    let clusters: Vec<&[Hit]> = clusters(hits).collect();
    clusters.into_par_iter().map(|hits| gouge(sheet, interior.as_ref(), hits, settings)).collect()
}

/// What belongs together, at its deepest.
fn gouge(sheet: &Sheet<'_>, interior: Option<&Interior<'_>>, hits: &[Hit], settings: &Settings) -> Gouge {
    let deepest = hits.iter().copied().reduce(|a, b| if b.depth > a.depth { b } else { a });
    let mut deepest = deepest.expect("a finding has hits");
    if let Some(interior) = interior {
        deepest = inside(sheet, interior, hits, deepest);
    } else if let Some(around) = around(sheet, hits) {
        deepest = nearby(sheet, around, hits, deepest);
    }
    debug_assert!(Nm::from_f64(deepest.depth) > settings.gouge, "shallow hits are left out");
    let narrow = narrowest(sheet, hits).filter(|width| width.share() < settings.keep);
    let costs = deepest.through || deepest.depth > settings.deep.to_f64() || narrow.is_some();
    let severity = if costs { Severity::Error } else { Severity::Warning };
    Gouge { severity, deepest, nets: vec![deepest.net], area: lost(sheet, hits), narrow, places: Vec::new() }
}

/// A cut that takes copper on both sides of a gap makes one place of them.
fn one_for_each_place(sheet: &Sheet<'_>, mut gouges: Vec<Gouge>) -> Vec<Gouge> {
    gouges.sort_by(|a, b| (a.deepest.cut, &a.nets).cmp(&(b.deepest.cut, &b.nets)));
    let mut places: Vec<Gouge> = Vec::new();
    for gouge in gouges {
        let half = sheet.cuts[gouge.deepest.cut].swept.half();
        let reach = (TOGETHER + half * 2).to_f64();
        let is_same = |place: &&mut Gouge| {
            place.deepest.forced == gouge.deepest.forced
                && !place.nets.contains(&gouge.deepest.net)
                && place.deepest.at.distance(gouge.deepest.at) <= reach
        };
        let recent = places.iter_mut().rev().take_while(|place| place.deepest.cut + 2 >= gouge.deepest.cut);
        let Some(place) = recent.into_iter().find(is_same) else {
            places.push(gouge);
            continue;
        };
        place.severity = place.severity.max(gouge.severity);
        place.area += gouge.area;
        place.nets.extend(&gouge.nets);
        place.narrow = place.narrow.or(gouge.narrow);
        let mut other = gouge.deepest;
        if other.depth > place.deepest.depth {
            std::mem::swap(&mut other, &mut place.deepest);
        }
        place.places.push(other.at);
    }
    places
}

/// A narrower kerf is none that a tool cuts. Chosen: finer tips break.
const FINEST: f64 = 20_000.0;

/// Why copper had to be cut away, for people, and the kerf that takes none at the deepest of these
/// places; of places that nothing forced, nothing.
fn why(sheet: &Sheet<'_>, deepest: &Hit, gaps: &str) -> String {
    if !deepest.forced {
        return String::new();
    }
    let kerf = sheet.cuts[deepest.cut].swept.half().to_f64() * 2.0 - deepest.depth * 2.0;
    let fits = Nm::from_f64((kerf / 1_000.0).floor() * 1_000.0);
    let fits = if kerf < FINEST { String::new() } else { format!("; one of {fits:.3} mm fits") };
    format!(": {gaps} narrower than the kerf{fits}")
}

fn finding(sheet: &Sheet<'_>, gouge: &Gouge) -> Finding {
    let Gouge { severity, deepest, area, narrow, .. } = gouge;
    let names: Vec<String> = gouge.nets.iter().map(|&net| sheet.nets.label(net)).collect();
    let left = narrow.map_or(String::new(), |Width { left, designed, .. }| {
        format!(", {left:.3} mm of {designed:.3} mm are left")
    });
    let (depth, names_and) = (deepest.depth / 1000.0, names.join(" and "));
    let why = why(sheet, deepest, "the gap is");
    let message = format!("{depth:.0} µm of {names_and} are cut away, {area:.4} mm²{left}{why}");
    let cut = sheet.cuts[deepest.cut];
    Finding {
        nets: names,
        at: Some(deepest.at),
        size: Some(Nm::from_f64(deepest.depth)),
        area: Some(*area),
        program: Some(cut.program.followed.file.clone()),
        line: Some(cut.swept.line),
        places: gouge.places.clone(),
        ..Finding::new(NAME, *severity, message)
    }
}

/// Shallow places of one cause, as one finding at the deepest of them.
fn together(sheet: &Sheet<'_>, gouges: &[Gouge]) -> Option<Finding> {
    let worst = gouges.iter().reduce(|a, b| if b.deepest.depth > a.deepest.depth { b } else { a })?;
    if gouges.len() == 1 {
        return Some(finding(sheet, worst));
    }
    let area: f64 = gouges.iter().map(|gouge| gouge.area).sum();
    let mut nets: Vec<NetId> = gouges.iter().flat_map(|gouge| gouge.nets.iter().copied()).collect();
    nets.sort_unstable();
    nets.dedup();
    let places =
        gouges.iter().flat_map(|gouge| std::iter::once(gouge.deepest.at).chain(gouge.places.iter().copied()));
    let others = places.filter(|at| *at != worst.deepest.at);
    let depth = worst.deepest.depth / 1000.0;
    let why = why(sheet, &worst.deepest, "their gaps are");
    let count = gouges.len();
    let message = format!("up to {depth:.0} µm of copper are cut away in {count} places, {area:.4} mm²{why}");
    Some(Finding {
        message,
        nets: nets.into_iter().map(|net| sheet.nets.label(net)).collect(),
        area: Some(area),
        places: others.collect(),
        ..finding(sheet, worst)
    })
}

/// How often so little is taken that it is nothing.
fn faint(sheet: &Outcome<'_>) -> Option<Finding> {
    let message = format!(
        "{} times a cut removes less than a micrometre, or a hundredth of the kerf, of copper: these are not listed",
        sheet.hits.faint
    );
    (sheet.hits.faint > 0).then(|| Finding::new(NAME, Severity::Info, message))
}

/// What bounds the cuts whose middle goes through copper, where there are any.
fn around(sheet: &Sheet<'_>, hits: &[Hit]) -> Option<Rect> {
    let through = hits.iter().filter(|hit| hit.through);
    through.map(|hit| sheet.cuts[hit.cut].swept.shape.bounds()).reduce(Rect::union)
}

/// How far copper is looked at around cuts, at first. Chosen: few cuts go through copper wider than
/// twice that.
const NEARBY: Nm = Nm::from_mm(1);

/// The same as [`inside`] by the copper near these cuts: what is cut off there is no edge, but none
/// of it is nearer than `reach`.
fn nearby(sheet: &Sheet<'_>, around: Rect, hits: &[Hit], deepest: Hit) -> Hit {
    let mut reach = NEARBY;
    loop {
        let rect = around.inflate(reach);
        let interior = Interior::new(sheet, deepest.net, &designed(sheet, deepest.net, rect, FINE));
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
