//! What holes, as programs make them, leave of a side's copper as it was designed.
//!
//! ```text
//!    ╭──────╮     ring: the copper round a hole, as wide as it may be off place
//!    │ ╭──╮ ├──   looked at in points all round it
//!    │ │  │ │     sound: there is copper at all of them, so what met in the pad still does
//!    │ ╰──╯ ├──   doubtful: all others, of which the exact shapes are asked
//!    ╰──────╯
//! ```

use std::collections::BTreeSet;

use rayon::prelude::*;

use crate::board::{Hole, Shape, polarity};
use crate::geometry::{Nm, Point, Polygon, Rect, RectIndex};
use crate::topology::{NetId, Proximity};

use super::Settings;
use super::bores::{Bore, Bores, Made, around, from_axis};
use super::exact;
use super::machining::half;
use super::rest::least;
use super::sheet::Sheet;

/// The holes of which a side's copper does not keep a sound ring.
pub(super) struct Drilled<'a, 'b> {
    pub(super) sheet: &'a Sheet<'a>,
    /// In the board's order.
    pub(super) holes: Vec<Opened<'a, 'b>>,
}

/// A hole that may take too much.
pub(super) struct Opened<'a, 'b> {
    pub(super) bore: &'a Bore<'b>,
    pub(super) made: Made<'b>,
    /// The nets that it surely reaches into, by how far; and how much of its ring is theirs.
    pub(super) nets: Vec<Touched>,
}

/// A net that a hole reaches into.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touched {
    pub(super) net: NetId,
    /// How far into its copper, in nanometres.
    pub(super) depth: f64,
    /// Whether the middle of the hole, or some of a slot's, lies there.
    pub(super) is_centred: bool,
    /// The part of the way round the hole where there is copper of it.
    pub(super) ring: f64,
    /// Whether that is one stretch, and long enough to be no trace alone: what met at the hole
    /// still does.
    pub(super) is_held: bool,
    /// What all holes leave of it.
    pub(super) left: Left,
}

/// What holes leave of a net round one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Left {
    /// Nothing considerable: it was this pad alone.
    Nothing,
    /// A connected whole.
    Whole,
    /// Parts that were one, and that nothing of the net joins any more.
    Parts,
}

impl<'a, 'b> Drilled<'a, 'b> {
    /// What `bores` leave of `sheet`.
    pub(super) fn new(sheet: &'a Sheet<'a>, bores: &'a Bores<'b>, settings: &Settings) -> Self {
        let opened = |bore: &'a Bore<'b>| opened(sheet, bore, settings);
        let mut holes: Vec<Opened<'a, 'b>> = bores.holes.par_iter().filter_map(opened).collect();
        let by_place = RectIndex::new(holes.iter().map(|hole| hole.bore.hole.bounds()));
        let copper = Copper { sheet, holes: &holes, by_place, settings };
        let left: Vec<Vec<Left>> = holes.par_iter().map(|hole| copper.left(hole)).collect();
        for (hole, left) in holes.iter_mut().zip(left) {
            hole.nets.iter_mut().zip(left).for_each(|(touched, left)| touched.left = left);
        }
        Self { sheet, holes }
    }
}

/// How much wider a hole is than the board has it, to each side.
fn wider(made: &Made<'_>) -> Nm {
    Nm::from_f64((made.beyond - made.short) / 2.0)
}

/// The hole, unless it keeps a sound ring or reaches into nothing.
fn opened<'a, 'b>(sheet: &Sheet<'_>, bore: &'a Bore<'b>, settings: &Settings) -> Option<Opened<'a, 'b>> {
    let made = bore.made?;
    let deep = bore.hole.shapes(wider(&made) - settings.place);
    let radius = bore.hole.diameter / 2 + wider(&made);
    if radius <= settings.place {
        return None;
    }
    let axis: Vec<Shape> = bore.hole.shapes(-(bore.hole.diameter / 2));
    let near = deep.iter().flat_map(|shape| sheet.proximity.near(shape, Nm::ZERO));
    let features: BTreeSet<usize> = near.map(|near| near.feature).collect();
    let nets: BTreeSet<NetId> = features.iter().map(|&feature| sheet.nets.of(feature)).collect();
    if nets.is_empty() {
        return None;
    }
    let ring = Hole { diameter: (radius + settings.place) * 2, ..bore.hole.clone() };
    let points = around(&ring);
    let at = |p: Point| Shape::Disc { center: p, radius: Nm::ZERO };
    // Mostly one pad holds it.
    let holds = |&feature: &usize| {
        let shape = &sheet.copper.features[feature].shape;
        points.iter().all(|&p| match shape {
            Shape::Polygon(polygon) => polygon.contains(p),
            _ => from_axis(shape, p) <= half(shape).to_f64(),
        })
    };
    if nets.len() == 1 && features.iter().any(holds) {
        return None;
    }
    let touched = |&net: &NetId| {
        let is_own = |feature: usize| sheet.nets.of(feature) == net;
        let has = |&p: &Point| sheet.proximity.any(&at(p), Nm::ZERO, is_own, |_| true);
        let copper: Vec<bool> = points.iter().map(has).collect();
        let ring = share(copper.iter().filter(|has| **has).count(), copper.len());
        let before = copper.iter().cycle().skip(copper.len() - 1);
        let begins = copper.iter().zip(before).filter(|(has, before)| **has && !**before).count();
        // Points of a slot do not follow each other.
        let is_held = !bore.hole.is_slot() && begins == 1 && ring >= RING;
        let away = axis.iter().flat_map(|shape| sheet.proximity.near_of(shape, radius, is_own));
        let away = away.map(|near| near.width).fold(radius.to_f64(), f64::min);
        let (depth, is_centred) = (radius.to_f64() - away, away <= 0.0);
        Touched { net, depth, is_centred, ring, is_held, left: Left::Whole }
    };
    let nets: Vec<Touched> = nets.iter().map(touched).collect();
    let sound = nets.len() == 1 && nets[0].ring >= 1.0;
    (!sound).then_some(Opened { bore, made, nets })
}

