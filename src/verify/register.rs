//! Where a program lies on the board, found from what it cuts.
//!
//! Every quarter turn, mirrored and not, is tried. Points along the cuts are laid over a picture of
//! how far copper is, and pushed about until most of them run close beside copper and as few as
//! possible through it (a cross-correlation); then, on the exact shapes, until the least clearances
//! are as large as they can be, which centres cuts between nets and loops round them alike. What
//! drills is laid on the holes, what cuts out on the outline.

use std::borrow::Cow;
use std::collections::BTreeSet;

use rayon::prelude::*;

use crate::board::{Board, Copper, Shape, Side};
use crate::geometry::{Nm, Point, Rect, Vector};
use crate::grid::Grid;
use crate::raster::{Buffers, Label, Scene, render};
use crate::topology::{Method, Nets, Proximity, recover, surface};

use super::check::along;
use super::machining::Machining;
use super::placement::turned;
use super::{Error, Placement, Program, Role, Settings};

/// How a program lies, as far as somebody knows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Orientation {
    /// How far the board is turned.
    pub degrees: Option<f64>,
    /// The line about which it is mirrored; any line will do, as the shift is found.
    pub mirror: Option<Nm>,
}

impl Orientation {
    /// Whether a placement is one of these.
    fn allows(&self, placement: &Placement) -> bool {
        self.degrees.is_none_or(|degrees| (degrees - placement.degrees).abs() < 1e-9)
            && (self.mirror.is_none() || self.mirror == placement.mirror)
    }
}

/// A program with the role and the places that are to be laid over the board.
struct Trial {
    placement: Placement,
    points: Vec<Point>,
    role: Role,
}

impl Trial {
    /// Whether, as it lies, it isolates so much that it is worth `least`: what lies off the board
    /// is near no copper.
    fn is_beside(&self, board: &Board, least: f64) -> bool {
        let Role::Isolation(side) = self.role else { return true };
        let copper = board.copper(side).filter(|copper| !copper.features.is_empty());
        copper.is_some_and(|copper| Map::new(copper).score(&self.points, Vector::default()) >= least)
    }

    /// How badly it fits moved by `shift`: how near to copper cuts are, how many plunges are beside
    /// holes, how far the cutout lies off the board's middle.
    fn misfit(&self, board: &Board, shift: Vector) -> f64 {
        /// Places are rounded when they are written. Chosen: above that.
        const ROUNDING: f64 = 20_000.0;
        match self.role {
            Role::Isolation(side) => board
                .copper(side)
                .map_or(0.0, |copper| crowding(&Proximity::new(copper), &self.points, shift)),
            Role::Drilling | Role::Alignment => -on_holes(&self.points, &holes(board), shift),
            Role::Cutout => {
                let (own, target) = (Rect::around(self.points.iter().copied()), board.outline.as_ref());
                own.zip(target).map_or(0.0, |(own, target)| {
                    let off = middle(own).distance(middle(target.bounds()) + shift);
                    alike(own, target.bounds()).abs() + (off - ROUNDING).max(0.0)
                })
            }
        }
    }
}

/// A shift in the plane of the board, and how well it fits: the larger the better.
#[derive(Clone, Copy, Debug)]
struct Fit {
    shift: Vector,
    score: f64,
}

/// Points that are looked at. Chosen: enough for one part of a millimetre square each on a small
/// board.
const POINTS: usize = 600;

/// What part of the best placement's worth one must have that the program's comments tell, and one
/// that is only likely: what lies off the board has none. Chosen.
const TOLD: f64 = 0.1;
const LIKELY: f64 = 0.5;

