//! The distance to a segment, as a surface.

use super::super::canvas::{Field, Slope};
use super::super::half_plane::{Convex, HalfPlane};
use super::super::lanes::Lanes;
use super::super::mosaic::Mosaic;
use super::super::simd::Simd;
use super::super::{Caps, PixelPoint, Sides};
use super::cone::floats;
use super::stroke::StrokeLanes;
use super::{Bounds, Stroke};

/// A segment's distance.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Curtain {
    from: (i32, i32),
    to: (i32, i32),
    caps: Caps,
    sides: Sides,
    pub stroke: Stroke,
    /// Where it starts, and the way from end to end, in steps; one over its squared length (0 for a
    /// point).
    start: (f32, f32),
    way: (f32, f32),
    inverse: f32,
}

impl Curtain {
    /// None where it covers nothing: a strip of no length without round ends.
    pub(in super::super) fn new(
        from: PixelPoint,
        to: PixelPoint,
        caps: Caps,
        sides: Sides,
        stroke: Stroke,
    ) -> Option<Self> {
        if from == to && caps == Caps::None {
            return None;
        }
        let (from, to) = (from.raw(), to.raw());
        let way = floats((to.0 - from.0, to.1 - from.1));
        let square = way.0 * way.0 + way.1 * way.1;
        let inverse = if square > 0.0 { 1.0 / square } else { 0.0 };
        Some(Self { from, to, caps, sides, stroke, start: floats(from), way, inverse })
    }

    /// Where it hangs: between its ends unless they are round, on its sides.
    pub(super) fn region(&self) -> Convex<3> {
        let (x, y) =
            (i64::from(self.to.0) - i64::from(self.from.0), i64::from(self.to.1) - i64::from(self.from.1));
        let start = (!self.caps.start()).then(|| HalfPlane::ahead(self.from, (x, y)));
        let end = (!self.caps.end()).then(|| HalfPlane::ahead(self.to, (-x, -y)));
        let side = match self.sides {
            Sides::Both => None,
            Sides::Left => Some(HalfPlane::clockwise(self.from, (-x, -y))),
            Sides::Right => Some(HalfPlane::clockwise(self.from, (x, y))),
        };
        Convex([start, end, side])
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds::curve([self.from, self.to], 0.0, self.stroke.offset, self.stroke.limit)
    }

    /// Whether a pixel lies in its strip or at a round end.
    pub(super) fn covers(&self, column: i32, row: i32) -> bool {
        self.region().holds(column, row)
    }

    /// Has the mosaic sample it.
    pub(super) fn weigh(&self, mosaic: &mut Mosaic) {
        let (offset, limit) = (self.stroke.offset, self.stroke.limit);
        let size = (self.way.0.abs() + self.way.1.abs()) / 256.0;
        if self.caps == Caps::Both && self.sides == Sides::Both {
            mosaic.sample(self, offset, size, limit);
        } else {
            mosaic.sample(&Hung(*self), offset, size, limit);
        }
    }
}

impl Field for Curtain {
    type Columns<S: Simd> = CurtainColumns<S>;

    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, x: Lanes<S>) -> Self::Columns<S> {
        let splat = |number| Lanes::splat(simd, number);
        let (wx, ux) = (x - splat(self.start.0), splat(self.way.0));
        CurtainColumns {
            wx,
            along: wx * ux,
            start_y: splat(self.start.1),
            ux,
            uy: splat(self.way.1),
            inverse: splat(self.inverse),
            zero: splat(0.0),
            one: splat(1.0),
            stroke: self.stroke.lanes(simd),
        }
    }

    /// With w the way from the start to the sample and u the way along the segment, the nearest
    /// point lies at t = clamp(w·u / u·u, 0, 1), and the distance is |w − t u|.
    #[inline(always)]
    fn depth<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        let (ex, ey) = columns.away(y);
        columns.stroke.depth((ex * ex + ey * ey).sqrt())
    }

    #[inline(always)]
    fn slope<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>, _: Lanes<S>) -> Slope<S> {
        let (ex, ey) = columns.away(y);
        columns.stroke.slope(ex, ey)
    }
}

/// What is constant in some columns of a curtain.
#[derive(Clone, Copy)]
pub(in super::super) struct CurtainColumns<S: Simd> {
    wx: Lanes<S>,
    /// The columns' part of w·u.
    along: Lanes<S>,
    start_y: Lanes<S>,
    ux: Lanes<S>,
    uy: Lanes<S>,
    inverse: Lanes<S>,
    zero: Lanes<S>,
    one: Lanes<S>,
    stroke: StrokeLanes<S>,
}

impl<S: Simd> CurtainColumns<S> {
    /// The way to the sample from the nearest point of the segment: w − t u.
    #[inline(always)]
    fn away(self, y: Lanes<S>) -> (Lanes<S>, Lanes<S>) {
        let wy = y - self.start_y;
        let t = ((self.along + wy * self.uy) * self.inverse).max(self.zero).min(self.one);
        (self.wx - t * self.ux, wy - t * self.uy)
    }
}

/// A curtain that does not cover everything: the same depth, and how far a place lies outside of
/// its region.
struct Hung(Curtain);

#[derive(Clone, Copy)]
struct HungColumns<S: Simd> {
    curtain: CurtainColumns<S>,
    /// One over the length, a pixel.
    scale: Lanes<S>,
    length: Lanes<S>,
    /// The columns' part of the cross product of the curtain's way and the way to the sample.
    across: Lanes<S>,
    /// 0 where a bound is there, else −∞, to be added to how far a place lies beyond it.
    start: Lanes<S>,
    end: Lanes<S>,
    left: Lanes<S>,
    right: Lanes<S>,
}

impl Field for Hung {
    type Columns<S: Simd> = HungColumns<S>;

    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, x: Lanes<S>) -> Self::Columns<S> {
        let (ux, uy) = self.0.way;
        let length = (ux * ux + uy * uy).sqrt();
        let splat = |number| Lanes::splat(simd, number);
        let bound = |there: bool| splat(if there { 0.0 } else { f32::NEG_INFINITY });
        let curtain = self.0.columns(simd, x);
        HungColumns {
            curtain,
            scale: splat(if length > 0.0 { 1.0 / (256.0 * length) } else { 0.0 }),
            length: splat(length / 256.0),
            across: curtain.wx * curtain.uy,
            start: bound(!self.0.caps.start()),
            end: bound(!self.0.caps.end()),
            left: bound(self.0.sides == Sides::Left),
            right: bound(self.0.sides == Sides::Right),
        }
    }

    #[inline(always)]
    fn depth<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        Curtain::depth(columns.curtain, y)
    }

    #[inline(always)]
    fn slope<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>, radius: Lanes<S>) -> Slope<S> {
        Curtain::slope(columns.curtain, y, radius)
    }

    #[inline(always)]
    fn beyond<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        let curtain = columns.curtain;
        let (wy, zero) = (y - curtain.start_y, curtain.zero);
        let along = (curtain.along + wy * curtain.uy) * columns.scale;
        let clockwise = (curtain.ux * wy - columns.across) * columns.scale;
        let ends = (zero - along + columns.start).max(along - columns.length + columns.end);
        let sides = (clockwise + columns.left).max(zero - clockwise + columns.right);
        ends.max(sides)
    }
}
