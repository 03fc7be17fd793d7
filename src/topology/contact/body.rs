//! A shape made ready for contact: a core, and how far the copper reaches round it.

use std::iter;

use crate::board::Shape;
use crate::geometry::{Nm, Point, Rect};

use super::area::{Area, is_least};
use super::near;
use super::nearest::{self, Way};
use super::sector::Sector;

/// A shape prepared for contact: a core, and how far the copper reaches round it.
#[derive(Debug)]
pub(in crate::topology) struct Body {
    core: Core,
    /// Zero for a polygon.
    radius: Nm,
    bounds: Rect,
}

/// What a shape is when its radius is taken away.
#[derive(Debug)]
enum Core {
    Line(Line),
    Area(Box<Area>),
}

/// A core without an inside.
#[derive(Clone, Copy, Debug)]
enum Line {
    Point(Point),
    Segment(Point, Point),
    Arc(Sector),
}

/// Radii at the ends of an arc that differ by more than this, in nanometres, are no circle: the
/// wedge between the two would be found that much too early. Chosen: what rounding in a program
/// makes of them.
const ROUND: f64 = 2_000.0;
/// How far chords may leave such a spiral, which is a chain of them. Chosen: far below what is
/// tolerated.
const CHORD: Nm = Nm::new(200);

impl Body {
    pub(in crate::topology) fn new(shape: &Shape) -> Self {
        let (core, radius) = match shape {
            Shape::Disc { center, radius } => (Core::Line(Line::Point(*center)), *radius),
            Shape::Stroke { from, to, radius } => (Core::Line(Line::Segment(*from, *to)), *radius),
            // Not an arc, but a file can say it.
            Shape::Arc { arc, radius } if [arc.start, arc.end].contains(&arc.center) => {
                (Core::Line(Line::Segment(arc.start, arc.end)), *radius)
            }
            Shape::Arc { arc, radius } if arc.drift() > ROUND => {
                let chain = iter::once(arc.start).chain(arc.flatten(CHORD)).collect();
                (Core::Area(Box::new(Area::chain(chain))), *radius)
            }
            Shape::Arc { arc, radius } => (Core::Line(Line::Arc(Sector::new(arc))), *radius),
            Shape::Polygon(polygon) => (Core::Area(Box::new(Area::new(polygon))), Nm::ZERO),
        };
        Self { core, radius, bounds: shape.bounds() }
    }

    pub(in crate::topology) const fn bounds(&self) -> Rect {
        self.bounds
    }

    /// Whether the two share at least a point. Exact as [`Body::is_within`].
    pub(in crate::topology) fn touches(&self, other: &Self) -> bool {
        self.is_within(other, Nm::ZERO)
    }

    /// Whether the two are no farther apart than `gap`. Exact but for the insides of two arcs (see
    /// [`near`]).
    pub(in crate::topology) fn is_within(&self, other: &Self, gap: Nm) -> bool {
        if !self.bounds.inflate(gap).touches(other.bounds) {
            return false;
        }
        match (&self.core, &other.core) {
            (Core::Line(a), Core::Line(b)) => a.is_within(b, (self.radius + other.radius + gap).get()),
            (Core::Line(line), Core::Area(area)) => self.reaches_area(line, area, gap + other.radius),
            (Core::Area(area), Core::Line(line)) => other.reaches_area(line, area, gap + self.radius),
            (Core::Area(a), Core::Area(b)) => a.is_within(b, gap + self.radius + other.radius),
        }
    }

    /// Whether this, whose core is `line`, comes as near to `area` as `gap`.
    fn reaches_area(&self, line: &Line, area: &Area, gap: Nm) -> bool {
        area.any_edge(self.bounds.inflate(gap), |(a, b)| {
            line.is_within(&Line::Segment(a, b), (self.radius + gap).get())
        }) || area.contains(*line.point())
    }
}

/// The narrowest place between two shapes.
#[derive(Clone, Copy, Debug)]
pub(in crate::topology) struct Narrowest {
    /// The width of the gap there in nanometres, zero where they touch.
    pub(in crate::topology) width: f64,
    /// The middle of it.
    pub(in crate::topology) at: Point,
}

