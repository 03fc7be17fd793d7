//! G5, G5.1 and G5.2: curves, as chords.

use crate::gcode::read::block::Word;
use crate::gcode::read::error::ReadError;
use crate::gcode::read::expression::index;
use crate::gcode::read::frame::Plane;
use crate::gcode::read::listing::Way;
use crate::gcode::read::meaning::{Curve, Mode};
use crate::geometry::Nm;

use super::{Machine, Run};

/// A place in the plane, in nanometres.
type Spot = [f64; 2];

/// A control point with its weight.
#[derive(Clone, Copy, Debug)]
struct Control {
    at: Spot,
    weight: f64,
}

/// What curves remember from line to line.
#[derive(Clone, Debug, Default)]
pub(super) struct Curves {
    /// P and Q of the last G5.
    tangent: Option<Spot>,
    /// The control points of a G5.2 that G5.3 has not ended.
    points: Vec<Control>,
    /// Its order, one more than its degree.
    order: usize,
}

/// The order where no L gives it: LinuxCNC's.
const ORDER: usize = 3;
/// Control points of one curve. Chosen: more than anybody writes.
const POINTS: usize = 10_000;
/// How far a chord may leave a curve, in nanometres, and into how many chords a piece of it is
/// split at most. Chosen.
const SAGITTA: f64 = 1_000.0;
const MOST: u32 = 1024;

impl Machine {
    pub(super) fn curve(&mut self, run: Run<'_>, curve: Curve) -> Result<(), ReadError> {
        self.listing.is_indirect(run.line(), "a curve");
        if self.modal.plane != Plane::Xy {
            return Err(run.refuse("curves are supported only in the plane of the board (G17)"));
        }
        let from = [self.known(run, 0)?, self.known(run, 1)?].map(Nm::to_f64);
        let to = self.target(run)?;
        let (Some(x), Some(y)) = (to[0], to[1]) else {
            return Err(run.refuse("a curve to an unknown position: its zero is not given"));
        };
        let end = [x.to_f64(), y.to_f64()];
        let offset = |machine: &Self, letters: [char; 2], none: Option<Spot>| {
            let [a, b] = letters.map(|letter| run.block.get(letter));
            if a.is_none() && b.is_none() && none.is_some() {
                return Ok(none.unwrap_or_default());
            }
            let length = |word: Option<Word>| word.map_or(Ok(0), |word| machine.scaled(run, word));
            Ok::<Spot, ReadError>([Nm::new(length(a)?).to_f64(), Nm::new(length(b)?).to_f64()])
        };
        match curve {
            Curve::Nurbs => self.control(run, from, end),
            Curve::Quadratic => {
                let way = offset(self, ['I', 'J'], None)?;
                let middle = add(from, way);
                self.chords(run, end, |t| bezier(&[from, middle, end], t))
            }
            Curve::Cubic => {
                let mirrored = self.curves.tangent.map(|[p, q]| [-p, -q]);
                let (first, last) = (offset(self, ['I', 'J'], mirrored)?, offset(self, ['P', 'Q'], None)?);
                self.curves.tangent = Some(last);
                let points = [from, add(from, first), add(end, last), end];
                self.chords(run, end, |t| bezier(&points, t))
            }
        }
    }

    /// A control point of G5.2.
    fn control(&mut self, run: Run<'_>, from: Spot, to: Spot) -> Result<(), ReadError> {
        if self.curves.points.is_empty() {
            self.curves.order = ORDER;
            self.curves.points.push(Control { at: from, weight: 1.0 });
        }
        if let Some(word) = run.block.get('L') {
            let order = index(word.value).filter(|order| (2..=16).contains(order));
            self.curves.order =
                order.ok_or_else(|| run.error(word, "expected an order of the curve from 2 to 16"))? as usize;
        }
        let weight = run.block.get('P').map_or(1.0, |word| word.value);
        if weight <= 0.0 || self.curves.points.len() >= POINTS {
            return Err(run.refuse(format!("expected weights above zero, of {POINTS} points at most")));
        }
        self.curves.points.push(Control { at: to, weight });
        // The next point counts from here; the tool comes after.
        self.axes[0].at = Some(Nm::from_f64(to[0]));
        self.axes[1].at = Some(Nm::from_f64(to[1]));
        Ok(())
    }

