//! A rectangle of pixels: what bins and bounds speak of.

use super::subpixel::sample;

/// A rectangle of pixels, never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    /// The leftmost column.
    pub x: i32,
    /// The topmost row.
    pub y: i32,
    /// Columns.
    pub width: i32,
    /// Rows.
    pub height: i32,
}

impl Cell {
    /// The sample of its top left pixel, in steps.
    pub(super) const fn first(self) -> (i32, i32) {
        (sample(self.x), sample(self.y))
    }

    /// The sample of its bottom right pixel, in steps.
    pub(super) const fn last(self) -> (i32, i32) {
        (sample(self.x + self.width - 1), sample(self.y + self.height - 1))
    }

    /// The middle of its samples, in pixels; exact.
    pub(super) fn center(self) -> (f64, f64) {
        (f64::from(2 * self.x + self.width) / 2.0, f64::from(2 * self.y + self.height) / 2.0)
    }

    /// Half the width and height of the rectangle of its samples, in pixels; exact.
    pub(super) fn half_size(self) -> (f64, f64) {
        (f64::from(self.width - 1) / 2.0, f64::from(self.height - 1) / 2.0)
    }

    /// How far a sample lies from the middle at most, in pixels.
    pub(super) fn radius(self) -> f64 {
        let (x, y) = self.half_size();
        (x * x + y * y).sqrt()
    }
}
