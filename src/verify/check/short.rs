//! # What it checks
//!
//! No connected piece of what is left holds considerable parts of two nets; where the picture
//! leaves a doubt, the exact shapes decide. For every two that are joined: the bridge's narrowest
//! place and its width, from face to face of the exact cuts on both sides of it.
//!
//! # Why
//!
//! They conduct to each other.
//!
//! # What it can miss
//!
//! Copper that is smeared across a groove. Of a bridge in a tangle of thin strips, or within three
//! pixels of a place where the cuts of the same two nets only just meet, the place and the width;
//! not that there is one.

use std::collections::BTreeMap;

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::Shape;
use crate::geometry::{Nm, Point};
use crate::topology::NetId;
use crate::verify::cut::Cut;
use crate::verify::flood::{Basin, Join, Water};
use crate::verify::outcome::Outcome;
use crate::verify::report::Finding;
use crate::verify::rest::Joined;
use crate::verify::sheet::{NETS, Sheet};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("two nets joined by remaining copper"),
    effect: Words::of("current flows between nets that must be apart: the board does not work"),
    advice: Words::of(
        "isolate with a narrower cut ({tool}, or {depth} with a V-bit), and check that every cut goes through the copper ({depth}, `voromill level`)",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Isolation(|sheet, _| check(sheet)) };

const NAME: &str = "short";

fn check(sheet: &Outcome<'_>) -> Vec<Finding> {
    sheet.remains.joined.iter().flat_map(|joined| shorts(sheet, joined)).collect()
}

/// Places where cuts only just meet that are looked behind for a bridge. Chosen.
const ROUNDS: usize = 20;

/// The shorts of a connected piece: so many that they join all its nets.
fn shorts(sheet: &Sheet<'_>, joined: &Joined) -> Vec<Finding> {
    let nets = &joined.nets;
    if joined.crowded {
        let mut found = Vec::new();
        unseen(sheet, nets, &mut found);
        return found.iter().map(|bridge| finding(sheet, bridge, nets.len())).collect();
    }
    let basin = Basin::new(sheet, joined.place);
    let mut plugs: Vec<Point> = Vec::new();
    let mut found = Vec::new();
    for _ in 0..ROUNDS {
        let (real, closed): (Vec<Bridge>, Vec<Bridge>) = bridges(sheet, &basin, nets, &plugs)
            .into_iter()
            .partition(|bridge| bridge.width.is_none_or(|width| width > Nm::ZERO));
        found = real;
        // What is closed by far says that no better way is left; what is only just closed, that the
        // next best may be open.
        let just = closed.iter().filter(|bridge| bridge.width > Some(basin.grid.pitch() * -3));
        let before = plugs.len();
        plugs.extend(just.map(|bridge| bridge.place));
        if plugs.len() == before {
            break;
        }
    }
    unseen(sheet, nets, &mut found);
    found.iter().map(|bridge| finding(sheet, bridge, nets.len())).collect()
}

/// Adds what joins the nets that no bridge was found for: their copper is in one piece, though the
/// picture is too coarse to show by what.
fn unseen(sheet: &Sheet<'_>, nets: &[NetId], found: &mut Vec<Bridge>) {
    let mut joined = vec![nets[0]];
    loop {
        let other = |bridge: &Bridge| {
            let (a, b) = bridge.nets;
            let [has_a, has_b] = [a, b].map(|net| joined.contains(&net));
            (has_a != has_b).then_some(if has_a { b } else { a })
        };
        if let Some(next) = found.iter().find_map(other) {
            joined.push(next);
            continue;
        }
        let Some(&lonely) = nets.iter().find(|net| !joined.contains(net)) else { return };
        let feature = sheet.nets.nets()[lonely.index()].features[0] as usize;
        let at = sheet.copper.features[feature].shape.anchor();
        let one = closest(sheet, at, &joined);
        found.push(Bridge { nets: (one.min(lonely), one.max(lonely)), at, width: None, place: at });
    }
}

/// Two nets and the narrowest place of what joins them.
struct Bridge {
    nets: (NetId, NetId),
    at: Point,
    /// None where no cut is near; not above zero where the cuts meet.
    width: Option<Nm>,
    /// The pixel where they join.
    place: Point,
}

