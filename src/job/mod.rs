//! A whole job: settings, and the pipeline as one short function.
//!
//! [`Options`] are what a person wrote, on the command line or in `voromill.toml`; [`Settings`] are those and the
//! defaults, complete and checked; [`mill`] does the work, in memory. Who calls it decides what becomes a file.

mod cache_key;
mod describe;
mod error;
mod inspect;
mod layer;
mod options;
mod page;
mod paper;
mod pipeline;
mod quantity;
mod settings;
mod settings_file;
mod show;
mod verification;
mod written;

pub use cache_key::cache_key;
pub use error::Error;
pub use inspect::inspect;
pub use layer::Layer;
pub use options::{DialectName, Narrow, Options, Origin, ParseDialectError, Sites, Strategy, Topology};
pub use paper::paper;
pub use pipeline::{Job, mill};
pub use quantity::{Drills, Length};
pub use settings::Settings;
pub use settings_file::{DEFAULTS, FILE_NAME};
pub use written::{Part, Written};
