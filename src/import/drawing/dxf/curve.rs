//! The curves of DXF as lines and arcs: arcs, bulges, ellipses, splines.

use std::f64::consts::{PI, TAU};

use super::frame::Frame;
use crate::board::FLATTEN;
use crate::geometry::Turn;
use crate::import::drawing::{Contour, Place};

/// The most chords of one curve. Chosen: finer than any tolerance asks for.
const MOST_CHORDS: f64 = 65_536.0;

/// A turned ellipse, or a circle, or a part of either, counter-clockwise in its own frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ellipse {
    pub(super) center: Place,
    /// From the centre to where the angle is zero, and to where it is a right one.
    pub(super) axes: (Place, Place),
    /// The angle at the start, and how far it goes: negative clockwise.
    pub(super) from: f64,
    pub(super) sweep: f64,
}

impl Ellipse {
    /// A part of a circle; the whole where both angles, in radians, are the same.
    pub(super) fn arc(center: Place, radius: f64, from: f64, to: f64) -> Self {
        Self { center, axes: ((radius, 0.0), (0.0, radius)), from, sweep: ahead(from, to) }
    }

    fn at(&self, angle: f64) -> Place {
        let (sin, cos) = libm::sincos(angle);
        let ((ax, ay), (bx, by)) = self.axes;
        (self.center.0 + ax * cos + bx * sin, self.center.1 + ay * cos + by * sin)
    }

    pub(super) fn start(&self) -> Place {
        self.at(self.from)
    }

    fn end(&self) -> Place {
        self.at(self.from + self.sweep)
    }

    /// The same from its end.
    pub(super) fn reversed(self) -> Self {
        Self { from: self.from + self.sweep, sweep: -self.sweep, ..self }
    }

    /// Follows it in `contour`, which is at its start.
    pub(super) fn follow(&self, frame: &Frame, contour: &mut Contour) {
        let ((ax, ay), (bx, by)) = self.axes;
        let (a, b) = (libm::hypot(ax, ay), libm::hypot(bx, by));
        let is_circle = (a - b).abs() <= a.max(b) * 1e-9 && (ax * bx + ay * by).abs() <= a * b * 1e-9;
        let is_left = ax * by - ay * bx >= 0.0;
        if is_circle && frame.similar().is_some() {
            let turn = if (self.sweep > 0.0) == is_left { frame.turn() } else { frame.turn().reversed() };
            round(contour, frame.place(self.center), turn, self.sweep, frame.place(self.end()));
            return;
        }
        let radius = a.max(b) * frame.largest();
        let step = 2.0 * libm::acos(1.0 - (FLATTEN.to_f64() / radius.max(1.0)).min(0.5));
        let chords = (self.sweep.abs() / step).ceil().clamp(4.0, MOST_CHORDS);
        let mut count = 1.0;
        while count <= chords {
            contour.line(frame.place(self.at(self.from + self.sweep * count / chords)));
            count += 1.0;
        }
    }
}

/// Round `center` to a place: all the way where that is the beginning, to a nanometre.
fn round(contour: &mut Contour, center: Place, turn: Turn, sweep: f64, to: Place) {
    let at = contour.at();
    let is_back = libm::hypot(to.0 - at.0, to.1 - at.1) < 1.0;
    if sweep.abs() > PI && is_back { contour.circle(center, turn) } else { contour.arc(center, turn, to) }
}

/// How far from one angle to the next, counter-clockwise, in radians; all the way round where they
/// are the same.
pub(super) fn ahead(from: f64, to: f64) -> f64 {
    let turns = (to - from) / TAU;
    let part = turns - turns.floor();
    if part <= 1e-12 || part >= 1.0 - 1e-12 { TAU } else { part * TAU }
}

