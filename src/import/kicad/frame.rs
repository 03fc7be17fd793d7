//! Where things of a board file lie: its axes point right and down, ours right and up.
//!
//! ```text
//!   in the file          on the board
//!   o──▶ x                 y ▲
//!   │                        │
//!   ▼ y                      o──▶ x
//! ```
//!
//! Angles run counter-clockwise, as seen, in both.

use crate::geometry::{Nm, Point};

/// A place and a direction in which other things are given.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    x: f64,
    y: f64,
    sin: f64,
    cos: f64,
}

impl Frame {
    /// The frame of the board, whose point (`x`, `y`) in the file is our origin.
    pub(super) fn board((x, y): (Nm, Nm)) -> Self {
        Self { x: -x.to_f64(), y: y.to_f64(), sin: 0.0, cos: 1.0 }
    }

    /// A frame at `origin`, turned by `degrees`.
    pub(super) fn at(origin: Point, degrees: f64) -> Self {
        let (x, y) = origin.to_f64();
        let (sin, cos) = sincos(degrees);
        Self { x, y, sin, cos }
    }

    /// The same, moved to `origin`.
    pub(super) const fn moved_to(self, origin: Point) -> Self {
        let (x, y) = origin.to_f64();
        Self { x, y, ..self }
    }

    /// Where the file's (`x`, `y`) lies.
    pub(super) fn place(&self, (x, y): (Nm, Nm)) -> Point {
        self.map(x.to_f64(), -y.to_f64())
    }

    /// Where (`x`, `y`) in nanometres with y up lies.
    pub(super) fn map(&self, x: f64, y: f64) -> Point {
        Point::from_f64(self.x + x * self.cos - y * self.sin, self.y + x * self.sin + y * self.cos)
    }
}

/// Sine and cosine; of quarter turns exactly.
pub(super) fn sincos(degrees: f64) -> (f64, f64) {
    const QUARTERS: [(f64, f64, f64); 4] =
        [(0.0, 0.0, 1.0), (90.0, 1.0, 0.0), (180.0, 0.0, -1.0), (270.0, -1.0, 0.0)];
    let turned = (degrees % 360.0 + 360.0) % 360.0;
    let quarter = QUARTERS.iter().find(|(angle, ..)| turned.total_cmp(angle).is_eq());
    quarter.map_or_else(|| libm::sincos(turned.to_radians()), |&(_, sin, cos)| (sin, cos))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> (Nm, Nm) {
        (Nm::new(x), Nm::new(y))
    }

    #[test]
    fn the_file_looks_down_and_turns_against_the_clock() {
        let board = Frame::board(at(100, 50));
        let origin = board.place(at(103, 51));
        assert_eq!(origin, Point::new(Nm::new(3), Nm::new(-1)), "y down becomes y up");
        let turned = Frame::at(origin, 90.0).place(at(10, 0));
        assert_eq!(turned, Point::new(Nm::new(3), Nm::new(9)), "what was to the right is above");
        let whole = Frame::at(origin, -360.0).place(at(10, 0));
        assert_eq!(whole, Point::new(Nm::new(13), Nm::new(-1)), "a whole turn is none");
    }
}
