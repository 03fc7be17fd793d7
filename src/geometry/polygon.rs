//! Filled areas of closed contours, and their clipping to rectangles.

use super::{Circle, Nm, Orientation, Point, Rect, Vector, orientation};

/// A filled area: closed contours, of which each point counts as inside by the non-zero winding
/// rule.
///
/// # Guarantees
///
/// Every contour has at least three points; the closing edge from last to first is implied. A
/// polygon that comes from a boolean is simple: outer contours counter-clockwise, holes clockwise,
/// no crossing.
///
/// Where its edges are chords of curves it may remember of which circles, in any order: what knows
/// arcs can take them for arcs again.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Polygon {
    contours: Vec<Vec<Point>>,
    circles: Vec<Circle>,
}

impl Polygon {
    /// The area inside `contours`, less those of fewer than three points; none where nothing is
    /// left.
    #[must_use]
    pub fn new(mut contours: Vec<Vec<Point>>) -> Option<Self> {
        contours.retain(|contour| contour.len() >= 3);
        (!contours.is_empty()).then_some(Self { contours, circles: Vec::new() })
    }

    /// The same, with some of its edges chords of `circles`, within the tolerance of what flattened
    /// them.
    #[must_use]
    pub fn of_circles(mut self, circles: impl IntoIterator<Item = Circle>) -> Self {
        self.circles.extend(circles);
        self
    }

    /// The circles that edges may be chords of.
    #[must_use]
    pub fn circles(&self) -> &[Circle] {
        &self.circles
    }

    /// The rectangle as a polygon.
    #[must_use]
    pub fn rectangle(rect: Rect) -> Self {
        Self { contours: vec![rect.corners().to_vec()], circles: Vec::new() }
    }

    /// The contours, each a ring of at least three points.
    #[must_use]
    pub fn contours(&self) -> &[Vec<Point>] {
        &self.contours
    }

    /// Every edge, with its direction.
    pub fn edges(&self) -> impl Iterator<Item = (Point, Point)> {
        self.contours
            .iter()
            .flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&from, &to)| (from, to)))
    }

    /// A rectangle that holds it.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        let first = self.contours[0][0];
        self.contours.iter().flatten().fold(Rect::new(first, first), |r, &p| r.union(Rect::new(p, p)))
    }

    /// The signed area in mm², counter-clockwise positive.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a display figure; the sum itself is exact")]
    pub fn area_mm2(&self) -> f64 {
        self.twice_area() as f64 / 2e12
    }

    /// Twice the signed area, in nm²: exact, so it tells whether anything was erased.
    #[must_use]
    pub fn twice_area(&self) -> i128 {
        self.contours.iter().map(|ring| twice_area(ring)).sum()
    }

    /// How often the contours wind round `p`; none where `p` lies on an edge. Exact.
    #[must_use]
    pub fn winding(&self, p: Point) -> Option<i32> {
        self.edges().map(|edge| winding_of(edge, p)).sum()
    }

    /// Whether `p` lies inside or on an edge, by the non-zero rule. Exact.
    #[must_use]
    pub fn contains(&self, p: Point) -> bool {
        self.winding(p) != Some(0)
    }

    /// Moved by `way`.
    #[must_use]
    pub fn translated(&self, way: Vector) -> Self {
        let circles = self.circles.iter().map(|&circle| Circle { center: circle.center + way, ..circle });
        Self {
            contours: self.contours.iter().map(|ring| ring.iter().map(|&p| p + way).collect()).collect(),
            circles: circles.collect(),
        }
    }

    /// What of it lies within `rect`, contour by contour; none where nothing does. Edges may run
    /// along those of the rectangle more than once, there and back: the area is right, but the
    /// polygon is not simple.
    #[must_use]
    pub fn clipped(&self, rect: Rect) -> Option<Self> {
        if rect.encloses(self.bounds()) {
            return Some(self.clone());
        }
        let clipped = Self::new(self.contours.iter().map(|ring| clip(ring.clone(), rect)).collect())?;
        Some(clipped.of_circles(self.circles.iter().copied()))
    }

    /// The total length of all edges, in nanometres.
    #[must_use]
    pub fn perimeter(&self) -> f64 {
        self.edges().map(|(a, b)| a.distance(b)).sum()
    }

    /// The area inside a circle, as a polygon within `tolerance` of it that reaches as far as the
    /// circle in x and y.
    #[must_use]
    pub fn disc(center: Point, radius: Nm, tolerance: Nm) -> Option<Self> {
        let east = center + Vector::new(radius, Nm::ZERO);
        let circle = super::Arc { start: east, end: east, center, turn: super::Turn::CounterClockwise };
        let (x, y) = center.to_f64();
        let quarter = u32::try_from(circle.chords(tolerance).div_ceil(4)).unwrap_or(u32::MAX);
        let point = |step: u32| {
            let angle = std::f64::consts::FRAC_PI_2 * f64::from(step) / f64::from(quarter);
            let (sin, cos) = libm::sincos(angle);
            Point::from_f64(x + radius.to_f64() * cos, y + radius.to_f64() * sin)
        };
        let disc = Self::new(vec![(0..4 * quarter).map(point).collect()])?;
        Some(disc.of_circles([Circle { center, radius }]))
    }

    /// The convex hull of `points`, counter-clockwise, without points on its edges; none where it
    /// has no area. Exact.
    pub fn hull(points: impl IntoIterator<Item = Point>) -> Option<Self> {
        let mut points: Vec<Point> = points.into_iter().collect();
        points.sort_unstable();
        points.dedup();
        // Andrew's monotone chain: the lower half from left to right, then the upper half back.
        let mut hull: Vec<Point> = Vec::with_capacity(points.len() + 1);
        let mut half = |points: &mut dyn Iterator<Item = Point>| {
            let base = hull.len();
            for p in points {
                while hull.len() >= base + 2
                    && orientation(hull[hull.len() - 2], hull[hull.len() - 1], p) != Orientation::Left
                {
                    hull.pop();
                }
                hull.push(p);
            }
            hull.pop();
        };
        half(&mut points.iter().copied());
        half(&mut points.iter().rev().copied());
        Self::new(vec![hull])
    }
}

