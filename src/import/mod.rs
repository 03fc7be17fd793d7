//! Files → [`Board`](crate::board::Board).
//!
//! ```text
//!  paths ─ archive ─▶ files ─ layers, jobfile, assign ─▶ roles ─ load ─▶ Board
//!                                                                 │
//!                              gerber, excellon, kicad, outline ──┤
//!                                 svg, dxf ─▶ Artwork ─ drawing ──┘
//! ```
//!
//! [`load()`] takes a folder, an archive or single files and puts a board together; the readers of
//! the formats stand alone and never touch the file system.
//! A [`picture`] of copper is a board by itself; of a drawing that is no board [`load_shapes`] has
//! what is milled.

mod advice;
mod archive;
mod assign;
mod build;
mod claims;
mod contradiction;
mod describe;
mod design;
pub mod diagnostic;
mod digest;
pub mod drawing;
mod drawing_board;
mod drawing_shapes;
mod error;
pub mod excellon;
mod format;
pub mod gerber;
mod gerber_drill;
mod jobfile;
pub mod kicad;
mod layers;
mod lists;
mod load;
mod naming;
mod off_board;
pub mod outline;
pub mod picture;
mod picture_board;
mod registration;
mod selection;
mod settle;
pub mod text;
mod unusable;
mod vote;
mod whole_board;

pub use build::Loaded;
pub use digest::sha256;
pub(crate) use digest::sha256_of;
pub use drawing::{dxf, svg};
pub use drawing_shapes::{Shapes, load_shapes};
pub use error::{Diagnosis, Error};
pub use format::{FORMATS, Format};
pub use load::{load, load_copper, survey};
pub use selection::Selection;
