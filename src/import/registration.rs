//! Whether layers and drill files lie on each other, as far as holes and pads tell it: exports with
//! different origins, and layers that were plotted mirrored.
//!
//! ```text
//!     ·        ◯        ◯    All differences between a hole and a pad are counted. The one
//!       · ◯      · ◯         that most holes have, among pads that are wide enough, is how
//!    hole pad                far they were moved. The same is asked of the pads' mirror
//!                            image: what puts more holes on pads is what happened.
//! ```
//!
//! Nothing is said where holes lie on pads, and nothing where no other way of laying them puts them
//! there: pads may be drawn as strokes, and holes may have none.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::advice::{NO_DRILL, quoted};
use super::archive::Found;
use super::error::Error;
use crate::board::{Axis, Copper, Feature, Hole, Plating, Sentence, Shape, Side, Words};
use crate::geometry::{Nm, Point, Rect, RectIndex, Vector};

/// So near to each other the middles of a hole and of its pad lie, in nanometres. Chosen: above
/// what rounding both to mils may part them, below the distance of any two pads.
const NEAR: i64 = 100_000;

/// As few holes may lie on pads by chance. Chosen.
const LEAST: usize = 10;

/// In one row pads of another kind may be as far apart. Chosen: less than two rows are.
const ROWS: Nm = Nm::from_mm(1);

/// So many pairs of a hole and a pad are looked at. Chosen: they take a quarter of a second and 60
/// MB, where files do not lie on each other.
const PAIRS: usize = 1_000_000;

/// A place with a width: a hole, or a pad that was flashed.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: Point,
    width: Nm,
}

/// Places that lie on pads only where they are laid otherwise.
pub(super) struct Misplaced {
    mirrored: bool,
    way: Vector,
    /// Of so many, so many lie on pads as they are, and so many would.
    all: usize,
    now: usize,
    then: usize,
}

/// The pads of a board's sides, as far as they were flashed.
pub(super) struct Flashed {
    sides: Vec<(Side, Pads)>,
}

impl Flashed {
    /// Those of `coppers`.
    pub(super) fn new(coppers: &[&Copper]) -> Self {
        let sides = coppers.iter().map(|copper| (copper.side, Pads::new(flashed(copper).collect())));
        Self { sides: sides.collect() }
    }

    /// The holes of a drill file that lie beside pads, and would lie on them if they were moved or
    /// mirrored.
    pub(super) fn drilled(&self, holes: &[Hole]) -> Option<Misplaced> {
        let holes = enough(plated(holes).collect())?;
        let fits = |hole: Nm, pad: Nm| pad > hole;
        let lies = |hole: &&Place| self.sides.iter().any(|(_, pads)| pads.has(hole.at, hole.width, fits));
        let now = holes.iter().filter(lies).count();
        let all = || self.sides.iter().flat_map(|(_, pads)| &pads.all).copied().collect();
        if now * 2 >= holes.len() { None } else { Pads::new(all()).laid_otherwise(&holes, now, fits) }
    }

    /// A side whose through-hole pads lie beside those of the other, which has the holes, and would
    /// lie on them if they were moved or mirrored.
    pub(super) fn plotted(&self, holes: &[Hole]) -> Option<(Side, Misplaced)> {
        let [front, back] = self.sides.as_slice() else { return None };
        [(front, back), (back, front)].into_iter().find_map(|((_, other), (side, own))| {
            let through =
                plated(holes).filter_map(|hole| other.near(hole.at).find(|pad| pad.width > hole.width));
            let through = enough(through.collect())?;
            // Pads of a part on the surface may be as far apart; they are not as wide.
            let fits = |a: Nm, b: Nm| (a - b).abs() * 10 <= a;
            let now = through.iter().filter(|pad| own.has(pad.at, pad.width, |_, _| true)).count();
            let laid = (now * 2 < through.len()).then(|| own.laid_otherwise(&through, now, fits))?;
            Some((*side, laid?))
        })
    }
}

/// Places, where they are so many and lie so that chance does not lay them on pads.
fn enough(places: Vec<Place>) -> Option<Vec<Place>> {
    let around = Rect::around(places.iter().map(|place| place.at))?;
    let is_field = around.width().min(around.height()) >= ROWS;
    (places.len() >= LEAST && is_field).then_some(places)
}

/// Through-hole pads in which there is no hole: how many of how many, and where one of them is.
pub(super) struct Undrilled {
    all: usize,
    bare: usize,
    pub(super) at: Point,
    pub(super) side: Side,
}

