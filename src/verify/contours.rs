//! The board's edge as programs cut it out: what of it is cut through, held by tabs, or left, and
//! where the board itself is cut.
//!
//! Each contour is looked at in many spots. Beyond a spot the board must be cut through; a stretch
//! of spots that is cut, but not through, is a tab or a mistake. An inner corner that no round
//! cutter reaches into counts as cut.
//!
//! ```text
//!   stock ░░░░░░░░░░░░░░░░░░░░░░░      spots  · · · · · ·
//!   ──────╮ through ╭────╮ through     left   how far beyond the spot the board goes on
//!   ══════╧═════════╧════╧═══════      taken  how far the cutter reaches into the board
//!   board  ·  ·  ·  · tab ·  ·
//! ```

use rayon::prelude::*;

use crate::board::{Board, FLATTEN, Hole, Shape};
use crate::geometry::{Edges, Nm, Point, Polygon};
use crate::topology::{Near, Proximity};

use super::Settings;
use super::bores::past;
use super::cut::Cut;
use super::machining::{Machining, Swept};

/// All contours of a board, cut by programs.
pub(super) struct Contours<'a> {
    pub(super) programs: Vec<&'a Machining>,
    pub(super) outline: Polygon,
    /// The edges of the outline by place.
    pub(super) edges: Edges,
    pub(super) rings: Vec<Ring>,
    /// Where the cutter reaches into the board: neighbouring pieces together, the deepest of each.
    pub(super) taken: Vec<Taken<'a>>,
    /// Half the narrowest groove.
    pub(super) half: Nm,
}

/// A contour.
pub(super) struct Ring {
    /// Whether it goes round a board; else round a cut-out.
    pub(super) is_board: bool,
    /// Stretches of spots of one state, all the way round.
    pub(super) stretches: Vec<Stretch>,
    /// All spots, the first stretch's first.
    spots: Vec<Spot>,
}

/// How the edge is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// Through the board.
    Through,
    /// Not through the board.
    Shallow,
    /// Not where it should be.
    Uncut,
    /// Not where it should be, and the cutter does not fit there.
    Narrow,
}

/// Neighbouring spots of one state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) state: State,
    /// How long, in nanometres.
    pub(super) length: f64,
    /// The spot where most is left.
    pub(super) at: Point,
    /// The spot in the middle of it.
    pub(super) middle: Point,
    /// How far the board goes on beyond its edge there, in nanometres; infinite where nothing near
    /// is cut through.
    pub(super) left: f64,
    /// How long the parts are together where the board notably goes on.
    pub(super) off: f64,
    /// How far it goes on there on average.
    pub(super) mean: f64,
    /// How deep it is cut where that is least.
    pub(super) depth: Nm,
    /// Its spots, of all those of the contour.
    first: usize,
    spots: usize,
}

/// The way from a tab to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// How long, in nanometres.
    pub(super) length: f64,
    /// The longest of its stretches.
    pub(super) stretch: Stretch,
}

/// A piece of a cut that reaches into the board.
#[derive(Clone, Copy)]
pub(super) struct Taken<'a> {
    pub(super) cut: Cut<'a>,
    /// How far, in nanometres.
    pub(super) depth: f64,
    pub(super) at: Point,
}

/// A spot of an edge.
struct Spot {
    at: Point,
    /// Away from the board, of length 1.
    out: (f64, f64),
    length: f64,
}

/// What is found at a spot.
struct Seen {
    state: State,
    left: f64,
    depth: Nm,
}

/// How far the edge may be off before anybody is told. Chosen: what cheap machines repeat to, and
/// several times what paths are rounded to.
const NOTABLE: Nm = Nm::from_um(20);

/// Half the groove where nothing is cut. Chosen: that of the usual cutter.
const IDLE: Nm = Nm::from_um(500);

/// How far a cutter that just fits may seem to touch the other side of a slot: what flattening
/// makes of curves. Chosen.
const FIT: f64 = 3_000.0;

