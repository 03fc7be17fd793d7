//! Floating positions and distances, in nanometres: what places points between pixels. They never
//! decide what meets what.

use std::ops::{Add, Mul, Sub};

use crate::geometry;
use crate::geometry::Point;

/// A position or direction in the plane, in nanometres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spot {
    pub(super) x: f64,
    pub(super) y: f64,
}

impl Spot {
    pub(super) const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    pub(super) const fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    pub(super) const fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    pub(super) fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    pub(super) fn midpoint(self, other: Self) -> Self {
        (self + other) * 0.5
    }

    pub(super) fn rounded(self) -> Point {
        Point::from_f64(self.x, self.y)
    }

    /// The distance from this point to the chord from `a` to `b`, ends included.
    pub(super) fn distance_to_chord(self, a: Self, b: Self) -> f64 {
        (self - nearest_on_chord(self, a, b)).length()
    }
}

/// The box round two places: left, bottom, right, top.
pub(super) fn spanned(a: Spot, b: Spot) -> [f64; 4] {
    geometry::spanned((a.x, a.y), (b.x, b.y))
}

/// The point of the chord from `a` to `b` nearest to `p`.
pub(super) fn nearest_on_chord(p: Spot, a: Spot, b: Spot) -> Spot {
    let way = b - a;
    let along = (p - a).dot(way);
    let squared = way.dot(way);
    if along <= 0.0 || squared <= 0.0 {
        a
    } else if along >= squared {
        b
    } else {
        a + way * (along / squared)
    }
}

impl From<Point> for Spot {
    fn from(p: Point) -> Self {
        let (x, y) = p.to_f64();
        Self { x, y }
    }
}

impl Add for Spot {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for Spot {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Mul<f64> for Spot {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}
