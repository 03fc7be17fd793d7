//! Circular arcs between whole nanometres: turn, radius, flattening to a tolerance.

use std::f64::consts::PI;

use super::{Nm, Point, Rect};

/// The way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Turn {
    /// G02, with the clock.
    Clockwise,
    /// G03, against the clock.
    CounterClockwise,
}

impl Turn {
    /// The other way round.
    #[must_use]
    pub const fn reversed(self) -> Self {
        match self {
            Self::Clockwise => Self::CounterClockwise,
            Self::CounterClockwise => Self::Clockwise,
        }
    }
}

/// A circle, as a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Circle {
    /// The point in its middle.
    pub center: Point,
    /// How far it is from there.
    pub radius: Nm,
}

impl Circle {
    /// A rectangle that holds it.
    #[must_use]
    pub fn bounds(self) -> Rect {
        Rect::new(self.center, self.center).inflate(self.radius)
    }
}

/// A circular arc from `start` round `center` to `end`; a full circle where `start` and `end` are
/// the same point.
///
/// The three points are whole nanometres, so the two radii may differ by a rounding (and, in sloppy
/// files, by more): in between, the radius goes over evenly from one to the other, and both ends
/// are met exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Arc {
    /// Where it begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
    /// The point it runs round.
    pub center: Point,
    /// Which way.
    pub turn: Turn,
}

impl Arc {
    /// The distance from the centre to the start, in nanometres.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.center.distance(self.start)
    }

    /// How much its two radii differ, in nanometres: what rounding three points leaves, and in
    /// sloppy files more.
    #[must_use]
    pub fn drift(&self) -> f64 {
        (self.radius() - self.center.distance(self.end)).abs()
    }

    /// The circle that it is a part of, to a nanometre; none where its two radii differ by more.
    #[must_use]
    pub fn circle(&self) -> Option<Circle> {
        let radius = f64::midpoint(self.radius(), self.center.distance(self.end));
        (self.drift() <= 1.0).then(|| Circle { center: self.center, radius: Nm::from_f64(radius) })
    }

    /// The angle from +x to the start, in radians within −π..=π.
    #[must_use]
    pub fn start_angle(&self) -> f64 {
        angle(self.center, self.start)
    }

    /// The angle swept, in radians: positive counter-clockwise, never zero, ±2π for a full circle.
    #[must_use]
    pub fn sweep(&self) -> f64 {
        if self.start == self.end {
            return match self.turn {
                Turn::Clockwise => -2.0 * PI,
                Turn::CounterClockwise => 2.0 * PI,
            };
        }
        let difference = angle(self.center, self.end) - angle(self.center, self.start);
        match self.turn {
            Turn::CounterClockwise if difference <= 0.0 => difference + 2.0 * PI,
            Turn::Clockwise if difference >= 0.0 => difference - 2.0 * PI,
            _ => difference,
        }
    }

    /// The length along the arc, in nanometres.
    #[must_use]
    pub fn length(&self) -> f64 {
        f64::midpoint(self.radius(), self.center.distance(self.end)) * self.sweep().abs()
    }

    /// The point at `fraction` (0 at the start, 1 at the end) of the way round, in nanometres, not
    /// rounded.
    #[must_use]
    pub fn at(&self, fraction: f64) -> (f64, f64) {
        self.course()(fraction)
    }

    /// The same, rounded.
    pub(crate) fn point(&self, fraction: f64) -> Point {
        let (x, y) = self.at(fraction);
        Point::from_f64(x, y)
    }

    /// The ends of so many equal parts of the way round: [`Arc::at`] of 1/count, 2/count, …, 1.
    pub(crate) fn divided(&self, count: u32) -> impl Iterator<Item = (f64, f64)> + use<> {
        let at = self.course();
        (1..=count).map(move |i| at(f64::from(i) / f64::from(count)))
    }

    /// The same, rounded, but for the last, which is its end; of one part at least.
    pub(crate) fn parts(&self, count: u32) -> impl Iterator<Item = Point> + use<> {
        let within = self.divided(count).take(count.saturating_sub(1) as usize);
        within.map(|(x, y)| Point::from_f64(x, y)).chain([self.end])
    }

    /// [`Arc::at`], for many places.
    fn course(&self) -> impl Fn(f64) -> (f64, f64) + use<> {
        let (from, to) = (self.radius(), self.center.distance(self.end));
        let (start, sweep) = (self.start_angle(), self.sweep());
        let (x, y) = self.center.to_f64();
        move |fraction| {
            let radius = from + (to - from) * fraction;
            let (sin, cos) = libm::sincos(start + sweep * fraction);
            (x + radius * cos, y + radius * sin)
        }
    }

    /// The same arc walked from its end.
    #[must_use]
    pub const fn reversed(&self) -> Self {
        Self { start: self.end, end: self.start, center: self.center, turn: self.turn.reversed() }
    }

    /// How many equal chords stay within `tolerance` of the arc; at least 1, and 3 for a full
    /// circle.
    ///
    /// A chord over the angle φ leaves a circle of radius r by r (1 − cos φ/2).
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
    pub fn chords(&self, tolerance: Nm) -> usize {
        let radius = self.radius().max(1.0);
        let ratio = (tolerance.to_f64().max(1.0) / radius).min(0.5);
        let step = 2.0 * libm::acos(1.0 - ratio);
        let least = if self.start == self.end { 3 } else { 1 };
        ((self.sweep().abs() / step).ceil() as usize).clamp(least, 1 << 16)
    }

    /// The end points of chords within `tolerance` of the arc, without the start and with the exact
    /// end.
    pub fn flatten(&self, tolerance: Nm) -> impl Iterator<Item = Point> + use<> {
        self.parts(u32::try_from(self.chords(tolerance)).expect("at most 2¹⁶ chords"))
    }

    /// A rectangle that holds the arc; whole nanometres, rounded outwards.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        let mut bounds = Rect::new(self.start, self.end);
        let reach = self.radius().max(self.center.distance(self.end));
        let (start, sweep) = (self.start_angle(), self.sweep());
        for (quarter, (dx, dy)) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].into_iter().enumerate()
        {
            let angle = f64::from(u8::try_from(quarter).unwrap_or(0)) * PI / 2.0;
            let ahead = if sweep > 0.0 { angle - start } else { start - angle };
            let ahead = ahead - (ahead / (2.0 * PI)).floor() * 2.0 * PI;
            if ahead <= sweep.abs() {
                let (x, y) = self.center.to_f64();
                let extreme = Point::from_f64(x + dx * reach, y + dy * reach);
                bounds = bounds.union(Rect::new(extreme, extreme).inflate(Nm::new(1)));
            }
        }
        bounds
    }
}