/// A step of a polyline from where `contour` is: straight, or an arc of which a quarter has the
/// tangent `bulge`.
pub(super) fn bulge(frame: &Frame, contour: &mut Contour, from: Place, to: Place, bulge: f64) {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let chord = libm::hypot(dx, dy);
    if bulge.abs() < 1e-9 || chord <= 0.0 {
        contour.line(frame.place(to));
        return;
    }
    // From the middle of the chord to that of the circle, to the left of the way for a positive
    // bulge below one.
    let off = (1.0 - bulge * bulge) / (4.0 * bulge);
    let center = (f64::midpoint(from.0, to.0) - dy * off, f64::midpoint(from.1, to.1) + dx * off);
    let radius = libm::hypot(from.0 - center.0, from.1 - center.1);
    let start = libm::atan2(from.1 - center.1, from.0 - center.0);
    let sweep = 4.0 * libm::atan(bulge);
    if frame.similar().is_some() {
        let turn = if bulge > 0.0 { frame.turn() } else { frame.turn().reversed() };
        round(contour, frame.place(center), turn, sweep, frame.place(to));
        return;
    }
    Ellipse { center, axes: ((radius, 0.0), (0.0, radius)), from: start, sweep }.follow(frame, contour);
}

/// A spline by its control points.
#[derive(Clone, Debug)]
pub(super) struct Spline {
    pub(super) degree: usize,
    pub(super) knots: Vec<f64>,
    pub(super) controls: Vec<Place>,
    /// As many as controls, or none.
    pub(super) weights: Vec<f64>,
}

impl Spline {
    /// Whether its numbers fit each other.
    pub(super) fn is_sound(&self) -> bool {
        let (degree, count) = (self.degree, self.controls.len());
        (1..=11).contains(&degree)
            && count > degree
            && self.knots.len() == count + degree + 1
            && self.knots.windows(2).all(|pair| pair[0] <= pair[1])
            && self.knots[degree] < self.knots[count]
            && (self.weights.is_empty() || self.weights.len() == count)
            && self.weights.iter().all(|&weight| weight > 0.0)
    }

    /// The curve through `points`: cubic, its parameter as long as the chords, with no curvature at
    /// its ends.
    pub(super) fn through(points: &[Place]) -> Vec<[Place; 4]> {
        let lengths: Vec<f64> =
            points.windows(2).map(|p| libm::hypot(p[1].0 - p[0].0, p[1].1 - p[0].1).max(1e-12)).collect();
        let tangents = tangents(points, &lengths);
        let piece = |at: usize| {
            let (p, q, third) = (points[at], points[at + 1], lengths[at] / 3.0);
            let (u, v) = (tangents[at], tangents[at + 1]);
            [p, (p.0 + u.0 * third, p.1 + u.1 * third), (q.0 - v.0 * third, q.1 - v.1 * third), q]
        };
        (0..lengths.len()).map(piece).collect()
    }

    /// The point at `t`, by de Boor's algorithm with weights.
    pub(super) fn at(&self, t: f64) -> Place {
        let (degree, count) = (self.degree, self.controls.len());
        // The last knot that is no more than `t`.
        let span = degree + self.knots[degree..count].partition_point(|&knot| knot <= t).saturating_sub(1);
        let weight = |at: usize| self.weights.get(at).copied().unwrap_or(1.0);
        let mut points: Vec<(f64, f64, f64)> = (span - degree..=span)
            .map(|at| {
                let (w, p) = (weight(at), self.controls[at]);
                (p.0 * w, p.1 * w, w)
            })
            .collect();
        for round in 1..=degree {
            for at in (round..=degree).rev() {
                let left = self.knots[span - degree + at];
                let right = self.knots[span + 1 + at - round];
                let part = if right > left { (t - left) / (right - left) } else { 0.0 };
                let (p, q) = (points[at - 1], points[at]);
                let mix = |p: f64, q: f64| p + (q - p) * part;
                points[at] = (mix(p.0, q.0), mix(p.1, q.1), mix(p.2, q.2));
            }
        }
        let (x, y, w) = points[degree];
        (x / w, y / w)
    }

    pub(super) fn start(&self) -> Place {
        self.at(self.knots[self.degree])
    }

