//! What a person can choose between.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::gcode::dialect::{Dialect, DialectError};
use crate::voronoi::paper::Way;

/// How copper is isolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strategy {
    /// One cut midway between neighbouring nets.
    Voronoi,
    /// A loop round each net.
    Outline,
    /// For each net whichever costs less machine time.
    Auto,
}

impl Strategy {
    /// Which of the paper's toolpaths that is.
    pub(super) const fn paper(self) -> Way {
        match self {
            Self::Outline => Way::Outline,
            Self::Voronoi | Self::Auto => Way::Voronoi,
        }
    }
}

/// What a cut is midway between.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sites {
    /// The copper's true edge.
    Copper,
    /// The axes it was drawn along (the paper).
    Core,
}

/// What is done where the gap is narrower than the cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Narrow {
    /// The cut stays in the middle and takes copper on both sides.
    Centre,
    /// The gap is left, and the nets joined.
    Skip,
    /// Nothing is made.
    Error,
}

/// The side that lies up while holes are drilled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DrillSide {
    /// As for the front.
    Front,
    /// Mirrored, as for the back.
    Back,
}

/// How touching copper is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Topology {
    /// Exact geometry.
    Contact,
    /// Shared end points and centres alone (the paper's Algorithm 1).
    Coincidence,
    /// Those and overlaps that show in a picture of 500 DPI (the paper's Algorithm 2).
    Translucency,
    /// All three, held against each other by `inspect`; the nets are those of exact geometry.
    All,
}

/// What the machine speaks: one of [`dialect::ALL`](crate::gcode::dialect::ALL), or one of one's
/// own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DialectChoice(pub Dialect);

/// A dialect that nobody knows, or whose description cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseDialectError {
    /// Neither a name nor a file.
    #[error("`{0}` is not a dialect: expected {known} or a file such as mine.toml", known = Dialect::names())]
    Unknown(String),
    /// A file that cannot be read.
    #[error("cannot read the dialect {file}: {reason}")]
    File {
        /// Its name.
        file: String,
        /// Why.
        reason: String,
    },
    /// A file that describes none.
    #[error("{file}: {reason}")]
    Content {
        /// Its name.
        file: String,
        /// Why.
        reason: DialectError,
    },
}

/// A name, or the path of a file that ends in `.toml`, as seen from the working directory.
impl FromStr for DialectChoice {
    type Err = ParseDialectError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if let Some(dialect) = Dialect::by_name(text) {
            return Ok(Self(dialect.clone()));
        }
        if !text.ends_with(".toml") {
            return Err(ParseDialectError::Unknown(text.to_owned()));
        }
        let file = || text.to_owned();
        let described = std::fs::read_to_string(text).map_err(|error| ParseDialectError::File {
            file: file(),
            reason: error.to_string().to_lowercase(),
        })?;
        let dialect = Dialect::from_toml(&described);
        dialect.map(Self).map_err(|reason| ParseDialectError::Content { file: file(), reason })
    }
}

/// Its name: where its file lies says nothing to who reads a program.
impl fmt::Display for DialectChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.name)
    }
}

/// Where x and y are zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// The board's lower left corner.
    LowerLeft,
    /// Where the files have it.
    Keep,
    /// The board's middle.
    Center,
}
