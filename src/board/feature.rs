use crate::geometry::{Arc, Nm, Point, Polygon, Rect};

/// The copper of one feature, its edge included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// All points within `radius` of `center`.
    Disc {
        /// The middle.
        center: Point,
        /// Half the diameter; zero for a point.
        radius: Nm,
    },
    /// All points within `radius` of the line from `from` to `to`: a round aperture drawn along it, or an obround.
    Stroke {
        /// One end of the axis.
        from: Point,
        /// The other end; not `from`.
        to: Point,
        /// Half the width; zero for a bare line.
        radius: Nm,
    },
    /// All points within `radius` of an arc: a round aperture drawn along it.
    Arc {
        /// The axis.
        arc: Arc,
        /// Half the width; zero for a bare arc.
        radius: Nm,
    },
    /// Anything else: rectangles, regions, macros, and what clear polarity left. Curves are flattened within
    /// [`FLATTEN`](super::FLATTEN).
    Polygon(Polygon),
}

impl Shape {
    /// A rectangle that holds it.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        match self {
            Self::Disc { center, radius } => Rect::new(*center, *center).inflate(*radius),
            Self::Stroke { from, to, radius } => Rect::new(*from, *to).inflate(*radius),
            Self::Arc { arc, radius } => arc.bounds().inflate(*radius),
            Self::Polygon(polygon) => polygon.bounds(),
        }
    }
}

/// How a feature was drawn: the paper's vertices and approximate core medial axis (§III-A.1, III-D).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// An aperture flashed at a point.
    Flash(Point),
    /// An aperture drawn along a line; both ends may be the same point.
    Line(Point, Point),
    /// An aperture drawn along an arc.
    Arc(Arc),
    /// A region (G36/G37): the outline itself is all there is.
    Region,
}

/// A piece of copper with what is known of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Feature {
    /// The area it covers.
    pub shape: Shape,
    /// How it was drawn. Pieces that clear polarity cut from one feature all carry its axis.
    pub axis: Axis,
    /// The index of its attribute set in [`Copper::attributes`](super::Copper::attributes).
    pub attributes: u32,
    /// The line of the file that drew it, from 1.
    pub line: u32,
}
