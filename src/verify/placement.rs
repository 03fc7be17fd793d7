//! From machine coordinates back to the board, as the judge sees it.

use crate::board::Shape;
use crate::geometry::{Arc, Nm, Point, Rect, Vector};

/// How the board lies on the machine: turned about its own zero, moved, then (the back) mirrored
/// about a vertical line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placement {
    /// First: counter-clockwise, in degrees.
    pub degrees: f64,
    /// Then: moved.
    pub shift: Vector,
    /// Last: mirrored about the vertical line at this x of the machine.
    pub mirror: Option<Nm>,
}

impl Placement {
    /// The point of the board that lies at `p` on the machine.
    #[must_use]
    pub fn undo(&self, p: Point) -> Point {
        let moved = self.mirror.map_or(p, |axis| Point::new(axis * 2 - p.x, p.y)) + -self.shift;
        turned(moved, -self.degrees)
    }

    /// Where the point `p` of the board lies on the machine.
    #[must_use]
    pub fn apply(&self, p: Point) -> Point {
        let moved = turned(p, self.degrees) + self.shift;
        self.mirror.map_or(moved, |axis| Point::new(axis * 2 - moved.x, moved.y))
    }

    /// The placement that turns a board so, and lays the point of it that `zero` picks from the
    /// turned bounds on zero.
    pub(super) fn turned(degrees: f64, bounds: Rect, zero: impl Fn(Rect) -> Point) -> Self {
        let around = Rect::around(bounds.corners().map(|corner| turned(corner, degrees))).unwrap_or(bounds);
        let zero = zero(around);
        Self { degrees, shift: Vector::new(-zero.x, -zero.y), mirror: None }
    }

    /// An axis of the machine on the board.
    pub(super) fn undo_axis(&self, shape: Shape) -> Shape {
        match shape {
            Shape::Disc { center, radius } => Shape::Disc { center: self.undo(center), radius },
            Shape::Stroke { from, to, radius } => {
                Shape::Stroke { from: self.undo(from), to: self.undo(to), radius }
            }
            Shape::Arc { arc, radius } => {
                let turn = if self.mirror.is_some() { arc.turn.reversed() } else { arc.turn };
                let [start, end, center] = [arc.start, arc.end, arc.center].map(|p| self.undo(p));
                Shape::Arc { arc: Arc { start, end, center, turn }, radius }
            }
            Shape::Polygon(polygon) => Shape::Polygon(polygon),
        }
    }
}

/// A point turned about zero; exact for quarter turns.
pub(super) fn turned(p: Point, degrees: f64) -> Point {
    let (x, y) = p.to_f64();
    let (sin, cos) = match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => libm::sincos(other / 180.0 * std::f64::consts::PI),
    };
    Point::from_f64(x * cos - y * sin, x * sin + y * cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_turned_moved_and_mirrored_comes_back() {
        let shift = Vector::new(Nm::from_mm(5), Nm::from_mm(-2));
        let placement = Placement { degrees: 90.0, shift, mirror: Some(Nm::from_mm(10)) };
        // (3, 1) turns to (-1, 3), moves to (4, 1), mirrors to (16, 1).
        let back = placement.undo(Point::new(Nm::from_mm(16), Nm::from_mm(1)));
        assert_eq!(back, Point::new(Nm::from_mm(3), Nm::from_mm(1)), "the way back");
        assert_eq!(placement.apply(back), Point::new(Nm::from_mm(16), Nm::from_mm(1)), "and there again");
    }
}
