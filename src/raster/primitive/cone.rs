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
    type Columns<S: Simd> = ConeColumns<S>;

    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, x: Lanes<S>) -> Self::Columns<S> {
        let dx = x - Lanes::splat(simd, self.apex.0);
        let apex_y = Lanes::splat(simd, self.apex.1);
        ConeColumns { dx, dx2: dx * dx, apex_y, stroke: self.stroke.lanes(simd) }
    }

    #[inline(always)]
    fn depth<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        let dy = y - columns.apex_y;
        columns.stroke.depth((columns.dx2 + dy * dy).sqrt())
    }

    #[inline(always)]
    fn slope<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>, _: Lanes<S>) -> Slope<S> {
        columns.stroke.slope(columns.dx, y - columns.apex_y)
    }
}

/// What is constant in some columns of a cone.
#[derive(Clone, Copy)]
pub(in super::super) struct ConeColumns<S: Simd> {
    dx: Lanes<S>,
    dx2: Lanes<S>,
    apex_y: Lanes<S>,
    stroke: StrokeLanes<S>,
}

/// A point in steps as floats: exact within 65 536 pixels of the origin, beyond that rounded once.
#[expect(clippy::cast_precision_loss, reason = "rounded correctly, as the doc says")]
pub(super) const fn floats(point: (i32, i32)) -> (f32, f32) {
    (point.0 as f32, point.1 as f32)
}
