//! Generators: the one-sided edges that distances are measured to, each with an owner, and what
//! they hang together with.
//!
//! ```text
//!          end disc ──╮                             A stroke is two lines and a disc round either end, a polygon its
//!        ╭────────────┴─╮ line        ▓▓▓▓▓▓        edges and convex corners (discs of radius 0), an arc one full and one
//!        │ ▓▓▓▓▓▓▓▓▓▓▓▓ │             ▓▓▓▓▓▓        hollow arc and a disc round either end.
//!        ╰──────────────╯ line        corner ●
//! ```
//!
//! Lines and arcs count where the foot lies on them. A disc counts everywhere: it lies within the
//! copper, so its distance is never too small, and no gap is left at an end. Where a line or an arc
//! hands over to the disc at its end the two have the same foot and the same normal; such *joined*
//! generators have no bisector. Every generator knows its *breaks*, the places where another one
//! that lies on it ends, so that a walk stops at the same places from either side.
//!
//! What is the same from two features is one generator. Buried edges need not be found: from
//! outside all copper they are never nearest.

use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::board::{Copper, FLATTEN, Shape};
use crate::geometry::{Arc, Nm, Path, Point, Polygon, Rect, Segment, Turn, Vector, twice_area};
use crate::topology;
use crate::voronoi::plane::Spot;

use super::WALL;
use super::form::{Form, clockwise, is_one_way, unit};
use super::rounding::Circles;
use super::slit::without_slits;
use super::weld::{NEAR, welded};

/// No generator.
const NONE: u32 = u32::MAX;

/// Arcs of which the two radii differ by more, in nanometres, are cut into chords: rounding three
/// points leaves less. Chosen.
const DRIFT: f64 = 1_000.0;

/// Two edges that turn by less, in radians, are one for all that is nearest to their corner.
/// Derived: 100 mm away the distances to them differ by half a tie where both count.
const STRAIGHT: f64 = 3e-6;

/// A corner that lies off the chord between its neighbours by no more, in nanometres, is none: what
/// rounding to whole nanometres leaves of three points. Chosen.
const ROUNDING: f64 = 1.5;

/// Shaken points are moved by up to so many nanometres along either axis. Measured: of 3000 scenes
/// of tracks with rounded corners, whose lines and arcs end fractions of a nanometre apart, 170
/// have a fault when moved by 2, for that leaves them about as far apart as what is equal; 4 when
/// moved by 20, and none by 50.
const SHAKE: i64 = 25;

/// The same of what is looked at from within: what floats leave of a straight edge. Chosen.
const EXACT: f64 = 1e-3;

/// So many corners in a row are none at most, so that looking does not take the square of them.
/// Chosen.
const LONGEST_RUN: usize = 64;

/// Copper, by the numbers of the generators that are its edges.
#[derive(Clone, Debug)]
pub(super) enum Body {
    /// All of a disc.
    Disc(u32),
    /// Between the two sides of a stroke.
    Strip([u32; 2]),
    /// Within an outer arc, and outside an inner one.
    Band(u32, Option<u32>),
    /// What rings enclose, or where they are `open`, what they do not.
    Rings { rings: Box<[Vec<u32>]>, open: bool },
}

/// Generators under construction: what [`Diagram::new`](super::Diagram::new) takes.
#[derive(Clone, Debug, Default)]
pub struct Generators {
    pub(super) forms: Vec<Form>,
    pub(super) owners: Vec<u32>,
    /// What goes on at the start and the end of each: a disc, or a line that is straight on.
    ends: Vec<[u32; 2]>,
    /// What they are the edges of.
    pub(super) bodies: Vec<Body>,
    discs: FxHashMap<(Point, i64, u32), u32>,
    strokes: FxHashSet<(Point, Point, i64, u32)>,
    /// Points that are moved to others that they all but meet.
    welded: FxHashMap<Point, Point>,
    /// Zero, or which of many ways points are moved.
    attempt: u32,
    /// Whether what one owner has may lie in pieces.
    pub(super) is_loose: bool,
    /// Whether they are so far apart that what flattening left does not matter.
    is_round: bool,
}

impl Generators {
    /// None yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// None yet; each point of those to come is moved by up to 25 nanometres along either axis, as
    /// the number of the attempt says, the same point alike, so that equal distances differ. The
    /// first attempt, zero, leaves all as it is.
    #[must_use]
    pub fn shaken(attempt: u32) -> Self {
        Self { attempt, ..Self::default() }
    }