impl Body {
    /// The narrowest place between the two if it is at most `limit` wide; the shapes may touch.
    pub(in crate::topology) fn narrowest(&self, other: &Self, limit: Nm) -> Option<Narrowest> {
        if !self.bounds.inflate(limit).touches(other.bounds) {
            return None;
        }
        if self.touches(other) {
            return Some(Narrowest { width: 0.0, at: self.meeting(other) });
        }
        let way = self.way(other, limit)?;
        let width = way.length - (self.radius + other.radius).to_f64();
        (width <= limit.to_f64()).then(|| Narrowest { width: width.max(0.0), at: self.middle(other, &way) })
    }

    /// A point that both, which touch, have in common; to the nanometre.
    pub(in crate::topology) fn meeting(&self, other: &Self) -> Point {
        let reach = (self.radius + other.radius).to_f64() + 1.0;
        if let Some(way) = self.way(other, Nm::ZERO).filter(|way| way.length <= reach) {
            return self.middle(other, &way);
        }
        // No edge is near the other, so one lies in the other: a point of it is in both.
        let (own, others) = (self.core.points(), other.core.points());
        let mut both = own.chain(others).filter(|&p| self.holds(p) && other.holds(p));
        if let Some(point) = both.next() {
            return point;
        }
        // The wedge of an arc whose radii differ is near, the arc is not quite.
        let way = self.way(other, Nm::from_f64(2.0 * ROUND));
        way.map_or_else(|| self.bounds.min().midpoint(self.bounds.max()), |way| self.middle(other, &way))
    }

    /// Whether `p` is copper. Exact.
    pub(in crate::topology) fn holds(&self, p: Point) -> bool {
        match &self.core {
            Core::Line(line) => line.is_within(&Line::Point(p), self.radius.get()),
            Core::Area(area) => area.holds(p, self.radius),
        }
    }

    /// The shortest way from an edge of `area` to the core, if that is within `limit` of the
    /// copper.
    fn way_from_area(&self, area: &Area, limit: Nm) -> Option<Way> {
        let mut best: Option<Way> = None;
        area.any_edge(self.bounds().inflate(limit), |edge| {
            let window = Rect::new(edge.0, edge.1).inflate(limit + self.radius);
            let way = self.way_from(edge, window);
            best = [best, way].into_iter().flatten().reduce(|best, way| nearest::shortest(best, [way]));
            is_least(best)
        });
        best
    }

    /// The shortest way between the cores; for areas, among the edges within `limit` of the other's
    /// copper.
    fn way(&self, other: &Self, limit: Nm) -> Option<Way> {
        match (&self.core, &other.core) {
            (Core::Line(a), Core::Line(b)) => Some(a.way_to(b)),
            (Core::Area(area), _) => other.way_from_area(area, limit + self.radius),
            (Core::Line(_), Core::Area(area)) => {
                self.way_from_area(area, limit + other.radius).map(Way::reversed)
            }
        }
    }

    /// The middle of the gap, or of the overlap, along the way between the cores.
    fn middle(&self, other: &Self, way: &Way) -> Point {
        let (near, far) = (self.radius.to_f64(), other.radius.to_f64());
        way.at(f64::midpoint(near.min(way.length), (way.length - far).max(0.0)))
    }

    /// The shortest way from a segment to the core, among the edges in `window` for an area.
    pub(super) fn way_from(&self, edge: (Point, Point), window: Rect) -> Option<Way> {
        match &self.core {
            Core::Line(line) => Some(Line::Segment(edge.0, edge.1).way_to(line)),
            Core::Area(area) => area.way_from(edge, window),
        }
    }
}

impl Core {
    /// Points of it: one of a line, one of each contour of an area.
    fn points(&self) -> impl Iterator<Item = Point> {
        match self {
            Self::Line(line) => std::slice::from_ref(line.point()),
            Self::Area(area) => area.corners(),
        }
        .iter()
        .copied()
    }
}

