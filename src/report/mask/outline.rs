//! The outline of a shape: closed paths of lines and arcs, round what is inked.

use crate::board::{FLATTEN, Shape};
use crate::geometry::{Arc, Nm, Path, Point, Polygon, Segment, Turn, Vector};

/// How much the radii of an arc may differ and it still has a parallel. Chosen: what rounding
/// leaves, and no more.
const DRIFT: f64 = 10.0;

/// The closed paths whose inside, by the non-zero rule, is `shape`; outer ones run
/// counter-clockwise.
pub(super) fn outline(shape: &Shape) -> Vec<Path> {
    match *shape {
        Shape::Disc { center, radius } => vec![circle(center, center + Vector::new(radius, Nm::ZERO))],
        Shape::Stroke { from, to, radius } => vec![capsule(from, to, radius)],
        Shape::Arc { ref arc, radius } => swept(arc, radius).unwrap_or_else(|| {
            let flat = shape.polygon(FLATTEN);
            flat.iter().flat_map(rings).collect()
        }),
        Shape::Polygon(ref polygon) => rings(polygon).collect(),
    }
}

fn rings(polygon: &Polygon) -> impl Iterator<Item = Path> {
    polygon.contours().iter().filter_map(|ring| Path::polyline(ring.iter().copied().chain([ring[0]])))
}

/// A circle through `start`, in two halves.
fn circle(center: Point, start: Point) -> Path {
    let way = start - center;
    let half = |to| Segment::Arc { to, center, turn: Turn::CounterClockwise };
    Path { start, segments: vec![half(center - way), half(start)] }
}

/// All points within `radius` of a line.
fn capsule(from: Point, to: Point, radius: Nm) -> Path {
    let way = to - from;
    let left = Vector::new(-way.y, way.x).scaled(radius.to_f64() / way.length());
    let cap = |to, center| Segment::Arc { to, center, turn: Turn::CounterClockwise };
    let segments = vec![
        Segment::Line { to: to - left },
        cap(to + left, to),
        Segment::Line { to: from + left },
        cap(from - left, from),
    ];
    Path { start: from - left, segments }
}

/// All points within `radius` of an arc; none where that has no parallel on its inside.
fn swept(arc: &Arc, radius: Nm) -> Option<Vec<Path>> {
    let arc = if arc.turn == Turn::Clockwise { arc.reversed() } else { *arc };
    if arc.drift() > DRIFT || arc.radius() <= radius.to_f64() {
        return None;
    }
    let out = |p: Point| {
        let way = p - arc.center;
        way.scaled(radius.to_f64() / way.length())
    };
    let (first, last) = (out(arc.start), out(arc.end));
    if arc.start == arc.end {
        let outer = circle(arc.center, arc.start + first);
        return Some(vec![outer, circle(arc.center, arc.start - first).reversed()]);
    }
    let turn = |to, center, turn| Segment::Arc { to, center, turn };
    let segments = vec![
        turn(arc.end + last, arc.center, Turn::CounterClockwise),
        turn(arc.end - last, arc.end, Turn::CounterClockwise),
        turn(arc.start - first, arc.center, Turn::Clockwise),
        turn(arc.start + first, arc.start, Turn::CounterClockwise),
    ];
    Some(vec![Path { start: arc.start + first, segments }])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    /// The area of what the paths enclose.
    fn area(shape: &Shape) -> f64 {
        let ring = |path: &Path| {
            assert!(path.is_closed(), "{path:?} comes back");
            path.flatten(Nm::new(10))
        };
        let all: Vec<Vec<Point>> = outline(shape).iter().map(ring).collect();
        crate::board::polarity::clean(&all).iter().map(Polygon::area_mm2).sum()
    }

    #[test]
    fn an_outline_encloses_its_shape() {
        let quarter = |turn| Arc { start: at(1000, 0), end: at(0, 1000), center: at(0, 0), turn };
        let full = Arc { end: at(1000, 0), ..quarter(Turn::Clockwise) };
        let (wide, narrow) = (Nm::from_um(1500), Nm::from_um(200));
        // An arc without a parallel on its inside has chords.
        let exact = 2e-5;
        for (shape, tolerance) in [
            (Shape::Disc { center: at(10, 20), radius: wide }, exact),
            (Shape::Stroke { from: at(0, 0), to: at(3000, 1000), radius: narrow }, exact),
            (Shape::Arc { arc: quarter(Turn::CounterClockwise), radius: narrow }, exact),
            (Shape::Arc { arc: quarter(Turn::Clockwise), radius: narrow }, exact),
            (Shape::Arc { arc: quarter(Turn::CounterClockwise), radius: wide }, 2e-4),
            (Shape::Arc { arc: full, radius: narrow }, exact),
        ] {
            let expected = shape.polygon(Nm::new(10)).expect("an area").area_mm2();
            let found = area(&shape);
            assert!(
                (found / expected - 1.0).abs() < tolerance,
                "{shape:?}: {found} instead of {expected} mm²"
            );
        }
    }
}
