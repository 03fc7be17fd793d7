//! Levelling a program: adapting it to the surface that the machine really has.
//!
//! A sheet of copper lies a tenth of a millimetre higher here than there, as much as a cut is deep;
//! so machinists touch it in a grid of points before they cut. [`level()`] takes the [`HeightMap`]
//! of those touches and a program from any CAM, and adds the height of the surface to every z below
//! the height for travel. Between the points the surface is bilinear, as bCNC and OpenCNCPilot have
//! it, so a straight cut follows it on short straight pieces, and an arc on short helices: as few
//! as keep the tool within a given height of the surface. Whatever does not cut stays as it is, to
//! the letter: comments, tool changes, feeds, rapids above the board.
//!
//! ```text
//!   z ┄┄┄┄┄┄┄╮ safe: untouched    ╭┄┄┄
//!            ┆      ╭───╮         ┆
//!        ────┆──────╯   ╰─────────┆──── surface
//!            ╰──────╮   ╭─────────╯     the same depth below it everywhere
//!                   ╰───╯
//! ```
//!
//! Tried and left: splitting at every line of the grid and evenly between them is what others do,
//! and made programs three to ten times as long; splitting where the surface leaves the chord by
//! more than the tolerance (Douglas, Peucker 1973) makes a program on a gently curved sheet a
//! tenth longer.

mod course;
mod digit;
mod error;
mod format;
mod height_map;
mod leveller;
mod outlier;
mod touch;
mod words;

pub use error::{LevelError, MapError};
pub use format::{FORMATS, Format, Frame};
pub use height_map::HeightMap;
pub use leveller::{Levelled, Levelling, MARK, is_levelled, level};
pub use outlier::Outlier;
