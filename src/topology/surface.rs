//! Shapes of the board as the raster draws them.

use crate::board::Shape;
use crate::geometry::{Arc, Point, Turn};
use crate::grid::Grid;
use crate::raster::{Caps, FillRule, Sides, Spin, Surface};

/// The surface of `shape` on `grid`: flat where `limit` is zero, else the distance to it.
pub(crate) fn surface(shape: &Shape, grid: &Grid, limit: Option<f32>) -> Surface {
    grown(shape, grid, 0.0, limit)
}

/// The same of the shape grown by so many pixels; the inside of a polygon is as it is.
pub(crate) fn grown(shape: &Shape, grid: &Grid, by: f32, limit: Option<f32>) -> Surface {
    match shape {
        Shape::Disc { center, radius } => {
            Surface::Cone { apex: grid.pixel(*center), offset: grid.pixels(*radius) + by, limit }
        }
        Shape::Stroke { from, to, radius } => curtain(grid, [*from, *to], grid.pixels(*radius) + by, limit),
        Shape::Arc { arc, radius } => ring(grid, arc, grid.pixels(*radius) + by, limit),
        Shape::Polygon(polygon) => {
            let ring = |ring: &Vec<Point>| ring.iter().map(|&point| grid.pixel(point)).collect();
            let contours = polygon.contours().iter().map(ring).collect();
            Surface::Polygon { contours, rule: FillRule::NonZero, depth: 0.0 }
        }
    }
}

/// The distance to a line.
fn curtain(grid: &Grid, ends: [Point; 2], offset: f32, limit: Option<f32>) -> Surface {
    let [from, to] = ends.map(|end| grid.pixel(end));
    Surface::Curtain { from, to, caps: Caps::Both, sides: Sides::Both, offset, limit }
}

/// Arcs of which the ends are nearer to each other, in pixels, are drawn without telling the two
/// apart. Chosen: many times what ends are rounded by, and less than is seen.
const NEAR: f64 = 1.0 / 16.0;

/// The distance to an arc.
///
/// The rasterizer has an arc by its centre and its ends, which are rounded to parts of a pixel: one
/// that hardly goes round would become a circle, and one that hardly leaves a gap might become the
/// gap.
fn ring(grid: &Grid, arc: &Arc, offset: f32, limit: Option<f32>) -> Surface {
    let is_near = arc.start.distance(arc.end) < NEAR * grid.pitch().to_f64();
    if is_near && arc.start != arc.end && arc.sweep().abs() < std::f64::consts::PI {
        return curtain(grid, [arc.start, arc.end], offset, limit);
    }
    let start = grid.pixel(arc.start);
    Surface::Ring {
        center: grid.pixel(arc.center),
        start,
        end: if is_near { start } else { grid.pixel(arc.end) },
        // A turn is seen from above with y up, a spin with y down; both look the same.
        spin: match arc.turn {
            Turn::Clockwise => Spin::Clockwise,
            Turn::CounterClockwise => Spin::CounterClockwise,
        },
        caps: Caps::Both,
        offset,
        limit,
    }
}
