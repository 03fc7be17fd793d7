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
    /// Its part inside a picture of `width` × `height` pixels, none where they do not meet.
    pub(super) fn within(self, width: i32, height: i32) -> Option<Self> {
        let (x, y) = (self.x.max(0), self.y.max(0));
        let right = (self.x + self.width).min(width);
        let bottom = (self.y + self.height).min(height);
        (x < right && y < bottom).then(|| Self { x, y, width: right - x, height: bottom - y })
    }

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

    /// Its four quarters, in reading order, cut at multiples of `grain` from its corner; two or one where it is thin.
    pub(super) fn quarters(self, grain: i32) -> impl Iterator<Item = Self> {
        let split = |length: i32| {
            let cut = (length + 2 * grain - 1) / (2 * grain) * grain;
            if cut < length { [Some((0, cut)), Some((cut, length - cut))] } else { [Some((0, length)), None] }
        };
        let (columns, rows) = (split(self.width), split(self.height));
        rows.into_iter().flatten().flat_map(move |(down, height)| {
            columns.into_iter().flatten().map(move |(along, width)| Self {
                x: self.x + along,
                y: self.y + down,
                width,
                height,
            })
        })
    }
}