/// The angle from +x to the way from `center` to `p`, in radians.
fn angle(center: Point, p: Point) -> f64 {
    let way = p - center;
    libm::atan2(way.y.to_f64(), way.x.to_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn a_full_circle_comes_back_to_its_start() {
        let circle =
            Arc { start: at(1000, 0), end: at(1000, 0), center: at(0, 0), turn: Turn::CounterClockwise };
        let points: Vec<_> = circle.flatten(Nm::from_um(1)).collect();
        assert_eq!(points.last(), Some(&at(1000, 0)), "closed");
        assert!((circle.length() - 2.0 * PI * 1e6).abs() < 1e-3, "length {}", circle.length());
        for pair in points.windows(2) {
            let middle = pair[0].midpoint(pair[1]);
            let sagitta = 1e6 - at(0, 0).distance(middle);
            assert!(sagitta <= 1002.0, "chord leaves the circle by {sagitta} nm");
        }
    }

    #[test]
    fn the_turn_decides_the_sweep() {
        let quarter =
            Arc { start: at(1000, 0), end: at(0, 1000), center: at(0, 0), turn: Turn::CounterClockwise };
        assert!((quarter.sweep() - PI / 2.0).abs() < 1e-12, "a quarter against the clock");
        let rest = Arc { turn: Turn::Clockwise, ..quarter };
        assert!((rest.sweep() + 1.5 * PI).abs() < 1e-12, "three quarters with it");
    }

    #[test]
    fn bounds_hold_the_extremes() {
        let half =
            Arc { start: at(1000, 0), end: at(-1000, 0), center: at(0, 0), turn: Turn::CounterClockwise };
        assert!(half.bounds().contains(at(0, 1000)), "the top belongs to the upper half");
        assert!(!half.bounds().contains(at(0, -500)), "the bottom does not");
    }
}
