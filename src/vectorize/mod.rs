//! Pixels → contours: where a picture passes a level, as closed lines with sub-pixel accuracy, and
//! those as few straight lines as the pixels allow.
//!
//! ```text
//!  samples ─ level ─▶ two classes ─ trace ─▶ contours of many points ─ straighten ─▶ few corners
//! ```
//!
//! Positions are in pixels from the upper left corner of the picture, x to the right, y down; the
//! first sample lies at (½, ½). Nothing here knows what a pixel means.
//!
//! # Sources
//!
//! N. Otsu, *A threshold selection method from gray-level histograms*, IEEE Trans. SMC 9, 1979.
//! W. E. Lorensen, H. E. Cline, *Marching cubes*, SIGGRAPH 1987, in the plane; the saddle is
//! decided by the bilinear interpolant, as in G. Nielson, B. Hamann, *The asymptotic decider*,
//! 1991. P. Selinger, *Potrace: a polygon-based tracing algorithm*, 2003: few lines within half a
//! pixel of a staircase, corners where fitted lines meet.

mod field;
mod level;
mod straighten;
mod trace;

pub use field::{Field, Inside};
pub use level::{Level, level};
pub use straighten::{Edge, edges, straighten};
pub use trace::{Contour, contours};