    /// Says that what one owner has may lie in pieces, as core axes do: copper that hangs together
    /// has one rightmost point, each piece of these its own.
    pub const fn loosen(&mut self) {
        self.is_loose = true;
    }

    /// Says that owners are farther apart than flattening moves edges: then what chords are left of
    /// a curve is an arc.
    pub const fn round(&mut self) {
        self.is_round = true;
    }

    /// Says that those of `points`, of shapes to come, that all but meet are one: the first of them
    /// in the order of x and y.
    pub fn weld(&mut self, points: Vec<Point>) {
        self.weld_within(points, NEAR);
    }

    /// As [`Self::weld`], of points that lie nearer to each other than `near` nanometres along both
    /// axes.
    pub fn weld_within(&mut self, points: Vec<Point>, near: i64) {
        self.welded = welded(points, near);
    }

    /// The point that a point of a shape is.
    fn point(&self, p: Point) -> Point {
        self.welded.get(&p).copied().unwrap_or(p)
    }

    /// Where a point is moved to.
    fn moved(&self, p: Point) -> Point {
        let [x, y] = self.steps(p);
        p + Vector::new(Nm::new(x), Nm::new(y))
    }

    /// How far a point is moved along either axis, in nanometres.
    fn steps(&self, p: Point) -> [i64; 2] {
        if self.attempt == 0 {
            return [0; 2];
        }
        let [x, y] = [p.x, p.y].map(|nm| nm.get().cast_unsigned());
        let parts = [u64::from(self.attempt), x, y];
        let hash = parts.into_iter().fold(0, |hash, part| topology::splitmix(hash ^ part));
        [hash >> 32, hash & u64::from(u32::MAX)].map(|bits| {
            i64::try_from(bits % (2 * SHAKE.cast_unsigned() + 1)).expect("twice as many and one") - SHAKE
        })
    }

    /// The same without what was only needed to add more.
    pub(super) fn finished(mut self) -> Self {
        (self.discs, self.strokes, self.welded) = Default::default();
        self.forms.shrink_to_fit();
        self.owners.shrink_to_fit();
        self.ends.shrink_to_fit();
        self.bodies.shrink_to_fit();
        self
    }