fn finding(sheet: &Sheet<'_>, bridge: &Bridge, count: usize) -> Finding {
    let [a, b] = [bridge.nets.0, bridge.nets.1].map(|net| sheet.nets.label(net));
    let wide = bridge.width.map_or(String::new(), |width| match width < Nm::from_um(1) {
        true => ", less than a micrometre wide".to_owned(),
        false => format!(", {width:.3} mm wide"),
    });
    let of = if count > 2 { format!(" (of {count} nets in one piece)") } else { String::new() };
    let cause = nearest(sheet, bridge.at);
    Finding {
        at: Some(bridge.at),
        size: bridge.width,
        program: cause.map(|cut| cut.program.followed.file.clone()),
        line: cause.map(|cut| cut.swept.line),
        ..Finding::new(NAME, Severity::Error, format!("{a} and {b} are joined by a bridge{wide}{of}"))
    }
    .of([a, b])
}

/// The cut nearest to a place.
fn nearest<'a>(sheet: &Sheet<'a>, p: Point) -> Option<Cut<'a>> {
    let (mut reach, most) = (Nm::from_um(500), sheet.rect().width().max(sheet.rect().height()) * 2);
    while reach < most {
        let walls = sheet.walls.around(p, reach);
        if let Some(cut) = walls.iter().find_map(|wall| sheet.cuts.get(wall.index)) {
            return Some(*cut);
        }
        reach = reach * 4;
    }
    None
}

/// The bridges between `nets`, at most one fewer than there are nets, none through `plugs`.
fn bridges(sheet: &Sheet<'_>, basin: &Basin, nets: &[NetId], plugs: &[Point]) -> Vec<Bridge> {
    let (mut water, mut parts) = seeded(basin, nets);
    let mut bridges = Vec::new();
    basin.flood(&mut water, plugs, |Join { pixel, roots }| {
        let Some(other) = parts.remove(&roots.1) else { return false };
        let Some(one) = parts.get_mut(&roots.0) else {
            parts.insert(roots.0, other);
            return false;
        };
        bridges.push(bridge(sheet, basin, pixel, (one, &other)));
        one.extend(other);
        bridges.len() + 1 >= nets.len()
    });
    bridges
}

/// A net is one part to begin with, wherever its pixels are: what joins it to itself is not looked
/// for. By root, the nets.
fn seeded(basin: &Basin, nets: &[NetId]) -> (Water, BTreeMap<u32, Vec<NetId>>) {
    let mut water = Water::new(basin.labels.len());
    let mut first: BTreeMap<u32, u32> = BTreeMap::new();
    for (at, &label) in (0_u32..).zip(&basin.labels) {
        if label >= NETS && nets.binary_search(&NetId(label - NETS)).is_ok() {
            water.tie(*first.entry(label).or_insert(at), at);
        }
    }
    let parts = first.into_iter().map(|(label, root)| (root, vec![NetId(label - NETS)])).collect();
    (water, parts)
}

fn bridge(sheet: &Sheet<'_>, basin: &Basin, pixel: usize, nets: (&[NetId], &[NetId])) -> Bridge {
    let (width, at) = basin.width(sheet, pixel);
    let one = closest(sheet, at, nets.0);
    let other = closest(sheet, at, nets.1);
    Bridge { nets: (one.min(other), one.max(other)), at, width, place: basin.place(pixel) }
}

/// Which of `nets` is nearest to a place.
fn closest(sheet: &Sheet<'_>, place: Point, nets: &[NetId]) -> NetId {
    if nets.len() == 1 {
        return nets[0];
    }
    let spot = Shape::Disc { center: place, radius: Nm::ZERO };
    let (mut reach, most) = (Nm::from_um(500), sheet.rect().width().max(sheet.rect().height()) * 2);
    while reach < most {
        let near = sheet.proximity.near(&spot, reach);
        let found = near
            .iter()
            .map(|near| (near.width, sheet.nets.of(near.feature)))
            .filter(|(_, net)| nets.contains(net))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if let Some((_, net)) = found {
            return net;
        }
        reach = reach * 4;
    }
    nets[0]
}
