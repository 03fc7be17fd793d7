use pulp::Simd;

use super::super::cell::Cell;
use super::super::half_plane::Cover;
use super::super::lanes::Lanes;
use super::Reach;

/// How distance becomes depth: the half-width of a stroke and where it ends.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Stroke {
    pub offset: f32,
    /// Infinite where there is none.
    pub limit: f32,
}

/// How far, relative to the lengths that enter it, a computed distance may lie from the true one.
///
/// A fragment is off by a few roundings of 2⁻²⁴ each (see the module's doc); bounds of cells are kept 32 such
/// roundings wide of the truth.
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
        let [offset, pixel, zero] = [self.offset, PIXEL, 0.0].map(|number| Lanes::splat(simd, number));
        StrokeLanes { offset, pixel, zero }
    }

    /// What distances between `near` and `far` from the middle of `cell` mean for all of it; `size` is the
    /// largest length that entered their computation.
    pub(super) fn reach(self, near: f64, far: f64, size: f64, cover: Cover, cell: Cell) -> Option<Reach> {
        let offset = f64::from(self.offset);
        let margin = cell.radius() + (far + size + cell.radius() + offset.abs()) * f64::from(SLACK);
        let near = (near - margin - offset).max(0.0);
        let far = (far + margin - offset).max(0.0);
        let limit = f64::from(self.limit);
        if cover == Cover::Empty || near > limit {
            return None;
        }
        let cover = if far > limit { Cover::Part } else { cover };
        Some(Reach { near, far: if cover == Cover::Whole { far } else { f64::INFINITY }, cover })
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
}
