//! The edges of a polygon, or of a chain, by place.

use std::ops::ControlFlow;

use bitvec::prelude::BitVec;

use super::polygon::winding_of;
use super::tree::BoxTree;
use super::{Point, Polygon, Rect};

/// From how many edges on they are indexed.
///
/// Chosen: a pad is asked about its few neighbours only, and looking at all of its edges takes no
/// longer than filling an index; a plane is asked about everything in its clearings.
const INDEX_FROM: usize = 256;

/// The edges of a polygon by place, or those of a chain of points.
#[derive(Debug)]
pub(crate) struct Edges {
    /// Ring after ring, each with its first point once more at its end.
    points: Vec<Point>,
    /// Which points are the last of a ring: there no edge begins, but one of no length.
    lasts: BitVec,
    bounds: Rect,
    /// Of the edges that begin at each point; none where looking at all of them is as fast.
    tree: Option<BoxTree>,
}

impl Edges {
    pub(crate) fn new(polygon: &Polygon) -> Self {
        let count = polygon.contours().iter().map(|ring| ring.len() + 1).sum();
        let mut points = Vec::with_capacity(count);
        let mut lasts = BitVec::repeat(false, count);
        for ring in polygon.contours() {
            points.extend(ring.iter().chain(ring.first()));
            lasts.set(points.len() - 1, true);
        }
        Self { points, lasts, bounds: polygon.bounds(), tree: None }.by_place()
    }

    /// The edges from each of some points to the next.
    pub(crate) fn chain(points: Vec<Point>) -> Self {
        let mut lasts = BitVec::repeat(false, points.len());
        lasts.set(points.len() - 1, true);
        let bounds = Rect::around(points.iter().copied()).expect("a point");
        Self { points, lasts, bounds, tree: None }.by_place()
    }

    fn by_place(mut self) -> Self {
        let ends = (0..self.len()).map(|at| self.edge(at));
        let boxes = ends.map(|(from, to)| Rect::new(from, to).to_f64());
        self.tree = (self.len() >= INDEX_FROM).then(|| BoxTree::new(boxes));
        self
    }

    fn edge(&self, at: usize) -> (Point, Point) {
        let from = self.points[at];
        (from, if self.lasts[at] { from } else { self.points[at + 1] })
    }

    /// How many there are, those of no length included.
    pub(crate) const fn len(&self) -> usize {
        self.points.len()
    }

    /// A rectangle that holds them.
    pub(crate) const fn bounds(&self) -> Rect {
        self.bounds
    }

    /// Whether `found` is true of any edge whose rectangle shares a point with `window`; it may be
    /// shown one of no length where a ring begins.
    pub(crate) fn any(&self, window: Rect, mut found: impl FnMut((Point, Point)) -> bool) -> bool {
        let mut is_found = |(a, b)| Rect::new(a, b).touches(window) && found((a, b));
        let Some(tree) = &self.tree else {
            return (0..self.len()).any(|at| is_found(self.edge(at)));
        };
        let visit = |at: usize| {
            if is_found(self.edge(at)) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        tree.visit(&tree.window(window.to_f64()), visit).is_break()
    }

    /// How often the contours wind round `p`; none where `p` lies on an edge. Exact: counts the
    /// edges that a ray to the right crosses.
    pub(crate) fn winding(&self, p: Point) -> Option<i32> {
        if !self.bounds.contains(p) {
            return Some(0);
        }
        let ray = Rect::new(p, Point::new(self.bounds.max().x, p.y));
        let mut winding = Some(0);
        self.any(ray, |edge| {
            winding = winding.zip(winding_of(edge, p)).map(|(sum, one)| sum + one);
            winding.is_none()
        });
        winding
    }

    /// Whether `p` lies inside the contours or on an edge, by the non-zero rule. Exact.
    pub(crate) fn contains(&self, p: Point) -> bool {
        self.winding(p) != Some(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    #[test]
    fn a_tree_of_edges_winds_as_all_of_them_do() {
        let at = |x: i64, y: i64| Point::new(Nm::new(x), Nm::new(y));
        // A star of three hundred points that winds round its middle many times.
        let star: Vec<Point> = (0..300_i64).map(|i| at(i * 7919 % 101, i * i * 31 % 97)).collect();
        let star = Polygon::new(vec![star]).expect("many points");
        let edges = Edges::new(&star);
        assert!(edges.tree.is_some(), "enough for a tree");
        let mut seen = [0; 2];
        for (x, y) in (-3..104).flat_map(|x| (-3..100).map(move |y| (x, y))) {
            let winding = edges.winding(at(x, y));
            assert_eq!(winding, star.winding(at(x, y)), "at {x}, {y}");
            seen[usize::from(winding.is_none())] += 1;
        }
        assert!(seen.iter().all(|&count| count > 100), "places on edges and beside them: {seen:?}");
    }
}
