//! Masks: one side of a board as ink on a page of its true size, for etching, lasers, UV light and
//! photoplotters.
//!
//! ```text
//!  copper, regions or openings ──▶ Sheet ──▶ placed: mirrored, stretched ──▶ bitmap   1-bit PNG
//!                                    │                                       drawing  SVG
//!                                    └── negative: what is not inked         page     PDF
//!                                                                            film     Gerber X2
//! ```
//!
//! A [`Sheet`] is a list of shapes for each net; every format writes the same shapes. Round shapes
//! stay round: SVG has arcs, Gerber has apertures and arcs, PDF has strokes with round ends whose
//! arcs are Bézier curves. What went through polygon booleans has its curves as chords: negatives
//! within [`FLATTEN`](crate::board::FLATTEN), a quarter of a micrometre, regions within a whole
//! one.

mod bitmap;
mod cut;
mod drawing;
mod film;
mod outline;
mod page;
mod placing;
mod sheet;

pub use bitmap::{bitmap, size as bitmap_size};
pub use drawing::drawing;
pub use film::film;
pub use page::page;
pub use placing::Placing;
pub use sheet::{InkedNet, Parted, Sheet, What, ground};
