//! Drawings (SVG, DXF) → [`Artwork`](crate::artwork::Artwork), and drawings as layers of a board.
//!
//! A drawing tells by the names of its layers which of them are copper, edge and holes, in the
//! words that Gerber files have; or a person tells, with `--front x.svg` for all of a drawing or
//! `--front x.svg#Layer` for one layer of it. Where neither does, what covers an area is copper,
//! and bare lines are the edge and its holes.

mod contour;
pub mod dxf;
mod layers;
mod read;
mod roles;
mod sheet;
pub mod svg;
mod unit;

pub(in crate::import) use contour::{Contour, Place};
pub(in crate::import) use read::split;
pub use read::{FORMATS, Format, file_of, looks_like, open, read};
pub(in crate::import) use roles::{Part, Parts, layer, leaves, role_of};
pub use sheet::{Drawing, Options};
pub use unit::Unit;