    /// G5.3.
    pub(super) fn end_curve(&mut self, run: Run<'_>) -> Result<(), ReadError> {
        let points = std::mem::take(&mut self.curves.points);
        let order = self.curves.order;
        if points.len() < order.max(2) {
            return Err(run.refuse("expected as many points of G5.2 before it as the order of the curve"));
        }
        self.modal.mode = Mode::None;
        let knots = knots(points.len(), order);
        let start = points[0].at;
        self.axes[0].at = Some(Nm::from_f64(start[0]));
        self.axes[1].at = Some(Nm::from_f64(start[1]));
        for span in order - 1..points.len() {
            let (low, high) = (knots[span], knots[span + 1]);
            let at = |t: f64| spline(&points, &knots, order, span, low + (high - low) * t);
            self.chords(run, at(1.0), at)?;
        }
        Ok(())
    }

    /// A curve from 0 to 1, in as many chords as it takes.
    fn chords(&mut self, run: Run<'_>, end: Spot, at: impl Fn(f64) -> Spot) -> Result<(), ReadError> {
        let mut count = 8;
        while count < MOST && (0..count).any(|step| leaves(&at, f64::from(step), f64::from(count))) {
            count *= 2;
        }
        let z = self.axes[2].at;
        for step in 1..=count {
            let [x, y] = if step == count { end } else { at(f64::from(step) / f64::from(count)) };
            self.go(run, Way::Feed, [Some(Nm::from_f64(x)), Some(Nm::from_f64(y)), z])?;
        }
        Ok(())
    }
}

fn add(a: Spot, b: Spot) -> Spot {
    [a[0] + b[0], a[1] + b[1]]
}

fn between(a: Spot, b: Spot, t: f64) -> Spot {
    [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t]
}

/// Whether a curve leaves the chord of one of `count` steps.
fn leaves(at: &impl Fn(f64) -> Spot, step: f64, count: f64) -> bool {
    let middle = between(at(step / count), at((step + 1.0) / count), 0.5);
    let own = at((step + 0.5) / count);
    libm::hypot(own[0] - middle[0], own[1] - middle[1]) > SAGITTA
}

/// De Casteljau's.
fn bezier<const COUNT: usize>(points: &[Spot; COUNT], t: f64) -> Spot {
    let mut points = *points;
    for last in (1..COUNT).rev() {
        for index in 0..last {
            points[index] = between(points[index], points[index + 1], t);
        }
    }
    points[0]
}

/// The knots of a curve that begins and ends at its first and last points, all spans alike.
fn knots(points: usize, order: usize) -> Vec<f64> {
    let last = points - order + 1;
    let knot = |index: usize| u32::try_from((index + 1).saturating_sub(order).min(last)).unwrap_or(u32::MAX);
    (0..points + order).map(|index| f64::from(knot(index))).collect()
}

/// De Boor's, of points times their weights and the weights themselves.
fn spline(points: &[Control], knots: &[f64], order: usize, span: usize, u: f64) -> Spot {
    let first = span + 1 - order;
    let mut local: Vec<[f64; 3]> = points[first..=span]
        .iter()
        .map(|Control { at, weight }| [at[0] * weight, at[1] * weight, *weight])
        .collect();
    for level in 1..order {
        for index in (level..order).rev() {
            let (low, high) = (knots[first + index], knots[first + index + order - level]);
            let t = if high > low { (u - low) / (high - low) } else { 0.0 };
            let [before, own] = [local[index - 1], local[index]];
            local[index] = [0, 1, 2].map(|part| before[part] + (own[part] - before[part]) * t);
        }
    }
    let [x, y, weight] = local[order - 1];
    [x / weight, y / weight]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_circle_is_a_curve_with_weights() {
        let weight = 0.5_f64.sqrt();
        let at = |x: f64, y: f64, weight: f64| Control { at: [x, y], weight };
        let points = [at(1.0, 0.0, 1.0), at(1.0, 1.0, weight), at(0.0, 1.0, 1.0)];
        let knots = knots(3, 3);
        assert_eq!(knots, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], "clamped");
        for step in 0..=10 {
            let [x, y] = spline(&points, &knots, 3, 2, f64::from(step) / 10.0);
            assert!((libm::hypot(x, y) - 1.0).abs() < 1e-12, "step {step} lies on the circle");
        }
    }
}