/// Finds how the board lies under `program`; of several tiles, the first. Where several places fit
/// as well it is the one that its comments say, or that of the files, and else one of those that
/// are `likely`: how the board lies under other programs of the same run.
///
/// # Errors
///
/// [`Error`] where the program cannot be followed, and [`Error::Unplaced`] where nothing of it lies
/// anywhere near the board.
pub fn register(
    program: &Program,
    board: &Board,
    known: &Orientation,
    likely: &[Placement],
    settings: &Settings,
) -> Result<Placement, Error> {
    let laid = |degrees: f64| match settings.tiles {
        Some(tiles) => Cow::Owned(tiles.lay(board, degrees)),
        None => Cow::Borrowed(board),
    };
    let mut best: Option<(Fit, Placement)> = None;
    for (degrees, mirror) in orientations(known, program.role) {
        let placement = Placement { degrees, shift: Vector::default(), mirror };
        let trial = trial(program, board, placement, settings)?;
        let Some(fit) = lay(&trial, &laid(degrees)) else { continue };
        // Of a board that is its own mirror image, the orientation that is likelier comes first,
        // and stays.
        if best.is_none_or(|(best, _)| fit.score > best.score + best.score.abs() * 0.02) {
            best = Some((fit, trial.placement));
        }
    }
    let (fit, placement) = best.ok_or_else(|| Error::Unplaced(program.file.clone()))?;
    let found = trial(program, board, placement, settings)?;
    let laid_found = laid(placement.degrees);
    let fine = refine(&found, &laid_found, fit.shift);
    let least = found.misfit(&laid_found, fine);
    let declared = Machining::read(program, board, settings)?;
    let told = if declared.zero.is_some() { TOLD } else { LIKELY };
    let likely = likely.iter().map(|&likely| (likely, LIKELY));
    let candidates = [(declared.followed.placement, told)].into_iter().chain(likely);
    for (placement, share) in candidates.filter(|(candidate, _)| known.allows(candidate)) {
        let as_likely = trial(program, board, placement, settings)?;
        let laid = laid(placement.degrees);
        if as_likely.misfit(&laid, Vector::default()) <= least
            && as_likely.is_beside(&laid, fit.score * share)
        {
            return Ok(placement);
        }
    }
    Ok(Placement { shift: whole(turned_by(fine, placement.degrees)), ..placement })
}

/// The orientations to try, the likeliest first: the back is usually milled mirrored.
fn orientations(known: &Orientation, role: Option<Role>) -> Vec<(f64, Option<Nm>)> {
    let turns = known.degrees.map_or(vec![0.0, 90.0, 180.0, 270.0], |degrees| vec![degrees]);
    let mirrors = match (known.mirror, role) {
        (Some(axis), _) => vec![Some(axis)],
        (None, Some(Role::Isolation(Side::Back))) => vec![Some(Nm::ZERO), None],
        (None, _) => vec![None, Some(Nm::ZERO)],
    };
    turns.iter().flat_map(|&degrees| mirrors.iter().map(move |&mirror| (degrees, mirror))).collect()
}

fn trial(
    program: &Program,
    board: &Board,
    placement: Placement,
    settings: &Settings,
) -> Result<Trial, Error> {
    let placed = Program { placement: Some(placement), ..program.clone() };
    let read = Machining::read(&placed, board, settings)?;
    let points = match read.role {
        Role::Drilling | Role::Alignment => read.plunges,
        Role::Isolation(_) | Role::Cutout => spread(&read),
    };
    Ok(Trial { placement, points, role: read.role })
}

/// Points along all cuts, evenly.
fn spread(read: &Machining) -> Vec<Point> {
    let length = |shape: &Shape| along(shape, 1).iter().map(|(_, length)| length).sum::<f64>();
    let total: f64 = read.swept.iter().map(|swept| length(&swept.shape)).sum();
    let step = (total / f64::from(u16::try_from(POINTS).unwrap_or(u16::MAX))).max(1.0);
    let mut owed = 0.0;
    let mut points = Vec::new();
    for swept in &read.swept {
        owed += length(&swept.shape) / step;
        let count = (1..=1000_u32).take_while(|&count| f64::from(count) <= owed).last().unwrap_or(0);
        owed -= f64::from(count);
        points.extend(along(&swept.shape, count).into_iter().map(|(at, _)| at));
    }
    points
}

