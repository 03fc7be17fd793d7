//! The ways to plan a [`Section`](super::Section), one file each.

mod bore;
mod cutout;
mod drill;
mod isolate;

pub use cutout::{Cutout, Tabs, cutout};
pub use drill::{Drilling, drill};
pub use isolate::{Isolation, Narrow, Role, isolate};
