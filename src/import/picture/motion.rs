//! A turn and a shift in the plane of the board.

use crate::geometry::Point;

/// A place, in nanometres.
pub(in crate::import) type Place = (f64, f64);

/// A turn and a shift: how a picture lies on the board, or one picture on another.
///
/// ```text
///  x' = x cos − y sin + dx
///  y' = x sin + y cos + dy
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::import) struct Motion {
    sin: f64,
    cos: f64,
    shift: Place,
}

impl Motion {
    /// The turn by so many radians, counter-clockwise, after which `from` lies at `to`.
    pub(super) fn new(radians: f64, from: Place, to: Place) -> Self {
        let (sin, cos) = libm::sincos(radians);
        let still = Self { sin, cos, shift: (0.0, 0.0) };
        let (x, y) = still.place(from);
        Self { shift: (to.0 - x, to.1 - y), ..still }
    }

    /// Where a place comes to lie.
    pub(in crate::import) fn place(&self, (x, y): Place) -> Place {
        (x * self.cos - y * self.sin + self.shift.0, x * self.sin + y * self.cos + self.shift.1)
    }

    /// The same, in whole nanometres.
    pub(super) fn point(&self, p: Point) -> Point {
        let (x, y) = self.place((p.x.to_f64(), p.y.to_f64()));
        Point::from_f64(x, y)
    }

    /// This motion after another one.
    pub(super) fn after(&self, first: Self) -> Self {
        Self {
            sin: self.sin * first.cos + self.cos * first.sin,
            cos: self.cos * first.cos - self.sin * first.sin,
            shift: self.place(first.shift),
        }
    }

    /// The turn in degrees, counter-clockwise.
    pub(in crate::import) fn degrees(&self) -> f64 {
        libm::atan2(self.sin, self.cos).to_degrees()
    }
}
