//! The shapes of pads, round their own middle.
//!
//! ```text
//!   ╭────╮    chamfered corners are cut at 45°,
//!   │    │    the others rounded
//!   ╰────╲
//! ```

use super::frame::Frame;
use crate::board::{FLATTEN, Shape, polarity};
use crate::geometry::{Arc, Circle, Nm, Point, Polygon, Turn};

/// A circle, or with different sides an obround.
pub(super) fn obround(frame: &Frame, width: Nm, height: Nm) -> Shape {
    let (w, h) = (width.to_f64(), height.to_f64());
    let (x, y) = (((w - h) / 2.0).max(0.0), ((h - w) / 2.0).max(0.0));
    let (from, to, radius) = (frame.map(-x, -y), frame.map(x, y), width.min(height) / 2);
    if from == to { Shape::Disc { center: from, radius } } else { Shape::Stroke { from, to, radius } }
}

/// A trapezoid: `(dx, dy)` is by how much its left side is longer than its right one, and its lower
/// side than its upper one. Without, a rectangle.
pub(super) fn trapezoid(frame: &Frame, width: Nm, height: Nm, (dx, dy): (Nm, Nm)) -> Option<Shape> {
    let (w, h) = (width.to_f64() / 2.0, height.to_f64() / 2.0);
    let (dx, dy) = (dx.to_f64() / 2.0, dy.to_f64() / 2.0);
    let corners = [(-w - dy, -h - dx), (w + dy, -h + dx), (w - dy, h - dx), (-w + dy, h + dx)];
    let corners = corners.map(|(x, y)| frame.map(x, y)).to_vec();
    // Sides that differ by more than their length cross.
    polarity::clean(&[corners]).into_iter().next().map(Shape::Polygon)
}

/// How the corners of a rectangle end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    /// The radius of those that are not cut.
    pub(super) radius: f64,
    /// How much of each side the others lose.
    pub(super) cut: f64,
    /// Which are cut: top left, top right, bottom right, bottom left.
    pub(super) chosen: [bool; 4],
}

/// A rectangle with rounded or cut corners.
pub(super) fn rounded(frame: &Frame, width: Nm, height: Nm, corners: Corners) -> Option<Shape> {
    let (w, h) = (width.to_f64() / 2.0, height.to_f64() / 2.0);
    let (radius, cut) = (corners.radius.clamp(0.0, w.min(h)), corners.cut.clamp(0.0, w.min(h)));
    // The corners with the clock, each with the way of the side that runs into it.
    let places = [(-w, h, 0.0, 1.0), (w, h, 1.0, 0.0), (w, -h, 0.0, -1.0), (-w, -h, -1.0, 0.0)];
    let mut points: Vec<Point> = Vec::new();
    let mut circles: Vec<Circle> = Vec::new();
    for ((x, y, dx, dy), cut_off) in places.into_iter().zip(corners.chosen) {
        // The side that leaves a corner is turned by a quarter with the clock.
        let (ex, ey) = (dy, -dx);
        let back = if cut_off { cut } else { radius };
        let (start, end) = (frame.map(x - dx * back, y - dy * back), frame.map(x + ex * back, y + ey * back));
        points.push(start);
        if !cut_off && start != end {
            let center = frame.map(x - dx * back + ex * back, y - dy * back + ey * back);
            let arc = Arc { start, end, center, turn: Turn::Clockwise };
            points.extend(arc.flatten(FLATTEN));
            circles.extend(arc.circle());
        } else {
            points.push(end);
        }
    }
    points.dedup();
    polygon(points).map(|polygon| Shape::Polygon(polygon.of_circles(circles)))
}

/// The area inside `ring`, counter-clockwise; none where it has none.
fn polygon(mut ring: Vec<Point>) -> Option<Polygon> {
    if ring.first() == ring.last() {
        ring.pop();
    }
    let polygon = Polygon::new(vec![ring])?;
    let area = polygon.area_mm2();
    if area < 0.0 {
        let turned = polygon.contours()[0].iter().rev().copied().collect();
        return Polygon::new(vec![turned]);
    }
    (area > 0.0).then_some(polygon)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(shape: Option<Shape>) -> f64 {
        shape.and_then(|shape| shape.polygon(FLATTEN)).map_or(0.0, |polygon| polygon.area_mm2())
    }

    #[test]
    fn corners_are_rounded_and_cut() {
        let frame = Frame::at(Point::default(), 30.0);
        let (width, height) = (Nm::from_mm(4), Nm::from_mm(2));
        let all = |radius: f64, cut: f64, chosen| {
            area(rounded(&frame, width, height, Corners { radius: radius * 1e6, cut: cut * 1e6, chosen }))
        };
        let square = 1.0 - std::f64::consts::FRAC_PI_4;
        assert!((all(0.0, 0.0, [false; 4]) - 8.0).abs() < 1e-5, "a rectangle");
        assert!((all(0.5, 0.0, [false; 4]) - (8.0 - square)).abs() < 2e-3, "four round corners");
        assert!((all(0.0, 0.5, [true; 4]) - 7.5).abs() < 1e-5, "four cut corners");
        assert!(
            (all(0.5, 0.5, [true, false, false, true]) - (8.0 - 0.25 - square / 2.0)).abs() < 2e-3,
            "two"
        );
        assert!((all(9.0, 0.0, [false; 4]) - (8.0 - 4.0 * square)).abs() < 4e-3, "an obround at most");
    }

    #[test]
    fn a_trapezoid_has_sides_of_different_length() {
        let frame = Frame::at(Point::default(), 0.0);
        let delta = (Nm::ZERO, Nm::from_mm(1));
        let Some(Shape::Polygon(polygon)) = trapezoid(&frame, Nm::from_mm(2), Nm::from_mm(3), delta) else {
            panic!("it has an area");
        };
        assert!((polygon.area_mm2() - 6.0).abs() < 1e-9, "the mean width counts");
        let lower = polygon.contours()[0].iter().filter(|p| p.y < Nm::ZERO).map(|p| p.x.abs());
        assert!(lower.into_iter().all(|x| x == Nm::from_um(1500)), "wider below");
    }
}
