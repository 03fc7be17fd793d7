//! Where the cutter reaches into copper of the design, measured on the exact shapes.

use rayon::prelude::*;

use crate::board::Shape;
use crate::geometry::{Nm, Point};
use crate::topology::{Near, NetId};

use super::sheet::{Cut, Sheet};

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

/// All pieces of cuts that reach further than `tolerance` into a net: by net, what the gap forces
/// apart from the rest, in order; and how many more reach so little into one that it is nothing.
pub(super) fn hits(sheet: &Sheet<'_>, tolerance: Nm) -> (Vec<Hit>, usize) {
    let cuts = sheet.cuts.par_iter().enumerate();
    let mut hits: Vec<Hit> = cuts.flat_map_iter(|(index, cut)| taken(sheet, index, cut, tolerance)).collect();
    let all = hits.len();
    let kerf = |hit: &Hit| sheet.cuts[hit.cut].swept.half().to_f64() * 2.0;
    hits.retain(|hit| hit.depth > (kerf(hit) * FAINT_SHARE).max(FAINT));
    let faint = all - hits.len();
    hits.sort_by_key(|hit| (hit.net, hit.forced, hit.cut));
    (hits, faint)
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

/// The nets that a piece of a cut takes copper of, each once, at its deepest.
fn taken(sheet: &Sheet<'_>, index: usize, cut: &Cut<'_>, tolerance: Nm) -> Vec<Hit> {
    let half = cut.swept.half();
    let mut hits: Vec<Hit> = Vec::new();
    for near in sheet.proximity.near(&cut.swept.axis(), half - tolerance) {
        let net = sheet.nets.of(near.feature);
        let depth = half.to_f64() - near.width;
        let known = hits.iter().position(|other| other.net == net);
        let is_deeper = known.is_none_or(|known| hits[known].depth < depth);
        if near.width >= (half - tolerance).to_f64() || !is_deeper || !sheet.holds(near.at) {
            continue;
        }
        let hit = Hit { cut: index, net, depth, at: near.at, through: near.width <= 0.0, forced: false };
        match known {
            Some(known) => hits[known] = hit,
            None => hits.push(hit),
        }
    }
    for hit in &mut hits {
        hit.forced = forced(sheet, cut, hit, tolerance);
    }
    hits
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
