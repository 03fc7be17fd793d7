//! Exact answers to "is this within that of the other", for points, segments and arcs.
//!
//! A disc is a point, a stroke a segment, a drawn arc an arc, each with a radius round it; so two
//! features touch exactly if their cores are within the sum of the radii (closed: at the sum they
//! touch). Every comparison is made in integers, squared until the roots are gone:
//!
//! ```text
//! √d ≤ √m + R   ⟺   x ≤ 0 or x² ≤ 4 R² m     with x = d − m − R²
//! ```
//!
//! Coordinates span 31 bits, squares 63, products of squares 126: `u128` holds them, and a 256-bit
//! product ([`u128::carrying_mul`]) the one comparison that is squared twice.
//!
//! The exception is where the insides (not the ends) of two arcs meet: that takes sums of three
//! roots, compared in floats that are wrong by less than 10⁻³ nm, in favour of contact. See
//! [`arcs`].

use crate::geometry::{Point, Vector, cross};

use super::sector::Sector;

/// The square of a difference or radius.
pub(super) const fn square(x: i64) -> u128 {
    let x = unsigned(x);
    x * x
}

/// A length or square, none of which is negative.
const fn unsigned(x: i64) -> u128 {
    x.unsigned_abs() as u128
}

/// Whether √d ≤ √m + reach.
pub(super) const fn root_within(d: i64, m: i64, reach: i64) -> bool {
    let near = unsigned(m) + square(reach);
    let x = unsigned(d).saturating_sub(near);
    x * x <= 4 * square(reach) * unsigned(m)
}

/// Whether √(d / q) ≤ √m + reach, or the other way round √m ≤ √(d / q) + reach when `turned`.
fn ratio_root_within(d: u128, q: i64, m: i64, reach: i64, turned: bool) -> bool {
    let q = unsigned(q);
    // Multiplied by √q: √d ≤ √(m q) + reach √q.
    let (low, high) = if turned { (unsigned(m) * q, d) } else { (d, unsigned(m) * q) };
    let x = low.saturating_sub(high + square(reach) * q);
    let left = x.carrying_mul(x, 0);
    // 4 reach² q · high; the first factor stays below 2¹²⁷.
    let right = (4 * square(reach) * q).carrying_mul(high, 0);
    left.1 < right.1 || (left.1 == right.1 && left.0 <= right.0)
}

/// Whether two points are within `reach`.
pub(super) fn points(p: Point, q: Point, reach: i64) -> bool {
    unsigned((q - p).length_squared()) <= square(reach)
}

/// Whether a point and the segment from `a` to `b` are within `reach`; the segment may be a point.
pub(super) fn point_segment(p: Point, (a, b): (Point, Point), reach: i64) -> bool {
    let (along, way) = (b - a, p - a);
    let foot = way.dot(along);
    if foot <= 0 {
        points(p, a, reach)
    } else if foot >= along.length_squared() {
        points(p, b, reach)
    } else {
        square(along.cross(way)) <= square(reach) * unsigned(along.length_squared())
    }
}

/// Whether two segments are within `reach`; either may be a point.
pub(super) fn segments(s: (Point, Point), t: (Point, Point), reach: i64) -> bool {
    point_segment(s.0, t, reach)
        || point_segment(s.1, t, reach)
        || point_segment(t.0, s, reach)
        || point_segment(t.1, s, reach)
        || cross(s, t)
}

/// Whether a point and an arc are within `reach`.
pub(super) fn point_arc(p: Point, arc: &Sector, reach: i64) -> bool {
    let way = p - arc.center;
    let squared = way.length_squared();
    points(p, arc.start, reach)
        || points(p, arc.end, reach)
        || (arc.holds(way)
            && root_within(squared, arc.outer, reach)
            && root_within(arc.inner, squared, reach))
}

/// Where a point lies that the circle of an arc does not reach.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Beside {
    Inside,
    Outside,
}

/// Whether the segment from `a` to `b` and an arc are within `reach`.
///
/// An arc of at most half a circle spans a convex wedge, in which a segment has one piece. If no
/// end of either is near the other, the piece reaches the thick arc only if it has points on both
/// sides of it, or if the foot of the centre on it lies in it.
pub(super) fn segment_arc((a, b): (Point, Point), arc: &Sector, reach: i64) -> bool {
    if arc.is_wide() {
        return arc.halves().iter().any(|half| segment_arc((a, b), half, reach));
    }
    if point_segment(arc.start, (a, b), reach)
        || point_segment(arc.end, (a, b), reach)
        || point_arc(a, arc, reach)
        || point_arc(b, arc, reach)
    {
        return true;
    }
    let along = b - a;
    let ends = [a, b].map(|p| end_beside(p - arc.center, arc));
    let rays = [arc.start, arc.end].map(|end| ray_beside(a - arc.center, along, end - arc.center));
    let foot = match foot_beside(a - arc.center, along, arc, reach) {
        Ok(foot) => foot,
        Err(Touches) => return true,
    };
    let mut seen = ends.into_iter().chain(rays).chain([foot]).flatten();
    let first = seen.next();
    seen.any(|side| Some(side) != first)
}

