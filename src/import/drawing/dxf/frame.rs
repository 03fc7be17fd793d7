//! From the coordinates of a block, or of an object that is looked at from behind, to the board.

use crate::geometry::Turn;
use crate::import::drawing::Place;

/// An affine map of the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// What it makes of one to the right and of one up.
    right: Place,
    up: Place,
    origin: Place,
}

impl Frame {
    /// So many nanometres a unit.
    pub(super) const fn scale(by: f64) -> Self {
        Self { right: (by, 0.0), up: (0.0, by), origin: (0.0, 0.0) }
    }

    /// The point `p` of the frame.
    pub(super) fn place(&self, p: Place) -> Place {
        let way = self.way(p);
        (self.origin.0 + way.0, self.origin.1 + way.1)
    }

    /// What it makes of a direction.
    pub(super) fn way(&self, (x, y): Place) -> Place {
        (self.right.0 * x + self.up.0 * y, self.right.1 * x + self.up.1 * y)
    }

    /// The same with x to the left: objects whose extrusion points away from the viewer.
    pub(super) fn mirrored(self) -> Self {
        Self { right: (-self.right.0, -self.right.1), ..self }
    }

    /// The frame of what is put at `at`, stretched by `scale` and turned by `angle` in degrees, the
    /// point `base` of it being put there.
    pub(super) fn inserted(&self, at: Place, scale: (f64, f64), angle: f64, base: Place) -> Self {
        let (sin, cos) = libm::sincos(angle.to_radians());
        let inner = Self {
            right: self.way((cos * scale.0, sin * scale.0)),
            up: self.way((-sin * scale.1, cos * scale.1)),
            origin: self.place(at),
        };
        let off = inner.way(base);
        Self { origin: (inner.origin.0 - off.0, inner.origin.1 - off.1), ..inner }
    }

    /// How much longer a length becomes, where that is the same in all directions.
    pub(super) fn similar(&self) -> Option<f64> {
        let (x, y) = (libm::hypot(self.right.0, self.right.1), libm::hypot(self.up.0, self.up.1));
        let dot = self.right.0 * self.up.0 + self.right.1 * self.up.1;
        let same = (x - y).abs() <= x.max(y) * 1e-9 && dot.abs() <= x * y * 1e-9;
        same.then_some(x)
    }

    /// How much longer a length becomes at most.
    pub(super) fn largest(&self) -> f64 {
        libm::hypot(libm::hypot(self.right.0, self.right.1), libm::hypot(self.up.0, self.up.1))
    }

    /// How much longer a length becomes on average.
    pub(super) fn mean(&self) -> f64 {
        (self.right.0 * self.up.1 - self.right.1 * self.up.0).abs().sqrt()
    }

    /// The way round that counter-clockwise becomes.
    pub(super) fn turn(&self) -> Turn {
        let cross = self.right.0 * self.up.1 - self.right.1 * self.up.0;
        if cross < 0.0 { Turn::Clockwise } else { Turn::CounterClockwise }
    }
}