impl<'a> Contours<'a> {
    /// What `programs` make of the outline of `board`, and of its cut-outs those that drill; none
    /// where it has none.
    pub(super) fn new(
        programs: &[&'a Machining],
        drilling: &[&Machining],
        board: &Board,
        settings: &Settings,
    ) -> Option<Self> {
        let outline = board.outline.as_ref()?.polygon(FLATTEN);
        let cuts: Vec<Cut<'a>> = Cut::all(programs).collect();
        let half = cuts.iter().map(|cut| cut.swept.half()).min().unwrap_or(IDLE);
        let edges: Vec<Shape> = outline
            .edges()
            .map(|(from, to)| match from == to {
                true => Shape::Disc { center: from, radius: Nm::ZERO },
                false => Shape::Stroke { from, to, radius: Nm::ZERO },
            })
            .collect();
        let edge = Proximity::of(&edges);
        let edges = Edges::new(&outline);
        let milled = Look::new(&cuts, &edge, half, settings);
        // Cut-outs may be drilled. Holes at the edge of a board are no part of the way round it.
        let has_cut_outs = outline.contours().iter().any(|points| area(points) <= 0);
        let drilled = (has_cut_outs && !drilling.is_empty()).then(|| {
            let cuts: Vec<Cut<'_>> = cuts.iter().copied().chain(Cut::all(drilling)).collect();
            Look::new(&cuts, &edge, half, settings)
        });
        let ring = |points: &Vec<Point>| {
            let is_board = area(points) > 0;
            let look = drilled.as_ref().filter(|_| !is_board).unwrap_or(&milled);
            look.ring(points, is_board)
        };
        let rings = outline.contours().iter().map(ring).collect();
        let taken = taken(&cuts, &edges, &edge, &board.holes, settings);
        Some(Self { programs: programs.to_vec(), outline, edges, rings, taken, half })
    }

    /// How wide a stretch that is not cut through is in the groove, where it is narrowest: the
    /// cutter's round end reaches into it.
    pub(super) fn width(&self, stretch: &Stretch, settings: &Settings) -> f64 {
        let (half, edge) = (self.half.to_f64(), settings.edge.to_f64());
        stretch.length - 2.0 * (half - (2.0 * half * edge).sqrt().min(half))
    }

    /// What `stretch` is, of a contour that is as long as `ring`.
    pub(super) fn is_tab(&self, stretch: &Stretch, ring: &Ring, settings: &Settings) -> bool {
        let short = self.width(stretch, settings) <= widest(settings).to_f64()
            && stretch.length <= ring.length() / 2.0
            && settings.tabs != Some(0);
        match stretch.state {
            State::Through | State::Narrow => false,
            State::Shallow => short && settings.board - stretch.depth >= THINNEST_TAB,
            // Nobody has said that tabs are lower than the board.
            State::Uncut => {
                let is_gap = stretch.length >= self.half.to_f64() && stretch.left >= stretch.length / 4.0;
                short && is_gap && settings.tab_width.is_none()
            }
        }
    }

    /// The tabs of a contour.
    pub(super) fn tabs<'b>(
        &'b self,
        ring: &'b Ring,
        settings: &'b Settings,
    ) -> impl Iterator<Item = &'b Stretch> {
        ring.stretches.iter().filter(move |stretch| self.is_tab(stretch, ring, settings))
    }

    /// The ways from each tab of a contour to the next, all the way round; none where it has no
    /// tab.
    pub(super) fn ways(&self, ring: &Ring, settings: &Settings) -> Vec<Way> {
        let is_tab = |stretch: &Stretch| self.is_tab(stretch, ring, settings);
        let first = ring.stretches.iter().position(is_tab);
        let (before, after) = ring.stretches.split_at(first.unwrap_or(0));
        let mut ways: Vec<Way> = Vec::new();
        for stretch in after.iter().chain(before) {
            if is_tab(stretch) {
                ways.push(Way { length: 0.0, stretch: Stretch { length: 0.0, ..*stretch } });
            } else if let Some(way) = ways.last_mut() {
                way.length += stretch.length;
                if stretch.length > way.stretch.length {
                    way.stretch = *stretch;
                }
            }
        }
        ways
    }

    /// A program and a line of it for findings about what is not cut: the last.
    pub(super) fn last(&self) -> (Option<String>, Option<u32>) {
        let program = self.programs.last();
        let line = program.and_then(|program| program.swept.last()).map(|swept| swept.line);
        (program.map(|program| program.followed.file.clone()), line)
    }
}

/// The widest that is a tab, and no mistake: twice as wide as asked for and some, or where nobody
/// said how wide, wider than any that holds a board of this size. Chosen.
fn widest(settings: &Settings) -> Nm {
    settings.tab_width.map_or(Nm::from_mm(10), |width| width * 2 + Nm::from_mm(1))
}

/// What is left is no tab where it is thinner than this. Chosen: it breaks when it is looked at.
pub const THINNEST_TAB: Nm = Nm::from_um(100);

impl Ring {
    /// How long it is, in nanometres.
    pub(super) fn length(&self) -> f64 {
        self.stretches.iter().map(|stretch| stretch.length).sum()
    }

