//! Exact plane geometry in integer nanometres.
//!
//! Everything that is not a pixel is an [`Nm`]: a whole number of nanometres within ±(2³⁰ − 1),
//! about a metre each way. The bound is what makes the rest exact: the difference of two
//! coordinates fits 31 bits, a cross or dot product of two differences fits an `i64`, so
//! orientation and containment are decided without rounding.
//!
//! ```text
//!        y ▲         x to the right, y up, as in Gerber;
//!          │  · p    angles counter-clockwise
//!          └────▶ x
//! ```
//!
//! Floats appear only in [`Arc`] flattening (through `libm`, so that every machine agrees) and are
//! rounded to the nanometre before they leave.

mod arc;
mod coarse;
mod edges;
mod index;
mod length;
mod nearest;
mod nm;
mod path;
mod point;
mod polygon;
mod spans;
mod tree;

pub use arc::{Arc, Circle, Turn};
pub(crate) use coarse::coarse;
pub(crate) use edges::Edges;
pub(crate) use index::{RectIndex, spanned};
pub use length::ParseLengthError;
pub(crate) use length::nanometres;
pub(crate) use nearest::{between, distance_to_segment, off_segment, part_nearest};
pub use nm::{Nm, RangeError};
pub use path::{Path, Segment};
pub(crate) use point::cross;
pub use point::{Orientation, Point, Rect, Vector, orientation};
pub use polygon::Polygon;
pub(crate) use polygon::twice_area;
pub(crate) use spans::merge;
pub(crate) use tree::{BoxTree, Met, Region};
