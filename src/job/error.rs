//! Why a job could not be done.

use crate::board::{Side, Words};
use crate::geometry::Nm;
use crate::grid::GridError;
use crate::import;
use crate::verify;
use crate::voronoi;

/// Why a job could not be done.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A settings file that cannot be read.
    #[error("{file}:{line}:{column}: {problem}")]
    Settings {
        /// Its name.
        file: String,
        /// From 1.
        line: usize,
        /// From 1, in characters.
        column: usize,
        /// What is wrong there.
        problem: String,
    },
    /// A setting whose value is invalid, by itself or beside another.
    #[error("{key}: {problem}")]
    Value {
        /// Its name on the command line.
        key: &'static str,
        /// What is wrong with it.
        problem: String,
    },
    /// Files that cannot be read.
    #[error(transparent)]
    Import(#[from] import::Error),
    /// Nothing to isolate.
    #[error("there is no copper {0}")]
    NoCopper(String),
    /// Nothing to carve or to pocket.
    #[error("nothing in it has an area: there is nothing to {0}")]
    NoArea(&'static str),
    /// Shapes so far from zero that they cannot be handled exactly.
    #[error("the shapes reach {reach:.1} mm from zero: expected at most {most:.1} mm")]
    Beyond {
        /// How far.
        reach: Nm,
        /// How far they may.
        most: Nm,
    },
    /// A file that was cut off: what it lost would be milled away, or left to join nets.
    #[error("{0}")]
    Truncated(String),
    /// A gap that the cut does not fit, where none may be so narrow.
    #[error("{0}")]
    Narrow(String),
    /// A side that cannot be isolated.
    #[error("{side}: {reason}")]
    Voronoi {
        /// Which.
        side: Side,
        /// Why.
        reason: voronoi::Error,
    },
    /// A picture that cannot be drawn.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A program that cannot be shown.
    #[error("cannot make the page: {0}")]
    Page(crate::gcode::ReadError),
    /// Programs that cannot be judged.
    #[error("cannot verify: {0}")]
    Verify(#[from] verify::Error),
}

impl Error {
    /// What to do about it; may be empty.
    #[must_use]
    pub fn hint(&self) -> Words {
        Words::of(match self {
            Self::Settings { file, .. } if !file.ends_with(".toml") => {
                "see docs/millproject.md for what is taken over, and how"
            }
            Self::Settings { .. } => "`voromill init` writes a file with every key and its default",
            Self::Value { .. } | Self::Import(_) => "",
            Self::Page(_) => "with {no-html} the programs are written without the page",
            Self::Verify(_) => "with {no-verify} the programs are written without verification",
            Self::NoCopper(_) => {
                "`voromill inspect` shows what was found; {front} and {back} choose the copper files"
            }
            Self::NoArea(_) => {
                "fill shapes, close their lines, or give lines a width; `voromill inspect` shows what was found"
            }
            Self::Beyond { .. } => {
                "give the unit of the file with {unit} if it is wrong; with {origin} center half as much lies to either side"
            }
            Self::Narrow(_) => {
                "use a narrower {tool} or less {depth}, raise a V-bit in narrow gaps with {adaptive-depth}, or allow it with {narrow} centre"
            }
            Self::Truncated(_) => {
                "plot or copy the file again; `voromill inspect` and `draw` show what is left of it"
            }
            Self::Voronoi { reason: voronoi::Error::NoCopper, .. } => {
                "`voromill inspect` shows what was read; {outline} chooses another outline"
            }
            Self::Voronoi { reason: voronoi::Error::Torn { .. }, .. } => {
                "report it with the board; until it is mended another {strategy} may do"
            }
            Self::Grid(_) => "choose a larger {pixel}, or a smaller {window}",
        })
    }
}
