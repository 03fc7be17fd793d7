//! What is left, exactly: polygons where the picture leaves a doubt.
//!
//! The picture tells cheaply what is beyond doubt: drawn with narrower kerfs, a piece that holds
//! one net has no short. Whatever it leaves in doubt, and every net that a cut may part, is asked
//! here: the sheet less all kerfs, and the copper of each net less all kerfs, as polygons
//! ([`polarity`]), around the place in doubt only. A program without faults costs nothing here.
//!
//! ```text
//!   ▒▒▒▒╲ · ╱▒▒▒▒     A cut along a net leaves it whole; one across it leaves two pieces, however thin one
//!   ▒▒▒▒▒╲·╱▒▒▒▒▒     of them is, and however fine the pixel would have to be to show it.
//! ```

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use crate::board::polarity;
use crate::geometry::{Nm, Point, Polygon, Rect};
use crate::topology::NetId;

use super::Settings;
use super::crowd;
use super::hit::Hit;
use super::parting::may_part;
use super::sheet::Sheet;

/// What is left where it is not beyond doubt.
#[derive(Debug, Default)]
pub(super) struct Remains {
    /// Connected pieces of what is left that hold considerable copper of several nets.
    pub(super) joined: Vec<Joined>,
    /// The nets that a cut may have parted.
    pub(super) nets: BTreeMap<NetId, Rest>,
    /// Nets of which it was not worked out whether they are joined or parted.
    pub(super) unsure: BTreeSet<NetId>,
}

/// Nets that are joined.
#[derive(Clone, Debug)]
pub(super) struct Joined {
    /// Where all of it lies.
    pub(super) place: Rect,
    /// In order.
    pub(super) nets: Vec<NetId>,
    /// Whether too many cuts cross there to say by what.
    pub(super) crowded: bool,
}

/// What became of a net.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    /// Its copper as designed, as far as it lies on the board.
    pub(super) designed: Vec<Polygon>,
    /// Its considerable parts, the largest first.
    pub(super) parts: Vec<Remnant>,
}

/// A connected piece of a net's copper.
#[derive(Clone, Debug)]
pub(super) struct Remnant {
    pub(super) polygon: Polygon,
    /// In mm².
    pub(super) area: f64,
    /// The connected piece of clad that it is part of.
    pub(super) piece: usize,
}

impl Rest {
    /// Its area as designed, in mm².
    pub(super) fn area(&self) -> f64 {
        self.designed.iter().map(Polygon::area_mm2).sum()
    }

    /// The area from which on a part of it counts, in mm²: a crumb, or of small nets three tenths.
    pub(super) fn least(&self, settings: &Settings) -> f64 {
        (self.area() * SMALL).min(settings.crumb)
    }

    /// The parts by what they conduct to, each group the largest first; more than one for a net
    /// that is cut in two.
    pub(super) fn apart(&self) -> Vec<Vec<&Remnant>> {
        let mut groups: Vec<Vec<&Remnant>> = Vec::new();
        for part in &self.parts {
            match groups.iter_mut().find(|group| group[0].piece == part.piece) {
                Some(group) => group.push(part),
                None => groups.push(vec![part]),
            }
        }
        groups
    }
}

/// A part of the board in doubt.
#[derive(Clone, Debug)]
pub(super) struct Doubt {
    pub(super) rect: Rect,
    /// The nets that may be joined.
    pub(super) nets: BTreeSet<NetId>,
    /// Of these, those that may be parted; all of each lies in the rectangle.
    pub(super) parted: BTreeSet<NetId>,
}

/// In shares of a crumb, the copper of a net in the picture from which on a piece is in doubt.
/// Chosen: pixels are coarse.
pub(super) const HINT: f64 = 0.1;
/// The part of a small net that is left of it where something is.
pub(super) const SMALL: f64 = 0.3;

