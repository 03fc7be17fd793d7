//! Toolpath ↔ text.
//!
//! [`write()`] puts a [`Program`](crate::toolpath::Program) into the words of a [`Dialect`], which
//! is data, so it cannot get the motion wrong. [`read()`] is the other way, from the specification,
//! for programs from any CAM; the two share no code, so that reading back what was written says
//! something. [`level()`](level::level) adapts a text to a surface that was probed before.

pub mod dialect;
mod header;
pub mod level;
pub mod paper;
mod probe;
pub mod read;
mod write;

pub use dialect::Dialect;
pub use header::{Header, Input};
pub use probe::{ProbeError, Touching, write_probe};
pub use read::{ReadError, read};
pub use write::write;
