//! How a distance becomes a depth: the half-width and the limit of a surface.

use super::super::canvas::Slope;
use super::super::lanes::Lanes;
use super::super::simd::Simd;

/// How distance becomes depth: the half-width of a stroke and where it ends.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Stroke {
    pub offset: f32,
    /// Infinite where there is none.
    pub limit: f32,
}

/// How far, relative to the lengths that enter it, a computed distance may lie from the true one.
///
/// A fragment is off by a few roundings of 2⁻²⁴ each (see the module's doc); bounds of cells are
/// kept 32 such roundings wide of the truth.
pub(in super::super) const SLACK: f32 = 1.0 / 524_288.0;

/// Pixels in a step; a power of two, so that multiplying by it is exact.
const PIXEL: f32 = 1.0 / 256.0;

impl Stroke {
    /// # Panics
    ///
    /// Where a number is not finite.
    pub(in super::super) fn new(offset: f32, limit: Option<f32>) -> Self {
        assert!(offset.is_finite(), "an offset is a finite number of pixels");
        assert!(limit.is_none_or(f32::is_finite), "a limit is a finite number of pixels");
        Self { offset, limit: limit.unwrap_or(f32::INFINITY) }
    }

    /// The same for many distances at a time.
    #[inline(always)]
    pub(super) fn lanes<S: Simd>(self, simd: S) -> StrokeLanes<S> {
        StrokeLanes {
            offset: Lanes::splat(simd, self.offset),
            pixel: Lanes::splat(simd, PIXEL),
            zero: Lanes::splat(simd, 0.0),
        }
    }
}

/// A [`Stroke`] for many pixels at a time.
#[derive(Clone, Copy)]
pub(in super::super) struct StrokeLanes<S: Simd> {
    offset: Lanes<S>,
    pixel: Lanes<S>,
    zero: Lanes<S>,
}

impl<S: Simd> StrokeLanes<S> {
    /// The depth in pixels at a distance in steps. Equal numbers differ by +0, so no depth is −0.
    #[inline(always)]
    pub(super) fn depth(self, distance: Lanes<S>) -> Lanes<S> {
        (distance * self.pixel - self.offset).max(self.zero)
    }

    /// How the distance to a point lies, `ex` and `ey` steps away. As the nearest point of a convex
    /// curve it stands for the curve: the curve is nowhere nearer than the line across the way to
    /// it, nowhere farther than that point.
    #[inline(always)]
    pub(super) fn slope(self, ex: Lanes<S>, ey: Lanes<S>) -> Slope<S> {
        let distance = (ex * ex + ey * ey).sqrt() * self.pixel;
        // On the curve itself every way is as good as none, and the curve bends without bound.
        let curve = ex.all(1.0) / distance.max(ex.all(1e-9));
        let depth = distance - self.offset;
        let step = self.pixel * curve;
        Slope { near: depth, far: depth, way: (ex * step, ey * step), curve }
    }
}
