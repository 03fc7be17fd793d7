//! Regions (G36/G37, specification §4.10): areas given by their outline.

use std::ops::Range;

use crate::board::FLATTEN;
use crate::board::polarity::{self, FillRule};
use crate::geometry::{Arc, Circle, Point, Polygon, twice_area};

use super::sink::Ink;

/// The contour being drawn.
#[derive(Debug, Default)]
pub(super) struct Region {
    points: Vec<Point>,
    /// What arcs of it are parts of.
    circles: Vec<Circle>,
    /// What it began with, which counts for all of it.
    ink: Ink,
    /// Where it began.
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
    /// The area in mm² that it winds round, and round again.
    pub(super) doubtful: f64,
    /// What it began with.
    pub(super) ink: Ink,
    pub(super) place: Range<usize>,
}

impl Region {
    /// Begins the contour at `from`, unless it has begun.
    pub(super) fn begin(&mut self, from: Point, ink: Ink, place: &Range<usize>) {
        if self.points.is_empty() {
            self.points.push(from);
            (self.ink, self.place) = (ink, place.clone());
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
        let (mut pieces, mut doubtful) = (Vec::new(), 0.0);
        if points.len() > 2 && !tangled {
            let contour = [points];
            pieces = polarity::clean(&contour);
            doubtful = twice_wound(&contour, &pieces);
        }
        let pieces = polarity::of_circles(pieces, circles);
        Some(Contour { pieces, closed, tangled, doubtful, ink: self.ink, place: self.place.clone() })
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

/// The area in mm² that a contour winds round an even number of times, but not none: programs that
/// fill what is inside an odd number of times leave it out. `pieces` is what it fills here.
fn twice_wound(contour: &[Vec<Point>; 1], pieces: &[Polygon]) -> f64 {
    let filled: i128 = pieces.iter().map(Polygon::twice_area).sum();
    // Of one that winds round all once, cut-ins included, its own area says as much.
    if twice_area(&contour[0]).abs() == filled {
        return 0.0;
    }
    let area = |pieces: &[Polygon]| pieces.iter().map(Polygon::area_mm2).sum::<f64>();
    area(pieces) - area(&polarity::filled(contour, FillRule::EvenOdd))
}
