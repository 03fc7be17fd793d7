//! Shapes of the board as the raster draws them.

use crate::board::Shape;
use crate::geometry::{Point, Turn};
use crate::grid::Grid;
use crate::raster::{Caps, FillRule, Sides, Spin, Surface};

/// The surface of `shape` on `grid`: flat where `limit` is zero, else the distance to it.
pub(crate) fn surface(shape: &Shape, grid: &Grid, limit: Option<f32>) -> Surface {
    match shape {
        Shape::Disc { center, radius } => {
            Surface::Cone { apex: grid.pixel(*center), offset: grid.pixels(*radius), limit }
        }
        Shape::Stroke { from, to, radius } => Surface::Curtain {
            from: grid.pixel(*from),
            to: grid.pixel(*to),
            caps: Caps::Both,
            sides: Sides::Both,
            offset: grid.pixels(*radius),
            limit,
        },
        Shape::Arc { arc, radius } => Surface::Ring {
            center: grid.pixel(arc.center),
            start: grid.pixel(arc.start),
            end: grid.pixel(arc.end),
            // A turn is seen from above with y up, a spin with y down; both look the same.
            spin: match arc.turn {
                Turn::Clockwise => Spin::Clockwise,
                Turn::CounterClockwise => Spin::CounterClockwise,
            },
            caps: Caps::Both,
            offset: grid.pixels(*radius),
            limit,
        },
        Shape::Polygon(polygon) => {
            let ring = |ring: &Vec<Point>| ring.iter().map(|&point| grid.pixel(point)).collect();
            let contours = polygon.contours().iter().map(ring).collect();
            Surface::Polygon { contours, rule: FillRule::NonZero, depth: 0.0 }
        }
    }
}
