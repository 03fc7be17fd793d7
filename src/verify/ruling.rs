//! Where parallel lines run through shapes: how exact shapes become rows of pixels, areas and
//! widths.
//!
//! ```text
//!   ──────────╮        A line through a shape is inside along its chords: one for what is convex, two where it crosses
//!   ───████████────    a ring, as many as there are for a polygon. What a line costs does not depend on how
//!   ─██████──███───    much there is inside, as filling pixels does; only on how many shapes it meets.
//!   ──████───███───
//! ```
//!
//! Rows of pixels are horizontal lines through their centres. Areas are lines at a slant that edges
//! of boards do not have (3 to 4), so that a strip of any direction is crossed by many. A width is
//! one line.
//!
//! Filling pixels instead, judging a clean board took three times as long.

use std::ops::Range;

use crate::board::Shape;
use crate::geometry::{Arc, Nm, Point, Polygon, Turn};
use crate::grid::Grid;

/// Parallel lines, a pitch apart, numbered as they come.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ruling {
    /// Where the first line begins, in nanometres.
    origin: (f64, f64),
    /// Where lines go, of length 1. The next line lies to the right of it.
    way: (f64, f64),
    pitch: f64,
}

/// A place along a line and off the first line, in nanometres.
type Local = (f64, f64);

impl Ruling {
    /// The rows of pixels of a grid through their centres, each from the grid's left edge.
    pub(super) fn rows(grid: &Grid) -> Self {
        let (corner, center) = (grid.corner(0, 0).to_f64(), grid.center(0, 0).to_f64());
        Self { origin: (corner.0, center.1), way: (1.0, 0.0), pitch: grid.pitch().to_f64() }
    }

    /// A single line from `from` on through `to`, which is another place.
    pub(super) fn line(from: Point, to: Point) -> Self {
        let (length, way) = (from.distance(to), to - from);
        let way = (way.x.to_f64() / length, way.y.to_f64() / length);
        Self { origin: from.to_f64(), way, pitch: f64::INFINITY }
    }

    /// Slanting lines near `place`.
    pub(super) fn slanting(place: Point, pitch: Nm) -> Self {
        Self { origin: place.to_f64(), way: (0.8, 0.6), pitch: pitch.to_f64() }
    }