    /// How many there are.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.forms.len()
    }

    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.forms.is_empty()
    }

    /// The edges of all features of a layer that `owner` gives an owner.
    #[must_use]
    pub fn of_copper(copper: &Copper, owner: impl Fn(usize) -> Option<u32>) -> Self {
        let mut generators = Self::new();
        for (i, feature) in copper.features.iter().enumerate() {
            if let Some(owner) = owner(i) {
                generators.add(&feature.shape, owner);
            }
        }
        generators
    }

    /// Adds the edges of a shape; the space outside it is free.
    pub fn add(&mut self, shape: &Shape, owner: u32) {
        match shape {
            Shape::Disc { center, radius } => {
                self.disc(self.moved(self.point(*center)), radius.get(), owner);
            }
            Shape::Stroke { from, to, radius } => {
                let [from, to] = [from, to].map(|p| self.moved(self.point(*p)));
                self.stroke(from, to, radius.get(), owner);
            }
            Shape::Arc { arc, radius } => {
                let ends = [arc.start, arc.end].map(|p| self.point(p));
                // A short one must not become a whole turn.
                let is_one = ends[0] == ends[1] && arc.start != arc.end;
                let ends = if is_one { [arc.start, arc.end] } else { ends };
                let [start, end] = ends.map(|p| self.moved(p));
                let center = self.moved(arc.center);
                self.arc(&Arc { start, end, center, ..*arc }, radius.get(), owner);
            }
            Shape::Polygon(polygon) => self.polygon(polygon, owner),
        }
    }

    /// Adds the rings of a polygon; the space outside it is free.
    pub fn polygon(&mut self, polygon: &Polygon, owner: u32) {
        self.rings(polygon, |_| owner, false);
    }

    /// Adds the rings of a polygon, each with an owner of its own; the space inside it is free.
    pub fn inside(&mut self, polygon: &Polygon, owner: impl Fn(usize) -> u32) {
        self.rings(polygon, owner, true);
    }

    fn rings(&mut self, polygon: &Polygon, owner: impl Fn(usize) -> u32, inwards: bool) {
        // The inside of shapes is taken as it is: there every corner may have an axis. Corners that
        // rounding has left of fine chords are not shaken, though.
        let rounding = if inwards && self.attempt == 0 { EXACT } else { ROUNDING };
        let simple = |ring: Vec<Point>| simple(ring, rounding);
        let points = |ring: &Vec<Point>| ring.iter().map(|&p| self.point(p)).collect::<Vec<_>>();
        let rings: Vec<Vec<Point>> = polygon.contours().iter().map(|ring| simple(points(ring))).collect();
        let largest = rings.iter().map(|ring| twice_area(ring)).max_by_key(|area| area.unsigned_abs());
        let backwards = largest.is_some_and(|area| area < 0);
        let circles = Circles::new(if self.is_round && !inwards { polygon.circles() } else { &[] });
        // Of islands that rounding has left without a width, no axis tells the two sides.
        let is_ring = |ring: &[Point]| ring.len() > 1 && !(inwards && is_flat(ring));
        let paths = |(i, mut ring): (usize, Vec<Point>)| {
            if backwards != inwards {
                ring.reverse();
            }
            let rings = if inwards { vec![ring] } else { without_slits(vec![ring]) };
            let paths = rings.into_iter().filter_map(|ring| circles.rounded(simple(ring)));
            paths.map(|path| (i, self.shake(path))).collect::<Vec<_>>()
        };
        let rings = rings.into_par_iter().enumerate().filter(|(_, ring)| is_ring(ring));
        let paths: Vec<(usize, Path)> = rings.flat_map_iter(paths).collect();
        let numbers = paths.iter().map(|(i, path)| self.ring(path, owner(*i))).collect();
        self.bodies.push(Body::Rings { rings: numbers, open: inwards });
    }

    /// A ring with each point where it is moved to. Slits and what rounding leaves are gone by
    /// then: they are found by points that all but meet.
    fn shake(&self, ring: Path) -> Path {
        if self.attempt == 0 {
            return ring;
        }
        let moved = |segment: &Segment| match *segment {
            Segment::Line { to } => Segment::Line { to: self.moved(to) },
            Segment::Arc { to, center, turn } => {
                Segment::Arc { to: self.moved(to), center: self.moved(center), turn }
            }
        };
        let mut path =
            Path { start: self.moved(ring.start), segments: ring.segments.iter().map(moved).collect() };
        let mut at = path.start;
        path.segments.retain(|segment| {
            let from = std::mem::replace(&mut at, segment.to());
            segment.to() != from || segment.arc(from).is_some()
        });
        path
    }

    /// Adds the sides of a rectangle that holds all else; the space inside it is free.
    pub fn wall(&mut self, rect: Rect) {
        self.inside(&Polygon::rectangle(rect), |_| WALL);
    }

    /// The number of the next one.
    fn number(&self) -> u32 {
        u32::try_from(self.forms.len()).expect("below 2³² generators")
    }

    /// A ring with copper on its left: the numbers of its edges.
    fn ring(&mut self, ring: &Path, owner: u32) -> Vec<u32> {
        let first = ring.segments.first().and_then(|segment| segment.arc(ring.start));
        if let Some(circle) = first.filter(|arc| arc.start == arc.end) {
            return vec![self.circle(&circle, owner)];
        }
        let steps: Vec<(Point, &Segment)> = ring.steps().collect();
        let n = steps.len();
        let corner = |i: usize| {
            let ((a, before), (b, after)) = (steps[(i + n - 1) % n], steps[i]);
            match (before, after) {
                (Segment::Line { .. }, Segment::Line { to: c }) => {
                    cross(a, b, *c) > 0 || (cross(a, b, *c) == 0 && is_back(a, b, *c))
                }
                // Where it is none, what ends there hides it.
                _ => true,
            }
        };
        let corners: Vec<u32> =
            (0..n).map(|i| if corner(i) { self.disc(steps[i].0, 0, owner) } else { NONE }).collect();
        let first = self.number();
        for (i, &(from, segment)) in steps.iter().enumerate() {
            let ends = [corners[i], corners[(i + 1) % n]];
            match segment.arc(from) {
                None => drop(self.push(Form::line(Spot::from(from), Spot::from(segment.to())), owner, ends)),
                Some(arc) => self.bow(&arc, owner, ends),
            }
        }
        let count = self.number() - first;
        for (line, next) in (0..count).map(|i| (first + i, first + (i + 1) % count)) {
            self.join_straight(line, next);
        }
        (first..self.number()).collect()
    }

    /// A circle that is a whole ring.
    fn circle(&mut self, circle: &Arc, owner: u32) -> u32 {
        let (center, radius) = (Spot::from(circle.center), circle.radius());
        let hollow = circle.turn == Turn::Clockwise;
        self.push(Form::Circle { center, radius, hollow, sector: None }, owner, [NONE; 2])
    }

    /// An arc of a ring.
    fn bow(&mut self, arc: &Arc, owner: u32, [start, end]: [u32; 2]) {
        let [from, to] = [arc.start, arc.end].map(Spot::from);
        let (center, radius) = between(from, to, Spot::from(arc.center));
        let [from, to] = [from, to].map(|p| unit(p - center));
        let hollow = arc.turn == Turn::Clockwise;
        let (sector, ends) = if hollow { ([to, from], [end, start]) } else { ([from, to], [start, end]) };
        self.push(Form::Circle { center, radius, hollow, sector: Some(sector) }, owner, ends);
    }

    /// Joins two lines one after the other that turn so little into the free space that nothing is
    /// nearer to one of them alone.
    fn join_straight(&mut self, line: u32, next: u32) {
        let ways = [line, next].map(|i| match self.forms[i as usize] {
            Form::Line { along, .. } => along,
            Form::Circle { .. } => Spot::default(),
        });
        if is_one_way(ways[0], ways[1], STRAIGHT) && line != next && self.ends[line as usize][1] == NONE {
            self.ends[line as usize][1] = next;
            self.ends[next as usize][0] = line;
        }
    }

    fn push(&mut self, form: Form, owner: u32, ends: [u32; 2]) -> u32 {
        let number = self.number();
        self.forms.push(form);
        self.owners.push(owner);
        self.ends.push(ends);
        number
    }

    fn disc(&mut self, center: Point, radius: i64, owner: u32) -> u32 {
        if let Some(&known) = self.discs.get(&(center, radius, owner)) {
            return known;
        }
        let disc = self.push(Form::disc(Spot::from(center), Nm::new(radius).to_f64()), owner, [NONE; 2]);
        self.discs.insert((center, radius, owner), disc);
        self.bodies.push(Body::Disc(disc));
        disc
    }

    fn stroke(&mut self, from: Point, to: Point, radius: i64, owner: u32) {
        let (from, to) = (from.min(to), from.max(to));
        let discs = [from, to].map(|end| self.disc(end, radius, owner));
        if from == to || !self.strokes.insert((from, to, radius, owner)) {
            return;
        }
        self.sides(Spot::from(from), Spot::from(to), Nm::new(radius).to_f64(), owner, discs);
    }

    /// The two sides of a stroke.
    fn sides(&mut self, from: Spot, to: Spot, radius: f64, owner: u32, [first, last]: [u32; 2]) {
        let out = clockwise(unit(to - from)) * radius;
        let sides = [(from, to, out, [first, last]), (to, from, out * -1.0, [last, first])];
        // The length stays that of the axis, so that its ends are those of the discs.
        let sides = sides.map(|(a, b, out, ends)| self.push(Form::line(a + out, b + out), owner, ends));
        self.bodies.push(Body::Strip(sides));
    }

    fn arc(&mut self, arc: &Arc, radius: i64, owner: u32) {
        let half = Nm::new(radius).to_f64();
        let whole = arc.start == arc.end;
        let Some((center, reach)) = self.centred(arc) else {
            let points: Vec<Point> = std::iter::once(arc.start).chain(arc.flatten(FLATTEN)).collect();
            points.windows(2).for_each(|pair| self.stroke(pair[0], pair[1], radius, owner));
            return;
        };
        let (from, to) = if arc.sweep() > 0.0 { (arc.start, arc.end) } else { (arc.end, arc.start) };
        let sector = (!whole).then(|| [from, to].map(|end| unit(Spot::from(end) - center)));
        let ends = if whole { [NONE; 2] } else { [from, to].map(|end| self.disc(end, radius, owner)) };
        let outer = Form::Circle { center, radius: reach + half, hollow: false, sector };
        let outer = self.push(outer, owner, ends);
        let inner = Form::Circle { center, radius: reach - half, hollow: true, sector };
        let inner = (reach > half).then(|| self.push(inner, owner, ends));
        self.bodies.push(Body::Band(outer, inner));
    }

    /// The centre and radius of an arc that meets both its ends; none where the radii differ too
    /// much.
    fn centred(&self, arc: &Arc) -> Option<(Spot, f64)> {
        let [a, b, center] = [arc.start, arc.end, arc.center].map(Spot::from);
        if arc.start == arc.end {
            return Some((center, arc.radius()));
        }
        if arc.drift() > DRIFT {
            return None;
        }
        let (moved, radius) = between(a, b, center);
        ((moved - center).length() <= DRIFT).then_some((moved, radius))
    }

    /// Whether two generators have the same foot and normal where one ends on the other.
    pub(super) fn are_joined(&self, a: u32, b: u32) -> bool {
        self.ends[a as usize].contains(&b) || self.ends[b as usize].contains(&a)
    }

    /// Where an edge of a ring begins, and where the one before it ends.
    pub(super) fn start_of(&self, edge: u32) -> Spot {
        let form = &self.forms[edge as usize];
        match *form {
            Form::Line { from, .. } => from,
            Form::Circle { center, hollow, .. } => {
                let corner = self.ends[edge as usize][usize::from(hollow)];
                match self.forms.get(corner as usize) {
                    Some(Form::Circle { center, .. }) => *center,
                    Some(Form::Line { .. }) | None => center,
                }
            }
        }
    }

    /// What goes on at the ends of a generator.
    pub(super) fn ends_of(&self, a: u32) -> [Option<u32>; 2] {
        self.ends[a as usize].map(|end| (end != NONE).then_some(end))
    }
}

