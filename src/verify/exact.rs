//! What is left, exactly: polygons where the picture leaves a doubt.
//!
//! The sheet less all kerfs, and the copper of each net less all kerfs, as polygons
//! ([`polarity`]), around the place in doubt only.
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
use super::rest::{Doubt, Joined, Remains, Remnant, Rest};
use super::sheet::Sheet;

/// What is left in a part of the board.
pub(super) fn within(sheet: &Sheet<'_>, doubt: &Doubt, settings: &Settings) -> Remains {
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
    Remains { joined, nets: parted, unsure: BTreeSet::new() }
}

/// How far curves are flattened where areas count: of a strip of a tenth of a millimetre that is a
/// thousandth. Chosen.
pub(super) const FINE: Nm = Nm::new(50);
/// Of half a kerf that is wide, its ends are flattened by one part in so many. Chosen: a tenth of
/// what no mill is as true as.
const ENDS: i64 = 1000;

/// The kerfs that touch `rect`.
fn kerfs(sheet: &Sheet<'_>, rect: Rect) -> Vec<Polygon> {
    let kerf = |&cut: &usize| {
        let swept = sheet.cuts[cut].swept;
        swept.parting().polygon(FINE.max(swept.floor / ENDS))
    };
    sheet.places.cuts.touching(rect).par_iter().filter_map(kerf).collect()
}

/// The copper of a net within `rect`, one polygon for each connected piece, curves flattened so
/// far.
fn copper(sheet: &Sheet<'_>, net: NetId, rect: Rect, flat: Nm) -> Vec<Polygon> {
    let features = sheet.nets.nets()[net.index()].features.iter();
    let shapes = features.map(|&feature| &sheet.copper.features[feature as usize].shape);
    let near = shapes.filter(|shape| shape.bounds().touches(rect));
    let clipped: Vec<Polygon> = near.filter_map(|shape| shape.polygon(flat)?.clipped(rect)).collect();
    polarity::union(&clipped)
}

/// The copper of a net within `rect` as far as it lies on the board.
pub(super) fn designed(sheet: &Sheet<'_>, net: NetId, rect: Rect, flat: Nm) -> Vec<Polygon> {
    on(&sheet.ground(rect), copper(sheet, net, rect, flat))
}

/// What of copper lies on the ground.
fn on(ground: &[Polygon], copper: Vec<Polygon>) -> Vec<Polygon> {
    let bounds = copper.iter().map(Polygon::bounds).reduce(Rect::union);
    let is_within = |ground: &Polygon| {
        // A rectangle that holds all of it.
        let rect = ground.bounds();
        ground.edges().count() == 4
            && ground.twice_area() == Polygon::rectangle(rect).twice_area()
            && bounds.is_none_or(|bounds| rect.contains(bounds.min()) && rect.contains(bounds.max()))
    };
    if let [ground] = ground
        && is_within(ground)
    {
        return copper;
    }
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
        let designed = on(&self.ground, copper(sheet, net, self.rect, FINE));
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
