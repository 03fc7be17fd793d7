//! Regions (G36/G37, specification §4.10): areas given by their outline.

use std::ops::Range;

use crate::board::FLATTEN;
use crate::board::polarity::{self, Polarity};
use crate::geometry::{Arc, Circle, Point, Polygon};

/// The contour being drawn.
#[derive(Debug, Default)]
pub(super) struct Region {
    points: Vec<Point>,
    /// What arcs of it are parts of.
    circles: Vec<Circle>,
    /// What it began with, which counts for all of it.
    polarity: Polarity,
    /// Where it began.
    line: u32,
    place: Range<usize>,
}

/// A finished contour.
pub(super) struct Contour {
    /// Its area, one polygon a connected piece; none where it has no area.
    pub(super) pieces: Vec<Polygon>,
    /// Whether it ended where it began.
    pub(super) closed: bool,
    /// Whether it crosses itself so often that its area cannot be worked out in reasonable time.
    pub(super) tangled: bool,
    pub(super) polarity: Polarity,
    /// The line on which it began.
    pub(super) line: u32,
    pub(super) place: Range<usize>,
}

impl Region {
    /// Begins the contour at `from`, unless it has begun.
    pub(super) fn begin(&mut self, from: Point, polarity: Polarity, line: u32, place: &Range<usize>) {
        if self.points.is_empty() {
            self.points.push(from);
            (self.polarity, self.line, self.place) = (polarity, line, place.clone());
        }
    }

    /// Draws the outline on.
    pub(super) fn line(&mut self, to: Point) {
        if self.points.last() != Some(&to) {
            self.points.push(to);
        }
    }

    /// Draws the outline on along an arc.
    pub(super) fn arc(&mut self, arc: Arc) {
        self.points.extend(arc.flatten(FLATTEN));
        self.circles.extend(arc.circle());
    }

    /// Ends the contour; none where none had begun.
    ///
    /// Cut-ins are resolved here: they become holes. A contour that touches or crosses itself,
    /// which the specification forbids, fills what it winds round.
    pub(super) fn finish(&mut self) -> Option<Contour> {
        let mut points = std::mem::take(&mut self.points);
        let circles = std::mem::take(&mut self.circles);
        let (first, last) = (*points.first()?, *points.last()?);
        let closed = points.len() == 1 || first == last;
        if closed {
            points.pop();
        }
        let tangled = polarity::is_tangled([&points].into_iter());
        let pieces = if points.len() < 3 || tangled { Vec::new() } else { polarity::clean(&[points]) };
        let pieces = polarity::of_circles(pieces, circles);
        let (polarity, line, place) = (self.polarity, self.line, self.place.clone());
        Some(Contour { pieces, closed, tangled, polarity, line, place })
    }

    /// Whether a contour has begun.
    pub(super) fn is_open(&self) -> bool {
        !self.points.is_empty()
    }

    /// Whether all points drawn so far satisfy `test`.
    pub(super) fn all(&self, test: impl Fn(Point) -> bool) -> bool {
        self.points.iter().copied().all(test)
    }
}
