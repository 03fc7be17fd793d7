//! Where the cutter reaches into copper of the design, measured on the exact shapes.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use crate::board::Shape;
use crate::geometry::{Nm, Point};
use crate::topology::{Near, NetId};

use super::cut::Cut;
use super::machining::part;
use super::sheet::Sheet;

/// A piece of a cut that takes copper of a net.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) cut: usize,
    pub(super) net: NetId,
    /// In nanometres; where the cutter's middle goes through copper, half the kerf.
    pub(super) depth: f64,
    pub(super) at: Point,
    /// Whether the cutter's middle goes through copper.
    pub(super) through: bool,
    /// Whether the gap is narrower than the kerf.
    pub(super) forced: bool,
}

/// What reaches less far into copper is nothing: so many nanometres, or this part of the kerf. Both
/// chosen: no mill is as true.
pub(super) const FAINT: f64 = 1_000.0;
const FAINT_SHARE: f64 = 0.01;

/// Where cuts take copper.
#[derive(Debug, Default)]
pub(super) struct Hits {
    /// By net, what the gap forces apart from the rest, in order.
    pub(super) all: Vec<Hit>,
    /// How often a cut reaches so little into a net that it is nothing.
    pub(super) faint: usize,
    /// Of nets that more cuts reach into than are looked at one by one, how many do; the deepest
    /// are among `all`.
    pub(super) many: BTreeMap<NetId, Many>,
}

/// How many cuts reach into a net.
#[derive(Clone, Copy, Debug)]
pub(super) struct Many {
    pub(super) count: usize,
    /// Whether there may be more: of a net of which nothing is left it does not matter.
    pub(super) or_more: bool,
}

/// Cuts into a net that are looked at one by one: of a net of which nothing is left, and of one of
/// which something is. Chosen, and not compared with other numbers.
const MANY: [usize; 2] = [500, 2_000];
/// Cuts that are looked at between counting. Chosen: they take some megabytes at worst.
const CHUNK: usize = 4_096;

impl Hits {
    /// All pieces of cuts that reach further than `tolerance` into a net. Of those that are `lost`
    /// nothing is left.
    pub(super) fn new(sheet: &Sheet<'_>, lost: &BTreeSet<NetId>, tolerance: Nm) -> Self {
        let mut hits = Self::default();
        let mut nets: BTreeMap<NetId, (usize, Vec<Hit>)> = BTreeMap::new();
        // Lost nets that many cuts reach into: how many more do is not asked.
        let mut closed: BTreeSet<NetId> = BTreeSet::new();
        for first in (0..sheet.cuts.len()).step_by(CHUNK) {
            let enough = |(net, (count, _)): (&NetId, &(usize, _))| lost.contains(net) && *count > MANY[0];
            closed.extend(nets.iter().filter(|net| enough(*net)).map(|(net, _)| *net));
            if closed.len() == sheet.nets.nets().len() {
                break;
            }
            let chunk = first..(first + CHUNK).min(sheet.cuts.len());
            let taken = |index: usize| taken(sheet, index, &closed, tolerance);
            let found: Vec<Hit> = chunk.into_par_iter().flat_map_iter(taken).collect();
            for hit in found {
                let kerf = sheet.cuts[hit.cut].swept.half().to_f64() * 2.0;
                if hit.depth <= (kerf * FAINT_SHARE).max(FAINT) {
                    hits.faint += 1;
                    continue;
                }
                let (count, own) = nets.entry(hit.net).or_default();
                *count += 1;
                own.push(hit);
                let most = MANY[usize::from(!lost.contains(&hit.net))];
                if own.len() > most * 2 {
                    deepest(own, most);
                }
            }
        }
        for (net, (count, mut own)) in nets {
            let most = MANY[usize::from(!lost.contains(&net))];
            if count > most {
                // Where nothing is left one is enough.
                deepest(&mut own, if lost.contains(&net) { 1 } else { most });
                hits.many.insert(net, Many { count, or_more: closed.contains(&net) });
            }
            hits.all.extend(own);
        }
        let forced = |hit: &mut Hit| hit.forced = forced(sheet, &sheet.cuts[hit.cut], hit, tolerance);
        hits.all.par_iter_mut().for_each(forced);
        hits.all.sort_by_key(|hit| (hit.net, hit.forced, hit.cut));
        hits
    }
}

