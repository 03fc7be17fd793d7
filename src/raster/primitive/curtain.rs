use pulp::Simd;

use super::super::block::Field;
use super::super::cell::Cell;
use super::super::half_plane::{Convex, Cover, HalfPlane};
use super::super::lanes::Lanes;
use super::super::{Caps, PixelPoint, Sides};
use super::cone::floats;
use super::stroke::StrokeLanes;
use super::{Bounds, Reach, Stroke};

/// A segment's distance.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Curtain {
    from: (i32, i32),
    to: (i32, i32),
    caps: Caps,
    sides: Sides,
    pub stroke: Stroke,
    /// Where it starts, and the way from end to end, in steps; one over its squared length (0 for a point).
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

    pub(super) fn reach(&self, cell: Cell) -> Option<Reach> {
        let (x, y) = cell.center();
        let (wx, wy) = (x * 256.0 - f64::from(self.from.0), y * 256.0 - f64::from(self.from.1));
        let (ux, uy) = (f64::from(self.way.0), f64::from(self.way.1));
        let t = ((wx * ux + wy * uy) * f64::from(self.inverse)).clamp(0.0, 1.0);
        let (ex, ey) = (wx - t * ux, wy - t * uy);
        let distance = (ex * ex + ey * ey).sqrt() / 256.0;
        self.stroke.reach(distance, distance, f64::from(self.size()), self.cover(cell), cell)
    }

    /// How its strip and round ends lie to `cell`.
    pub(super) fn cover(&self, cell: Cell) -> Cover {
        if self.caps == Caps::Both && self.sides == Sides::Both {
            Cover::Whole
        } else {
            self.region().cover(cell)
        }
    }

    /// No less than its length, in pixels.
    pub(super) fn size(&self) -> f32 {
        (self.way.0.abs() + self.way.1.abs()) / 256.0
    }
}

impl Field for Curtain {
    type Row<S: Simd> = CurtainRow<S>;

    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, y: f32) -> Self::Row<S> {
        let wy = y - self.start.1;
        let splat = |number| Lanes::splat(simd, number);
        CurtainRow {
            start: splat(self.start.0),
            wy: splat(wy),
            along: splat(wy * self.way.1),
            ux: splat(self.way.0),
            uy: splat(self.way.1),
            inverse: splat(self.inverse),
            zero: splat(0.0),
            one: splat(1.0),
            stroke: self.stroke.lanes(simd),
        }
    }

    /// With w the way from the start to the sample and u the way along the segment, the nearest point lies at
    /// t = clamp(w·u / u·u, 0, 1), and the distance is |w − t u|.
    #[inline(always)]
    fn depth<S: Simd>(row: Self::Row<S>, x: Lanes<S>) -> Lanes<S> {
        let wx = x - row.start;
        let t = ((wx * row.ux + row.along) * row.inverse).max(row.zero).min(row.one);
        let (ex, ey) = (wx - t * row.ux, row.wy - t * row.uy);
        row.stroke.depth((ex * ex + ey * ey).sqrt())
    }
}

/// What is constant in a row of a curtain.
#[derive(Clone, Copy)]
pub(in super::super) struct CurtainRow<S: Simd> {
    start: Lanes<S>,
    wy: Lanes<S>,
    /// The row's part of w·u.
    along: Lanes<S>,
    ux: Lanes<S>,
    uy: Lanes<S>,
    inverse: Lanes<S>,
    zero: Lanes<S>,
    one: Lanes<S>,
    stroke: StrokeLanes<S>,
}