    /// Whether somewhere in the middle third of `stretch` the edge is straight for so long, as it
    /// should be at a tab.
    pub(super) fn is_straight_in(&self, stretch: &Stretch, long: f64) -> bool {
        /// In radians, some 30°. Chosen: more than tabs are put on where there is a choice.
        const STRAIGHT: f64 = 0.5;
        let third = stretch.spots / 3;
        let middle = &self.spots[stretch.first + third..stretch.first + stretch.spots - third];
        let is_straight = |from: usize| {
            let (mut gone, mut turned) = (0.0, 0.0);
            for pair in middle[from..].windows(2) {
                let [(ax, ay), (bx, by)] = [pair[0].out, pair[1].out];
                gone += pair[0].length;
                turned += libm::atan2(ax * by - ay * bx, ax * bx + ay * by).abs();
                if gone >= long || turned > STRAIGHT {
                    break;
                }
            }
            gone >= long && turned <= STRAIGHT
        };
        (0..middle.len()).any(is_straight)
    }
}

/// What spots are looked at with.
struct Look<'a> {
    edge: &'a Proximity,
    through: Proximity,
    any: Proximity,
    /// How deep each cut goes at its full width.
    depths: Vec<Nm>,
    half: Nm,
    tolerance: Nm,
}

impl<'a> Look<'a> {
    fn new(cuts: &[Cut<'_>], edge: &'a Proximity, half: Nm, settings: &Settings) -> Self {
        let through = |cut: &&Cut<'_>| cut.swept.full >= settings.board;
        let shapes = |cuts: &mut dyn Iterator<Item = &Cut<'_>>| -> Vec<Shape> {
            cuts.map(|cut| cut.swept.shape.clone()).collect()
        };
        Self {
            edge,
            through: Proximity::of(&shapes(&mut cuts.iter().filter(through))),
            any: Proximity::of(&shapes(&mut cuts.iter())),
            depths: cuts.iter().map(|cut| cut.swept.full).collect(),
            half,
            tolerance: settings.edge,
        }
    }

    fn ring(&self, points: &[Point], is_board: bool) -> Ring {
        let step = (self.half.to_f64() / 4.0).clamp(50_000.0, 250_000.0);
        let mut spots = spots(points, step);
        let mut seen: Vec<Seen> = spots.par_iter().map(|spot| self.see(spot)).collect();
        // It may begin in the middle of a stretch.
        let first = (1..seen.len()).find(|&i| seen[i].state != seen[i - 1].state).unwrap_or(0);
        spots.rotate_left(first);
        seen.rotate_left(first);
        Ring { is_board, stretches: stretches(&spots, &seen), spots }
    }

    fn see(&self, spot: &Spot) -> Seen {
        let tolerance = self.tolerance.to_f64();
        let reach = self.half * 4 + self.tolerance;
        let place = Shape::Disc { center: spot.at, radius: Nm::ZERO };
        let near = self.any.near(&place, self.tolerance);
        let here = near.iter().filter(|near| near.width <= tolerance);
        let depth = here.map(|near| self.depths[near.feature]).max();
        let close = self.through.near(&place, self.tolerance);
        if let Some(left) = least(&close).filter(|left| *left <= tolerance) {
            let left = if left > 0.0 && !self.fits(spot) { 0.0 } else { left };
            return Seen { state: State::Through, left, depth: depth.unwrap_or(Nm::ZERO) };
        }
        let left = least(&self.through.near(&place, reach)).unwrap_or(f64::INFINITY);
        let fits = self.fits(spot);
        if !fits && left <= self.half.to_f64() {
            // Into an inner corner no round cutter reaches.
            return Seen { state: State::Through, left: 0.0, depth: depth.unwrap_or(Nm::ZERO) };
        }
        let state = match depth {
            Some(_) => State::Shallow,
            None if fits => State::Uncut,
            None => State::Narrow,
        };
        Seen { state, left, depth: depth.unwrap_or(Nm::ZERO) }
    }

    /// Whether the cutter can touch the board here from outside, with a little room to spare: into
    /// a hole as wide as itself it does not go.
    fn fits(&self, spot: &Spot) -> bool {
        let (room, (x, y)) = (self.half.to_f64() + 2.0 * FIT, spot.at.to_f64());
        let center = Point::from_f64(x + spot.out.0 * room, y + spot.out.1 * room);
        let place = Shape::Disc { center, radius: Nm::ZERO };
        least(&self.edge.near(&place, Nm::from_f64(room))).is_none_or(|width| width >= room - FIT)
    }
}

fn least(near: &[Near]) -> Option<f64> {
    near.iter().map(|near| near.width).reduce(f64::min)
}

