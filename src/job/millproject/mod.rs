//! pcb2gcode's `millproject` files: what has a counterpart becomes [`Options`], the rest is listed
//! by name.
//!
//! A file holds `option = value` lines, `#` begins a comment. Bare numbers are inches and inches a
//! minute, or millimetres with `metric = true`; a number may carry its unit (pcb2gcode 2.5, its
//! `--help`). What the file does not say means what pcb2gcode means by it where a board would come
//! out otherwise (outlines instead of Voronoi regions, the back up for a board with copper there
//! alone, speeds halved for the plunge, half a cutter of overlap); else it is as if there were no
//! file.
//!
//! A value that has no counterpart and without which the board would be another one
//! (`invert-gerbers`, a depth above the surface) is an error with its line, unless the board has
//! nothing that it matters to. The rest is told of and left.

mod draft;
mod left;
mod together;
mod value;

use std::path::{Path, PathBuf};

use crate::board::Warning;

use super::own_lines::{OwnLines, ParseOwnLinesError};
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
    /// G-code of the user's own before and after each program.
    before: Option<OwnFile>,
    after: Option<OwnFile>,
    /// The options without a counterpart, each with its line.
    pub left: Vec<Warning>,
    /// The lines behind settings.
    said: Vec<Said>,
}

/// A file with G-code, and the line of a project that names it.
#[derive(Clone, Debug)]
struct OwnFile {
    path: PathBuf,
    line: usize,
}

impl OwnFile {
    fn new(entry: &Entry<'_>) -> Self {
        Self { path: PathBuf::from(entry.value), line: entry.line }
    }
}

/// A line of a project that says a setting of ours.
#[derive(Clone, Debug)]
struct Said {
    key: &'static str,
    file: String,
    line: usize,
    text: String,
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
    /// [`Error::Settings`] with the line, for what is no `option = value`, an option that pcb2gcode
    /// does not have, or a value that is none.
    pub fn read(file: &str, text: &str) -> Result<Self, Error> {
        let entries =
            value::entries(text).collect::<Result<Vec<_>, _>>().map_err(|wrong| wrong.into_error(file))?;
        let metric = entries.iter().rev().find(|entry| entry.name == "metric").map(Entry::flag);
        let metric = metric.transpose().map_err(|wrong| wrong.into_error(file))?.unwrap_or(false);
        let mut draft = Draft::new(if metric { Units::Metric } else { Units::Inches }, file);
        for entry in &entries {
            draft.take(entry).map_err(|wrong| wrong.into_error(file))?;
        }
        let mut made = draft.finish().map_err(|wrong| wrong.into_error(file))?;
        made.said = together::BEHIND
            .iter()
            .filter_map(|(key, names)| Some((*key, together::behind(names, &entries)?)))
            .map(|(key, entry)| Said {
                key,
                file: file.to_owned(),
                line: entry.line,
                text: format!("{} = {}", entry.name, entry.value),
            })
            .collect();
        Ok(made)
    }

    /// Takes over the G-code that `preamble` and `postamble` of the project `file` name, seen from
    /// `folder`.
    ///
    /// # Errors
    ///
    /// [`Error::Settings`] with the line, for a file that cannot be read, or whose lines cannot
    /// stand in a program.
    pub fn with_own_code(mut self, file: &str, folder: &Path) -> Result<Self, Error> {
        let read = |own: OwnFile| {
            let lines = OwnLines::read(&folder.join(&own.path));
            let wrong = |error: ParseOwnLinesError| Error::Settings {
                file: file.to_owned(),
                line: own.line,
                column: 1,
                problem: error.to_string(),
            };
            lines.map_err(wrong)
        };
        self.options.before = self.before.take().map(read).transpose()?;
        self.options.after = self.after.take().map(read).transpose()?;
        Ok(self)
    }

    /// An error of settings that this project said, with its line; as it is where the project did
    /// not say the setting.
    #[must_use]
    pub fn explain(&self, error: Error) -> Error {
        let Error::Value { key, problem } = &error else { return error };
        self.said.iter().find(|said| said.key == *key).map_or_else(
            || Error::Value { key, problem: problem.clone() },
            |Said { file, line, text, .. }| Error::Settings {
                file: file.clone(),
                line: *line,
                column: 1,
                problem: format!("`{text}`: {problem} (--{key})"),
            },
        )
    }
}
