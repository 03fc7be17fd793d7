//! A whole job: settings, and the pipeline as one short function.
//!
//! [`Options`] are what a person wrote, on the command line or in `voromill.toml`; [`Settings`] are
//! those and the defaults, complete and checked; [`mill`] does the work, in memory. Who calls it
//! decides what becomes a file.

mod area_choice;
mod art;
mod auto;
mod by_net;
mod cache_key;
mod carving;
mod checked;
mod choice;
mod clearing;
mod controller;
mod coupling;
mod cutting;
mod cutting_out;
mod describe;
mod described;
mod distance_for;
mod drilling;
mod effect;
mod error;
mod holding;
mod ignore;
mod inspect;
mod layer;
mod machine;
mod masking;
mod merge;
mod millproject;
pub mod names;
mod need;
mod neighbours;
mod numbering;
mod option_list;
mod options;
mod output_name;
mod overlap;
mod own_lines;
mod page;
mod paper;
mod part;
mod pipeline;
mod plain;
mod plan;
mod pocketing;
mod probing;
mod quantity;
mod reach;
mod rivet;
mod room;
mod settings;
mod settings_file;
mod show;
mod stock;
mod strategy_for;
mod tag;
mod tools;
mod turns;
mod validate;
mod verification;
mod workbench;
mod written;

pub use area_choice::{AreaChoice, ParseAreaChoiceError};
pub use art::{Art, OneTool};
pub use cache_key::cache_key;
pub use carving::{Carving, Engraving, Inlay, carve};
pub use choice::{DialectChoice, DrillSide, Narrow, Origin, Sites, Strategy, Topology};
pub use clearing::Clearing;
pub use coupling::coupling;
pub use cutting::Cutting;
pub use described::ParseDescribedError;
pub use distance_for::{DistanceFor, ParseDistanceForError};
pub use error::Error;
pub use holding::Holding;
pub use ignore::ignore;
pub use inspect::inspect;
pub use layer::Layer;
pub use machine::{ImportError, MachineChoice, ParsePerAxisError, PerAxis, Profile, READY, import_machine};
pub use masking::{Masking, mask};
pub use millproject::{MillProject, ProjectFiles};
pub use neighbours::neighbours;
pub use options::Options;
pub use output_name::{OutputName, ParseOutputNameError};
pub use overlap::{Overlap, ParseOverlapError};
pub use own_lines::{OwnLines, ParseOwnLinesError};
pub use paper::{paper, paper_picture, paper_program};
pub use part::Part;
pub use pipeline::{Job, mill, mill_side};
pub use plan::{Chosen, Tried};
pub use pocketing::{Pocket, Pocketing, pocket};
pub use probing::{ParseProbeGridError, ProbeGrid, Probing, probe};
pub use quantity::{
    Area, DrillChoice, Drills, Length, ParsePlaceError, ParseTilesError, ParseWaitError, Place, Tiles,
    ToolChangeAt, Triple, Wait,
};
pub use reach::Reach;
pub use rivet::rivet;
pub use settings::Settings;
pub use settings_file::{DEFAULTS, FILE_NAME, commented_defaults};
pub use strategy_for::{ParseStrategyForError, StrategyFor};
pub use tools::{Library, OwnTool, ToolChoice};
pub use turns::{ParseTurnsError, parse as turns};
pub use workbench::Workbench;
pub use written::Written;
