//! Areas with holes as single rings.

use crate::geometry::{Nm, Point, Polygon, Rect};

/// The contours of a polygon, the first of them the outer one, as a single ring.
///
/// ```text
///  ┌───────────────┐      From the leftmost corner of a hole a level line leads left to the first edge.
///  │    ╱──┐       │      Holes are taken from the left, so that edge is of the outer contour or of
///  p════q  │       │      a hole that is cut in already.
///  │    ╲──┘       │
///  └───────────────┘
/// ```
pub(super) fn cut_in(polygon: &Polygon) -> Vec<Point> {
    let outer = polygon.contours().iter().position(|ring| turns_left(ring)).unwrap_or(0);
    let mut holes: Vec<Vec<Point>> = Vec::new();
    for (at, hole) in polygon.contours().iter().enumerate() {
        if at != outer
            && let Some(first) = (0..hole.len()).min_by_key(|&i| hole[i])
        {
            holes.push(hole[first..].iter().chain(&hole[..first]).copied().collect());
        }
    }
    holes.sort_by_key(|hole| hole[0]);
    let mut ring = Ring::new(&polygon.contours()[outer], Bands::new(polygon.bounds(), holes.len()));
    holes.iter().for_each(|hole| ring.cut_in(hole));
    let mut points: Vec<Point> = ring.order().map(|at| ring.points[at]).collect();
    points.dedup();
    points
}

/// A ring that grows in its middle. An edge goes by the place of the point that it begins at.
struct Ring {
    points: Vec<Point>,
    /// The place of the point that follows each.
    next: Vec<usize>,
    bands: Bands,
}

impl Ring {
    fn new(points: &[Point], bands: Bands) -> Self {
        let next = (0..points.len()).map(|at| (at + 1) % points.len()).collect();
        let mut ring = Self { points: points.to_vec(), next, bands };
        (0..points.len()).for_each(|edge| ring.note(edge));
        ring
    }

    /// The places of its points, in its order.
    fn order(&self) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(0), |&at| Some(self.next[at]).filter(|&next| next != 0))
    }

    fn ends(&self, edge: usize) -> (Point, Point) {
        (self.points[edge], self.points[self.next[edge]])
    }

    fn note(&mut self, edge: usize) {
        let (a, b) = self.ends(edge);
        self.bands.add(a.y, b.y, edge);
    }

    /// Goes to the first corner of `hole`, round it, and back.
    fn cut_in(&mut self, hole: &[Point]) {
        let q = hole[0];
        let Some((edge, p)) = self.left_of(q) else { return };
        let first = self.points.len();
        self.points.extend([p].into_iter().chain(hole.iter().copied()).chain([q, p]));
        let last = self.points.len() - 1;
        self.next.extend(first + 1..=last);
        self.next.push(self.next[edge]);
        self.next[edge] = first;
        (first..=last).for_each(|edge| self.note(edge));
    }

    /// The edge that a level line from `q` to the left meets first, and where; of several that it
    /// meets there the last one.
    fn left_of(&self, q: Point) -> Option<(usize, Point)> {
        let met = |edge: usize| {
            let (a, b) = self.ends(edge);
            if (a.y <= q.y) == (b.y <= q.y) {
                return None;
            }
            let part = (q.y - a.y).to_f64() / (b.y - a.y).to_f64();
            let x = Nm::from_f64(a.x.to_f64() + (b.x - a.x).to_f64() * part);
            (x <= q.x).then_some((x, edge))
        };
        let all = || self.bands.at(q.y).iter().filter_map(|&edge| met(edge));
        let (x, _) = all().max()?;
        let first: Vec<usize> = all().filter(|met| met.0 == x).map(|met| met.1).collect();
        let edge = match first[..] {
            [only] => only,
            _ => self.order().filter(|edge| first.contains(edge)).last()?,
        };
        Some((edge, Point::new(x, q.y)))
    }
}

/// Edges by the heights that they reach over, so that few are looked at beside a point.
struct Bands {
    bottom: Nm,
    height: Nm,
    edges: Vec<Vec<usize>>,
}

