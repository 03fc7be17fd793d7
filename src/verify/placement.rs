use crate::board::Shape;
use crate::geometry::{Arc, Nm, Point, Vector};

/// How the board lies on the machine: moved, then (the back) mirrored about a vertical line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Placement {
    /// First: added to the board's coordinates.
    pub shift: Vector,
    /// Then: mirrored about the vertical line at this x of the machine.
    pub mirror: Option<Nm>,
}

impl Placement {
    /// The point of the board that lies at `p` on the machine.
    #[must_use]
    pub fn undo(&self, p: Point) -> Point {
        self.mirror.map_or(p, |axis| Point::new(axis * 2 - p.x, p.y)) + -self.shift
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
