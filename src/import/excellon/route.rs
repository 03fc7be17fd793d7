//! The router: a lowered bit that follows lines and arcs.

use crate::geometry::{Nm, Point, Segment, Turn, Vector};

/// What a move in route mode is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Interpolation {
    /// `G00`: above the board.
    Rapid,
    /// `G01`.
    Line,
    /// `G02`, `G03`.
    Arc(Turn),
}

/// How an arc says where its centre is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Center {
    /// `I` and `J`: the way between the start and the centre.
    Offset(Vector),
    /// `A`: the radius, of an arc of at most half a circle.
    Radius(Nm),
}

/// The arc from `from` to `to`; none where a radius is given for a full circle, or a way of no
/// length.
pub(super) fn arc(from: Point, to: Point, turn: Turn, center: Center) -> Option<Segment> {
    let center = match center {
        Center::Offset(way) => by_offset(from, to, way),
        Center::Radius(_) if from == to => return None,
        Center::Radius(radius) => on_radius(from, to, turn, radius),
    };
    (center != from).then_some(Segment::Arc { to, center, turn })
}

/// The centre that `I` and `J` lead to. The manual counts them from the centre to the start, most
/// programs the other way: the one holds that is as far from the end as from the start.
fn by_offset(from: Point, to: Point, way: Vector) -> Point {
    let mismatch = |center: Point| (center.distance(from) - center.distance(to)).abs();
    let (ahead, behind) = (from + way, from - way);
    if mismatch(behind) < mismatch(ahead) { behind } else { ahead }
}

/// The centre of the arc of at most half a circle; halfway where the radius does not reach.
///
/// ```text
///        c        h² = r² − (d/2)²
///       /|\       counter-clockwise the centre lies to the left of the way, h from its middle
///    r / |h\
///     /__|__\
///  from  d   to
/// ```
fn on_radius(from: Point, to: Point, turn: Turn, radius: Nm) -> Point {
    let way = to - from;
    let (half, r) = (way.length() / 2.0, radius.to_f64());
    let height = (r * r - half * half).max(0.0).sqrt();
    let left = way.perpendicular();
    let scale = match turn {
        Turn::CounterClockwise => height,
        Turn::Clockwise => -height,
    } / way.length();
    let (x, y) = from.to_f64();
    let (wx, wy) = (way.x.to_f64() / 2.0, way.y.to_f64() / 2.0);
    Point::from_f64(x + wx + left.x.to_f64() * scale, y + wy + left.y.to_f64() * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn a_radius_puts_the_centre_on_the_side_it_turns_to() {
        let quarter = |turn| arc(at(1000, 0), at(0, 1000), turn, Center::Radius(Nm::from_um(1000)));
        let centre = |segment: Option<Segment>| match segment {
            Some(Segment::Arc { center, .. }) => center,
            other => panic!("no arc: {other:?}"),
        };
        assert_eq!(centre(quarter(Turn::CounterClockwise)), at(0, 0), "to the left");
        assert_eq!(centre(quarter(Turn::Clockwise)), at(1000, 1000), "to the right");
    }

    #[test]
    fn an_offset_may_be_counted_either_way() {
        for x in [-1000, 1000] {
            let way = at(x, 0) - at(0, 0);
            let quarter = arc(at(1000, 0), at(0, 1000), Turn::CounterClockwise, Center::Offset(way));
            let Some(Segment::Arc { center, .. }) = quarter else { panic!("no arc: {quarter:?}") };
            assert_eq!(center, at(0, 0), "the one that is as far from both ends");
        }
    }
}