    /// Follows it in `contour`, which is at its start: between knots by chords, halved until their
    /// middles are near enough.
    pub(super) fn follow(&self, frame: &Frame, contour: &mut Contour) {
        let mut knots = self.knots[self.degree..=self.controls.len()].to_vec();
        knots.dedup();
        for pair in knots.windows(2) {
            let mut parts = vec![(pair[1], 0_u32)];
            let mut from = pair[0];
            while let Some((to, depth)) = parts.pop() {
                let place = |part: f64| frame.place(self.at(from + (to - from) * part));
                let (a, b) = (frame.place(self.at(from)), place(1.0));
                let leaves = |part: f64| {
                    let (p, q) = (place(part), (a.0 + (b.0 - a.0) * part, a.1 + (b.1 - a.1) * part));
                    libm::hypot(p.0 - q.0, p.1 - q.1) > FLATTEN.to_f64()
                };
                // The first halvings see to bends that three places would miss.
                if depth < 2 || (depth < 14 && [0.25, 0.5, 0.75].into_iter().any(leaves)) {
                    parts.push((to, depth + 1));
                    parts.push((f64::midpoint(from, to), depth + 1));
                    continue;
                }
                contour.line(b);
                from = to;
            }
        }
    }
}

/// The tangents at the points of a natural cubic spline: a tridiagonal system, solved from the
/// front (Thomas).
fn tangents(points: &[Place], lengths: &[f64]) -> Vec<Place> {
    let last = points.len() - 1;
    let slope = |at: usize| {
        let (p, q) = (points[at], points[at + 1]);
        ((q.0 - p.0) / lengths[at], (q.1 - p.1) / lengths[at])
    };
    let mut solved: Vec<(f64, Place)> = Vec::with_capacity(points.len());
    for at in 0..=last {
        let (below, middle, above, right) = if at == 0 {
            let s = slope(0);
            (0.0, 2.0, 1.0, (3.0 * s.0, 3.0 * s.1))
        } else if at == last {
            let s = slope(last - 1);
            (1.0, 2.0, 0.0, (3.0 * s.0, 3.0 * s.1))
        } else {
            let (h, k) = (lengths[at - 1], lengths[at]);
            let (s, t) = (slope(at - 1), slope(at));
            (k, 2.0 * (h + k), h, (3.0 * (k * s.0 + h * t.0), 3.0 * (k * s.1 + h * t.1)))
        };
        let (ratio, before) = solved.last().copied().unwrap_or((0.0, (0.0, 0.0)));
        let pivot = middle - below * ratio;
        let value = ((right.0 - below * before.0) / pivot, (right.1 - below * before.1) / pivot);
        solved.push((above / pivot, value));
    }
    let mut tangents = vec![(0.0, 0.0); points.len()];
    let mut after = (0.0, 0.0);
    for at in (0..=last).rev() {
        let (ratio, value) = solved[at];
        after = (value.0 - ratio * after.0, value.1 - ratio * after.1);
        tangents[at] = after;
    }
    tangents
}

/// The way round of a closed ring of places.
pub(super) fn turn(ring: &[Place]) -> Turn {
    let twice: f64 = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum();
    if twice < 0.0 { Turn::Clockwise } else { Turn::CounterClockwise }
}

/// Degrees as radians.
pub(super) fn radians(degrees: f64) -> f64 {
    degrees * PI / 180.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rational_quadratic_is_a_quarter_of_a_circle() {
        let spline = Spline {
            degree: 2,
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            controls: vec![(10.0, 0.0), (10.0, 10.0), (0.0, 10.0)],
            weights: vec![1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0],
        };
        assert!(spline.is_sound(), "three controls of degree two");
        for step in 0..=10_u32 {
            let (x, y) = spline.at(f64::from(step) / 10.0);
            assert!((libm::hypot(x, y) - 10.0).abs() < 1e-12, "{x}, {y} is on the circle");
        }
    }

    #[test]
    fn a_curve_through_points_of_a_line_is_that_line() {
        let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 6.0), (4.0, 8.0)];
        for piece in Spline::through(&points) {
            for (x, y) in piece {
                assert!((y - 2.0 * x).abs() < 1e-9, "{x}, {y} is on it");
            }
        }
    }

    #[test]
    fn a_bulge_of_one_is_half_a_circle() {
        let frame = Frame::scale(1e6);
        let mut contour = Contour::new((0.0, 0.0));
        bulge(&frame, &mut contour, (0.0, 0.0), (4.0, 0.0), 1.0);
        let path = contour.finish().expect("in range");
        let bounds = path.bounds();
        assert!((bounds.min().y.to_mm() + 2.0).abs() < 1e-5, "below, to the right of the way: {bounds:?}");
        assert!(bounds.max().y.to_mm() < 1e-5, "and nothing above");
    }
}