/// Spots of a contour, no further apart than `step`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
fn spots(points: &[Point], step: f64) -> Vec<Spot> {
    let mut spots = Vec::new();
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        let length = a.distance(*b);
        if length < 1.0 {
            continue;
        }
        let count = ((length / step).ceil() as u32).max(1);
        let ((x, y), way) = (a.to_f64(), *b - *a);
        let (ux, uy) = (way.x.to_f64() / length, way.y.to_f64() / length);
        spots.extend((0..count).map(|i| {
            let along = length * (f64::from(i) + 0.5) / f64::from(count);
            // The board lies to the left.
            let at = Point::from_f64(x + ux * along, y + uy * along);
            Spot { at, out: (uy, -ux), length: length / f64::from(count) }
        }));
    }
    spots
}

/// Neighbouring spots of one state together.
fn stretches(spots: &[Spot], seen: &[Seen]) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    for (i, (Spot { at, length, .. }, &Seen { state, left, depth })) in spots.iter().zip(seen).enumerate() {
        let off = if left > NOTABLE.to_f64() { *length } else { 0.0 };
        match found.last_mut().filter(|last| last.state == state) {
            Some(last) => {
                last.length += length;
                if off > 0.0 {
                    last.mean = (last.mean * last.off + left * off) / (last.off + off);
                }
                last.off += off;
                if left > last.left {
                    (last.at, last.left) = (*at, left);
                }
                last.depth = last.depth.min(depth);
                last.spots += 1;
                last.middle = spots[last.first + (last.spots - 1) / 2].at;
            }
            None => {
                let (at, middle, length) = (*at, *at, *length);
                let (first, spots) = (i, 1);
                found.push(Stretch { state, length, at, middle, left, off, mean: left, depth, first, spots });
            }
        }
    }
    found
}

/// Twice the area of a ring in nm²: above zero where it goes round counter-clockwise, as boards do;
/// cut-outs go round the other way.
fn area(ring: &[Point]) -> i128 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(a, b)| {
            i128::from(a.x.get()) * i128::from(b.y.get()) - i128::from(b.x.get()) * i128::from(a.y.get())
        })
        .sum()
}

/// What reaches into the board, further than may be.
fn taken<'a>(
    cuts: &[Cut<'a>],
    outline: &Edges,
    edge: &Proximity,
    holes: &[Hole],
    settings: &Settings,
) -> Vec<Taken<'a>> {
    let into = |cut: &Cut<'a>| {
        let half = cut.swept.half().to_f64();
        let axes = chords(&cut.swept.axis()).into_iter();
        let near = axes.flat_map(|axis| edge.near(&axis, cut.swept.half()));
        let nearest = near.reduce(|a, b| if b.width < a.width { b } else { a });
        let anchor = cut.swept.shape.anchor();
        let (depth, at) = match nearest {
            Some(near) if near.width <= 0.0 => (half, near.at),
            _ if outline.contains(anchor) => (half + nearest.map_or(half, |near| near.width), anchor),
            Some(near) => (half - near.width, near.at),
            None => return None,
        };
        let is_wrong = depth > NOTABLE.to_f64() && !in_hole(cut.swept, holes, settings);
        is_wrong.then_some(Taken { cut: *cut, depth, at })
    };
    let all: Vec<Option<Taken<'a>>> = cuts.par_iter().map(into).collect();
    let mut found: Vec<Taken<'a>> = Vec::new();
    let mut last = None;
    for (index, taken) in all.iter().enumerate() {
        let Some(taken) = taken else { continue };
        let follows = last.is_some_and(|last| index - last <= 2);
        last = Some(index);
        match found.last_mut().filter(|_| follows) {
            Some(before) if before.depth < taken.depth => *before = *taken,
            Some(_) => {}
            None => found.push(*taken),
        }
    }
    found
}

/// How far chords may leave an arc. Chosen: far below what is told.
const CHORD: Nm = Nm::from_um(1);

/// An axis, and of an arc its chords: radii that differ at both ends by a last digit make no ring.
fn chords(axis: &Shape) -> Vec<Shape> {
    let Shape::Arc { arc, radius } = axis else { return vec![axis.clone()] };
    let points: Vec<Point> = std::iter::once(arc.start).chain(arc.flatten(CHORD)).collect();
    let chord = |pair: &[Point]| Shape::Stroke { from: pair[0], to: pair[1], radius: *radius };
    points.windows(2).filter(|pair| pair[0] != pair[1]).map(chord).collect()
}

/// Whether a cut stays within a hole of the board: some cut large holes out.
fn in_hole(swept: &Swept, holes: &[Hole], settings: &Settings) -> bool {
    let bounds = swept.shape.bounds();
    let holds = |hole: &Hole| {
        let room = hole.bounds().inflate(settings.place);
        let may_hold = room.contains(bounds.min()) && room.contains(bounds.max());
        may_hold && past(hole, &swept.shape) <= settings.place.to_f64()
    };
    holes.iter().any(holds)
}
