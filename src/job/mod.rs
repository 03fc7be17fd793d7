//! A whole job: settings, and the pipeline as one short function.
//!
//! [`Options`] are what a person wrote, on the command line or in `voromill.toml`; [`Settings`] are those and the
//! defaults, complete and checked; [`mill`] does the work, in memory. Who calls it decides what becomes a file.

mod cache_key;
mod describe;
mod error;
mod ignore;
mod inspect;
mod layer;
mod options;
mod page;
mod paper;
mod pattern;
mod pipeline;
mod probing;
mod quantity;
mod settings;
mod settings_file;
mod show;
mod stock;
mod tools;
mod verification;
mod written;

pub use cache_key::cache_key;
pub use error::Error;
pub use inspect::inspect;
pub use layer::Layer;
pub use options::{DialectName, Narrow, Options, Origin, ParseDialectError, Sites, Strategy, Topology};
pub use paper::paper;
pub use pattern::Pattern;
pub use pipeline::{Job, mill};
pub use probing::{ParseProbeGridError, ProbeGrid, Probing, probe};
pub use quantity::{DrillChoice, Drills, Length, ParsePlaceError, ParseTilesError, Place, Tiles, Triple};
pub use settings::{Cutting, Holding, Settings};
pub use settings_file::{DEFAULTS, FILE_NAME};
pub use tools::{Library, OwnTool, ToolChoice, Workbench};
pub use written::{Part, Written};
