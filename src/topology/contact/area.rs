//! Contact with an area: does anything touch a polygon's inside or edge, decided in integers.

use std::ops::ControlFlow;

use crate::geometry::{Nm, Orientation, Point, Polygon, Rect, RectIndex, orientation};

use super::near;
use super::nearest::{self, Way};

/// From how many edges on they are indexed.
///
/// Chosen: a pad is asked about its few neighbours only, and looking at all of its edges takes no
/// longer than filling an index; a plane is asked about everything in its clearings.
const INDEX_FROM: usize = 256;

/// A polygon with its edges by place.
#[derive(Debug)]
pub(in crate::topology) struct Area {
    edges: Vec<(Point, Point)>,
    /// A point of each contour.
    contours: Vec<Point>,
    bounds: Rect,
    /// Of the edges; none where looking at all of them is as fast.
    index: Option<RectIndex>,
}

/// Memory that questions about areas reuse.
#[derive(Debug, Default)]
pub(in crate::topology) struct Scratch {
    pub(super) edges: Vec<usize>,
    pub(super) facing: Vec<usize>,
}

impl Area {
    pub(super) fn new(polygon: &Polygon) -> Self {
        let mut edges = Vec::with_capacity(polygon.contours().iter().map(Vec::len).sum());
        for ring in polygon.contours() {
            let mut from = ring[ring.len() - 1];
            for &to in ring {
                edges.push((from, to));
                from = to;
            }
        }
        let index = (edges.len() >= INDEX_FROM)
            .then(|| RectIndex::new(edges.iter().map(|&(from, to)| Rect::new(from, to))));
        let contours = polygon.contours().iter().map(|ring| ring[0]).collect();
        Self { edges, contours, bounds: polygon.bounds(), index }
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
        mut found: impl FnMut((Point, Point)) -> bool,
    ) -> bool {
        let Some(index) = &self.index else {
            let mut near = self.edges.iter().filter(|(a, b)| Rect::new(*a, *b).touches(window));
            return near.any(|&edge| found(edge));
        };
        let visit = |edge: usize| {
            if found(self.edges[edge]) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        index.visit(window, stack, visit).is_break()
    }

    /// Whether `p` lies inside or on an edge, by the non-zero rule: counts the edges that a ray to
    /// the right crosses.
    pub(in crate::topology) fn contains(&self, p: Point, scratch: &mut Scratch) -> bool {
        if !self.bounds.contains(p) {
            return false;
        }
        let ray = Rect::new(p, Point::new(self.bounds.max().x, p.y));
        let mut winding = 0;
        let on_edge = self.any_edge(ray, &mut scratch.edges, |(a, b)| {
            let side = orientation(a, b, p);
            if a.y <= p.y && b.y > p.y && side == Orientation::Left {
                winding += 1;
            } else if a.y > p.y && b.y <= p.y && side == Orientation::Right {
                winding -= 1;
            }
            side == Orientation::Straight && Rect::new(a, b).contains(p)
        });
        on_edge || winding != 0
    }

    /// Whether the two areas are no farther apart than `gap`: edges are, or a contour of one lies
    /// in the other.
    pub(super) fn is_within(&self, other: &Self, gap: Nm, scratch: &mut Scratch) -> bool {
        let (few, many) = if self.edges.len() < other.edges.len() { (self, other) } else { (other, self) };
        let Scratch { edges, facing } = scratch;
        few.any_edge(many.bounds.inflate(gap), edges, |edge| {
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
