//! Points and vectors in nanometres, with exact products.

use std::ops::{Add, Neg, Sub};

use super::Nm;

/// A place on the board, in nanometres; x to the right, y up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Point {
    /// To the right.
    pub x: Nm,
    /// Up.
    pub y: Nm,
}

/// The way from one [`Point`] to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Vector {
    /// To the right.
    pub x: Nm,
    /// Up.
    pub y: Nm,
}

impl Point {
    /// The point (`x`, `y`).
    #[must_use]
    pub const fn new(x: Nm, y: Nm) -> Self {
        Self { x, y }
    }

    /// The point at `x`, `y` nanometres, rounded to whole ones.
    #[must_use]
    pub fn from_f64(x: f64, y: f64) -> Self {
        Self { x: Nm::from_f64(x), y: Nm::from_f64(y) }
    }

    /// Both coordinates as floats, in nanometres; exact.
    #[must_use]
    pub const fn to_f64(self) -> (f64, f64) {
        (self.x.to_f64(), self.y.to_f64())
    }

    /// The distance to `other` in nanometres, correctly rounded steps only.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        (other - self).length()
    }

    /// The point at a share of the way to `other`, 0 here and 1 there, rounded.
    #[must_use]
    pub fn toward(self, other: Self, share: f64) -> Self {
        self + (other - self).scaled(share)
    }

    /// The point halfway to `other`, rounded towards this one.
    #[must_use]
    pub fn midpoint(self, other: Self) -> Self {
        let half = other - self;
        self + Vector::new(half.x / 2, half.y / 2)
    }
}

impl Vector {
    /// The vector (`x`, `y`).
    #[must_use]
    pub const fn new(x: Nm, y: Nm) -> Self {
        Self { x, y }
    }

    /// So many times as long, rounded.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self::new(Nm::from_f64(self.x.to_f64() * factor), Nm::from_f64(self.y.to_f64() * factor))
    }

    /// The dot product in nm²; exact for differences of coordinates in range.
    #[must_use]
    pub const fn dot(self, other: Self) -> i64 {
        self.x.get() * other.x.get() + self.y.get() * other.y.get()
    }

    /// The cross product in nm²: positive where `other` lies counter-clockwise of this; exact as
    /// [`Vector::dot`].
    #[must_use]
    pub const fn cross(self, other: Self) -> i64 {
        self.x.get() * other.y.get() - self.y.get() * other.x.get()
    }

    /// The squared length in nm²; exact.
    #[must_use]
    pub const fn length_squared(self) -> i64 {
        self.dot(self)
    }

    /// The length in nanometres.
    #[must_use]
    pub fn length(self) -> f64 {
        let (x, y) = (self.x.to_f64(), self.y.to_f64());
        (x * x + y * y).sqrt()
    }

    /// A quarter turn counter-clockwise.
    #[must_use]
    pub fn perpendicular(self) -> Self {
        Self { x: -self.y, y: self.x }
    }
}

