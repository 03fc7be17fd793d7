//! Long ways as rectangles that hold them closely: the bounds of a long slanting stroke, or of a
//! large arc, hold much that is nowhere near it.
//!
//! ```text
//!   ┌────────────╱┐      ┌──╱┐
//!   │         ╱   │      ├╱──┘      A point in the bounds of a way across the board is near the way once in
//!   │      ╱      │    ┌─╱┐         some hundred times. Of ten thousand such ways each was held to be near
//!   │   ╱         │    ├╱─┘         thousands of others.
//!   └╱────────────┘    └┘
//! ```

use crate::board::Shape;
use crate::geometry::{Nm, Rect};

/// How long a stretch is, in nanometres. Chosen: a few times what cuts and traces are wide.
const LONG: f64 = 1_500_000.0;
/// Stretches of a shape at most: of one that is very long they are longer. Chosen.
const MOST: u32 = 256;

/// Rectangles that hold a long way together, those of its stretches; none for a shape that its
/// bounds hold as closely.
pub(super) fn stretches(shape: &Shape) -> Option<Vec<Rect>> {
    let bounds = shape.bounds();
    // One that runs along an axis fills its bounds.
    let is_slanting = bounds.width().min(bounds.height()).to_f64() > LONG;
    is_slanting.then(|| pieces(shape)).flatten()
}

/// The same of a way that fills its bounds, too: what is near it may be far from a stretch of it.
pub(super) fn pieces(shape: &Shape) -> Option<Vec<Rect>> {
    if shape.length() <= LONG {
        return None;
    }
    match shape {
        // Places are whole nanometres.
        Shape::Stroke { radius, .. } => Some(parts(shape, *radius + Nm::new(1))),
        Shape::Arc { arc, radius } => {
            // How far a stretch bulges beyond its ends.
            let part = arc.sweep().abs() / f64::from(count(shape.length()));
            let widest = arc.radius() + arc.drift().abs();
            let bulge = widest * (1.0 - libm::cos((part / 2.0).min(std::f64::consts::PI)));
            let room = Nm::from_f64((bulge + arc.drift().abs()).ceil() + 2.0);
            Some(parts(shape, *radius + room))
        }
        Shape::Disc { .. } | Shape::Polygon(_) => None,
    }
}

/// So many stretches a way of this length has.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
fn count(length: f64) -> u32 {
    ((length / LONG).ceil() as u32).clamp(1, MOST)
}

fn parts(shape: &Shape, room: Nm) -> Vec<Rect> {
    let count = count(shape.length());
    let place = |i: u32| shape.at(f64::from(i) / f64::from(count));
    (0..count).map(|i| Rect::new(place(i), place(i + 1)).inflate(room)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Arc, Point, Turn};

    #[test]
    fn stretches_hold_the_whole_way() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let radius = Nm::from_um(100);
        let arc = |start: Point, end: Point| Arc { start, end, center: at(0, 0), turn: Turn::Clockwise };
        let stroke = Shape::Stroke { from: at(-3000, 1000), to: at(45_000, 38_000), radius };
        let ring = Shape::Arc { arc: arc(at(9000, 0), at(9000, 0)), radius };
        let spiral = Shape::Arc { arc: arc(at(9000, 0), at(0, 9010)), radius };
        for shape in [stroke, ring, spiral] {
            let rects = stretches(&shape).expect("it is long");
            assert!(rects.len() > 10, "{shape:?} is long");
            let polygon = shape.polygon(Nm::new(100)).expect("it has an area");
            for &corner in polygon.contours().iter().flatten() {
                assert!(rects.iter().any(|rect| rect.contains(corner)), "{corner:?} of {shape:?} is held");
            }
            let area = |rect: &Rect| rect.width().to_mm() * rect.height().to_mm();
            let together: f64 = rects.iter().map(area).sum();
            assert!(together < area(&shape.bounds()) / 4.0, "{together} mm² hold {shape:?} closely");
        }
    }
}