impl Remains {
    /// What is left of a sheet; of the nets that are `lost` nothing is.
    pub(super) fn new(sheet: &Sheet<'_>, lost: &BTreeSet<NetId>, settings: &Settings) -> Self {
        let mut all = Self::default();
        // Of a net that is lost to many cuts there is nothing to work out.
        let many = |net: &&NetId| sheet.hits.many.contains_key(net);
        for &net in lost.iter().filter(many) {
            let designed = sheet.extent(net).map_or(Vec::new(), |rect| designed(sheet, net, rect));
            all.nets.insert(net, Rest { designed, parts: Vec::new() });
        }
        let mut doubts: Vec<Doubt> = Vec::new();
        for doubt in doubts_of(sheet, &all, settings) {
            merge(&mut doubts, doubt);
        }
        let look = |doubt: &Doubt| match crosses(sheet, doubt.rect) {
            true => crowd::within(sheet, doubt, settings),
            false => Self::within(sheet, doubt, settings),
        };
        let looked_at: Vec<Self> = doubts.par_iter().map(look).collect();
        for mut remains in looked_at {
            all.joined.append(&mut remains.joined);
            all.nets.append(&mut remains.nets);
            all.unsure.append(&mut remains.unsure);
        }
        all
    }

    /// What is left in a part of the board.
    pub(super) fn within(sheet: &Sheet<'_>, doubt: &Doubt, settings: &Settings) -> Self {
        let bounded = |polygon: Polygon| (polygon.bounds(), polygon);
        let kerfs: Vec<(Rect, Polygon)> = kerfs(sheet, doubt.rect).into_iter().map(bounded).collect();
        let ground = sheet.ground(doubt.rect);
        let clad: Vec<(Rect, Polygon)> = left(&ground, &kerfs).into_iter().map(bounded).collect();
        let within = Within { rect: doubt.rect, ground, kerfs, clad };
        let nets: Vec<NetId> = doubt.nets.iter().copied().collect();
        let rests: Vec<Rest> = nets.par_iter().map(|&net| within.rest(sheet, net, settings)).collect();
        let mut by_piece: BTreeMap<usize, Vec<NetId>> = BTreeMap::new();
        for (net, rest) in nets.iter().zip(&rests) {
            let pieces: BTreeSet<usize> = rest.parts.iter().map(|part| part.piece).collect();
            pieces.into_iter().for_each(|piece| by_piece.entry(piece).or_default().push(*net));
        }
        let several = by_piece.into_iter().filter(|(_, nets)| nets.len() > 1);
        let joined =
            |(piece, nets): (usize, Vec<NetId>)| Joined { place: within.clad[piece].0, nets, crowded: false };
        let joined = several.map(joined).collect();
        let parted = nets.into_iter().zip(rests).filter(|(net, _)| doubt.parted.contains(net)).collect();
        Self { joined, nets: parted, unsure: BTreeSet::new() }
    }
}

