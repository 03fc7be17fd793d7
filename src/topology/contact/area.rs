//! Contact with an area: does anything touch a polygon's inside or edge, decided in integers.

use crate::geometry::{Edges, Nm, Point, Polygon, Rect};

use super::near;
use super::nearest::{self, Way};

/// A polygon with its edges by place.
#[derive(Debug)]
pub(in crate::topology) struct Area {
    edges: Edges,
    /// A point of each contour.
    contours: Vec<Point>,
}

/// Memory that questions about areas reuse.
#[derive(Debug, Default)]
pub(in crate::topology) struct Scratch {
    pub(super) edges: Vec<usize>,
    pub(super) facing: Vec<usize>,
}

impl Area {
    pub(super) fn new(polygon: &Polygon) -> Self {
        let contours = polygon.contours().iter().map(|ring| ring[0]).collect();
        Self { edges: Edges::new(polygon), contours }
    }

    /// A point of each contour.
    pub(super) fn corners(&self) -> &[Point] {
        &self.contours
    }

    /// Whether `found` is true of any edge whose rectangle shares a point with `window`.
    pub(in crate::topology) fn any_edge(
        &self,
        window: Rect,
        stack: &mut Vec<usize>,
        found: impl FnMut((Point, Point)) -> bool,
    ) -> bool {
        self.edges.any(window, stack, found)
    }

    /// Whether `p` lies inside or on an edge, by the non-zero rule.
    pub(in crate::topology) fn contains(&self, p: Point, scratch: &mut Scratch) -> bool {
        self.edges.winding(p, &mut scratch.edges) != Some(0)
    }

    /// Whether the two areas are no farther apart than `gap`: edges are, or a contour of one lies
    /// in the other.
    pub(super) fn is_within(&self, other: &Self, gap: Nm, scratch: &mut Scratch) -> bool {
        let (few, many) = if self.edges.len() < other.edges.len() { (self, other) } else { (other, self) };
        let Scratch { edges, facing } = scratch;
        few.any_edge(many.edges.bounds().inflate(gap), edges, |edge| {
            let near = Rect::new(edge.0, edge.1).inflate(gap);
            many.any_edge(near, facing, |other| near::segments(edge, other, gap.get()))
        }) || few.contours.iter().any(|&p| many.contains(p, scratch))
            || many.contours.iter().any(|&p| few.contains(p, scratch))
    }

    /// The shortest way from a segment to the edges that reach into `window`.
    pub(super) fn way_from(&self, from: (Point, Point), window: Rect, stack: &mut Vec<usize>) -> Option<Way> {
        let mut best: Option<Way> = None;
        self.any_edge(window, stack, |edge| {
            let way = nearest::segments(from, edge);
            best = Some(best.map_or(way, |best| nearest::shortest(best, [way])));
            is_least(best)
        });
        best
    }
}

/// Whether no way is shorter: of equals the first counts, so that no other need be looked at.
pub(super) fn is_least(way: Option<Way>) -> bool {
    way.is_some_and(|way| way.length <= 0.0)
}
