//! Holes as programs make them: how far the wall of each is from where the board has it, how deep
//! it goes, and what is cut where the board has no hole.
//!
//! A drill leaves a disc, an end mill a ring of strokes and arcs: both are the same here, pieces of
//! what the cutter sweeps. The wall of a hole is looked at from its middle in all directions.
//!
//! ```text
//!      ╭──────╮         short: how far the cut ends before the wall, at its worst; below zero where it goes
//!     ╱ ╭────╮ ╲        beyond the wall everywhere
//!    │  │ cut│←→│wall   beyond: how far it reaches past the wall, at its worst
//!     ╲ ╰────╯ ╱        of a round hole (short + beyond) / 2 is how far it is off its place, beyond − short
//!      ╰──────╯         how much it is too wide
//! ```

use rayon::prelude::*;

use crate::board::{Board, Hole, Shape};
use crate::geometry::{Nm, Point, RectIndex, distance_to_segment};

use super::cut::Cut;
use super::machining::{self, Machining};

/// All holes of a board, and what is cut elsewhere.
pub(super) struct Bores<'a> {
    /// The holes in the board's order.
    pub(super) holes: Vec<Bore<'a>>,
    /// What lies in no hole: neighbouring pieces together, the first of each.
    pub(super) strays: Vec<Cut<'a>>,
}

/// A hole of the board.
pub(super) struct Bore<'a> {
    pub(super) hole: &'a Hole,
    /// How it is made; none where nothing of it is.
    pub(super) made: Option<Made<'a>>,
}

/// A hole as it is made; distances in nanometres.
#[derive(Clone, Copy)]
pub(super) struct Made<'a> {
    pub(super) short: f64,
    pub(super) beyond: f64,
    /// How deep the wall is at its full width, where that is least.
    pub(super) depth: Nm,
    /// How deep the cutter's end goes there.
    pub(super) end: Nm,
    /// A piece of it.
    pub(super) cut: Cut<'a>,
}

/// Pieces whose distances from a place differ by less than this both make the wall there. Chosen:
/// more than the ridges between the holes of a slot.
const BOTH: f64 = 20_000.0;

impl<'a> Bores<'a> {
    /// What `programs` make of the holes of `board`.
    pub(super) fn new(programs: &[&'a Machining], board: &'a Board) -> Self {
        let cuts: Vec<Cut<'a>> = Cut::all(programs).collect();
        let walls: Vec<Wall<'a>> = board.holes.iter().map(Wall::new).collect();
        let by_place = RectIndex::new(board.holes.iter().map(Hole::bounds));
        let owners: Vec<Option<usize>> =
            cuts.par_iter().map(|cut| owner(&cut.swept.shape, &walls, &by_place)).collect();
        let mut own: Vec<Vec<usize>> = vec![Vec::new(); walls.len()];
        let mut strays: Vec<Cut<'a>> = Vec::new();
        let mut last: Option<usize> = None;
        for (index, (owner, cut)) in owners.iter().zip(&cuts).enumerate() {
            match *owner {
                Some(hole) => own[hole].push(index),
                None => {
                    if last.is_none_or(|last| !is_beside(&cuts[last], cut)) {
                        strays.push(*cut);
                    }
                    last = Some(index);
                }
            }
        }
        let all = RectIndex::new(cuts.iter().map(|cut| cut.swept.shape.bounds()));
        let bore = |(wall, own): (&Wall<'a>, &Vec<usize>)| {
            let made = wall.made(own, &cuts);
            let whole = made.as_ref().is_some_and(|made| made.short <= BOTH);
            let near = || all.touching(wall.hole.bounds());
            Bore { hole: wall.hole, made: if whole { made } else { wall.shared(made, &near(), &cuts) } }
        };
        Self { holes: walls.par_iter().zip(&own).map(bore).collect(), strays }
    }
}

/// Whether a stray piece belongs to the one before it.
fn is_beside(before: &Cut<'_>, cut: &Cut<'_>) -> bool {
    let apart = before.swept.shape.anchor().distance(cut.swept.shape.anchor());
    let follows = cut.swept.line.saturating_sub(before.swept.line) <= 3;
    let same = std::ptr::eq(before.program, cut.program);
    same && (apart < 1.0 || follows && !matches!(cut.swept.shape, Shape::Disc { .. }))
}

/// A hole with points of its wall.
struct Wall<'a> {
    hole: &'a Hole,
    /// The cutter's way, flattened.
    path: Vec<Point>,
    radius: f64,
    points: Vec<Point>,
}

