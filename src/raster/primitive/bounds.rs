//! Boxes around primitives, in pixels.

use super::stroke::SLACK;

/// Where primitives may have fragments, and how near: a box around their curves or areas, in
/// pixels.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Bounds {
    low: (f32, f32),
    high: (f32, f32),
    /// The least depth inside the box, of those that have fragments there only.
    flat: f32,
    /// The largest offset and limit of the distance surfaces; none where there are only flat ones.
    offset: f32,
    limit: f32,
}

impl Bounds {
    /// Of nothing.
    pub(in super::super) const NONE: Self = Self {
        low: (f32::INFINITY, f32::INFINITY),
        high: (f32::NEG_INFINITY, f32::NEG_INFINITY),
        flat: f32::INFINITY,
        offset: f32::NEG_INFINITY,
        limit: f32::NEG_INFINITY,
    };

    /// Of an area around `points` (in steps) that lies no nearer than `depth`.
    pub(super) fn flat(points: impl IntoIterator<Item = (i32, i32)>, depth: f32) -> Self {
        Self { flat: depth, ..Self::around(points, 0.0) }
    }

    /// Of a curve no farther than `reach` pixels from one of `points`' box.
    pub(super) fn curve(
        points: impl IntoIterator<Item = (i32, i32)>,
        reach: f32,
        offset: f32,
        limit: f32,
    ) -> Self {
        Self { offset, limit, ..Self::around(points, reach) }
    }

    fn around(points: impl IntoIterator<Item = (i32, i32)>, reach: f32) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "widened by more than the rounding")]
        let boxes = points.into_iter().map(|(x, y)| {
            let (x, y) = (x as f32 / 256.0, y as f32 / 256.0);
            let wide = |v: f32| reach + (v.abs() + reach + 1.0) * SLACK;
            Self { low: (x - wide(x), y - wide(y)), high: (x + wide(x), y + wide(y)), ..Self::NONE }
        });
        boxes.fold(Self::NONE, Self::union)
    }

    pub(in super::super) fn union(self, other: Self) -> Self {
        Self {
            low: (self.low.0.min(other.low.0), self.low.1.min(other.low.1)),
            high: (self.high.0.max(other.high.0), self.high.1.max(other.high.1)),
            flat: self.flat.min(other.flat),
            offset: self.offset.max(other.offset),
            limit: self.limit.max(other.limit),
        }
    }

    /// The middle of the box.
    pub(in super::super) fn center(&self) -> (f32, f32) {
        (f32::midpoint(self.low.0, self.high.0), f32::midpoint(self.low.1, self.high.1))
    }

    /// A depth that no fragment on the pixel is nearer than; none where there is no fragment.
    pub(in super::super) fn nearest(&self, column: i32, row: i32) -> Option<f32> {
        #[expect(clippy::cast_precision_loss, reason = "below 2¹⁷, so exact")]
        let (x, y) = (column as f32 + 0.5, row as f32 + 0.5);
        let beside = |low: f32, at: f32, high: f32| (low - at).max(at - high).max(0.0);
        let (dx, dy) = (beside(self.low.0, x, self.high.0), beside(self.low.1, y, self.high.1));
        let nearest = self.depth((dx * dx + dy * dy).sqrt());
        (nearest < f32::INFINITY).then_some(nearest)
    }

    /// A depth that no fragment in `count` rows of pixels from `first` on is nearer than; infinite
    /// where there is none.
    pub(in super::super) fn nearest_in_rows(&self, first: i32, count: i32) -> f32 {
        #[expect(clippy::cast_precision_loss, reason = "below 2¹⁷, so exact")]
        let (top, bottom) = (first as f32 + 0.5, (first + count) as f32 - 0.5);
        self.depth((self.low.1 - bottom).max(top - self.high.1).max(0.0))
    }

    /// A depth that no fragment so far from the box is nearer than.
    fn depth(&self, distance: f32) -> f32 {
        let slack = (distance + self.offset.abs()) * SLACK;
        let sloped =
            if self.limit >= 0.0 { (distance - slack - self.offset).max(0.0) } else { f32::INFINITY };
        let sloped = if sloped <= self.limit { sloped } else { f32::INFINITY };
        let flat = if distance > 0.0 { f32::INFINITY } else { self.flat };
        sloped.min(flat)
    }
}