/// Twice the area that a ring goes round counter-clockwise, in nm². Exact, of walls beyond the
/// range of coordinates, too.
pub(crate) fn twice_area(ring: &[Point]) -> i128 {
    let Some(&origin) = ring.first() else { return 0 };
    let way = |p: Point| [p.x - origin.x, p.y - origin.y].map(|nm| i128::from(nm.get()));
    // The edges at the origin add nothing.
    let pairs = ring.windows(2).map(|pair| (way(pair[0]), way(pair[1])));
    pairs.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

/// What an edge adds to how often contours wind round `p`: something where a ray to the right
/// crosses it; none where `p` lies on it.
pub(super) fn winding_of((a, b): (Point, Point), p: Point) -> Option<i32> {
    let side = orientation(a, b, p);
    if side == Orientation::Straight && Rect::new(a, b).contains(p) {
        return None;
    }
    Some(match side {
        Orientation::Left if a.y <= p.y && b.y > p.y => 1,
        Orientation::Right if a.y > p.y && b.y <= p.y => -1,
        _ => 0,
    })
}

/// What of a ring lies within `rect`, side by side (Sutherland and Hodgman 1974).
fn clip(mut ring: Vec<Point>, rect: Rect) -> Vec<Point> {
    let (min, max) = (rect.min(), rect.max());
    let sides = [(true, min.x, false), (true, max.x, true), (false, min.y, false), (false, max.y, true)];
    for (in_x, limit, upper) in sides {
        let along = |p: Point| if in_x { p.x } else { p.y };
        let holds = |p: Point| if upper { along(p) <= limit } else { along(p) >= limit };
        let crossing = |a: Point, b: Point| {
            let part = (limit - along(a)).to_f64() / (along(b) - along(a)).to_f64();
            let ((ax, ay), (bx, by)) = (a.to_f64(), b.to_f64());
            Point::from_f64(ax + (bx - ax) * part, ay + (by - ay) * part)
        };
        let mut kept = Vec::with_capacity(ring.len() + 4);
        for (at, &to) in ring.iter().enumerate() {
            let from = ring[(at + ring.len() - 1) % ring.len()];
            if holds(from) != holds(to) {
                kept.push(crossing(from, to));
            }
            if holds(to) {
                kept.push(to);
            }
        }
        ring = kept;
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn what_is_clipped_keeps_the_area_within() {
        let comb = [(0, 0), (10, 0), (10, 10), (8, 10), (8, 2), (2, 2), (2, 10), (0, 10)];
        let comb = Polygon::new(vec![comb.map(|(x, y)| at(x, y)).to_vec()]).expect("eight corners");
        let clipped = comb.clipped(Rect::new(at(-5, 5), at(20, 20))).expect("two teeth");
        assert!((clipped.area_mm2() - 20e-6).abs() < 1e-12, "two teeth of 2 by 5: {}", clipped.area_mm2());
        assert_eq!(comb.clipped(Rect::new(at(3, 5), at(7, 20))), None, "nothing between them");
    }

    #[test]
    fn a_hole_is_outside_and_its_edge_is_not() {
        let outer = Rect::new(at(0, 0), at(10, 10)).corners().to_vec();
        let mut hole = Rect::new(at(4, 4), at(6, 6)).corners().to_vec();
        hole.reverse();
        let ring = Polygon::new(vec![outer, hole]).expect("two contours");
        assert!(ring.contains(at(1, 1)), "in the copper");
        assert!(!ring.contains(at(5, 5)), "in the hole");
        assert!(ring.contains(at(4, 5)), "on the edge of the hole");
        assert!(!ring.contains(at(11, 5)), "outside");
        assert!((ring.area_mm2() - 96e-6).abs() < 1e-15, "area {}", ring.area_mm2());
    }
}
