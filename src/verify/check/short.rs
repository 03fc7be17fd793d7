//! # What it checks
//!
//! No connected piece of what is left holds considerable parts of two nets. For every two that are joined: the bridge's narrowest place
//! and its width, which is where the piece comes apart when all cuts, and the board's edge, are made ever wider.
//!
//! # Why
//!
//! They conduct to each other.
//!
//! # What it can miss
//!
//! Bridges narrower than a pixel (an eighth of the kerf, or 25 µm), which only a cut that fails by less leaves. Copper that is
//! smeared across a groove.

use super::{Check, Run, Severity, considerable};
use crate::board::Shape;
use crate::geometry::{Nm, Point, Rect};
use crate::grid::Grid;
use crate::topology::NetId;
use crate::verify::Settings;
use crate::verify::pieces::Part;
use crate::verify::report::Finding;
use crate::verify::sheet::{CUT, Cut, NETS, OUTSIDE, Sheet, Show};

pub(super) const CHECK: Check =
    Check { name: NAME, about: "two nets joined by copper that was left", run: Run::Isolation(check) };

const NAME: &str = "short";

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let pieces = sheet.parts.chunk_by(|a, b| a.piece == b.piece);
    pieces.flat_map(|parts| joined(sheet, parts, settings)).collect()
}

/// The shorts of a piece.
fn joined(sheet: &Sheet<'_>, parts: &[Part], settings: &Settings) -> Vec<Finding> {
    let nets: Vec<NetId> = parts
        .iter()
        .filter_map(|part| {
            let (net, area) = (Sheet::net(part.label)?, sheet.mm2(part.pixels));
            let counts = area >= settings.crumb || area >= considerable(sheet, net, area, settings);
            counts.then_some(net)
        })
        .collect();
    if nets.len() < 2 {
        return Vec::new();
    }
    let place = parts.iter().map(|part| sheet.place(part.extent)).reduce(Rect::union);
    let bridges = bridges(sheet, place.unwrap_or(sheet.rect()), &nets);
    bridges.iter().map(|bridge| finding(sheet, bridge, nets.len())).collect()
}

/// Two nets and the narrowest place of what joins them.
struct Bridge {
    nets: (NetId, NetId),
    at: Point,
    /// None where no cut is near.
    width: Option<Nm>,
}

fn finding(sheet: &Sheet<'_>, bridge: &Bridge, count: usize) -> Finding {
    let [a, b] = [bridge.nets.0, bridge.nets.1].map(|net| sheet.nets.label(net));
    let wide = bridge.width.map_or(String::new(), |width| format!(", {width:.3} mm wide"));
    let of = if count > 2 { format!(" (of {count} nets in one piece)") } else { String::new() };
    let cause = nearest(sheet, bridge.at);
    Finding {
        at: Some(bridge.at),
        size: bridge.width,
        program: cause.map(|cut| cut.program.file.clone()),
        line: cause.map(|cut| cut.swept.line),
        ..Finding::new(NAME, Severity::Error, format!("{a} and {b} are joined by a bridge{wide}{of}"))
    }
    .of([a, b])
}

/// The cut nearest to a place.
fn nearest<'a>(sheet: &Sheet<'a>, p: Point) -> Option<Cut<'a>> {
    let off = |cut: &Cut<'_>| {
        let (min, max) = (cut.swept.shape.bounds().min(), cut.swept.shape.bounds().max());
        let beside = |low: Nm, at: Nm, high: Nm| (low - at).max(at - high).max(Nm::ZERO);
        let beside = Point::new(beside(min.x, p.x, max.x), beside(min.y, p.y, max.y));
        beside.distance(Point::default())
    };
    sheet.cuts.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// Pixels along a side of the picture in which bridges are looked for, at most. Chosen: a second for the worst.
const SIDE: u32 = 1200;