/// Leaves the deepest of some hits, the first of those that are as deep.
fn deepest(hits: &mut Vec<Hit>, most: usize) {
    hits.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.cut.cmp(&b.cut)));
    hits.truncate(most);
}

/// Hits this near to each other are one. Chosen: what one looks at at once.
pub(super) const TOGETHER: Nm = Nm::from_um(500);

/// Hits in order, those together that follow one another or are near each other.
pub(super) fn clusters(hits: &[Hit]) -> impl Iterator<Item = &[Hit]> {
    hits.chunk_by(|a, b| {
        let near = b.cut - a.cut.min(b.cut) <= 2 || a.at.distance(b.at) <= TOGETHER.to_f64();
        (a.net, a.forced) == (b.net, b.forced) && near
    })
}

/// The nets that a piece of a cut takes copper of, each once, at its deepest; those that are
/// `closed` are not looked at.
fn taken(sheet: &Sheet<'_>, index: usize, closed: &BTreeSet<NetId>, tolerance: Nm) -> Vec<Hit> {
    let cut = sheet.cuts[index];
    let (half, axis) = (cut.swept.half(), cut.swept.axis());
    let mut hits: Vec<Hit> = Vec::new();
    let is_open = |feature: usize| closed.is_empty() || !closed.contains(&sheet.nets.of(feature));
    let near = sheet.proximity.near_of(&axis, half - tolerance, is_open).into_iter();
    for near in near.filter(|near| sheet.has_some_of(near.feature)) {
        let net = sheet.nets.of(near.feature);
        let known = hits.iter().position(|other| other.net == net);
        let least = known.map_or((half - tolerance).to_f64(), |known| half.to_f64() - hits[known].depth);
        let Some(near) = on_the_board(sheet, &axis, near, least) else { continue };
        let depth = half.to_f64() - near.width;
        let hit = Hit { cut: index, net, depth, at: near.at, through: near.width <= 0.0, forced: false };
        match known {
            Some(known) => hits[known] = hit,
            None => hits.push(hit),
        }
    }
    hits
}

/// Parts of a way shorter than this are not divided: where the narrowest place of one lies beyond
/// the board's edge, no more than half of it may lie within. Chosen: what a cut takes on so short a
/// way is nothing to the eye.
const SHORTEST: f64 = 10_000.0;

/// Where a way comes nearest to a feature, nearer than `least`, on the board. `near` is where it
/// does so anywhere: if that lies beyond the board's edge, both halves of the way are asked.
fn on_the_board(sheet: &Sheet<'_>, way: &Shape, near: Near, least: f64) -> Option<Near> {
    if near.width >= least {
        return None;
    }
    if sheet.holds(near.at) {
        return Some(near);
    }
    if way.length() <= SHORTEST {
        return None;
    }
    let mut best: Option<Near> = None;
    for (from, to) in [(0.0, 0.5), (0.5, 1.0)] {
        let half = part(way, from, to);
        let least = best.map_or(least, |best| best.width);
        let near = sheet.proximity.near_one(&half, Nm::from_f64(least.ceil()), near.feature);
        best = near.and_then(|near| on_the_board(sheet, &half, near, least)).or(best);
    }
    best
}

/// Whether the gap between the net and the next one is narrower than the kerf, and the cut goes
/// through its middle as far as it can.
fn forced(sheet: &Sheet<'_>, cut: &Cut<'_>, hit: &Hit, tolerance: Nm) -> bool {
    let kerf = cut.swept.half().to_f64() * 2.0;
    let own = cut.swept.half().to_f64() - hit.depth;
    let middle = Shape::Disc { center: sheet.walls.foot(hit.cut, hit.at), radius: Nm::ZERO };
    let others = sheet.proximity.near(&middle, Nm::from_f64(kerf));
    let others = others.iter().filter(|near| sheet.nets.of(near.feature) != hit.net);
    let Some(other) = others.map(|near: &Near| near.width).reduce(f64::min) else { return false };
    let gap = own + other;
    gap < kerf && hit.depth <= (kerf - gap) / 2.0 + tolerance.to_f64()
}