impl Bands {
    /// Such as lie within `bounds`, in as many bands as there are `holes`.
    fn new(bounds: Rect, holes: usize) -> Self {
        let count = i64::try_from(holes).unwrap_or(i64::MAX).max(1);
        let height = bounds.height() / count + Nm::new(1);
        Self { bottom: bounds.min().y, height, edges: vec![Vec::new(); holes.max(1)] }
    }

    fn band(&self, y: Nm) -> usize {
        let band = (y - self.bottom).get() / self.height.get();
        usize::try_from(band).unwrap_or(0).min(self.edges.len() - 1)
    }

    /// A level edge is beside no point.
    fn add(&mut self, from: Nm, to: Nm, edge: usize) {
        if from != to {
            let bands = self.band(from.min(to))..=self.band(from.max(to));
            self.edges[bands].iter_mut().for_each(|band| band.push(edge));
        }
    }

    fn at(&self, y: Nm) -> &[usize] {
        &self.edges[self.band(y)]
    }
}

fn turns_left(ring: &[Point]) -> bool {
    Polygon::new(vec![ring.to_vec()]).is_some_and(|ring| ring.area_mm2() > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::polarity;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    /// A corner to the right, below and to the left of its middle, and one above it.
    fn rhomb(x: i64, y: i64, reach: i64) -> Vec<Point> {
        vec![at(x + reach, y), at(x, y - reach), at(x - reach, y), at(x, y + reach)]
    }

    /// As [`Ring::left_of`], the obvious way: every edge is looked at.
    fn obvious(ring: &[Point], q: Point) -> Option<(usize, Point)> {
        let ends = ring.iter().zip(ring.iter().cycle().skip(1));
        let met = ends.enumerate().filter_map(|(edge, (&a, &b))| {
            if (a.y <= q.y) == (b.y <= q.y) {
                return None;
            }
            let part = (q.y - a.y).to_f64() / (b.y - a.y).to_f64();
            let x = Nm::from_f64(a.x.to_f64() + (b.x - a.x).to_f64() * part);
            (x <= q.x).then_some((edge, Point::new(x, q.y)))
        });
        met.max_by_key(|(_, p)| p.x)
    }

    #[test]
    fn holes_are_cut_in_as_if_every_edge_was_looked_at() {
        // In rows, so that edges end on the level line of the next hole, and out of them.
        let place = |i: i64| (2_000 + i % 12 * 1_500, 2_000 + i / 12 * 1_500 + i * i % 7 / 5 * 130);
        let mut holes: Vec<Vec<Point>> =
            (0..144).map(place).map(|(x, y)| rhomb(x, y, 300 + x % 400)).collect();
        let outer = vec![at(0, 0), at(21_000, 1), at(20_500, 21_000), at(-300, 20_000)];
        let polygon = Polygon::new([std::slice::from_ref(&outer), &holes[..]].concat()).expect("contours");
        for hole in &mut holes {
            hole.rotate_left(2);
        }
        holes.sort_by_key(|hole| hole[0]);
        let mut ring = outer;
        for hole in holes {
            let (q, (edge, p)) = (hole[0], obvious(&ring, hole[0]).expect("within the outer contour"));
            ring.splice(edge + 1..edge + 1, [p].into_iter().chain(hole).chain([q, p]));
        }
        ring.dedup();
        assert_eq!(cut_in(&polygon), ring, "point by point");
    }

    #[test]
    fn holes_are_cut_in_without_loss_of_area() {
        let square = |x: i64, y: i64, side: i64| {
            vec![at(x, y), at(x + side, y), at(x + side, y + side), at(x, y + side)]
        };
        let mut rings = vec![square(0, 0, 10_000)];
        for (x, y) in [(1000, 1000), (4000, 1500), (7000, 1000), (4000, 6000)] {
            let mut hole = square(x, y, 1000);
            hole.reverse();
            rings.push(hole);
        }
        let polygon = Polygon::new(rings).expect("a square with four holes");
        let ring = cut_in(&polygon);
        let back = polarity::clean(&[ring]);
        assert_eq!(back.len(), 1, "one piece");
        assert_eq!(back[0].contours().len(), 5, "and its holes");
        assert!((back[0].area_mm2() - polygon.area_mm2()).abs() < 1e-9, "area {}", back[0].area_mm2());
    }
}