/// The pads of through-hole components and vias in which none of `holes` is: as files with
/// attributes call them, or where none does, round pads that are on both sides.
pub(super) fn undrilled(holes: &[Hole], coppers: &[&Copper]) -> Option<Undrilled> {
    let told: Vec<(&Copper, &Feature)> = coppers.iter().flat_map(|copper| called_through(copper)).collect();
    let pads = if told.is_empty() { on_both_sides(coppers) } else { told };
    let holes = RectIndex::new(holes.iter().map(Hole::bounds));
    // Each place once, and whether it is drilled.
    let mut places: BTreeMap<Cell, (bool, Point, Side)> = BTreeMap::new();
    for (copper, feature) in pads {
        let Axis::Flash(at) = feature.axis else { continue };
        let (drilled, ..) = places.entry(cell(at)).or_insert((false, at, copper.side));
        *drilled |= !holes.touching(feature.shape.bounds()).is_empty();
    }
    let bare = || places.values().filter(|(drilled, ..)| !drilled);
    let &(_, at, side) = bare().next()?;
    Some(Undrilled { all: places.len(), bare: bare().count(), at, side })
}

fn called_through(copper: &Copper) -> impl Iterator<Item = (&Copper, &Feature)> {
    let pads = copper.features.iter().filter(|feature| matches!(feature.axis, Axis::Flash(_)));
    let through = pads.filter(|feature| {
        let function = copper.attributes_of(feature).function.as_deref().unwrap_or_default();
        ["ComponentPad", "ViaPad"].contains(&function.split(',').next().unwrap_or_default())
    });
    through.map(move |feature| (copper, feature))
}

fn on_both_sides<'a>(coppers: &[&'a Copper]) -> Vec<(&'a Copper, &'a Feature)> {
    let &[front, back] = coppers else { return Vec::new() };
    let behind = Pads::new(flashed(back).collect());
    let round = front.features.iter().filter(|feature| {
        let is_round = matches!((&feature.shape, &feature.axis), (Shape::Disc { .. }, Axis::Flash(_)));
        is_round && behind.near(feature.shape.anchor()).next().is_some()
    });
    round.map(|feature| (front, feature)).collect()
}

impl Undrilled {
    /// What is wrong.
    pub(super) fn message(&self) -> String {
        let Self { all, bare, .. } = self;
        format!("{bare} of {all} through-hole pads have no hole")
    }
}

impl Misplaced {
    /// What is wrong with the holes of a drill file.
    pub(super) fn of_holes(&self) -> String {
        let Self { all, now, then, .. } = self;
        format!("{now} of {all} holes lie on pads, and {then} would if they were {}", self.how())
    }

    /// What is wrong with the layer of a side.
    pub(super) fn of_pads(&self, side: Side) -> String {
        let Self { all, now, then, .. } = self;
        let other = if side == Side::Front { Side::Back } else { Side::Front };
        format!(
            "{now} of {all} through-hole pads of the {other} lie on pads of this layer, and {then} would if it were {}",
            self.how()
        )
    }

    fn how(&self) -> String {
        let Vector { x, y } = self.way;
        if self.mirrored { "mirrored".to_owned() } else { format!("moved by {x:.3}, {y:.3} mm") }
    }

    /// The same of holes as an error.
    pub(super) fn refuse_holes(&self, file: &Found) -> Error {
        let hint =
            Words::of("export copper and holes with the same origin; if they are right, use {drill} {0}");
        Error::content(&file.shown, self.of_holes(), hint.with([&quoted(&file.name)]).then(NO_DRILL))
    }

    /// The same of a layer as an error.
    pub(super) fn refuse_layer(&self, file: &Found, side: Side) -> Error {
        let hint = match side {
            Side::Front => {
                Words::of("plot all layers unmirrored, with the same origin; if it is right, use {front} {0}")
            }
            Side::Back => {
                Words::of("plot all layers unmirrored, with the same origin; if it is right, use {back} {0}")
            }
        };
        let hint: Sentence = hint.with([&quoted(&file.name)]);
        Error::content(&file.shown, self.of_pads(side), hint)
    }
}

/// The holes that have pads, as far as anybody knows.
fn plated(holes: &[Hole]) -> impl Iterator<Item = Place> {
    let may_be = holes.iter().filter(|hole| hole.plating != Plating::NonPlated);
    may_be.map(|hole| Place { at: hole.path.start.midpoint(hole.path.end()), width: hole.diameter })
}

fn flashed(copper: &Copper) -> impl Iterator<Item = Place> {
    copper.features.iter().filter_map(|feature| {
        let Axis::Flash(at) = feature.axis else { return None };
        let bounds = feature.shape.bounds();
        Some(Place { at, width: bounds.width().min(bounds.height()) })
    })
}