/// How far the flattened way of a slot may leave its curve. Chosen: far below what is tolerated.
const FLAT: Nm = Nm::from_um(2);
/// Directions in which a wall is looked at. Chosen: a hole off its place is seen to half a
/// hundredth of how far it is off.
const DIRECTIONS: u32 = 32;

/// Points of a hole's wall, all round.
pub(super) fn around(hole: &Hole) -> Vec<Point> {
    Wall::new(hole).points
}

/// How far a piece reaches past a hole's wall, in nanometres; below zero where it stays within.
pub(super) fn past(hole: &Hole, shape: &Shape) -> f64 {
    Wall::new(hole).past(shape)
}

impl<'a> Wall<'a> {
    fn new(hole: &'a Hole) -> Self {
        let path = hole.path.flatten(FLAT);
        let radius = hole.diameter.to_f64() / 2.0;
        let mut wall = Self { hole, path, radius, points: Vec::new() };
        let turns = (0..DIRECTIONS).map(|i| f64::from(i) / f64::from(DIRECTIONS) * std::f64::consts::TAU);
        let round: Vec<(f64, f64)> = turns.map(libm::sincos).map(|(sin, cos)| (cos, sin)).collect();
        let mut points = Vec::new();
        let mut add = |from: Point, way: (f64, f64)| {
            let (x, y) = from.to_f64();
            points.push(Point::from_f64(x + way.0 * radius, y + way.1 * radius));
        };
        for &end in &wall.path {
            round.iter().for_each(|&way| add(end, way));
        }
        for pair in wall.path.windows(2) {
            let (way, length) = (pair[1] - pair[0], pair[0].distance(pair[1]).max(1.0));
            let aside = (way.y.to_f64() / length, -way.x.to_f64() / length);
            for middle in middles(pair[0], pair[1], radius / 2.0) {
                add(middle, aside);
                add(middle, (-aside.0, -aside.1));
            }
        }
        // What lies within the slot is no wall; ends are rounded to the nanometre.
        points.retain(|&p| wall.off(p) >= radius - 2.0);
        wall.points = points;
        wall
    }

    /// How far a point is from where the hole's cutter goes.
    fn off(&self, p: Point) -> f64 {
        let first = p.distance(self.path[0]);
        self.path.windows(2).map(|pair| distance_to_segment(p, (pair[0], pair[1]))).fold(first, f64::min)
    }

    /// How far a piece reaches past the wall; below zero where it stays within.
    fn past(&self, shape: &Shape) -> f64 {
        let farthest = stops(shape).into_iter().map(|p| self.off(p)).fold(0.0, f64::max);
        farthest + half(shape) - self.radius
    }

    /// The hole as its own pieces make it; none where they are none.
    fn made(&self, own: &[usize], cuts: &[Cut<'a>]) -> Option<Made<'a>> {
        let first = *own.first()?;
        let past = own.iter().map(|&index| self.past(&cuts[index].swept.shape));
        let made = Made {
            short: f64::NEG_INFINITY,
            beyond: past.fold(f64::NEG_INFINITY, f64::max),
            depth: Nm::MAX,
            end: Nm::MAX,
            cut: cuts[first],
        };
        Some(self.seen(made, own, cuts))
    }

    /// The hole where pieces for other holes make it whole: holes may overlap. Where they leave
    /// some of it, it is as its own pieces make it; none where nothing of its own is cut.
    fn shared(&self, own: Option<Made<'a>>, near: &[usize], cuts: &[Cut<'a>]) -> Option<Made<'a>> {
        let first = *near.first()?;
        let (beyond, depth, end) = (0.0, Nm::MAX, Nm::MAX);
        let made = Made { short: f64::NEG_INFINITY, beyond, depth, end, cut: cuts[first] };
        let made = self.seen(made, near, cuts);
        let short = made.short.max(0.0);
        match own {
            Some(own) if short > BOTH => Some(own),
            Some(own) => Some(Made { short, beyond: own.beyond.max(0.0), ..made }),
            None => (short <= BOTH).then_some(Made { short, beyond: short, ..made }),
        }
    }

