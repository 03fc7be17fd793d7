//! The surfaces, made ready to draw: for each where it reaches, and how deep it lies at a sample.

mod bounds;
mod cone;
mod curtain;
mod polygon;
mod ring;
mod stroke;
mod triangle;

pub(super) use bounds::Bounds;
pub(super) use cone::Cone;
pub(super) use curtain::Curtain;
pub(super) use polygon::{Part, Polygon};
pub(super) use ring::Ring;
pub(super) use stroke::{SLACK, Stroke};
pub(super) use triangle::Triangle;

use super::canvas::{Canvas, Extent, Field, position};
use super::cell::Cell;
use super::half_plane::{Convex, Cover};
use super::lanes::Lanes;
use super::mosaic::Mosaic;
use super::simd::Scalar;
use super::subpixel::sample;
use super::{Label, Surface};

/// A surface and whose it is.
#[derive(Clone, Debug)]
pub(super) struct Primitive {
    pub label: Label,
    pub shape: Shape,
}

/// A surface made ready to draw.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    Polygon(Polygon),
    Triangle(Triangle),
    Cone(Cone),
    Curtain(Curtain),
    Ring(Ring),
}

/// How deep a primitive lies in a cell: no fragment of it is nearer than `near`, and where it
/// covers the whole cell none is deeper than `far`, else that is infinite.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    pub near: f64,
    pub far: f64,
}

impl Shape {
    /// The surface made ready; none where it covers nothing.
    ///
    /// # Panics
    ///
    /// Where a depth, an offset or a limit is not finite.
    pub(super) fn new(surface: Surface) -> Option<Self> {
        match surface {
            Surface::Polygon { contours, rule, depth } => {
                Polygon::new(&contours, rule, depth).map(Self::Polygon)
            }
            Surface::Triangle { corners, depths } => Triangle::new(corners, depths).map(Self::Triangle),
            Surface::Cone { apex, offset, limit } => {
                Some(Self::Cone(Cone::new(apex, Stroke::new(offset, limit))))
            }
            Surface::Curtain { from, to, caps, sides, offset, limit } => {
                Curtain::new(from, to, caps, sides, Stroke::new(offset, limit)).map(Self::Curtain)
            }
            Surface::Ring { center, start, end, spin, caps, offset, limit } => {
                Some(Self::Ring(Ring::new(center, start, end, spin, caps, Stroke::new(offset, limit))))
            }
        }
    }

    /// How deep it lies in `cell`, where there is no formula for many; none where it has no
    /// fragment there.
    pub(super) fn reach(&self, cell: Cell) -> Option<Reach> {
        match self {
            Self::Triangle(triangle) => triangle.reach(cell),
            Self::Cone(_) | Self::Curtain(_) | Self::Ring(_) | Self::Polygon(_) => None,
        }
    }

    /// Has the mosaic sample it; false where it has no formula for many pieces at once.
    pub(super) fn weigh(&self, mosaic: &mut Mosaic) -> bool {
        match self {
            Self::Cone(cone) => mosaic.sample(cone, cone.stroke.offset, 0.0, cone.stroke.limit),
            Self::Curtain(curtain) => curtain.weigh(mosaic),
            Self::Ring(ring) => ring.weigh(mosaic),
            Self::Triangle(_) | Self::Polygon(_) => return false,
        }
        true
    }

    /// Draws it on the block of `canvas`, of which it covers what `cover` says; `first` where
    /// nothing is drawn there yet and it covers all. Polygons are drawn by their [`Part`]s instead.
    pub(super) fn draw(&self, label: Label, cover: Cover, first: bool, canvas: &mut Canvas) {
        match self {
            Self::Cone(cone) => lay(cone, label, cover, first, cone.stroke, &Convex([]), canvas),
            Self::Curtain(curtain) if cover == Cover::Whole => {
                lay(curtain, label, cover, first, curtain.stroke, &Convex([]), canvas);
            }
            Self::Curtain(curtain) => {
                lay(curtain, label, cover, first, curtain.stroke, &curtain.region(), canvas)
            }
            Self::Ring(ring) => ring.draw(label, cover, canvas),
            Self::Triangle(triangle) => triangle.draw(label, canvas),
            Self::Polygon(_) => {}
        }
    }

    /// Where it may have fragments, and how near.
    pub(super) fn bounds(&self) -> Bounds {
        match self {
            Self::Polygon(polygon) => polygon.bounds(),
            Self::Triangle(triangle) => triangle.bounds(),
            Self::Cone(cone) => cone.bounds(),
            Self::Curtain(curtain) => curtain.bounds(),
            Self::Ring(ring) => ring.bounds(),
        }
    }

    /// Its depth at a pixel, the very number that drawing gives it; none where it has no fragment
    /// there.
    pub(super) fn fragment(&self, column: i32, row: i32) -> Option<f32> {
        let depth = match self {
            Self::Polygon(polygon) => return polygon.fragment(column, row),
            Self::Triangle(triangle) => return triangle.fragment(column, row),
            Self::Cone(cone) => at(cone, column, row),
            Self::Curtain(curtain) if !curtain.covers(column, row) => return None,
            Self::Curtain(curtain) => at(curtain, column, row),
            Self::Ring(ring) => ring.depth_at(column, row),
        };
        (depth <= self.limit() && depth < f32::INFINITY).then_some(depth)
    }

    const fn limit(&self) -> f32 {
        match self {
            Self::Polygon(_) | Self::Triangle(_) => f32::INFINITY,
            Self::Cone(cone) => cone.stroke.limit,
            Self::Curtain(curtain) => curtain.stroke.limit,
            Self::Ring(ring) => ring.stroke.limit,
        }
    }

    /// Whether it may be drawn first on a block that has not been cleared, where it covers all of
    /// it.
    pub(super) const fn fills(&self) -> bool {
        matches!(self, Self::Cone(_) | Self::Curtain(_))
    }
}

/// What a field says to one pixel.
fn at<F: Field>(field: &F, column: i32, row: i32) -> f32 {
    let simd = Scalar;
    F::depth(field.columns(simd, Lanes::splat(simd, position(column))), Lanes::splat(simd, position(row)))
        .value
}

/// Lays a surface on the whole of a block or on the part of it that lies in `region`.
fn lay<const N: usize>(
    field: &impl Field,
    label: Label,
    cover: Cover,
    first: bool,
    stroke: Stroke,
    region: &Convex<N>,
    canvas: &mut Canvas,
) {
    if cover == Cover::Whole {
        canvas.lay(label, field, if first { Extent::First } else { Extent::Whole });
        return;
    }
    let (all, cell) = (canvas.padded_columns(), canvas.block());
    let mut columns = std::mem::take(&mut canvas.columns);
    columns.clear();
    columns.extend((cell.y..cell.y + cell.height).map(|row| region.columns(sample(row), all.clone())));
    canvas.lay(label, field, Extent::Part(&columns, stroke.limit));
    canvas.columns = columns;
}
