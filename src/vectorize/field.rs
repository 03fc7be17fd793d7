//! Samples in rows, and which of them are inside.

/// Samples of a picture, row by row from the top.
///
/// # Guarantees
///
/// As many samples as width times height, at least one.
#[derive(Clone, Debug)]
pub struct Field {
    width: usize,
    height: usize,
    samples: Vec<u16>,
}

impl Field {
    /// The samples of a picture that is so many pixels wide; none where they are no rectangle.
    #[must_use]
    pub fn new(width: usize, samples: Vec<u16>) -> Option<Self> {
        let height = samples.len().checked_div(width)?;
        (height > 0 && height * width == samples.len()).then_some(Self { width, height, samples })
    }

    /// Pixels across.
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub const fn height(&self) -> usize {
        self.height
    }

    /// Pixels across and down.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a picture is less than 2¹⁶ pixels wide")]
    pub const fn size(&self) -> (f64, f64) {
        (self.width as f64, self.height as f64)
    }

    /// All samples.
    #[must_use]
    pub fn samples(&self) -> &[u16] {
        &self.samples
    }
}

/// What is inside: samples above a level, or those below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inside {
    /// What parts the two. Twice the value of a sample, so that no sample lies on it: odd.
    twice: i64,
    /// Whether the higher samples are inside.
    high: bool,
    /// How far those of the outside are from the level, as a rule.
    outside: i64,
}

impl Inside {
    /// What is above `level`, or below it unless `high`; `outside` is what a sample outside has.
    #[must_use]
    pub fn new(level: u16, high: bool, outside: u16) -> Self {
        let twice = i64::from(level) * 2 + 1;
        Self { twice, high, outside: (i64::from(outside) * 2 - twice).abs().max(1) }
    }

    /// How far a sample is inside; negative outside, never zero. Beyond the picture all is outside.
    #[must_use]
    pub fn depth(&self, field: &Field, x: i64, y: i64) -> i64 {
        let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else { return -self.outside };
        if x >= field.width || y >= field.height {
            return -self.outside;
        }
        let above = i64::from(field.samples[y * field.width + x]) * 2 - self.twice;
        if self.high { above } else { -above }
    }

    /// Whether the pixel at a position is inside.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "`as` saturates, and no picture is so large")]
    pub fn holds(&self, field: &Field, (x, y): (f64, f64)) -> bool {
        self.depth(field, x.floor() as i64, y.floor() as i64) > 0
    }
}