    /// The lines that may run through a shape, of all there are; the first below zero for some
    /// before the first one.
    #[expect(clippy::cast_possible_truncation, reason = "lines are counted in 64 bits")]
    pub(super) fn lines(&self, shape: &Shape) -> Range<i64> {
        let bounds = shape.bounds();
        let off = bounds.corners().map(|corner| self.local(corner).1 / self.pitch);
        let (low, high) = off
            .into_iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), off| (low.min(off), high.max(off)));
        low.ceil() as i64..high.floor() as i64 + 1
    }

    /// Tells `chord` of every stretch of `lines` inside `shape`: the line, from where, and to
    /// where, in nanometres. They may overlap.
    pub(super) fn rule(&self, shape: &Shape, lines: Range<i64>, chord: &mut impl FnMut(i64, f64, f64)) {
        let own = self.lines(shape);
        let lines = lines.start.max(own.start)..lines.end.min(own.end);
        if lines.is_empty() {
            return;
        }
        match shape {
            Shape::Disc { center, radius } => {
                let disc = Disc { center: self.local(*center), radius: radius.to_f64() };
                self.one_each(lines, |v| disc.chord(v), chord);
            }
            Shape::Stroke { from, to, radius } => {
                let capsule = Capsule::new(self.local(*from), self.local(*to), radius.to_f64());
                self.one_each(lines, |v| capsule.chord(v), chord);
            }
            Shape::Arc { arc, radius } => self.arc(arc, *radius, lines, chord),
            Shape::Polygon(polygon) => self.polygon(polygon, lines, chord),
        }
    }

    /// From where to where along them `lines` may run through a shape, in nanometres; none where
    /// they run past it.
    pub(super) fn reach(&self, shape: &Shape, lines: Range<i64>) -> Option<(f64, f64)> {
        let Shape::Stroke { from, to, radius } = shape else {
            let along = shape.bounds().corners().map(|corner| self.local(corner).0);
            return Some((
                along.into_iter().fold(f64::INFINITY, f64::min),
                along.into_iter().fold(f64::NEG_INFINITY, f64::max),
            ));
        };
        let (a, b, room) = (self.local(*from), self.local(*to), radius.to_f64() + 1.0);
        let share = |off: f64| (off - a.1) / (b.1 - a.1);
        let (low, high) = (self.off(lines.start) - room, self.off(lines.end - 1) + room);
        // Along the lines it is all in reach, or none.
        let is_level = (a.1 - b.1).abs() < 1.0;
        let (first, last) = if is_level { (0.0, 1.0) } else { (share(low), share(high)) };
        let (first, last) = (first.min(last).max(0.0), first.max(last).min(1.0));
        let [one, other] = [first, last].map(|share| a.0 + (b.0 - a.0) * share);
        (first <= last).then_some((one.min(other) - room, one.max(other) + room))
    }

    fn local(&self, p: Point) -> Local {
        let (x, y) = p.to_f64();
        let (x, y) = (x - self.origin.0, y - self.origin.1);
        (x * self.way.0 + y * self.way.1, x * self.way.1 - y * self.way.0)
    }

    #[expect(clippy::cast_precision_loss, reason = "lines are few beside 2⁵³")]
    fn off(&self, line: i64) -> f64 {
        // A single line has no pitch.
        if line == 0 { 0.0 } else { line as f64 * self.pitch }
    }

    /// Asks for the one chord of each line.
    fn one_each(
        &self,
        lines: Range<i64>,
        stretch: impl Fn(f64) -> Option<(f64, f64)>,
        chord: &mut impl FnMut(i64, f64, f64),
    ) {
        for line in lines {
            if let Some((from, to)) = stretch(self.off(line)) {
                chord(line, from, to);
            }
        }
    }

    /// Asks `chords` of each line.
    fn each(
        &self,
        lines: Range<i64>,
        chords: impl Fn(f64, &mut dyn FnMut(Option<(f64, f64)>)),
        chord: &mut impl FnMut(i64, f64, f64),
    ) {
        for line in lines {
            let mut found = |stretch: Option<(f64, f64)>| {
                if let Some((from, to)) = stretch {
                    chord(line, from, to);
                }
            };
            chords(self.off(line), &mut found);
        }
    }

    fn arc(&self, arc: &Arc, radius: Nm, lines: Range<i64>, chord: &mut impl FnMut(i64, f64, f64)) {
        if arc.drift() > ROUND {
            // No ring: a piece of a spiral.
            let points: Vec<Point> = std::iter::once(arc.start).chain(arc.flatten(CHORD)).collect();
            for pair in points.windows(2).filter(|pair| pair[0] != pair[1]) {
                let stroke = Shape::Stroke { from: pair[0], to: pair[1], radius };
                self.rule(&stroke, lines.clone(), chord);
            }
            return;
        }
        let [center, start, end] = [arc.center, arc.start, arc.end].map(|p| self.local(p));
        // To the right of a line is the other way round.
        let ends = match arc.turn {
            Turn::CounterClockwise => (end, start),
            Turn::Clockwise => (start, end),
        };
        let ring = Ring::new(center, ends, arc.start == arc.end, radius.to_f64());
        self.each(lines, |v, found| ring.chords(v, found), chord);
    }

    /// By the winding numbers between the crossings with its edges.
    fn polygon(&self, polygon: &Polygon, lines: Range<i64>, chord: &mut impl FnMut(i64, f64, f64)) {
        let mut crossings: Vec<(i64, f64, i32)> = Vec::new();
        for (from, to) in polygon.edges() {
            let (a, b) = (self.local(from), self.local(to));
            let (low, high, turn) = if a.1 < b.1 { (a, b, 1) } else { (b, a, -1) };
            for line in self.between(low.1, high.1, &lines) {
                let share = (self.off(line) - low.1) / (high.1 - low.1);
                crossings.push((line, low.0 + (high.0 - low.0) * share, turn));
            }
        }
        crossings.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        for crossings in crossings.chunk_by(|a, b| a.0 == b.0) {
            let mut winding = 0;
            for pair in crossings.windows(2) {
                winding += pair[0].2;
                if winding != 0 {
                    chord(pair[0].0, pair[0].1, pair[1].1);
                }
            }
        }
    }

    /// The lines above `low` up to `high`: of edges that follow one another one only owns the line
    /// through their corner.
    #[expect(clippy::cast_possible_truncation, reason = "lines are counted in 64 bits")]
    fn between(&self, low: f64, high: f64, lines: &Range<i64>) -> Range<i64> {
        let after = |off: f64| (off / self.pitch).floor() as i64 + 1;
        let (mut start, mut end) = (after(low), after(high));
        if self.pitch.is_infinite() {
            (start, end) = (i64::from(low >= 0.0), i64::from(high >= 0.0));
        }
        start.max(lines.start)..end.min(lines.end)
    }
}

/// Radii of an arc this near to each other, in nanometres, are one: what a last digit of a program
/// makes of them. Chosen.
const ROUND: f64 = 2_000.0;
/// How far chords may leave a spiral. Chosen: far below what is tolerated.
const CHORD: Nm = Nm::new(200);

#[derive(Clone, Copy)]
struct Disc {
    center: Local,
    radius: f64,
}

impl Disc {
    fn chord(self, v: f64) -> Option<(f64, f64)> {
        let off = v - self.center.1;
        let squared = self.radius * self.radius - off * off;
        let half = if squared > 0.0 { squared.sqrt() } else { return None };
        Some((self.center.0 - half, self.center.0 + half))
    }
}

/// A stroke with its round ends.
struct Capsule {
    ends: [Disc; 2],
    /// Its way, of length 1.
    way: Local,
    along: Slab,
    beside: Slab,
}

