//! Letters of texts, which wait for the copper round them.

use super::curve::line;
use super::ring::Drawing;
use crate::board::{FLATTEN, Feature, Side};
use crate::geometry::{Nm, Point, Rect, distance_to_segment, orientation};

/// How near a letter may come to other copper: the least clearance that KiCad starts a board with.
pub(super) const CLEAR: Nm = Nm::from_um(200);

/// A letter that waits for the copper round it.
#[derive(Clone, Debug)]
pub(super) struct Letter {
    pub(super) side: Side,
    pub(super) strokes: Vec<Vec<Point>>,
    pub(super) pen: Nm,
    pub(super) bounds: Rect,
    pub(super) line: u32,
    /// Where the text stands in the file, and what it says.
    pub(super) place: std::ops::Range<usize>,
    pub(super) of: String,
}

impl Letter {
    /// Whether it comes too near to `feature`.
    pub(super) fn is_near(&self, feature: &Feature) -> bool {
        let window = self.bounds.inflate(CLEAR);
        if !feature.shape.bounds().touches(window) {
            return false;
        }
        let Some(polygon) = feature.shape.polygon(FLATTEN) else { return false };
        let reach = (self.pen / 2 + CLEAR).to_f64();
        let edges: Vec<_> = polygon.edges().filter(|&(a, b)| Rect::new(a, b).touches(window)).collect();
        let near = |part| edges.iter().any(|&edge| are_within(part, edge, reach));
        self.strokes.iter().any(|stroke| polygon.contains(stroke[0]) || parts(stroke).any(near))
    }

    pub(super) fn drawing(&self) -> Drawing {
        self.strokes
            .iter()
            .flat_map(|stroke| parts(stroke))
            .map(|(from, to)| line(from, to, self.pen / 2))
            .collect()
    }
}

/// The lines of a stroke; a dot is one without length.
fn parts(stroke: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    let ends = if stroke.len() > 1 { &stroke[1..] } else { stroke };
    stroke.iter().copied().zip(ends.iter().copied())
}

/// Whether two segments come nearer to each other than `reach`.
fn are_within((a, b): (Point, Point), (c, d): (Point, Point), reach: f64) -> bool {
    let parted = |from, to, p, q| orientation(from, to, p) != orientation(from, to, q);
    let near = |p: Point, from: Point, to: Point| distance_to_segment(p, (from, to)) < reach;
    near(a, c, d)
        || near(b, c, d)
        || near(c, a, b)
        || near(d, a, b)
        || (parted(a, b, c, d) && parted(c, d, a, b))
}
