//! A path in the making: places in nanometres, not rounded, become lines and arcs.
//!
//! Formats have cubic curves where a circle was drawn. A cubic that lies on a circle within what
//! the usual approximation leaves becomes that arc, and what goes on round the same middle becomes
//! one with it; any other becomes chords.

use crate::board::FLATTEN;
use crate::geometry::{Nm, Path, Point, Segment, Turn, between};

/// A place in nanometres.
pub(in crate::import) type Place = (f64, f64);

/// How far a cubic may leave the circle that it stands for, as a part of the radius, in nanometres
/// at most, and for what rounding to 32-bit floats does. A quarter of a circle is drawn 0.000273 of
/// its radius off.
const CIRCULAR: (f64, f64, f64) = (0.0003, 5_000.0, 30.0);

/// Arcs go on round one middle where their own are no farther from each other, in nanometres, nor
/// differ their radii more. Chosen: three places in 32-bit floats leave so much.
const TOGETHER: f64 = 60.0;

/// An arc turns by no more, in radians, or all the way. Chosen: of more its ends are too near to
/// each other.
const LONGEST: f64 = 5.95;

/// The most chords of one curve. Chosen: finer than any tolerance asks for.
const MOST_CHORDS: f64 = 65_536.0;

/// A connected path that grows.
#[derive(Clone, Debug)]
pub(in crate::import) struct Contour {
    path: Path,
    at: Place,
    first: Place,
    /// The arc that it ends with, where that was a curve.
    bow: Option<Bow>,
    is_beyond: bool,
}

/// An arc that curves stand for.
#[derive(Clone, Copy, Debug)]
struct Bow {
    start: Place,
    /// The middle of all curves' middles, and how many they are.
    center: Place,
    count: f64,
    turn: Turn,
    radius: f64,
    /// How far it turns, in radians.
    swept: f64,
}

impl Bow {
    /// Round `center` by less than half a turn.
    fn new(start: Place, center: Place, turn: Turn, to: Place) -> Self {
        let (u, v) = ((start.0 - center.0, start.1 - center.1), (to.0 - center.0, to.1 - center.1));
        let swept = libm::atan2((u.0 * v.1 - u.1 * v.0).abs(), u.0 * v.0 + u.1 * v.1);
        Self { start, center, count: 1.0, turn, radius: libm::hypot(u.0, u.1), swept }
    }

    /// Both as one, where `next` goes on round the same middle to `to`; and whether that is all the
    /// way round.
    fn with(&self, next: &Self, to: Place) -> Option<(Self, bool)> {
        let is_near = |a: Place, b: Place| libm::hypot(a.0 - b.0, a.1 - b.1) <= TOGETHER;
        let goes_on = self.turn == next.turn
            && is_near(self.center, next.center)
            && (self.radius - next.radius).abs() <= TOGETHER;
        let swept = self.swept + next.swept;
        let is_whole = swept > LONGEST && is_near(self.start, to);
        let count = self.count + 1.0;
        let joined = Self { center: between(self.center, next.center, 1.0 / count), count, swept, ..*self };
        (goes_on && (is_whole || swept <= LONGEST)).then_some((joined, is_whole))
    }
}

impl Contour {
    /// One that begins at `start`.
    pub(in crate::import) fn new(start: Place) -> Self {
        let path = Path { start: Point::default(), segments: Vec::new() };
        let mut contour = Self { path, at: start, first: start, bow: None, is_beyond: false };
        contour.path.start = contour.point(start);
        contour
    }

    /// Where it is.
    pub(in crate::import) const fn at(&self) -> Place {
        self.at
    }

    /// Straight on.
    pub(in crate::import) fn line(&mut self, to: Place) {
        let end = self.point(to);
        self.at = to;
        if end != self.path.end() {
            self.bow = None;
            self.path.segments.push(Segment::Line { to: end });
        }
    }

    /// Round `center` by less than a turn: what is shorter than a nanometre is none.
    pub(in crate::import) fn arc(&mut self, center: Place, turn: Turn, to: Place) {
        let end = self.point(to);
        if end == self.path.end() {
            self.at = to;
        } else {
            self.round(center, turn, to);
        }
    }

    /// All the way round `center`.
    pub(in crate::import) fn circle(&mut self, center: Place, turn: Turn) {
        self.round(center, turn, self.at);
    }

