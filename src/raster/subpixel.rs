//! Coordinates of the pixel plane: 24.8 fixed point, as a GPU snaps its vertices.

/// A coordinate in the pixel plane: 24.8 fixed point, 256 steps a pixel, as a GPU snaps its
/// vertices.
///
/// # Range
///
/// Within ±(2³⁰ − 1) steps, about ±4.19 million pixels: then twice the area of any triangle fits an
/// `i64`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SubPx(i32);

impl SubPx {
    /// Steps in a pixel.
    pub const STEPS: i32 = 256;
    /// The largest coordinate.
    pub const MAX: Self = Self((1 << 30) - 1);
    /// The smallest coordinate.
    pub const MIN: Self = Self(1 - (1 << 30));

    /// The coordinate `raw` / 256 pixels.
    ///
    /// # Panics
    ///
    /// Where `raw` lies outside the range.
    #[must_use]
    pub const fn new(raw: i32) -> Self {
        assert!(Self::MIN.0 <= raw && raw <= Self::MAX.0, "a coordinate of the pixel plane is out of range");
        Self(raw)
    }

    /// The coordinate of a whole number of pixels.
    ///
    /// # Panics
    ///
    /// Beyond ±4 194 303 pixels.
    #[must_use]
    pub const fn from_pixels(pixels: i32) -> Self {
        assert!(pixels.unsigned_abs() < 1 << 22, "a coordinate of the pixel plane is out of range");
        Self::new(pixels * Self::STEPS)
    }

    /// The steps.
    #[must_use]
    pub const fn raw(self) -> i32 {
        self.0
    }

    /// The coordinate in pixels; exact.
    #[must_use]
    pub fn to_pixels(self) -> f64 {
        f64::from(self.0) / f64::from(Self::STEPS)
    }
}

/// A point of the pixel plane.
///
/// ```text
///  (0,0)──▶ x        pixel (column 2, row 1) is the square from (2,1) to (3,2)
///    │ ┌─┬─┬─┐       and is sampled at its centre, (2.5, 1.5)
///    ▼ ├─┼─┼─┤
///    y │ │ │·│
///      └─┴─┴─┘
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PixelPoint {
    /// To the right.
    pub x: SubPx,
    /// Downwards.
    pub y: SubPx,
}

impl PixelPoint {
    /// The point (`x`, `y`).
    #[must_use]
    pub const fn new(x: SubPx, y: SubPx) -> Self {
        Self { x, y }
    }

    /// The point at whole pixels (`x`, `y`).
    ///
    /// # Panics
    ///
    /// As [`SubPx::from_pixels`].
    #[must_use]
    pub const fn from_pixels(x: i32, y: i32) -> Self {
        Self { x: SubPx::from_pixels(x), y: SubPx::from_pixels(y) }
    }

    /// Both coordinates in steps.
    pub(super) const fn raw(self) -> (i32, i32) {
        (self.x.0, self.y.0)
    }
}

/// The sample position of a column or row, in steps.
pub(super) const fn sample(index: i32) -> i32 {
    index * SubPx::STEPS + SubPx::STEPS / 2
}
