//! Where nanometres meet pixels: the only crossing between the board's plane and the raster's.
//!
//! ```text
//!   board (nm)                       picture (pixels)
//!   y ▲                              0,0 ┌──┬──┬──┐ ─▶ column
//!     │   ┌────────┐  ◀─ top             │ ·│ ·│ ·│      · a pixel samples its centre,
//!     │   │        │                     ├──┼──┼──┤        at (column + ½, row + ½)
//!     │   └────────┘                     │ ·│ ·│ ·│
//!     │   ▲ left                         └──┴──┴──┘
//!     └──────────────▶ x                 │
//!                                        ▼ row
//! ```
//!
//! The y axis turns over: row 0 is the top. A position goes to the nearest 1/256 pixel, half away
//! from zero; a pixel's corner comes back without rounding. The board's coordinates are whole
//! nanometres and so is the pitch, so a picture of 500 DPI has pixels of exactly 50.8 µm.

use crate::geometry::{Nm, Point, Rect};
use crate::raster::{PixelPoint, SubPx};

/// The smallest pitch: below it, the far end of the coordinate range would not fit the fixed point
/// of the raster.
pub const FINEST: Nm = Nm::from_um(1);

/// The largest picture in either direction, in pixels.
pub const LARGEST: u32 = 1 << 16;

/// A picture's place on the board.
///
/// # Guarantees
///
/// The pitch is at least [`FINEST`]; width and height are within 1..=[`LARGEST`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    left: Nm,
    top: Nm,
    pitch: Nm,
    width: u32,
    height: u32,
}

/// Why a rectangle cannot be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// The pixels are too small.
    #[error("a pixel of {0:.6} mm is too fine: the smallest is 0.001 mm")]
    TooFine(Nm),
    /// The picture is too large.
    #[error(
        "{columns} × {rows} pixels are too many: at most 65536 each way, and 134 million in a picture; \
         use larger pixels"
    )]
    TooLarge {
        /// Pixels across.
        columns: i64,
        /// Pixels down.
        rows: i64,
    },
}

impl Grid {
    /// The grid of pixels of `pitch` that covers `rect`, from its upper left corner; at least one
    /// pixel.
    ///
    /// # Errors
    ///
    /// [`GridError`] for a pitch below [`FINEST`] or a picture beyond [`LARGEST`].
    pub fn covering(rect: Rect, pitch: Nm) -> Result<Self, GridError> {
        if pitch < FINEST {
            return Err(GridError::TooFine(pitch));
        }
        let count =
            |extent: Nm| extent.get().div_euclid(pitch.get()) + i64::from(extent.get() % pitch.get() != 0);
        let (columns, rows) = (count(rect.width()).max(1), count(rect.height()).max(1));
        let fits = |n: i64| u32::try_from(n).ok().filter(|&n| n <= LARGEST);
        let (Some(width), Some(height)) = (fits(columns), fits(rows)) else {
            return Err(GridError::TooLarge { columns, rows });
        };
        Ok(Self { left: rect.min().x, top: rect.max().y, pitch, width, height })
    }

    /// `height` of its rows from row `top` on, as a picture of their own: the same pixels.
    #[must_use]
    pub fn rows(&self, top: u32, height: u32) -> Self {
        self.part((0, top), self.width, height)
    }

    /// Which row of `whole`, of which it is a part, is its first.
    #[must_use]
    pub fn first_row(&self, whole: &Self) -> u32 {
        u32::try_from((whole.top - self.top).get() / self.pitch.get()).expect("a part of it")
    }

    /// `width` by `height` of its pixels from a column and row on, as a picture of their own.
    #[must_use]
    pub fn part(&self, (column, row): (u32, u32), width: u32, height: u32) -> Self {
        let corner = self.corner(i64::from(column), i64::from(row));
        Self { left: corner.x, top: corner.y, width: width.max(1), height: height.max(1), ..*self }
    }

    /// Pixels across.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The side of a pixel.
    #[must_use]
    pub const fn pitch(&self) -> Nm {
        self.pitch
    }

    /// The area covered: at least what was asked for.
    #[must_use]
    pub fn rect(&self) -> Rect {
        let lower_right = Point::new(
            self.left + self.pitch * i64::from(self.width),
            self.top - self.pitch * i64::from(self.height),
        );
        Rect::new(Point::new(self.left, self.top), lower_right)
    }

    /// The position of `p` in the picture, to the nearest 1/256 pixel.
    #[must_use]
    pub fn pixel(&self, p: Point) -> PixelPoint {
        PixelPoint { x: self.subpixels(p.x - self.left), y: self.subpixels(self.top - p.y) }
    }

    /// A length in pixels.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "rounding to the depth format is what is wanted")]
    pub fn pixels(&self, length: Nm) -> f32 {
        (length.to_f64() / self.pitch.to_f64()) as f32
    }

    /// The place of the corner above and to the left of pixel (`column`, `row`), in nanometres;
    /// exact.
    #[must_use]
    pub fn corner(&self, column: i64, row: i64) -> Point {
        Point::new(self.left + self.pitch * column, self.top - self.pitch * row)
    }

    /// The place of the centre of pixel (`column`, `row`), rounded down to whole nanometres.
    #[must_use]
    pub fn center(&self, column: i64, row: i64) -> Point {
        let half = self.pitch / 2;
        let corner = self.corner(column, row);
        Point::new(corner.x + half, corner.y - half)
    }

    fn subpixels(&self, length: Nm) -> SubPx {
        let pitch = self.pitch.get();
        let scaled = length.get() * 512;
        let rounded = (scaled + if scaled < 0 { -pitch } else { pitch }) / (2 * pitch);
        SubPx::new(
            i32::try_from(rounded).expect("the range of Nm over the finest pitch fits 24.8 fixed point"),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn row_zero_is_on_top() {
        let grid = Grid::covering(Rect::new(at(0, 0), at(100, 50)), Nm::from_um(10)).expect("a small grid");
        assert_eq!((grid.width(), grid.height()), (10, 5), "one pixel each 10 µm");
        let top_left = grid.pixel(at(0, 50));
        assert_eq!((top_left.x, top_left.y), (SubPx::new(0), SubPx::new(0)), "the upper left corner");
        assert_eq!(grid.pixel(at(5, 45)).x, SubPx::new(128), "the centre of the first pixel");
        assert_eq!(grid.center(0, 0), at(5, 45), "and back");
    }

    #[test]
    fn rows_are_the_same_pixels() {
        let grid = Grid::covering(Rect::new(at(0, 0), at(100, 50)), Nm::from_um(10)).expect("a small grid");
        let band = grid.rows(2, 3);
        assert_eq!((band.width(), band.height()), (10, 3), "as wide, and as many rows as asked for");
        assert_eq!(band.center(4, 0), grid.center(4, 2), "its first row is the third of the whole");
    }

    #[test]
    fn a_part_of_a_pixel_is_a_pixel() {
        let grid = Grid::covering(Rect::new(at(0, 0), at(101, 50)), Nm::from_um(10)).expect("a small grid");
        assert_eq!(grid.width(), 11, "the last pixel hangs over");
    }

    #[test]
    fn extremes_are_refused() {
        let board = Rect::new(at(0, 0), at(500_000, 500_000));
        assert!(matches!(Grid::covering(board, Nm::new(999)), Err(GridError::TooFine(_))), "too fine");
        assert!(
            matches!(Grid::covering(board, Nm::from_um(5)), Err(GridError::TooLarge { .. })),
            "too large"
        );
    }
}