    fn round(&mut self, center: Place, turn: Turn, to: Place) {
        let (end, center) = (self.point(to), self.point(center));
        (self.at, self.bow) = (to, None);
        self.path.segments.push(Segment::Arc { to: end, center, turn });
    }

    /// A Bézier curve of the second degree.
    pub(in crate::import) fn quadratic(&mut self, control: Place, to: Place) {
        let third = |end: Place| between(end, control, 2.0 / 3.0);
        self.cubic(third(self.at), third(to), to);
    }

    /// A Bézier curve of the third degree.
    pub(in crate::import) fn cubic(&mut self, a: Place, b: Place, to: Place) {
        // What leaves the range of coordinates is no path: no need to follow it.
        self.point(to);
        if self.is_beyond {
            return;
        }
        let ends = [self.at, a, b, to];
        if let Some((center, turn)) = circle(ends) {
            self.bend(center, turn, to);
            return;
        }
        // Wang's bound on the distance between a curve and its chords.
        let bend = |p: Place, q: Place, r: Place| libm::hypot(p.0 - 2.0 * q.0 + r.0, p.1 - 2.0 * q.1 + r.1);
        let most = bend(ends[0], a, b).max(bend(a, b, to));
        let chords = (0.75 * most / FLATTEN.to_f64()).sqrt().ceil().clamp(1.0, MOST_CHORDS);
        let mut step = 1.0;
        while step < chords {
            self.line(on_curve(ends, step / chords));
            step += 1.0;
        }
        self.line(to);
    }

    /// Round `center` by less than half a turn, in one arc with what it goes on from.
    fn bend(&mut self, center: Place, turn: Turn, to: Place) {
        let next = Bow::new(self.at, center, turn, to);
        if self.point(to) == self.path.end() {
            self.at = to;
            return;
        }
        let Some((joined, is_whole)) = self.bow.and_then(|bow| bow.with(&next, to)) else {
            self.round(center, turn, to);
            self.bow = Some(next);
            return;
        };
        self.path.segments.pop();
        self.round(joined.center, turn, if is_whole { joined.start } else { to });
        self.bow = (!is_whole).then_some(joined);
    }

    /// Straight back to where it began.
    pub(in crate::import) fn close(&mut self) {
        let first = self.first;
        self.line(first);
    }

    /// The path; none where it leaves the range of coordinates.
    pub(in crate::import) fn finish(mut self) -> Option<Path> {
        self.path.segments.shrink_to_fit();
        (!self.is_beyond).then_some(self.path)
    }

    fn point(&mut self, (x, y): Place) -> Point {
        let most = Nm::MAX.to_f64();
        // Not a number is beyond, too.
        if !(x.abs() <= most && y.abs() <= most) {
            self.is_beyond = true;
            return Point::default();
        }
        Point::from_f64(x, y)
    }
}

/// A point of a cubic, by de Casteljau.
fn on_curve([p, q, r, s]: [Place; 4], part: f64) -> Place {
    let (a, b, c) = (between(p, q, part), between(q, r, part), between(r, s, part));
    between(between(a, b, part), between(b, c, part), part)
}

/// The middle of the circle that a cubic runs along, and the way round; none where it does not.
fn circle(ends: [Place; 4]) -> Option<(Place, Turn)> {
    let (start, middle, end) = (ends[0], on_curve(ends, 0.5), ends[3]);
    let (center, twice) = through(start, middle, end)?;
    let radius = libm::hypot(start.0 - center.0, start.1 - center.1);
    if radius > Nm::MAX.to_f64() / 4.0 {
        return None;
    }
    let most = (radius * CIRCULAR.0).min(CIRCULAR.1) + CIRCULAR.2;
    let leaves = |part: f64| {
        let p = on_curve(ends, part);
        (libm::hypot(p.0 - center.0, p.1 - center.1) - radius).abs() > most
    };
    // Beyond half a turn three points do not tell the way round.
    let chord = libm::hypot(end.0 - start.0, end.1 - start.1);
    let bow = libm::hypot(middle.0 - f64::midpoint(start.0, end.0), middle.1 - f64::midpoint(start.1, end.1));
    if bow > chord * 0.45 || [0.08, 0.2, 0.35, 0.65, 0.8, 0.92].into_iter().any(leaves) {
        return None;
    }
    Some((center, if twice > 0.0 { Turn::CounterClockwise } else { Turn::Clockwise }))
}