/// What the picture leaves in doubt.
fn doubts_of(sheet: &Sheet<'_>, known: &Remains, settings: &Settings) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    let mut reach: BTreeMap<NetId, Rect> = BTreeMap::new();
    for parts in sheet.parts.chunk_by(|a, b| a.piece == b.piece) {
        let place = parts.iter().map(|part| sheet.place(part.extent)).reduce(Rect::union);
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
    let hits = sheet.hits.all.chunk_by(|a, b| a.net == b.net);
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

/// How far curves are flattened where areas count: of a strip of a tenth of a millimetre that is a
/// thousandth. Chosen.
const FINE: Nm = Nm::new(50);
/// The kerfs that touch `rect`.
fn kerfs(sheet: &Sheet<'_>, rect: Rect) -> Vec<Polygon> {
    let near = sheet.places.cuts.touching(rect);
    near.par_iter().filter_map(|&cut| sheet.cuts[cut].swept.parting().polygon(FINE)).collect()
}

/// The copper of a net within `rect`, one polygon for each connected piece.
fn copper(sheet: &Sheet<'_>, net: NetId, rect: Rect) -> Vec<Polygon> {
    let features = sheet.nets.nets()[net.index()].features.iter();
    let shapes = features.map(|&feature| &sheet.copper.features[feature as usize].shape);
    let near = shapes.filter(|shape| shape.bounds().touches(rect));
    let clipped: Vec<Polygon> = near.filter_map(|shape| shape.polygon(FINE)?.clipped(rect)).collect();
    polarity::union(&clipped)
}

/// The copper of a net within `rect` as far as it lies on the board.
pub(super) fn designed(sheet: &Sheet<'_>, net: NetId, rect: Rect) -> Vec<Polygon> {
    on(&sheet.ground(rect), &copper(sheet, net, rect))
}

/// What of copper lies on the ground.
fn on(ground: &[Polygon], copper: &[Polygon]) -> Vec<Polygon> {
    let both = |copper| ground.iter().flat_map(move |ground| polarity::intersection(copper, ground));
    copper.iter().flat_map(both).collect()
}

/// What kerfs leave of polygons.
fn left(whole: &[Polygon], kerfs: &[(Rect, Polygon)]) -> Vec<Polygon> {
    let less = |polygon: &Polygon| {
        let rect = polygon.bounds();
        let near = kerfs.iter().filter(|(bounds, _)| bounds.touches(rect)).map(|(_, kerf)| kerf);
        polarity::difference(polygon, near)
    };
    whole.iter().flat_map(less).collect()
}

/// A part of the board, milled.
struct Within {
    rect: Rect,
    /// The board.
    ground: Vec<Polygon>,
    /// All kerfs, each with its bounds; and what they leave of the board.
    kerfs: Vec<(Rect, Polygon)>,
    clad: Vec<(Rect, Polygon)>,
}

impl Within {
    /// What became of a net.
    fn rest(&self, sheet: &Sheet<'_>, net: NetId, settings: &Settings) -> Rest {
        let designed = on(&self.ground, &copper(sheet, net, self.rect));
        let mut rest = Rest { parts: Vec::new(), designed };
        let least = rest.least(settings);
        let parts = left(&rest.designed, &self.kerfs).into_iter();
        rest.parts = parts.filter_map(|polygon| self.remnant(polygon, least)).collect();
        rest.parts.sort_by(|a, b| b.area.total_cmp(&a.area));
        rest
    }

    /// A part of a net with its place, where it has so many mm².
    fn remnant(&self, polygon: Polygon, least: f64) -> Option<Remnant> {
        let area = polygon.area_mm2();
        let p = if area >= least { inside(&polygon)? } else { return None };
        let holds = |(bounds, clad): &(Rect, Polygon)| bounds.contains(p) && clad.contains(p);
        let piece = self.clad.iter().position(holds)?;
        Some(Remnant { polygon, area, piece })
    }
}

/// Rows that are looked along for a point inside. Chosen.
const ROWS: u32 = 7;

/// A point inside a simple polygon, far from its edges as such points go: the middle of the longest
/// way across it in a few rows.
fn inside(polygon: &Polygon) -> Option<Point> {
    let bounds = polygon.bounds();
    let row = |row: u32| {
        let y = bounds.min().y.to_f64() + bounds.height().to_f64() * (f64::from(row) + 0.5) / f64::from(ROWS);
        // Between two values of y that corners can have.
        let y = libm::floor(y) + 0.5;
        let mut crossings: Vec<f64> = polygon
            .edges()
            .map(|(a, b)| (a.to_f64(), b.to_f64()))
            .filter(|((_, ay), (_, by))| (*ay < y) != (*by < y))
            .map(|((ax, ay), (bx, by))| ax + (bx - ax) * (y - ay) / (by - ay))
            .collect();
        crossings.sort_by(f64::total_cmp);
        let spans = crossings.chunks_exact(2).map(|pair| (pair[1] - pair[0], (pair[0] + pair[1]) / 2.0));
        spans.reduce(|a, b| if b.0 > a.0 { b } else { a }).map(|(width, x)| (width, Point::from_f64(x, y)))
    };
    let rows = (0..ROWS).filter_map(row);
    rows.reduce(|a, b| if b.0 > a.0 { b } else { a }).map(|(_, p)| p)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_inside_a_ring_lies_in_its_copper() {
        let square = |low: i64, high: i64| {
            let at = |um: i64| Point::new(Nm::from_um(um), Nm::from_um(um));
            Rect::new(at(low), at(high)).corners().to_vec()
        };
        let mut hole = square(10, 990);
        hole.reverse();
        let ring = Polygon::new(vec![square(0, 1000), hole]).expect("a ring");
        let p = inside(&ring).expect("a point");
        assert!(ring.winding(p) == Some(1), "{p:?} lies in the ring, 10 µm wide");
    }
}
