use super::super::block::Block;
use super::super::cell::Cell;
use super::super::half_plane::{Convex, Cover, HalfPlane};
use super::super::{Caps, Label, PixelPoint, Sides};
use super::cone::float;
use super::{Reach, Stroke};

/// A segment's distance.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Curtain {
    from: (i32, i32),
    to: (i32, i32),
    caps: Caps,
    sides: Sides,
    stroke: Stroke,
    /// The way from end to end in steps, and one over its squared length (0 for a point).
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
        let way = (float(to.0 - from.0), float(to.1 - from.1));
        let square = way.0 * way.0 + way.1 * way.1;
        let inverse = if square > 0.0 { 1.0 / square } else { 0.0 };
        Some(Self { from, to, caps, sides, stroke, way, inverse })
    }

    /// Where it hangs: between its ends unless they are round, on its sides.
    fn region(&self) -> Convex<3> {
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

    pub(super) fn reach(&self, cell: Cell) -> Option<Reach> {
        let (x, y) = cell.center();
        let (wx, wy) = (x * 256.0 - f64::from(self.from.0), y * 256.0 - f64::from(self.from.1));
        let (ux, uy) = (f64::from(self.way.0), f64::from(self.way.1));
        let t = ((wx * ux + wy * uy) * f64::from(self.inverse)).clamp(0.0, 1.0);
        let (ex, ey) = (wx - t * ux, wy - t * uy);
        let distance = (ex * ex + ey * ey).sqrt() / 256.0;
        let length = (ux.abs() + uy.abs()) / 256.0;
        let cover = if self.caps == Caps::Both && self.sides == Sides::Both {
            Cover::Whole
        } else {
            self.region().cover(cell)
        };
        self.stroke.reach(distance, distance, length, cover, cell)
    }

    pub(super) fn draw(&self, label: Label, cover: Cover, block: &mut Block) {
        if cover == Cover::Whole {
            for mut row in block.rows() {
                let depth = self.along(row.y);
                row.draw(label, depth);
            }
            return;
        }
        let region = self.region();
        for mut row in block.rows() {
            let columns = region.columns(row.y, row.columns());
            let depth = self.along(row.y);
            row.draw_part(label, &columns, self.stroke.limit, depth);
        }
    }

    /// The depth along the row at `y`, by the sample position.
    ///
    /// With w the way from the start to the sample and u the way along the segment, the nearest point lies at
    /// t = clamp(w·u / u·u, 0, 1), and the distance is |w − t u|.
    #[inline(always)]
    fn along(&self, y: i32) -> impl Fn(i32) -> f32 + Copy {
        let (from, (ux, uy), inverse, stroke) = (self.from.0, self.way, self.inverse, self.stroke);
        let wy = float(y - self.from.1);
        let wy_uy = wy * uy;
        move |x| {
            let wx = float(x - from);
            let t = (wx * ux + wy_uy) * inverse;
            let t = if t > 0.0 { t } else { 0.0 };
            let t = if t < 1.0 { t } else { 1.0 };
            let (ex, ey) = (wx - t * ux, wy - t * uy);
            stroke.depth((ex * ex + ey * ey).sqrt() * (1.0 / 256.0))
        }
    }
}