/// On which side of the circle the end of a segment lies; none outside the wedge.
fn end_beside(way: Vector, arc: &Sector) -> Option<Beside> {
    arc.holds(way).then(|| beside(way.length_squared() < arc.inner))
}

/// On which side of the circle a segment crosses the ray from the centre (the origin) through
/// `end`, a point of it.
fn ray_beside(a: Vector, along: Vector, end: Vector) -> Option<Beside> {
    let b = a + along;
    let sides = (end.cross(a).signum(), end.cross(b).signum());
    if sides.0 * sides.1 >= 0 {
        return None;
    }
    // It crosses at `end` × top / bottom.
    let (top, bottom) = (i128::from(a.cross(along)), i128::from(end.cross(along)));
    let (top, bottom) = if bottom < 0 { (-top, -bottom) } else { (top, bottom) };
    (top > 0).then(|| beside(top < bottom))
}

/// The foot of the centre on a segment is within reach of the arc.
struct Touches;

/// On which side of the circle the foot of the centre (the origin) on a segment lies; none where it
/// is not on the segment or not in the wedge.
fn foot_beside(a: Vector, along: Vector, arc: &Sector, reach: i64) -> Result<Option<Beside>, Touches> {
    let squared = along.length_squared();
    let foot = -a.dot(along);
    if foot <= 0 || foot >= squared {
        return Ok(None);
    }
    let normal = along.perpendicular();
    let offset = normal.dot(a);
    let way = if offset < 0 { -normal } else { normal };
    if offset != 0 && !arc.holds(way) {
        return Ok(None);
    }
    let offset = square(offset);
    if ratio_root_within(offset, squared, arc.outer, reach, false)
        && ratio_root_within(offset, squared, arc.inner, reach, true)
    {
        return Err(Touches);
    }
    Ok(Some(beside(offset < unsigned(arc.inner) * unsigned(squared))))
}

const fn beside(inside: bool) -> Beside {
    if inside { Beside::Inside } else { Beside::Outside }
}

/// Whether two arcs are within `reach`.
///
/// Exact where an end of either is the nearest; where two insides are, they are nearest on the line
/// of the centres or cross, and that is decided with [`SLACK`] in favour of contact.
pub(super) fn arcs(s: &Sector, t: &Sector, reach: i64) -> bool {
    point_arc(s.start, t, reach)
        || point_arc(s.end, t, reach)
        || point_arc(t.start, s, reach)
        || point_arc(t.end, s, reach)
        || on_the_line_of_centers(s, t, reach)
        || crossing(s, t).is_some()
}

/// How much nearer than they are two arcs may be taken to be, in nanometres.
///
/// Derived: each of the distance of the centres and the two radii is a correctly rounded root below
/// 2³² nm, wrong by at most 2⁻²¹ nm, and three operations follow.
const SLACK: f64 = 1e-5;

/// Whether the arcs are within `reach` along the line through their centres. Concentric arcs never
/// are: an end of one is as near to the other as its inside.
#[expect(clippy::cast_precision_loss, reason = "the rounding is within SLACK")]
fn on_the_line_of_centers(s: &Sector, t: &Sector, reach: i64) -> bool {
    let way = t.center - s.center;
    if way == Vector::default() {
        return false;
    }
    let (apart, reach) = (way.length(), reach as f64 + SLACK + s.thickness() + t.thickness());
    let (r, q) = ((s.outer as f64).sqrt(), (t.outer as f64).sqrt());
    [(way, r), (-way, -r)].into_iter().filter(|(towards, _)| s.holds(*towards)).any(|(_, r)| {
        let mut others = [(way, q), (-way, -q)].into_iter().filter(|(towards, _)| t.holds(*towards));
        others.any(|(_, q)| (apart + q - r).abs() <= reach)
    })
}

/// How far beyond the arm of a wedge a common point of two circles may lie to count as inside, in
/// nanometres. Chosen: the point of two circles that cross at a fair angle is wrong by less,
/// however large they are; circles that almost touch are found on the line of their centres.
pub(super) const ASIDE: f64 = 1e-3;

/// Where the arcs cross, from the first one's centre: a common point of their circles that lies in
/// both wedges.
#[expect(clippy::cast_precision_loss, reason = "the exact integer is rounded once")]
pub(super) fn crossing(s: &Sector, t: &Sector) -> Option<(f64, f64)> {
    let way = t.center - s.center;
    let squared = way.length_squared();
    if squared == 0 {
        return None;
    }
    let (apart, radius) = (squared as f64, s.outer as f64);
    // The common points lie `along` of the way to the other centre and `aside` of it at right
    // angles.
    let along = (i128::from(squared) + i128::from(s.outer) - i128::from(t.outer)) as f64 / (2.0 * apart);
    let aside = radius / apart - along * along;
    if aside < 0.0 {
        return None;
    }
    let aside = aside.sqrt();
    let (x, y) = (way.x.to_f64(), way.y.to_f64());
    let points = [aside, -aside].map(|aside| (x * along - y * aside, y * along + x * aside));
    let in_both = |point: &(f64, f64)| {
        s.nearly_holds(*point, ASIDE) && t.nearly_holds((point.0 - x, point.1 - y), ASIDE)
    };
    points.into_iter().find(in_both)
}