/// The best shift of a trial; none where there is nothing to lay it on.
fn lay(trial: &Trial, board: &Board) -> Option<Fit> {
    let own = Rect::around(trial.points.iter().copied())?;
    match trial.role {
        Role::Isolation(side) => {
            let copper = board.copper(side).filter(|copper| !copper.features.is_empty())?;
            let map = Map::new(copper);
            let around = [Some(map.rect), board.bounds()];
            around
                .into_iter()
                .flatten()
                .filter_map(|target| map.search(&trial.points, own, target))
                .reduce(better)
        }
        Role::Drilling | Role::Alignment => lay_holes(&trial.points, board),
        Role::Cutout => {
            let target = board.outline.as_ref()?.bounds();
            Some(Fit { shift: middle(own) - middle(target), score: alike(own, target) })
        }
    }
}

/// How alike two rectangles are in size: the less, the more they differ.
fn alike(own: Rect, target: Rect) -> f64 {
    -((own.width() - target.width()).abs() + (own.height() - target.height()).abs()).to_f64()
}

fn better(a: Fit, b: Fit) -> Fit {
    if b.score > a.score { b } else { a }
}

fn middle(rect: Rect) -> Point {
    rect.min().midpoint(rect.max())
}

/// How far copper is, in a picture.
struct Map {
    grid: Grid,
    buffers: Buffers,
    rect: Rect,
}

/// How near beside copper a cut counts as beside it, in nanometres. Chosen: wider than gaps are.
const BESIDE: f64 = 400_000.0;
/// What a point on copper costs, against one beside it.
const THROUGH: f64 = 4.0;
/// How far the middles of the board and of the program may differ beyond what their sizes differ
/// by. Chosen.
const ROOM: Nm = Nm::from_mm(1);

impl Map {
    fn new(copper: &Copper) -> Self {
        let rect = copper.bounds().unwrap_or(Rect::new(Point::default(), Point::default()));
        let around = rect.inflate(Nm::from_f64(BESIDE));
        let pitch = (around.width().max(around.height()) / 3000).max(Nm::from_um(25));
        let grid = Grid::covering(around, pitch).expect("some thousand pixels");
        let mut scene = Scene::new(grid.width(), grid.height());
        let limit = grid.pixels(Nm::from_f64(BESIDE));
        for feature in &copper.features {
            scene.add(Label(1), surface(&feature.shape, &grid, Some(limit)));
        }
        let mut buffers = Buffers::new();
        render(&scene, &mut buffers);
        Self { grid, buffers, rect }
    }

    /// The best shift near those that lay the middle of `own` on that of `target`.
    fn search(&self, points: &[Point], own: Rect, target: Rect) -> Option<Fit> {
        let start = middle(own) - middle(target);
        let room = |a: Nm, b: Nm| ((a - b).abs() / 2 + ROOM).min(Nm::from_mm(15));
        let (x, y) = (room(own.width(), target.width()), room(own.height(), target.height()));
        let coarse = self.best(points, start, (x, y), Nm::from_um(120))?;
        let fine = self.best(points, coarse.shift, (Nm::from_um(120), Nm::from_um(120)), Nm::from_um(20));
        Some(fine.map_or(coarse, |fine| better(coarse, fine)))
    }

    /// The best of a lattice of shifts.
    fn best(&self, points: &[Point], start: Vector, room: (Nm, Nm), step: Nm) -> Option<Fit> {
        let count = |room: Nm| room.get() / step.get();
        let (columns, rows) = (count(room.0), count(room.1));
        let row = |row: i64| {
            let shifts = (-columns..=columns).map(|column| start + Vector::new(step * column, step * row));
            shifts.map(|shift| Fit { shift, score: self.score(points, shift) }).reduce(better)
        };
        let rows: Vec<Option<Fit>> = (-rows..=rows).into_par_iter().map(row).collect();
        rows.into_iter().flatten().reduce(better)
    }