/// The middle of the circle through three points, and twice their signed area.
pub(in crate::import) fn through(a: Place, b: Place, c: Place) -> Option<(Place, f64)> {
    let (bx, by, cx, cy) = (b.0 - a.0, b.1 - a.1, c.0 - a.0, c.1 - a.1);
    let twice = bx * cy - by * cx;
    let (bb, cc) = (bx * bx + by * by, cx * cx + cy * cy);
    let x = (cy * bb - by * cc) / (2.0 * twice);
    let y = (bx * cc - cx * bb) / (2.0 * twice);
    (x.is_finite() && y.is_finite()).then_some(((a.0 + x, a.1 + y), twice))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::off_segment;

    #[test]
    fn four_cubics_of_a_circle_are_the_circle() {
        const K: f64 = 0.552_284_749_830_793_6;
        let r = 5e6;
        let mut contour = Contour::new((r, 0.0));
        contour.cubic((r, K * r), (K * r, r), (0.0, r));
        contour.cubic((-K * r, r), (-r, K * r), (-r, 0.0));
        contour.cubic((-r, -K * r), (-K * r, -r), (0.0, -r));
        contour.cubic((K * r, -r), (r, -K * r), (r, 0.0));
        let path = contour.finish().expect("in range");
        let to = path.start;
        let circle = Segment::Arc { to, center: Point::default(), turn: Turn::CounterClockwise };
        assert_eq!(path.segments, [circle], "one circle");
        assert!((path.length() - std::f64::consts::TAU * r).abs() < 20.0, "{}", path.length());
    }

    #[test]
    fn curves_that_go_on_round_one_middle_are_one_arc() {
        const K: f64 = 0.552_284_749_830_793_6;
        let (r, turn) = (5e6, Turn::CounterClockwise);
        // Off by what 32-bit floats leave.
        let half = |second: f64| {
            let mut contour = Contour::new((r, 0.0));
            contour.cubic((r + 8.0, K * r), (K * r, r - 8.0), (0.0, r));
            contour.cubic((-K * second, second), (-second, K * second), (-second, 0.0));
            contour.line((-second, -r));
            contour.finish().expect("in range").segments
        };
        let down = |x: f64| Segment::Line { to: Point::from_f64(x, -r) };
        let [arc, line] = half(r)[..] else { panic!("one arc and a line") };
        let Segment::Arc { to, center, turn: round } = arc else { panic!("an arc") };
        assert_eq!((to, round, line), (Point::from_f64(-r, 0.0), turn, down(-r)));
        assert!(center.distance(Point::default()) < 20.0, "round the middle of both: {center:?}");
        assert_eq!(half(r + 1_000.0).len(), 3, "a micrometre smaller, the other is another");
    }

    #[test]
    fn any_other_cubic_is_followed_within_the_tolerance() {
        let ends = [(0.0, 0.0), (0.0, 8e6), (10e6, 8e6), (10e6, -2e6)];
        let mut contour = Contour::new(ends[0]);
        contour.cubic(ends[1], ends[2], ends[3]);
        let points = contour.finish().expect("in range").flatten(FLATTEN);
        assert!(points.len() > 50, "chords: {}", points.len());
        for step in 0..1000_u32 {
            let p = on_curve(ends, f64::from(step) / 1000.0);
            let off = |pair: &[Point]| {
                let (a, b) = (pair[0].to_f64(), pair[1].to_f64());
                let (x, y) = off_segment(p, a, b);
                libm::hypot(x, y)
            };
            let nearest = points.windows(2).map(off).fold(f64::INFINITY, f64::min);
            assert!(nearest < 252.0, "{p:?} is {nearest} nm off");
        }
    }

    #[test]
    fn what_lies_beyond_the_range_is_no_path() {
        let mut contour = Contour::new((0.0, 0.0));
        contour.line((2e9, 0.0));
        assert_eq!(contour.finish(), None, "two metres");
        assert_eq!(Contour::new((f64::NAN, 0.0)).finish(), None, "no number");
        let mut contour = Contour::new((0.0, 0.0));
        contour.cubic((0.0, 1e30), (1e30, 1e30), (1e30, 0.0));
        assert_eq!((contour.path.segments.len(), contour.finish()), (0, None), "nor is it followed");
    }
}
