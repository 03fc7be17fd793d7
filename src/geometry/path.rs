//! Connected lines and arcs: what a stroke, a contour or a cut follows.

use super::{Arc, Circle, Nm, Point, Rect, Turn, Vector};

/// A step of a [`Path`], from where the one before it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Segment {
    /// Straight on.
    Line {
        /// Where it ends.
        to: Point,
    },
    /// Round a centre.
    Arc {
        /// Where it ends.
        to: Point,
        /// The point it runs round.
        center: Point,
        /// Which way.
        turn: Turn,
    },
}

impl Segment {
    /// Where it ends.
    #[must_use]
    pub const fn to(&self) -> Point {
        match *self {
            Self::Line { to } | Self::Arc { to, .. } => to,
        }
    }

    /// The length from `from`, in nanometres.
    #[must_use]
    pub fn length(&self, from: Point) -> f64 {
        match self.arc(from) {
            Some(arc) => arc.length(),
            None => from.distance(self.to()),
        }
    }

    /// The arc that this is when begun at `from`; none for a line.
    #[must_use]
    pub const fn arc(&self, from: Point) -> Option<Arc> {
        match *self {
            Self::Line { .. } => None,
            Self::Arc { to, center, turn } => Some(Arc { start: from, end: to, center, turn }),
        }
    }

    /// The point at a share of the way when begun at `from`, 0 there and 1 at its end, rounded.
    #[must_use]
    pub fn at(&self, from: Point, share: f64) -> Point {
        self.arc(from).map_or_else(|| from.toward(self.to(), share), |arc| arc.point(share))
    }

    /// The same with another end.
    #[must_use]
    pub const fn ending(self, to: Point) -> Self {
        match self {
            Self::Line { .. } => Self::Line { to },
            Self::Arc { center, turn, .. } => Self::Arc { to, center, turn },
        }
    }

    /// A rectangle that holds it when begun at `from`.
    #[must_use]
    pub fn bounds(&self, from: Point) -> Rect {
        self.arc(from).map_or_else(|| Rect::new(from, self.to()), |arc| arc.bounds())
    }
}

/// A connected way of lines and arcs.
///
/// Closed where its last segment ends at its start.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Path {
    /// Where it begins.
    pub start: Point,
    /// The steps, each from the end of the one before.
    pub segments: Vec<Segment>,
}

impl Path {
    /// The path of straight lines through `points`; none for no point.
    pub fn polyline(points: impl IntoIterator<Item = Point>) -> Option<Self> {
        let mut points = points.into_iter();
        let start = points.next()?;
        Some(Self { start, segments: points.map(|to| Segment::Line { to }).collect() })
    }

    /// A whole circle, from its rightmost point.
    #[must_use]
    pub fn circle(center: Point, radius: Nm, turn: Turn) -> Self {
        let start = center + Vector::new(radius, Nm::ZERO);
        Self { start, segments: vec![Segment::Arc { to: start, center, turn }] }
    }

    /// Where it ends.
    #[must_use]
    pub fn end(&self) -> Point {
        self.segments.last().map_or(self.start, Segment::to)
    }

    /// Moved by `way`.
    #[must_use]
    pub fn translated(&self, way: Vector) -> Self {
        let moved = |segment: &Segment| match *segment {
            Segment::Line { to } => Segment::Line { to: to + way },
            Segment::Arc { to, center, turn } => Segment::Arc { to: to + way, center: center + way, turn },
        };
        Self { start: self.start + way, segments: self.segments.iter().map(moved).collect() }
    }

    /// Whether it ends where it begins, having gone somewhere.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        !self.segments.is_empty() && self.end() == self.start
    }

    /// Its length in nanometres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.steps().map(|(from, segment)| segment.length(from)).sum()
    }

    /// Each segment with the point it begins at.
    pub fn steps(&self) -> impl Iterator<Item = (Point, &Segment)> {
        let starts = std::iter::once(self.start).chain(self.segments.iter().map(Segment::to));
        starts.zip(&self.segments)
    }

    /// The circles that its arcs are parts of.
    pub fn circles(&self) -> impl Iterator<Item = Circle> {
        self.steps().filter_map(|(from, segment)| segment.arc(from)?.circle())
    }

    /// The same path walked from its end.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let back = |(from, segment): (Point, &Segment)| match *segment {
            Segment::Line { .. } => Segment::Line { to: from },
            Segment::Arc { center, turn, .. } => Segment::Arc { to: from, center, turn: turn.reversed() },
        };
        let mut segments: Vec<_> = self.steps().map(back).collect();
        segments.reverse();
        Self { start: self.end(), segments }
    }

    /// The points of a polyline within `tolerance` of it, both ends included.
    #[must_use]
    pub fn flatten(&self, tolerance: Nm) -> Vec<Point> {
        let mut points = vec![self.start];
        for (from, segment) in self.steps() {
            match segment.arc(from) {
                Some(arc) => points.extend(arc.flatten(tolerance)),
                None => points.push(segment.to()),
            }
        }
        points
    }

    /// A rectangle that holds it.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        let start = Rect::new(self.start, self.start);
        self.steps().fold(start, |bounds, (from, segment)| bounds.union(segment.bounds(from)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn walking_back_and_back_again_changes_nothing() {
        let path = Path {
            start: at(0, 0),
            segments: vec![
                Segment::Line { to: at(1000, 0) },
                Segment::Arc { to: at(1000, 2000), center: at(1000, 1000), turn: Turn::CounterClockwise },
                Segment::Line { to: at(0, 0) },
            ],
        };
        assert!(path.is_closed(), "it ends where it began");
        assert_eq!(path.reversed().reversed(), path, "there and back");
        assert!((path.reversed().length() - path.length()).abs() < 1e-6, "the same length both ways");
        assert!(path.bounds().contains(at(2000, 1000)), "the arc bulges to the right");
    }
}