    fn score(&self, points: &[Point], shift: Vector) -> f64 {
        let (corner, pitch) = (self.grid.corner(0, 0), self.grid.pitch().get());
        let (width, height) = (i64::from(self.grid.width()), i64::from(self.grid.height()));
        let worth = |&p: &Point| {
            let at = p - shift;
            let (column, row) =
                ((at.x - corner.x).get().div_euclid(pitch), (corner.y - at.y).get().div_euclid(pitch));
            if !(0..width).contains(&column) || !(0..height).contains(&row) {
                return 0.0;
            }
            let pixel = usize::try_from(row * width + column).unwrap_or(0);
            match self.buffers.labels()[pixel] {
                0 => 0.0,
                _ if self.buffers.depths()[pixel] > 0.0 => 1.0,
                _ => -THROUGH,
            }
        };
        points.iter().map(worth).sum()
    }
}

/// How near a plunge must be to its hole. Chosen.
const HOLE: Nm = Nm::from_um(100);

/// The shift that lays most plunges on holes: one that lays the first on one of them.
fn lay_holes(points: &[Point], board: &Board) -> Option<Fit> {
    let first = *points.first()?;
    let holes = holes(board);
    let fits = |shift: Vector| Fit { shift, score: on_holes(points, &holes, shift) };
    holes.iter().map(|&hole| fits(first - hole)).reduce(better)
}

/// The places of holes, in order.
fn holes(board: &Board) -> Vec<Point> {
    let ends = board.holes.iter().flat_map(|hole| [hole.path.start, hole.path.end()]);
    ends.collect::<BTreeSet<Point>>().into_iter().collect()
}

/// How many plunges lie on holes.
fn on_holes(points: &[Point], holes: &[Point], shift: Vector) -> f64 {
    let on = points.iter().filter(|&&p| nearest_hole(holes, p - shift).is_some()).count();
    f64::from(u32::try_from(on).unwrap_or(u32::MAX))
}

/// The hole within [`HOLE`] of a point, of holes in order.
fn nearest_hole(holes: &[Point], p: Point) -> Option<Point> {
    let from = holes.partition_point(|hole| hole.x < p.x - HOLE);
    let near = holes[from..].iter().take_while(|hole| hole.x <= p.x + HOLE);
    let near = near.copied().filter(|hole| hole.distance(p) <= HOLE.to_f64());
    near.min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
}

/// A shift made better on the exact shapes: the one at which most cuts lie midway between nets, and
/// else the one at which they are farthest from copper.
fn refine(trial: &Trial, board: &Board, shift: Vector) -> Vector {
    let Role::Isolation(side) = trial.role else { return shift };
    let Some(copper) = board.copper(side) else { return shift };
    let proximity = Proximity::new(copper);
    let clear = descend(shift, Nm::from_um(16), |shift| crowding(&proximity, &trial.points, shift));
    Midway::new(copper, &proximity, &trial.points).shift(clear).unwrap_or(clear)
}

/// The shift near `start` at which `misfit` is least, as far as steps along the axes lead, of which
/// the first is so long.
fn descend(start: Vector, first: Nm, misfit: impl Fn(Vector) -> f64) -> Vector {
    let (mut at, mut least) = (start, misfit(start));
    let mut step = first;
    while step >= Nm::new(500) {
        let ways = [(step, Nm::ZERO), (-step, Nm::ZERO), (Nm::ZERO, step), (Nm::ZERO, -step)];
        let tried = ways.map(|(x, y)| at + Vector::new(x, y)).map(|shift| (shift, misfit(shift)));
        match tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((shift, now)) if now < least => (at, least) = (shift, now),
            _ => step = step / 2,
        }
    }
    at
}

