//! The distance to a point, as a surface.

use super::super::PixelPoint;
use super::super::canvas::{Field, Slope};
use super::super::lanes::Lanes;
use super::super::simd::Simd;
use super::stroke::StrokeLanes;
use super::{Bounds, Stroke};

/// A point's distance.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Cone {
    /// In steps.
    apex: (f32, f32),
    place: (i32, i32),
    pub stroke: Stroke,
}

impl Cone {
    pub(in super::super) fn new(apex: PixelPoint, stroke: Stroke) -> Self {
        Self { apex: floats(apex.raw()), place: apex.raw(), stroke }
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds::curve([self.place], 0.0, self.stroke.offset, self.stroke.limit)
    }
}

impl Field for Cone {
    type Row<S: Simd> = (Lanes<S>, Lanes<S>, StrokeLanes<S>);

    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, y: f32) -> Self::Row<S> {
        let dy = y - self.apex.1;
        (Lanes::splat(simd, self.apex.0), Lanes::splat(simd, dy), self.stroke.lanes(simd))
    }

    #[inline(always)]
    fn depth<S: Simd>((apex, dy, stroke): Self::Row<S>, x: Lanes<S>) -> Lanes<S> {
        let dx = x - apex;
        stroke.depth((dx * dx + dy * dy).sqrt())
    }

    #[inline(always)]
    fn slope<S: Simd>((apex, dy, stroke): Self::Row<S>, x: Lanes<S>, _: Lanes<S>) -> Slope<S> {
        stroke.slope(x - apex, dy)
    }
}

/// A point in steps as floats: exact within 65 536 pixels of the origin, beyond that rounded once.
#[expect(clippy::cast_precision_loss, reason = "rounded correctly, as the doc says")]
pub(super) const fn floats(point: (i32, i32)) -> (f32, f32) {
    (point.0 as f32, point.1 as f32)
}