/// The bridges between `nets`, which hang together within `place`: one fewer than there are nets.
///
/// Pixels come back one by one, the farthest from all cuts first; where one joins two parts of different nets, the bridge is
/// narrowest there (Kruskal's maximum spanning tree).
fn bridges(sheet: &Sheet<'_>, place: Rect, nets: &[NetId]) -> Vec<Bridge> {
    let (grid, pictures) = sheet.window(place, sheet.pitch(), SIDE, &[Show::Left, Show::Distance]);
    let (labels, depths) = (pictures[0].labels(), pictures[1].depths());
    let mut order: Vec<u32> = (0_u32..)
        .zip(labels)
        .filter(|(_, label)| !matches!(**label, CUT | OUTSIDE))
        .map(|(at, _)| at)
        .collect();
    order.sort_by(|&a, &b| depths[b as usize].total_cmp(&depths[a as usize]).then(a.cmp(&b)));
    let mut flood = Flood::new(labels, nets);
    let mut bridges = Vec::new();
    let (width, count) = (grid.width() as usize, labels.len());
    for at in order.into_iter().map(|at| at as usize) {
        flood.dry[at] = true;
        let column = at % width;
        let left = (column > 0).then(|| at - 1);
        let right = (column + 1 < width).then_some(at + 1);
        let neighbours =
            [left, right, at.checked_sub(width), Some(at + width).filter(|&below| below < count)];
        for other in neighbours.into_iter().flatten().filter(|&other| flood.dry[other]).collect::<Vec<_>>() {
            if let Some(nets) = flood.join(at, other) {
                bridges.push(bridge(sheet, &grid, at, depths[at], nets));
            }
        }
        if bridges.len() + 1 >= nets.len() {
            break;
        }
    }
    bridges
}

fn bridge(sheet: &Sheet<'_>, grid: &Grid, at: usize, depth: f32, nets: (Vec<NetId>, Vec<NetId>)) -> Bridge {
    let index = i64::try_from(at).unwrap_or(0);
    let place = grid.center(index % i64::from(grid.width()), index / i64::from(grid.width()));
    let width = depth.is_finite().then(|| Nm::from_f64(f64::from(depth) * 2.0 * grid.pitch().to_f64()));
    let one = closest(sheet, place, &nets.0);
    let other = closest(sheet, place, &nets.1);
    Bridge { nets: (one.min(other), one.max(other)), at: place, width }
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

/// What has come back so far, in connected parts.
struct Flood {
    dry: Vec<bool>,
    parent: Vec<u32>,
    /// The nets in each part, at its root; the parts without are not in it.
    nets: std::collections::BTreeMap<u32, Vec<NetId>>,
}

impl Flood {
    fn new(labels: &[u32], nets: &[NetId]) -> Self {
        let count = u32::try_from(labels.len()).expect("a small picture");
        let mut flood =
            Self { dry: vec![false; labels.len()], parent: (0..count).collect(), nets: Default::default() };
        // A net is one to begin with, wherever its pixels are: what joins it to itself is not looked for.
        for &net in nets {
            let mut own =
                (0_u32..).zip(labels).filter(|(_, label)| **label == net.0 + NETS).map(|(at, _)| at);
            let Some(first) = own.next() else { continue };
            for at in own {
                flood.parent[at as usize] = first;
            }
            flood.nets.insert(first, vec![net]);
        }
        flood
    }

    fn find(&mut self, mut at: u32) -> u32 {
        while self.parent[at as usize] != at {
            let above = self.parent[self.parent[at as usize] as usize];
            self.parent[at as usize] = above;
            at = above;
        }
        at
    }

    /// Joins two pixels; the nets on both sides where that makes a bridge.
    fn join(&mut self, a: usize, b: usize) -> Option<(Vec<NetId>, Vec<NetId>)> {
        let [a, b] = [a, b].map(|at| self.find(u32::try_from(at).unwrap_or(0)));
        if a == b {
            return None;
        }
        self.parent[b as usize] = a;
        match (self.nets.get(&a).cloned(), self.nets.remove(&b)) {
            (Some(one), Some(other)) => {
                self.nets.entry(a).or_default().extend_from_slice(&other);
                Some((one, other))
            }
            (None, Some(other)) => {
                self.nets.insert(a, other);
                None
            }
            _ => None,
        }
    }
}
