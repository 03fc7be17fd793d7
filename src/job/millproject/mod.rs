//! pcb2gcode's `millproject` files: what has a counterpart becomes [`Options`], the rest is listed by name.
//!
//! A file holds `option = value` lines, `#` begins a comment. Bare numbers are inches and inches a minute, or millimetres with
//! `metric = true`; a number may carry its unit (pcb2gcode 2.5, its `--help`). What the file does not say is as if there were no file: pcb2gcode's own
//! defaults (outlines instead of Voronoi regions, no bridges) are not taken over.

mod draft;
mod value;

use std::path::PathBuf;

use crate::board::Warning;

use super::{Error, Options};
use draft::Draft;
use value::{Entry, Units};

/// What a `millproject` says.
#[derive(Clone, Debug, Default)]
pub struct MillProject {
    /// Its options that have a counterpart.
    pub options: Options,
    /// The board's files, as seen from the folder of the project.
    pub files: ProjectFiles,
    /// What its outputs are called.
    pub name: Option<String>,
    /// The folder for its outputs, as seen from its own.
    pub output: Option<PathBuf>,
    /// The options without a counterpart, each with its line.
    pub left: Vec<Warning>,
}

/// The files a `millproject` names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProjectFiles {
    /// Front copper.
    pub front: Option<PathBuf>,
    /// Back copper.
    pub back: Option<PathBuf>,
    /// The outline.
    pub outline: Option<PathBuf>,
    /// Holes.
    pub drill: Option<PathBuf>,
}

impl MillProject {
    /// Reads the text of a project. `file` is its name, for errors and warnings.
    ///
    /// # Errors
    ///
    /// [`Error::Settings`] with the line, for what is no `option = value`, an option that pcb2gcode does not have, or a value that is none.
    pub fn read(file: &str, text: &str) -> Result<Self, Error> {
        let entries =
            value::entries(text).collect::<Result<Vec<_>, _>>().map_err(|wrong| wrong.into_error(file))?;
        let metric = entries.iter().rev().find(|entry| entry.name == "metric").map(Entry::flag);
        let metric = metric.transpose().map_err(|wrong| wrong.into_error(file))?.unwrap_or(false);
        let mut draft = Draft::new(if metric { Units::Metric } else { Units::Inches }, file);
        for entry in &entries {
            draft.take(entry).map_err(|wrong| wrong.into_error(file))?;
        }
        Ok(draft.finish())
    }
}
