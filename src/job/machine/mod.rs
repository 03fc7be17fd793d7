//! Machines as people describe them: ready profiles, `[machine]` tables, and what a controller says
//! of itself.

mod dump;
mod per_axis;
mod profile;
mod ready;

pub use dump::{ImportError, import_machine};
pub use per_axis::{ParsePerAxisError, PerAxis};
pub(super) use profile::{KEYS, in_settings};
pub use profile::{MachineChoice, Profile};
pub use ready::READY;
