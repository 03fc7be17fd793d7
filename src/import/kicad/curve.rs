//! Lines, arcs through three points and Bézier curves: the axes of what is drawn.

use std::f64::consts::PI;

use crate::board::{Axis, FLATTEN, Shape};
use crate::geometry::{Arc, Nm, Orientation, Point, Turn, orientation};

/// The axis of a stroke.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Curve {
    Line(Point, Point),
    Arc(Arc),
    /// A curve of another kind, as lines within [`FLATTEN`] of it.
    Chain(Vec<Point>),
}

impl Curve {
    /// The arc from `start` through `mid` to `end`: a line where they are in one, a full circle
    /// where it ends where it starts.
    pub(super) fn through(start: Point, mid: Point, end: Point) -> Self {
        if start == end && start != mid {
            let center = start.midpoint(mid);
            return Self::Arc(Arc { start, end, center, turn: Turn::CounterClockwise });
        }
        let turn = match orientation(start, mid, end) {
            Orientation::Left => Turn::CounterClockwise,
            Orientation::Right => Turn::Clockwise,
            Orientation::Straight => return Self::Chain(vec![start, mid, end]),
        };
        let (x, y) = center(start, mid, end);
        let in_range = |value: f64| value.abs() < Nm::MAX.to_f64();
        if in_range(x) && in_range(y) {
            Self::Arc(Arc { start, end, center: Point::from_f64(x, y), turn })
        } else {
            Self::Chain(flat_arc(start, end, (x, y), turn))
        }
    }

    /// The arc round `center` from `start` on, over `degrees` with the clock.
    pub(super) fn round(center: Point, start: Point, degrees: f64) -> Self {
        let turn = if degrees < 0.0 { Turn::CounterClockwise } else { Turn::Clockwise };
        let (sin, cos) = super::frame::sincos(-degrees);
        let (way, (x, y)) = (start - center, center.to_f64());
        let (dx, dy) = (way.x.to_f64(), way.y.to_f64());
        let end = if degrees.abs() >= 360.0 {
            start
        } else {
            Point::from_f64(x + dx * cos - dy * sin, y + dx * sin + dy * cos)
        };
        if (end == start && degrees.abs() < 180.0) || start == center {
            return Self::Line(start, end);
        }
        Self::Arc(Arc { start, end, center, turn })
    }

    /// The cubic Bézier curve with these control points.
    pub(super) fn bezier(points: [Point; 4]) -> Self {
        /// Chosen: beyond what any drawing needs for 250 nm.
        const MOST: u32 = 4096;
        let [a, b, c, d] = points.map(Point::to_f64);
        // A curve leaves its chord by at most an eighth of its second derivative times the step
        // squared; the derivative is six times the larger second difference.
        let second = |p: (f64, f64), q: (f64, f64), r: (f64, f64)| {
            let (x, y) = (p.0 - 2.0 * q.0 + r.0, p.1 - 2.0 * q.1 + r.1);
            (x * x + y * y).sqrt()
        };
        let steps = (0.75 * second(a, b, c).max(second(b, c, d)) / FLATTEN.to_f64()).sqrt().ceil();
        let steps = (1..=MOST).find(|&count| f64::from(count) >= steps).unwrap_or(MOST);
        let at = |step: u32| {
            let t = f64::from(step) / f64::from(steps);
            let s = 1.0 - t;
            let blend = |a: f64, b: f64, c: f64, d: f64| {
                a * s * s * s + 3.0 * b * s * s * t + 3.0 * c * s * t * t + d * t * t * t
            };
            Point::from_f64(blend(a.0, b.0, c.0, d.0), blend(a.1, b.1, c.1, d.1))
        };
        Self::Chain((0..=steps).map(at).collect())
    }

    /// Its points but the first, within [`FLATTEN`].
    pub(super) fn flatten(&self) -> Vec<Point> {
        match self {
            Self::Line(_, to) => vec![*to],
            Self::Arc(arc) => arc.flatten(FLATTEN).collect(),
            Self::Chain(points) => points[1..].to_vec(),
        }
    }

    /// Where it starts.
    pub(super) fn start(&self) -> Point {
        match self {
            Self::Line(from, _) => *from,
            Self::Arc(arc) => arc.start,
            Self::Chain(points) => points[0],
        }
    }

    /// What a pen of `width` leaves that is drawn along it.
    pub(super) fn drawn(&self, width: Nm) -> Vec<(Shape, Axis)> {
        let radius = width / 2;
        match self {
            Self::Line(from, to) => vec![line(*from, *to, radius)],
            Self::Arc(arc) => vec![(Shape::Arc { arc: *arc, radius }, Axis::Arc(*arc))],
            Self::Chain(points) => points.windows(2).map(|pair| line(pair[0], pair[1], radius)).collect(),
        }
    }
}