/// The centre nearest to `center` that is as far from `a` as from `b`, and how far: its foot on the
/// perpendicular bisector of the chord.
fn between(a: Spot, b: Spot, center: Spot) -> (Spot, f64) {
    let along = unit(b - a);
    let moved = center - along * (center - a.midpoint(b)).dot(along);
    (moved, f64::midpoint((a - moved).length(), (b - moved).length()))
}

/// Twice the signed area of the triangle.
fn cross(a: Point, b: Point, c: Point) -> i128 {
    let (u, v) = (b - a, c - b);
    i128::from(u.x.get()) * i128::from(v.y.get()) - i128::from(u.y.get()) * i128::from(v.x.get())
}

/// Whether a ring turns back on itself at `b`.
fn is_back(a: Point, b: Point, c: Point) -> bool {
    let (u, v) = (b - a, c - b);
    i128::from(u.x.get()) * i128::from(v.x.get()) + i128::from(u.y.get()) * i128::from(v.y.get()) < 0
}

/// Whether all of a ring lies on one line, but for rounding.
fn is_flat(ring: &[Point]) -> bool {
    let Some(&far) = ring.iter().max_by_key(|p| (**p - ring[0]).length_squared()) else { return true };
    ring.iter().all(|&p| Spot::from(p).distance_to_chord(ring[0].into(), far.into()) <= ROUNDING)
}

/// A ring without repeated points and without those that say nothing: on straight edges, or off
/// them by no more than `rounding` nanometres.
fn simple(mut points: Vec<Point>, rounding: f64) -> Vec<Point> {
    points.dedup();
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    let n = points.len();
    let is_corner = |i: usize| {
        let (a, b, c) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
        is_back(a, b, c) || Spot::from(b).distance_to_chord(a.into(), c.into()) > rounding
    };
    let Some(first) = (0..n).find(|&i| is_corner(i)).filter(|_| n > 3) else { return points };
    points.rotate_left(first);
    let mut kept = vec![points[0]];
    let mut last = 0;
    for next in 1..=n {
        // As far on as what lies between says nothing.
        let end = points[(next + 1) % n];
        let from = points[last];
        let is_straight = next < n
            && next - last < LONGEST_RUN
            && !is_back(from, points[next], end)
            && points[last + 1..=next]
                .iter()
                .all(|&p| Spot::from(p).distance_to_chord(from.into(), end.into()) <= rounding);
        if !is_straight && next < n {
            kept.push(points[next]);
            last = next;
        }
    }
    if kept.len() > 2 { kept } else { points }
}
