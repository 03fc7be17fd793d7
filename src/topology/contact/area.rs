//! Contact with an area: does anything touch a polygon's inside or edge, decided in integers.

use crate::geometry::{Edges, Nm, Point, Polygon, Rect};

use super::near;
use super::nearest::{self, Way};

/// A polygon with its edges by place, or a chain of edges, which has no inside.
#[derive(Debug)]
pub(in crate::topology) struct Area {
    edges: Edges,
    /// A point of each contour.
    contours: Vec<Point>,
    is_chain: bool,
}

impl Area {
    pub(super) fn new(polygon: &Polygon) -> Self {
        let contours = polygon.contours().iter().map(|ring| ring[0]).collect();
        Self { edges: Edges::new(polygon), contours, is_chain: false }
    }

    /// The edges from each of some points to the next.
    pub(super) fn chain(points: Vec<Point>) -> Self {
        let contours = points[..1].to_vec();
        Self { edges: Edges::chain(points), contours, is_chain: true }
    }

    /// A point of each contour.
    pub(super) fn corners(&self) -> &[Point] {
        &self.contours
    }

    /// Whether `found` is true of any edge whose rectangle shares a point with `window`.
    pub(in crate::topology) fn any_edge(
        &self,
        window: Rect,
        found: impl FnMut((Point, Point)) -> bool,
    ) -> bool {
        self.edges.any(window, found)
    }

    /// Whether `p` lies inside or on an edge, by the non-zero rule.
    pub(in crate::topology) fn contains(&self, p: Point) -> bool {
        !self.is_chain && self.edges.winding(p) != Some(0)
    }

    /// The same of a place within `radius` of an edge, too.
    pub(super) fn holds(&self, p: Point, radius: Nm) -> bool {
        let near = |edge| near::point_segment(p, edge, radius.get());
        self.contains(p) || radius > Nm::ZERO && self.any_edge(Rect::new(p, p).inflate(radius), near)
    }

    /// Whether the two areas are no farther apart than `gap`: edges are, or a contour of one lies
    /// in the other.
    pub(super) fn is_within(&self, other: &Self, gap: Nm) -> bool {
        let (few, many) = if self.edges.len() < other.edges.len() { (self, other) } else { (other, self) };
        few.any_edge(many.edges.bounds().inflate(gap), |edge| {
            let near = Rect::new(edge.0, edge.1).inflate(gap);
            many.any_edge(near, |other| near::segments(edge, other, gap.get()))
        }) || few.contours.iter().any(|&p| many.contains(p))
            || many.contours.iter().any(|&p| few.contains(p))
    }

    /// The shortest way from a segment to the edges that reach into `window`.
    pub(super) fn way_from(&self, from: (Point, Point), window: Rect) -> Option<Way> {
        let mut best: Option<Way> = None;
        self.any_edge(window, |edge| {
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