impl Line {
    /// Whether the two are within `reach`.
    fn is_within(&self, other: &Self, reach: i64) -> bool {
        match (*self, *other) {
            (Self::Point(p), Self::Point(q)) => near::points(p, q, reach),
            (Self::Point(p), Self::Segment(a, b)) | (Self::Segment(a, b), Self::Point(p)) => {
                near::point_segment(p, (a, b), reach)
            }
            (Self::Point(p), Self::Arc(arc)) | (Self::Arc(arc), Self::Point(p)) => {
                near::point_arc(p, &arc, reach)
            }
            (Self::Segment(a, b), Self::Segment(c, d)) => near::segments((a, b), (c, d), reach),
            (Self::Segment(a, b), Self::Arc(arc)) | (Self::Arc(arc), Self::Segment(a, b)) => {
                near::segment_arc((a, b), &arc, reach)
            }
            (Self::Arc(s), Self::Arc(t)) => near::arcs(&s, &t, reach),
        }
    }

    /// The shortest way to the other; of no length where they cross.
    fn way_to(&self, other: &Self) -> Way {
        match (*self, *other) {
            (Self::Point(p), Self::Point(q)) => nearest::points(p, q),
            (Self::Point(p), Self::Segment(a, b)) => nearest::point_segment(p, (a, b)),
            (Self::Point(p), Self::Arc(arc)) => nearest::point_arc(p, &arc),
            (Self::Segment(a, b), Self::Segment(c, d)) => nearest::segments((a, b), (c, d)),
            (Self::Segment(a, b), Self::Arc(arc)) => nearest::segment_arc((a, b), &arc),
            (Self::Arc(s), Self::Arc(t)) => nearest::arcs(&s, &t),
            (Self::Segment(..) | Self::Arc(_), Self::Point(_)) | (Self::Arc(_), Self::Segment(..)) => {
                other.way_to(self).reversed()
            }
        }
    }

    /// Any point of it.
    const fn point(&self) -> &Point {
        match self {
            Self::Point(p) | Self::Segment(p, _) => p,
            Self::Arc(arc) => &arc.start,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Arc, Polygon, Turn};
    use crate::topology::random;

    /// What has two radii is as far from all as strokes along it are.
    #[test]
    fn a_spiral_is_as_far_as_its_chords() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let (turn, radius) = (Turn::CounterClockwise, Nm::from_um(150));
        let arc = Arc { start: at(2000, 0), end: at(-2300, 0), center: at(0, 0), turn };
        let spiral = Body::new(&Shape::Arc { arc, radius });
        assert!(matches!(spiral.core, Core::Area(_)), "no circle");
        let points: Vec<Point> = iter::once(arc.start).chain(arc.flatten(Nm::new(20))).collect();
        let stroke = |ends: &[Point]| Body::new(&Shape::Stroke { from: ends[0], to: ends[1], radius });
        let strokes: Vec<Body> = points.windows(2).map(stroke).collect();
        let (mut next, limit) = (random(), Nm::from_mm(3));
        let mut seen = [0; 2];
        for number in 0..300 {
            let [from, to] = [(); 2].map(|()| at(next(8000) - 4000, next(8000) - 4000));
            let shape = match number % 3 {
                0 => Shape::Disc { center: from, radius },
                1 => Shape::Stroke { from, to, radius },
                _ => Shape::Polygon(Polygon::rectangle(Rect::new(from, to))),
            };
            let other = Body::new(&shape);
            let narrowest = |body: &Body| other.narrowest(body, limit).map(|place| place.width);
            let chords = strokes.iter().filter_map(narrowest).reduce(f64::min);
            for found in [narrowest(&spiral), spiral.narrowest(&other, limit).map(|place| place.width)] {
                let off = found.unwrap_or(limit.to_f64()) - chords.unwrap_or(limit.to_f64());
                assert!(off.abs() <= 250.0, "{found:?} where chords have {chords:?}, {shape:?}");
            }
            assert_eq!(spiral.holds(from), strokes.iter().any(|stroke| stroke.holds(from)), "{from:?}");
            seen[usize::from(chords.is_some_and(|width| width > 0.0))] += 1;
        }
        assert!(seen.iter().all(|&count| count > 30), "what touches and what does not: {seen:?}");
    }
}