#[expect(clippy::cast_precision_loss, reason = "a small count")]
fn share(some: usize, all: usize) -> f64 {
    some as f64 / all.max(1) as f64
}

/// The part of the way round a hole below which copper is no ring. Chosen: two traces that leave a
/// pad in both directions are less.
pub(super) const RING: f64 = 1.0 / 3.0;
/// How near to a hole a part of a net lies that the hole bounds. Chosen: flattened curves are apart
/// by less.
const BESIDE: Nm = Nm::from_um(2);
/// How far curves are flattened. Chosen: far below what a hole may be off its place.
const FLAT: Nm = Nm::from_um(1);
/// How far round a hole is looked first at what joins the parts of a net there. Chosen: twice as
/// far each time after, so that a pour costs no more than what is near.
const ROUND: Nm = Nm::from_um(250);

impl Opened<'_, '_> {
    /// The hole as it is made, grown by `by`.
    fn shapes(&self, by: Nm) -> Vec<Shape> {
        self.bore.hole.shapes(wider(&self.made) + by)
    }
}

/// A side's copper and the holes that may take too much of it.
struct Copper<'c, 'a, 'b> {
    sheet: &'c Sheet<'a>,
    holes: &'c [Opened<'c, 'b>],
    by_place: RectIndex,
    settings: &'c Settings,
}

impl Copper<'_, '_, '_> {
    /// What the holes leave round this one of each net that it reaches into.
    fn left(&self, hole: &Opened<'_, '_>) -> Vec<Left> {
        hole.nets.iter().map(|touched| self.left_of(touched, hole)).collect()
    }

    fn left_of(&self, touched: &Touched, hole: &Opened<'_, '_>) -> Left {
        let net = touched.net;
        let Some(extent) = self.sheet.extent(net) else { return Left::Nothing };
        if touched.is_held {
            return Left::Whole;
        }
        let own = hole.shapes(Nm::ZERO);
        let mut reach = ROUND;
        loop {
            let rect = hole.bore.hole.bounds().inflate(reach);
            let designed = exact::designed(self.sheet, net, rect, FLAT);
            // A pad with nothing but itself may have a rim left.
            if reach == ROUND && self.parts(&designed, rect, self.settings.place).is_empty() {
                return Left::Nothing;
            }
            let parts = Proximity::of(&self.parts(&designed, rect, Nm::ZERO));
            let beside = own.iter().flat_map(|shape| parts.near(shape, BESIDE));
            let beside: BTreeSet<usize> = beside.map(|near| near.feature).collect();
            if beside.len() < 2 {
                return Left::Whole;
            }
            if rect.contains(extent.min()) && rect.contains(extent.max()) {
                return Left::Parts;
            }
            reach = reach * 2;
        }
    }

    /// The considerable parts of copper within `rect` that the holes, grown by `by`, leave.
    fn parts(&self, designed: &[Polygon], rect: Rect, by: Nm) -> Vec<Shape> {
        let crumb = least(designed.iter().map(Polygon::area_mm2).sum(), self.settings);
        let near = self.by_place.touching(rect).into_iter().flat_map(|hole| self.holes[hole].shapes(by));
        let cuts: Vec<Polygon> = near.filter_map(|shape| shape.polygon(FLAT)).collect();
        let left = |whole: &Polygon| {
            let near = cuts.iter().filter(|cut| cut.bounds().touches(whole.bounds()));
            polarity::difference(whole, near)
        };
        let parts = designed.iter().flat_map(left).filter(|part| part.area_mm2() >= crumb);
        parts.map(Shape::Polygon).collect()
    }
}