/// What a round pen leaves along a line, which may have no length.
pub(super) fn line(from: Point, to: Point, radius: Nm) -> (Shape, Axis) {
    let shape =
        if from == to { Shape::Disc { center: from, radius } } else { Shape::Stroke { from, to, radius } };
    (shape, Axis::Line(from, to))
}

/// The point as far from all three, which are not in one line.
fn center(a: Point, b: Point, c: Point) -> (f64, f64) {
    let ((x, y), p, q) = (a.to_f64(), b - a, c - a);
    let ((px, py), (qx, qy)) = ((p.x.to_f64(), p.y.to_f64()), (q.x.to_f64(), q.y.to_f64()));
    let twice = 2.0 * (px * qy - py * qx);
    let (p2, q2) = (px * px + py * py, qx * qx + qy * qy);
    (x + (qy * p2 - py * q2) / twice, y + (px * q2 - qx * p2) / twice)
}

/// An arc round a centre so far away that it is no coordinate: lines within [`FLATTEN`].
fn flat_arc(start: Point, end: Point, (x, y): (f64, f64), turn: Turn) -> Vec<Point> {
    /// The most lines of an arc. Chosen: as for other curves.
    const MOST: u32 = 65_536;
    let way = |p: Point| (p.to_f64().0 - x, p.to_f64().1 - y);
    let ((ax, ay), (bx, by)) = (way(start), way(end));
    let radius = (ax * ax + ay * ay).sqrt();
    let sweep = match (libm::atan2(ax * by - ay * bx, ax * bx + ay * by), turn) {
        (sweep, Turn::CounterClockwise) if sweep < 0.0 => sweep + 2.0 * PI,
        (sweep, Turn::Clockwise) if sweep > 0.0 => sweep - 2.0 * PI,
        (sweep, _) => sweep,
    };
    let step = 2.0 * libm::acos(1.0 - (FLATTEN.to_f64() / radius).min(0.5));
    let steps = (1..=MOST).find(|&count| f64::from(count) * step >= sweep.abs()).unwrap_or(MOST);
    let between = (1..steps).map(|i| {
        let (sin, cos) = libm::sincos(sweep * f64::from(i) / f64::from(steps));
        Point::from_f64(x + ax * cos - ay * sin, y + ax * sin + ay * cos)
    });
    std::iter::once(start).chain(between).chain([end]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn three_points_make_an_arc() {
        let Curve::Arc(arc) = Curve::through(at(1000, 0), at(0, 1000), at(-1000, 0)) else {
            panic!("an arc");
        };
        assert_eq!((arc.center, arc.turn), (at(0, 0), Turn::CounterClockwise), "over the top");
        let Curve::Arc(circle) = Curve::through(at(1000, 0), at(-1000, 0), at(1000, 0)) else {
            panic!("a circle");
        };
        assert_eq!((circle.center, circle.start), (at(0, 0), circle.end), "all round");
        let straight = Curve::through(at(0, 0), at(5, 0), at(10, 0));
        assert_eq!(straight, Curve::Chain(vec![at(0, 0), at(5, 0), at(10, 0)]), "in one line");
    }

    #[test]
    fn an_arc_that_is_almost_straight_still_bends() {
        // 200 mm long and 1 mm high: its radius is 5 m.
        let Curve::Chain(points) = Curve::through(at(0, 0), at(100_000, 1_000), at(200_000, 0)) else {
            panic!("its centre is out of range");
        };
        let top = points.iter().map(|p| p.y).max().expect("points");
        assert!((top - Nm::from_mm(1)).abs() <= FLATTEN, "the top at {top}");
        assert_eq!((points[0], points[points.len() - 1]), (at(0, 0), at(200_000, 0)), "both ends");
    }

    #[test]
    fn old_arcs_turn_with_the_clock() {
        let Curve::Arc(arc) = Curve::round(at(0, 0), at(1000, 0), 90.0) else { panic!("an arc") };
        assert_eq!((arc.end, arc.turn), (at(0, -1000), Turn::Clockwise), "a quarter down");
    }

    #[test]
    fn a_curve_keeps_to_its_control_points() {
        let curve = Curve::bezier([at(0, 0), at(0, 1000), at(1000, 1000), at(1000, 0)]);
        let points = curve.flatten();
        assert_eq!(points.last(), Some(&at(1000, 0)), "it ends where it should");
        let top = points.iter().map(|p| p.y).max().expect("points");
        assert!((top - Nm::from_um(750)).abs() <= FLATTEN, "three quarters of the height: {top}");
    }
}