type Cell = (i64, i64);

fn cell(at: Point) -> Cell {
    (at.x.get().div_euclid(NEAR), at.y.get().div_euclid(NEAR))
}

/// Pads by place.
struct Pads {
    all: Vec<Place>,
    by_cell: FxHashMap<Cell, Vec<usize>>,
}

impl Pads {
    fn new(all: Vec<Place>) -> Self {
        let mut by_cell: FxHashMap<Cell, Vec<usize>> = FxHashMap::default();
        for (index, pad) in all.iter().enumerate() {
            by_cell.entry(cell(pad.at)).or_default().push(index);
        }
        Self { all, by_cell }
    }

    fn near(&self, at: Point) -> impl Iterator<Item = Place> {
        let (x, y) = cell(at);
        let cells = (x - 1..=x + 1).flat_map(move |x| (y - 1..=y + 1).map(move |y| (x, y)));
        let near = cells.filter_map(|cell| self.by_cell.get(&cell)).flatten().map(|&index| self.all[index]);
        near.filter(move |pad| pad.at.distance(at) <= Nm::new(NEAR).to_f64())
    }

    /// Whether there is a pad that something so wide fits on.
    fn has(&self, at: Point, width: Nm, fits: impl Fn(Nm, Nm) -> bool) -> bool {
        self.near(at).any(|pad| fits(width, pad.width))
    }

    /// How most of `places` would lie on pads, of which `now` do.
    fn laid_otherwise(
        &self,
        places: &[Place],
        now: usize,
        fits: impl Fn(Nm, Nm) -> bool + Copy,
    ) -> Option<Misplaced> {
        let flipped = || self.all.iter().map(|pad| Place { at: Point::new(-pad.at.x, pad.at.y), ..*pad });
        let laid = |mirrored: bool| {
            let image = mirrored.then(|| Self::new(flipped().collect()));
            let pads = image.as_ref().unwrap_or(self);
            let way = pads.middle(places, pads.commonest(places, fits)?, fits);
            let lies = |place: &&Place| pads.has(place.at + way, place.width, fits);
            let then = places.iter().filter(lies).count();
            let is_sure = then * 5 >= places.len() * 4;
            is_sure.then_some(Misplaced { mirrored, way, all: places.len(), now, then })
        };
        // The last of those that are as good: what was moved is no image of itself.
        [true, false].into_iter().filter_map(laid).max_by_key(|laid| laid.then)
    }

    /// How far pads lie from `places` on average, of those that are about `way` off.
    fn middle(&self, places: &[Place], way: Vector, fits: impl Fn(Nm, Nm) -> bool) -> Vector {
        let near = |place: &Place| self.near(place.at + way).find(|pad| fits(place.width, pad.width));
        let ways: Vec<Vector> = places.iter().filter_map(|place| Some(near(place)?.at - place.at)).collect();
        let count = i64::try_from(ways.len()).unwrap_or(i64::MAX).max(1);
        let sum = |along: fn(&Vector) -> Nm| ways.iter().map(|way| along(way).get()).sum::<i64>();
        Vector::new(Nm::new(sum(|way| way.x) / count), Nm::new(sum(|way| way.y) / count))
    }

    /// The difference that most pairs of a place and a pad that fits have.
    fn commonest(&self, places: &[Place], fits: impl Fn(Nm, Nm) -> bool) -> Option<Vector> {
        let step = (places.len() * self.all.len()).div_ceil(PAIRS).max(1);
        // How often, and the sum of all.
        let mut votes: FxHashMap<Cell, [i64; 3]> = FxHashMap::default();
        for place in places.iter().step_by(step) {
            for pad in self.all.iter().filter(|pad| fits(place.width, pad.width)) {
                let way = pad.at - place.at;
                let [count, x, y] = votes.entry(cell(Point::default() + way)).or_default();
                (*count, *x, *y) = (*count + 1, *x + way.x.get(), *y + way.y.get());
            }
        }
        // A difference that lies where cells meet is in up to four of them.
        let together = |&(x, y): &Cell| {
            let cells = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
            let found = cells.into_iter().filter_map(|cell| votes.get(&cell));
            found.fold([0; 3], |[count, x, y], more| [count + more[0], x + more[1], y + more[2]])
        };
        let best = votes.keys().max_by_key(|cell| (together(cell)[0], **cell))?;
        let [count, x, y] = together(best);
        Some(Vector::new(Nm::new(x / count), Nm::new(y / count)))
    }
}
