//! Floating positions and distances, in nanometres: what places points between pixels. They never
//! decide what meets what.

use std::ops::{Add, Mul, Sub};

use crate::geometry;
use crate::geometry::{Point, Rect, Segment, Turn};

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

/// The box of a rectangle.
pub(super) fn sides(rect: Rect) -> [f64; 4] {
    spanned(rect.min().into(), rect.max().into())
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

/// A line or an arc.
#[derive(Clone, Copy, Debug)]
pub(super) enum Span {
    Line([Spot; 2]),
    /// Counter-clockwise from one end to the other; a full circle where they are the same.
    Arc {
        center: Spot,
        radius: f64,
        ends: [Spot; 2],
    },
}

impl Span {
    /// The segment of a path that begins at `from`.
    pub(super) fn new(from: Point, segment: &Segment) -> Self {
        let Some(arc) = segment.arc(from) else { return Self::Line([from, segment.to()].map(Spot::from)) };
        let ends = match arc.turn {
            Turn::CounterClockwise => [arc.start, arc.end],
            Turn::Clockwise => [arc.end, arc.start],
        };
        Self::Arc { center: arc.center.into(), radius: arc.radius(), ends: ends.map(Spot::from) }
    }

    /// The point of it nearest to `p`.
    pub(super) fn foot(&self, p: Spot) -> Spot {
        match *self {
            Self::Line([a, b]) => nearest_on_chord(p, a, b),
            Self::Arc { center, radius, ends } if p != center && is_beside(center, ends, p) => {
                let way = p - center;
                center + way * (radius / way.length())
            }
            Self::Arc { ends: [a, b], .. } => {
                let (to_a, to_b) = (p - a, p - b);
                if to_a.dot(to_a) <= to_b.dot(to_b) { a } else { b }
            }
        }
    }

    /// The distance from `p` to it, ends included.
    pub(super) fn distance(&self, p: Spot) -> f64 {
        match *self {
            Self::Arc { center, radius, ends } if is_beside(center, ends, p) => {
                ((p - center).length() - radius).abs()
            }
            Self::Line(_) | Self::Arc { .. } => (p - self.foot(p)).length(),
        }
    }
}

/// Whether `p` lies in the sector between the ends of an arc, seen from its centre.
fn is_beside(center: Spot, [from, to]: [Spot; 2], p: Spot) -> bool {
    let (way, a, b) = (p - center, from - center, to - center);
    let is_wide = a.cross(b) < 0.0 || (a.cross(b) <= 0.0 && a.dot(b) < 0.0 && a.cross(way) < 0.0);
    let is_within = if is_wide {
        !(b.cross(way) > 0.0 && way.cross(a) > 0.0)
    } else {
        a.cross(way) >= 0.0 && way.cross(b) >= 0.0
    };
    from == to || is_within
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;
    use crate::topology::random;

    #[test]
    fn a_span_is_as_far_away_as_the_nearest_of_its_places() {
        let mut below = random();
        for seed in 0..300 {
            let mut place = || Point::new(Nm::new(below(2_000_000)), Nm::new(below(2_000_000)));
            let [from, center, other, p] = [(); 4].map(|()| place());
            let turn = if seed % 2 == 0 { Turn::Clockwise } else { Turn::CounterClockwise };
            // Half a turn, some part of one, and a whole one.
            let opposite = Point::new(center.x * 2 - from.x, center.y * 2 - from.y);
            let toward = [opposite, other, from][seed % 3];
            let way = Spot::from(toward) - center.into();
            let to = Spot::from(center) + way * (center.distance(from) / way.length().max(1.0));
            let (to, p) = (to.rounded(), Spot::from(p));
            for segment in [Segment::Line { to }, Segment::Arc { to, center, turn }] {
                let span = Span::new(from, &segment);
                let place = |part: f64| match segment.arc(from) {
                    Some(arc) => Spot::new(arc.at(part).0, arc.at(part).1),
                    None => Spot::from(from) + (Spot::from(to) - from.into()) * part,
                };
                let places = (0..=4000).map(|i| place(f64::from(i) / 4000.0));
                let nearest = places.map(|q| (p - q).length()).fold(f64::INFINITY, f64::min);
                let (distance, foot) = (span.distance(p), (p - span.foot(p)).length());
                assert!((distance - foot).abs() < 1.0, "{seed}: {distance} is not {foot}");
                assert!((distance - nearest).abs() < 2_000.0, "{seed}: {distance} is not {nearest}");
            }
        }
    }
}