    /// What is seen from the middle in all directions.
    fn seen(&self, mut made: Made<'a>, pieces: &[usize], cuts: &[Cut<'a>]) -> Made<'a> {
        let mut gaps: Vec<(f64, usize)> = Vec::with_capacity(pieces.len());
        for &p in &self.points {
            gaps.clear();
            let gap = |&index: &usize| {
                let shape = &cuts[index].swept.shape;
                (from_axis(shape, p) - half(shape), index)
            };
            gaps.extend(pieces.iter().map(gap));
            let least = gaps.iter().map(|(gap, _)| *gap).fold(f64::INFINITY, f64::min);
            made.short = made.short.max(least);
            let here = gaps.iter().filter(|(gap, _)| *gap <= least.max(0.0) + BOTH);
            let deepest = here.map(|(_, index)| cuts[*index]).max_by_key(|cut| cut.swept.full);
            if let Some(cut) = deepest.filter(|cut| cut.swept.full < made.depth) {
                (made.depth, made.end, made.cut) = (cut.swept.full, cut.swept.depth, cut);
            }
        }
        made
    }
}

/// The hole that a piece is for: that past whose wall it reaches least. None where it touches no
/// hole.
fn owner(shape: &Shape, walls: &[Wall<'_>], by_place: &RectIndex) -> Option<usize> {
    let touching = by_place.touching(shape.bounds()).into_iter();
    let past = touching.map(|index| (walls[index].past(shape), index));
    let near = past.filter(|(past, _)| *past < 2.0 * half(shape));
    let key = |past: f64| (past.max(0.0), past.abs());
    let first = |a: &f64, b: &f64| {
        let (a, b) = (key(*a), key(*b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    };
    near.min_by(|a, b| first(&a.0, &b.0)).map(|(_, index)| index)
}

/// Half the width of a piece, in nanometres.
fn half(shape: &Shape) -> f64 {
    machining::half(shape).to_f64()
}

/// Points of a piece's axis, one of which is the farthest from any way but for a hair.
fn stops(shape: &Shape) -> Vec<Point> {
    match shape {
        Shape::Disc { center, .. } => vec![*center],
        Shape::Stroke { from, to, .. } => vec![*from, *to],
        Shape::Arc { arc, .. } => {
            let between = (1..DIRECTIONS).map(|i| arc.at(f64::from(i) / f64::from(DIRECTIONS)));
            let between = between.map(|(x, y)| Point::from_f64(x, y));
            [arc.start, arc.end].into_iter().chain(between).collect()
        }
        Shape::Polygon(_) => Vec::new(),
    }
}

/// The middles of equal parts of a way, each no longer than `step`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
fn middles(a: Point, b: Point, step: f64) -> impl Iterator<Item = Point> {
    let count = ((a.distance(b) / step.max(1.0)).ceil() as u32).clamp(1, 10_000);
    (0..count).map(move |i| a.toward(b, (f64::from(i) + 0.5) / f64::from(count)))
}

/// How far a point is from the way of a cutter's middle, in nanometres.
pub(super) fn from_axis(shape: &Shape, p: Point) -> f64 {
    match shape {
        Shape::Disc { center, .. } => p.distance(*center),
        Shape::Stroke { from, to, .. } => distance_to_segment(p, (*from, *to)),
        Shape::Arc { arc, .. } => {
            let ends = p.distance(arc.start).min(p.distance(arc.end));
            let (way, sweep) = (p - arc.center, arc.sweep());
            let angle = libm::atan2(way.y.to_f64(), way.x.to_f64()) - arc.start_angle();
            let along = if sweep < 0.0 { -angle } else { angle }.rem_euclid(std::f64::consts::TAU);
            if along > sweep.abs() {
                return ends;
            }
            let ((x, y), (px, py)) = (arc.at(along / sweep.abs()), p.to_f64());
            ((px - x) * (px - x) + (py - y) * (py - y)).sqrt()
        }
        Shape::Polygon(_) => f64::INFINITY,
    }
}
