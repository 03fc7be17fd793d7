use super::super::block::Block;
use super::super::cell::Cell;
use super::super::half_plane::Cover;
use super::super::{Label, PixelPoint};
use super::{Reach, Stroke};

/// A point's distance.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Cone {
    apex: (i32, i32),
    stroke: Stroke,
}

/// Pixels in a step; a power of two, so that multiplying by it is exact.
const PIXEL: f32 = 1.0 / 256.0;

impl Cone {
    pub(in super::super) fn new(apex: PixelPoint, stroke: Stroke) -> Self {
        Self { apex: apex.raw(), stroke }
    }

    pub(super) fn reach(&self, cell: Cell) -> Option<Reach> {
        let (x, y) = cell.center();
        let (dx, dy) = (x - f64::from(self.apex.0) / 256.0, y - f64::from(self.apex.1) / 256.0);
        let distance = (dx * dx + dy * dy).sqrt();
        self.stroke.reach(distance, distance, 0.0, Cover::Whole, cell)
    }

    pub(super) fn draw(&self, label: Label, cover: Cover, block: &mut Block) {
        for mut row in block.rows() {
            let depth = self.along(row.y);
            if cover == Cover::Whole {
                row.draw(label, depth);
            } else {
                row.draw_part(label, &row.columns(), self.stroke.limit, depth);
            }
        }
    }

    /// The depth along the row at `y`, by the sample position.
    #[inline(always)]
    fn along(&self, y: i32) -> impl Fn(i32) -> f32 + Copy {
        let (apex, stroke) = (self.apex, self.stroke);
        let dy = float(y - apex.1);
        let dy2 = dy * dy;
        move |x| {
            let dx = float(x - apex.0);
            stroke.depth((dx * dx + dy2).sqrt() * PIXEL)
        }
    }
}

/// A difference of coordinates as a float: exact up to 65 536 pixels, beyond that rounded once.
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "rounded correctly, as the doc says")]
pub(super) fn float(steps: i32) -> f32 {
    steps as f32
}
