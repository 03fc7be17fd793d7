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
    /// Steps in a pixel. Chosen: 24.8 fixed point.
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

    /// The coordinate nearest to a number of pixels; halfway between two the one farther from zero.
    ///
    /// ```
    /// use voromill::raster::SubPx;
    ///
    /// assert_eq!(SubPx::from_f64(1.5).raw(), 384, "in 1/256");
    /// assert_eq!(SubPx::from_f64(-0.001).to_pixels(), 0.0, "the nearest");
    /// ```
    ///
    /// # Panics
    ///
    /// Where that lies outside the range.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "`as` saturates, beyond the range")]
    pub fn from_f64(pixels: f64) -> Self {
        assert!(!pixels.is_nan(), "a coordinate of the pixel plane is a number");
        Self::new((pixels * f64::from(Self::STEPS)).round() as i32)
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

    /// The point nearest to (`x`, `y`) in pixels.
    ///
    /// # Panics
    ///
    /// As [`SubPx::from_f64`].
    #[must_use]
    pub fn from_f64(x: f64, y: f64) -> Self {
        Self { x: SubPx::from_f64(x), y: SubPx::from_f64(y) }
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
