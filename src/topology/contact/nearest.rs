//! How near two cores come, and where, in floats: for people to read, never to decide what
//! conducts.

use crate::geometry::{Point, Vector, cross};

use super::near::{self, ASIDE};
use super::sector::Sector;

/// A place in nanometres, not rounded.
type Place = (f64, f64);

/// The ends of the shortest way between two cores.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) from: Place,
    pub(super) to: Place,
    /// Its length in nanometres.
    pub(super) length: f64,
}

impl Way {
    fn new(from: Place, to: Place) -> Self {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        Self { from, to, length: (x * x + y * y).sqrt() }
    }

    pub(super) const fn reversed(self) -> Self {
        Self { from: self.to, to: self.from, length: self.length }
    }

    /// The place `distance` along it.
    pub(super) fn at(&self, distance: f64) -> Point {
        let part = if self.length > 0.0 { distance / self.length } else { 0.0 };
        let ((x0, y0), (x1, y1)) = (self.from, self.to);
        Point::from_f64(x0 + (x1 - x0) * part, y0 + (y1 - y0) * part)
    }
}

/// The shortest of `first` and `others`; the first of equals.
pub(super) fn shortest(first: Way, others: impl IntoIterator<Item = Way>) -> Way {
    others.into_iter().fold(first, |best, way| if way.length < best.length { way } else { best })
}

/// Between two points.
pub(super) fn points(p: Point, q: Point) -> Way {
    Way::new(p.to_f64(), q.to_f64())
}

/// From a point to a segment, which may be a point.
pub(super) fn point_segment(p: Point, (a, b): (Point, Point)) -> Way {
    let (along, way) = (b - a, p - a);
    let (foot, squared) = (Vector::dot(way, along), along.length_squared());
    if foot <= 0 {
        points(p, a)
    } else if foot >= squared {
        points(p, b)
    } else {
        Way::new(p.to_f64(), foot_of(a, along, foot, squared))
    }
}

/// The place foot / squared of the way `along` from `a`.
#[expect(clippy::cast_precision_loss, reason = "a display figure")]
fn foot_of(a: Point, along: Vector, foot: i64, squared: i64) -> Place {
    let part = foot as f64 / squared as f64;
    (a.x.to_f64() + along.x.to_f64() * part, a.y.to_f64() + along.y.to_f64() * part)
}

/// Between two segments; of no length where they cross.
pub(super) fn segments(s: (Point, Point), t: (Point, Point)) -> Way {
    if cross(s, t) {
        let (along, across, way) = (s.1 - s.0, t.1 - t.0, t.0 - s.0);
        let place = foot_of(s.0, along, way.cross(across), along.cross(across));
        return Way::new(place, place);
    }
    let back = [point_segment(t.0, s).reversed(), point_segment(t.1, s).reversed()];
    shortest(point_segment(s.0, t), [point_segment(s.1, t)].into_iter().chain(back))
}

/// From a point to an arc.
pub(super) fn point_arc(p: Point, arc: &Sector) -> Way {
    let round = arc.holds(p - arc.center).then(|| place_arc(p.to_f64(), arc));
    shortest(points(p, arc.start), [points(p, arc.end)].into_iter().chain(round))
}

/// From a place, whose direction an arc holds, straight to its circle.
#[expect(clippy::cast_precision_loss, reason = "a display figure")]
fn place_arc(p: Place, arc: &Sector) -> Way {
    let (center, radius) = (arc.center.to_f64(), (arc.outer as f64).sqrt());
    let (x, y) = (p.0 - center.0, p.1 - center.1);
    let length = (x * x + y * y).sqrt();
    if length > 0.0 {
        let part = radius / length;
        Way::new(p, (center.0 + x * part, center.1 + y * part))
    } else {
        Way::new(p, arc.start.to_f64())
    }
}

/// Between a segment and an arc; of no length where they cross.
pub(super) fn segment_arc((a, b): (Point, Point), arc: &Sector) -> Way {
    if let Some(place) = crossing_of_segment((a, b), arc) {
        return Way::new(place, place);
    }
    let along = b - a;
    let (foot, squared) = ((arc.center - a).dot(along), along.length_squared());
    let back = [arc.start, arc.end].map(|end| point_segment(end, (a, b)).reversed());
    let normal = along.perpendicular();
    let towards = if normal.dot(a - arc.center) < 0 { -normal } else { normal };
    let middle = (foot > 0 && foot < squared && arc.holds(towards))
        .then(|| place_arc(foot_of(a, along, foot, squared), arc));
    shortest(point_arc(a, arc), [point_arc(b, arc)].into_iter().chain(back).chain(middle))
}

/// Where a segment crosses an arc, the first along it.
#[expect(clippy::cast_precision_loss, reason = "a display figure")]
fn crossing_of_segment((a, b): (Point, Point), arc: &Sector) -> Option<Place> {
    let (along, way) = (b - a, a - arc.center);
    let squared = along.length_squared() as f64;
    if squared == 0.0 {
        return None;
    }
    // |way + t along|² = r² at t = foot ∓ reach.
    let foot = -(way.dot(along) as f64) / squared;
    let aside = way.cross(along) as f64;
    let reach = (arc.outer as f64 - aside * aside / squared) / squared;
    if reach < 0.0 {
        return None;
    }
    let reach = reach.sqrt();
    let (x, y) = (way.x.to_f64(), way.y.to_f64());
    let at = |t: f64| (x + along.x.to_f64() * t, y + along.y.to_f64() * t);
    let mut crossings = [foot - reach, foot + reach].into_iter();
    let t = crossings.find(|&t| (0.0..=1.0).contains(&t) && arc.nearly_holds(at(t), ASIDE))?;
    let (center, (x, y)) = (arc.center.to_f64(), at(t));
    Some((center.0 + x, center.1 + y))
}

/// Between two arcs; of no length where they cross.
pub(super) fn arcs(s: &Sector, t: &Sector) -> Way {
    if let Some((x, y)) = near::crossing(s, t) {
        let place = (s.center.x.to_f64() + x, s.center.y.to_f64() + y);
        return Way::new(place, place);
    }
    let back = [t.start, t.end].map(|end| point_arc(end, s).reversed());
    shortest(
        point_arc(s.start, t),
        [point_arc(s.end, t)].into_iter().chain(back).chain(on_the_line_of_centers(s, t)),
    )
}

/// The ways between the points of both arcs on the line through their centres.
#[expect(clippy::cast_precision_loss, reason = "a display figure")]
fn on_the_line_of_centers(s: &Sector, t: &Sector) -> Vec<Way> {
    let way = t.center - s.center;
    let on = |arc: &Sector| -> Vec<Place> {
        let (center, part) = (arc.center.to_f64(), (arc.outer as f64).sqrt() / way.length());
        [way, -way]
            .into_iter()
            .filter(|towards| arc.holds(*towards))
            .map(|towards| (center.0 + towards.x.to_f64() * part, center.1 + towards.y.to_f64() * part))
            .collect()
    };
    if way == Vector::default() {
        return Vec::new();
    }
    let others = on(t);
    on(s).into_iter().flat_map(|p| others.iter().map(move |&q| Way::new(p, q)).collect::<Vec<_>>()).collect()
}