impl Sub for Point {
    type Output = Vector;
    fn sub(self, other: Self) -> Vector {
        Vector { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Add<Vector> for Point {
    type Output = Self;
    fn add(self, way: Vector) -> Self {
        Self { x: self.x + way.x, y: self.y + way.y }
    }
}

impl Sub<Vector> for Point {
    type Output = Self;
    fn sub(self, way: Vector) -> Self {
        Self { x: self.x - way.x, y: self.y - way.y }
    }
}

impl Add for Vector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Neg for Vector {
    type Output = Self;
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

/// On which side of a directed line a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// To the left: the turn is counter-clockwise.
    Left,
    /// On the line.
    Straight,
    /// To the right: the turn is clockwise.
    Right,
}

/// On which side of the line from `a` to `b` the point `c` lies; exact.
#[must_use]
pub fn orientation(a: Point, b: Point, c: Point) -> Orientation {
    match (b - a).cross(c - a) {
        1.. => Orientation::Left,
        0 => Orientation::Straight,
        _ => Orientation::Right,
    }
}

/// Whether two segments cross between their ends; exact.
pub(crate) fn cross(one: (Point, Point), other: (Point, Point)) -> bool {
    let is_parted = |(a, b): (Point, Point), (c, d): (Point, Point)| {
        let sides = (orientation(a, b, c), orientation(a, b, d));
        matches!(sides, (Orientation::Left, Orientation::Right) | (Orientation::Right, Orientation::Left))
    };
    is_parted(one, other) && is_parted(other, one)
}

/// An upright rectangle, its edges included.
///
/// # Guarantees
///
/// `min` is not above or to the right of `max`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rect {
    min: Point,
    max: Point,
}

impl Rect {
    /// The smallest rectangle that holds `a` and `b`.
    #[must_use]
    pub fn new(a: Point, b: Point) -> Self {
        Self { min: Point::new(a.x.min(b.x), a.y.min(b.y)), max: Point::new(a.x.max(b.x), a.y.max(b.y)) }
    }

    /// The smallest rectangle that holds all `points`; none for no point.
    pub fn around(points: impl IntoIterator<Item = Point>) -> Option<Self> {
        points.into_iter().map(|p| Self::new(p, p)).reduce(Self::union)
    }

    /// The lower left corner.
    #[must_use]
    pub const fn min(self) -> Point {
        self.min
    }

    /// The upper right corner.
    #[must_use]
    pub const fn max(self) -> Point {
        self.max
    }

    /// The extent in x.
    #[must_use]
    pub fn width(self) -> Nm {
        self.max.x - self.min.x
    }

    /// The extent in y.
    #[must_use]
    pub fn height(self) -> Nm {
        self.max.y - self.min.y
    }

    /// The smallest rectangle that holds both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: Point::new(self.min.x.min(other.min.x), self.min.y.min(other.min.y)),
            max: Point::new(self.max.x.max(other.max.x), self.max.y.max(other.max.y)),
        }
    }

    /// Grown by `margin` on every side; a negative margin that would turn it inside out leaves its
    /// centre.
    #[must_use]
    pub fn inflate(self, margin: Nm) -> Self {
        let by = margin.max(-(self.width().min(self.height()) / 2));
        let way = Vector::new(by, by);
        Self { min: self.min - way, max: self.max + way }
    }

    /// Whether `p` lies inside or on an edge.
    #[must_use]
    pub fn contains(self, p: Point) -> bool {
        self.min.x <= p.x && p.x <= self.max.x && self.min.y <= p.y && p.y <= self.max.y
    }

    /// Whether all of `other` lies inside or on an edge.
    #[must_use]
    pub fn encloses(self, other: Self) -> bool {
        self.contains(other.min) && self.contains(other.max)
    }

    /// Whether the two share at least a point.
    #[must_use]
    pub fn touches(self, other: Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    /// What both have in common; none where they are apart.
    #[must_use]
    pub fn common(self, other: Self) -> Option<Self> {
        let min = Point::new(self.min.x.max(other.min.x), self.min.y.max(other.min.y));
        let max = Point::new(self.max.x.min(other.max.x), self.max.y.min(other.max.y));
        self.touches(other).then_some(Self { min, max })
    }

    /// Left, bottom, right, top, in nanometres.
    pub(crate) const fn to_f64(self) -> [f64; 4] {
        let ((left, bottom), (right, top)) = (self.min.to_f64(), self.max.to_f64());
        [left, bottom, right, top]
    }

    /// The four corners, counter-clockwise from the lower left.
    #[must_use]
    pub fn corners(self) -> [Point; 4] {
        [self.min, Point::new(self.max.x, self.min.y), self.max, Point::new(self.min.x, self.max.y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::new(x), Nm::new(y))
    }

    #[test]
    fn orientation_is_exact_at_the_ends_of_the_range() {
        let (low, high) = (Nm::MIN.get(), Nm::MAX.get());
        let (a, b) = (at(low, low), at(high, high));
        assert_eq!(
            orientation(a, b, at(0, 0)),
            Orientation::Straight,
            "the diagonal runs through the origin"
        );
        assert_eq!(orientation(a, b, at(0, 1)), Orientation::Left, "one nanometre above it");
        assert_eq!(orientation(a, b, at(1, 0)), Orientation::Right, "one nanometre below it");
    }

    #[test]
    fn a_rectangle_does_not_turn_inside_out() {
        let r = Rect::new(at(10, 4), at(0, 0)).inflate(Nm::new(-100));
        assert_eq!((r.width(), r.height()), (Nm::new(6), Nm::ZERO), "shrunk to its middle line");
    }
}
