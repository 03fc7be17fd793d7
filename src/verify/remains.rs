//! What is left: beyond doubt where the picture tells, and asked more closely where it does not.
//!
//! The picture tells cheaply what is beyond doubt: drawn with narrower kerfs, a piece that holds
//! one net has no short. Whatever it leaves in doubt, and every net that a cut may part, is asked
//! of polygons, or of finer pictures where too many cuts cross. A program without faults costs
//! nothing here.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use crate::geometry::{Nm, Rect};
use crate::topology::NetId;

use super::hit::{Hit, Hits};
use super::parting::may_part;
use super::pieces::Part;
use super::rest::{Doubt, HINT, Remains, Rest};
use super::sheet::Sheet;
use super::{Settings, crowd, exact};

/// What is left of a sheet; of the nets that are `lost` nothing is.
pub(super) fn remains(
    sheet: &Sheet<'_>,
    parts: &[Part],
    hits: &Hits,
    lost: &BTreeSet<NetId>,
    settings: &Settings,
) -> Remains {
    let mut all = Remains::default();
    // Of a net that is lost to many cuts there is nothing to work out.
    let many = |net: &&NetId| hits.many.contains_key(net);
    for &net in lost.iter().filter(many) {
        let designed =
            sheet.extent(net).map_or(Vec::new(), |rect| exact::designed(sheet, net, rect, exact::FINE));
        all.nets.insert(net, Rest { designed, parts: Vec::new() });
    }
    let mut doubts: Vec<Doubt> = Vec::new();
    for doubt in doubts_of(sheet, parts, hits, &all, settings) {
        merge(&mut doubts, doubt);
    }
    let look = |doubt: &Doubt| match crosses(sheet, doubt.rect) {
        true => crowd::within(sheet, doubt, settings),
        false => exact::within(sheet, doubt, settings),
    };
    let looked_at: Vec<Remains> = doubts.par_iter().map(look).collect();
    for mut remains in looked_at {
        all.joined.append(&mut remains.joined);
        all.nets.append(&mut remains.nets);
        all.unsure.append(&mut remains.unsure);
    }
    all
}

/// What the picture leaves in doubt.
fn doubts_of(
    sheet: &Sheet<'_>,
    parts: &[Part],
    hits: &Hits,
    known: &Remains,
    settings: &Settings,
) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    let mut reach: BTreeMap<NetId, Rect> = BTreeMap::new();
    for parts in parts.chunk_by(|a, b| a.piece == b.piece) {
        let place = parts.iter().map(|part| part.extent.rect(&sheet.grid)).reduce(Rect::union);
        let Some(rect) = place.map(|rect| rect.inflate(sheet.pitch() * 2)) else { continue };
        let held = parts.iter().filter_map(|part| Some((Sheet::net(part.label)?, part.pixels)));
        let mut nets = BTreeSet::new();
        for (net, pixels) in held {
            reach.entry(net).and_modify(|all| *all = all.union(rect)).or_insert(rect);
            if sheet.mm2(pixels) >= settings.crumb * HINT {
                nets.insert(net);
            }
        }
        if nets.len() > 1 {
            doubts.push(Doubt { rect, nets, parted: BTreeSet::new() });
        }
    }
    let hits = hits.all.chunk_by(|a, b| a.net == b.net);
    let hits: Vec<&[Hit]> = hits.filter(|hits| !known.nets.contains_key(&hits[0].net)).collect();
    let parted = |hits: &[Hit]| {
        let net = hits[0].net;
        let place = sheet.extent(net)?;
        let rect = reach.get(&net).map_or(place, |reach| reach.union(place));
        let nets = BTreeSet::from([net]);
        may_part(sheet, hits, place, settings).then(|| Doubt { rect, parted: nets.clone(), nets })
    };
    doubts.par_extend(hits.into_par_iter().filter_map(parted));
    doubts
}

/// Adds a doubt, as one with all whose rectangles touch its own.
fn merge(doubts: &mut Vec<Doubt>, mut doubt: Doubt) {
    while let Some(at) = doubts.iter().position(|other| other.rect.touches(doubt.rect)) {
        let mut other = doubts.swap_remove(at);
        doubt.rect = doubt.rect.union(other.rect);
        doubt.nets.append(&mut other.nets);
        doubt.parted.append(&mut other.parted);
    }
    doubts.push(doubt);
}

/// Pairs of cuts that may cross in a doubt of which polygons are made, and for each cut so many
/// more. Chosen, and not compared with other numbers.
const PAIRS: usize = 200_000;
const EACH: usize = 20;

/// Whether more cuts cross within `rect` than polygons are made of.
fn crosses(sheet: &Sheet<'_>, rect: Rect) -> bool {
    let near = sheet.places.cuts.touching(rect);
    let most = PAIRS + near.len() * EACH;
    let mut pairs = 0;
    for cut in near {
        pairs += sheet.walls.count(cut, Nm::ZERO, most);
        if pairs > most {
            return true;
        }
    }
    false
}