/// Cuts that are midway between nets, laid over these: where gaps are wide, nothing is near to
/// copper wherever it lies.
struct Midway<'a> {
    proximity: &'a Proximity,
    nets: Nets,
    points: Vec<Point>,
}

impl<'a> Midway<'a> {
    /// How far nets are looked for. Chosen: half of the widest gap that is usual.
    const REACH: Nm = Nm::from_mm(2);
    /// No point is farther from where it ought to be, in nanometres: the limit of a region is not
    /// midway. Chosen.
    const MOST: f64 = 400_000.0;
    /// What counts as midway, in nanometres. Chosen: as moves are rounded, and arcs are fitted.
    const NEAR: f64 = 10_000.0;

    /// One of so many cuts must be midway, whatever the others are. Chosen.
    const LEAST: usize = 10;

    fn new(copper: &Copper, proximity: &'a Proximity, points: &[Point]) -> Self {
        let points = points.iter().step_by(3).copied().collect();
        Self { proximity, nets: recover(copper, Method::Contact), points }
    }

    /// The shift that lays most of the cuts that have nets on both sides midway, near `start`; none
    /// where few are.
    fn shift(&self, start: Vector) -> Option<Vector> {
        let found = descend(start, Nm::from_um(512), |shift| {
            self.offs(shift).iter().map(|off| off.min(Self::MOST)).sum()
        });
        let offs = self.offs(found);
        let midway = offs.iter().filter(|&&off| off <= Self::NEAR).count();
        let between = offs.iter().filter(|off| off.is_finite()).count();
        (midway * 2 > between && midway * Self::LEAST > offs.len()).then_some(found)
    }

    /// How far each point is from being midway; infinite where there are not two nets.
    fn offs(&self, shift: Vector) -> Vec<f64> {
        let off = |&p: &Point| {
            let spot = Shape::Disc { center: p - shift, radius: Nm::ZERO };
            let near = self.proximity.near(&spot, Self::REACH);
            let Some(first) = near.iter().min_by(|a, b| a.width.total_cmp(&b.width)) else {
                return f64::INFINITY;
            };
            let net = self.nets.of(first.feature);
            let others = near.iter().filter(|other| self.nets.of(other.feature) != net);
            let second = others.map(|other| other.width).reduce(f64::min);
            second.map_or(f64::INFINITY, |second| (second - first.width) / 2.0)
        };
        self.points.par_iter().map(off).collect()
    }
}

/// How far a clearance counts, in nanometres: so much more weighs a third. Chosen: fine beside a
/// kerf.
const FALL: f64 = 30_000.0;

/// How near to copper points are: the nearer, the much more.
fn crowding(proximity: &Proximity, points: &[Point], shift: Vector) -> f64 {
    let reach = Nm::from_f64(BESIDE);
    let near = |&p: &Point| {
        let spot = Shape::Disc { center: p - shift, radius: Nm::ZERO };
        let nearest = proximity.near(&spot, reach).iter().map(|near| near.width).reduce(f64::min);
        nearest.map_or(0.0, |width| libm::exp(-width / FALL))
    };
    // Added up in order, so that it is the same for any number of threads.
    let all: Vec<f64> = points.par_iter().map(near).collect();
    all.iter().sum()
}

/// A shift of the board's own plane as one of the turned board.
fn turned_by(shift: Vector, degrees: f64) -> Vector {
    turned(Point::default() + shift, degrees) - Point::default()
}

/// Programs are laid on round numbers: what is within 3 µm of a hundredth of a millimetre is taken
/// for it.
fn whole(shift: Vector) -> Vector {
    let round = |length: Nm| {
        let hundredths = (length.get() + 5_000).div_euclid(10_000);
        let rounded = Nm::new(hundredths * 10_000);
        if (rounded - length).abs() <= Nm::from_um(3) { rounded } else { length }
    };
    Vector::new(round(shift.x), round(shift.y))
}