impl Capsule {
    fn new(from: Local, to: Local, radius: f64) -> Self {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = (x * x + y * y).sqrt().max(f64::MIN_POSITIVE);
        let way = (x / length, y / length);
        Self {
            ends: [from, to].map(|center| Disc { center, radius }),
            way,
            along: Slab { low: 0.0, high: length, step: 1.0 / way.0 },
            beside: Slab { low: -radius, high: radius, step: -1.0 / way.1 },
        }
    }

    /// Both ends and what is between them are convex together, so that it is from the first of them
    /// to the last.
    fn chord(&self, v: f64) -> Option<(f64, f64)> {
        let [one, other] = self.ends.map(|end| end.chord(v));
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for (first, last) in [one, other, self.between(v)].into_iter().flatten() {
            (from, to) = (from.min(first), to.max(last));
        }
        (from <= to).then_some((from, to))
    }

    /// Along the line, the distance along the way and that from it change evenly.
    fn between(&self, v: f64) -> Option<(f64, f64)> {
        let (u, own) = self.ends[0].center;
        let off = v - own;
        let along = self.along.of(off * self.way.1)?;
        let beside = self.beside.of(off * self.way.0)?;
        let (from, to) = (along.0.max(beside.0), along.1.min(beside.1));
        (from < to).then_some((u + from, u + to))
    }
}

/// Where a value lies between two others that changes evenly along a line.
#[derive(Clone, Copy)]
struct Slab {
    low: f64,
    high: f64,
    /// How far it is along the line for a change of one; not finite where it does not change.
    step: f64,
}

impl Slab {
    /// The stretch of a line at whose beginning it is `start`.
    fn of(self, start: f64) -> Option<(f64, f64)> {
        if !self.step.is_finite() {
            let holds = self.low <= start && start <= self.high;
            return holds.then_some((f64::NEG_INFINITY, f64::INFINITY));
        }
        let (one, other) = ((self.low - start) * self.step, (self.high - start) * self.step);
        Some((one.min(other), one.max(other)))
    }
}

/// An arc with its round ends.
struct Ring {
    center: Local,
    /// From the centre, with the turn: from the first counter-clockwise, as the local frame has it,
    /// to the second.
    ends: (Local, Local),
    whole: bool,
    outer: f64,
    inner: f64,
    caps: [Disc; 2],
}

impl Ring {
    fn new(center: Local, (start, end): (Local, Local), whole: bool, radius: f64) -> Self {
        let from = |p: Local| (p.0 - center.0, p.1 - center.1);
        let length = |p: Local| (p.0 * p.0 + p.1 * p.1).sqrt();
        let ends = (from(start), from(end));
        let middle = f64::midpoint(length(ends.0), length(ends.1));
        let caps = [start, end].map(|center| Disc { center, radius });
        Self { center, ends, whole, outer: middle + radius, inner: middle - radius, caps }
    }

    fn chords(&self, v: f64, found: &mut dyn FnMut(Option<(f64, f64)>)) {
        let disc = |radius: f64| Disc { center: (0.0, self.center.1), radius };
        if let Some(outer) = disc(self.outer).chord(v) {
            self.within(v - self.center.1, outer, found);
        }
        if !self.whole {
            self.caps.iter().for_each(|cap| found(cap.chord(v)));
        }
    }

    /// What of the chord of the outer circle lies in the ring, between its ends.
    fn within(&self, off: f64, (from, to): (f64, f64), found: &mut dyn FnMut(Option<(f64, f64)>)) {
        // Where anything can change: at the inner circle, and where the line crosses the ways to
        // both ends.
        let mut stops = [from, to, to, to, to, to];
        let mut count = 1;
        let mut stop = |at: f64| {
            if from < at && at < to {
                stops[count] = at;
                count += 1;
            }
        };
        let squared = self.inner * self.inner - off * off;
        if self.inner > 0.0 && squared > 0.0 {
            let half = squared.sqrt();
            stop(-half);
            stop(half);
        }
        if !self.whole {
            for end in [self.ends.0, self.ends.1] {
                stop(end.0 * off / end.1);
            }
        }
        stops[1..count].sort_by(f64::total_cmp);
        for pair in stops[..=count].windows(2) {
            let middle = (f64::midpoint(pair[0], pair[1]), off);
            if self.holds(middle) {
                found(Some((self.center.0 + pair[0], self.center.0 + pair[1])));
            }
        }
    }

    /// Whether a place within the outer circle, seen from the centre, lies in the ring between its
    /// ends.
    fn holds(&self, p: Local) -> bool {
        let cross = |a: Local, b: Local| a.0 * b.1 - a.1 * b.0;
        let is_outside = self.inner <= 0.0 || p.0 * p.0 + p.1 * p.1 >= self.inner * self.inner;
        let (start, end) = self.ends;
        let (after, before) = (cross(start, p) >= 0.0, cross(p, end) >= 0.0);
        let is_wide = cross(start, end) < 0.0;
        is_outside && (self.whole || if is_wide { after || before } else { after && before })
    }
}
