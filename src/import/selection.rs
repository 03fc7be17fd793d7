//! What a person says of the files, and what a board must have.

use std::path::PathBuf;

use super::{drawing, picture};
use crate::geometry::Nm;

/// What a person says of the files, where names do not tell or tell wrong.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// The copper of the front.
    pub front: Option<PathBuf>,
    /// The copper of the back.
    pub back: Option<PathBuf>,
    /// The edge of the board.
    pub outline: Option<PathBuf>,
    /// The drill files; where any is given, no other is taken.
    pub drill: Vec<PathBuf>,
    /// Files and folders that are left aside, by name or by the end of their path.
    pub skip: Vec<PathBuf>,
    /// Whether no drill file is taken, whatever there is.
    pub no_drill: bool,
    /// What the board is called.
    pub name: Option<String>,
    /// How far apart two lines of the outline may end and still meet; where it is left open,
    /// [`outline::GAP`](super::outline::GAP).
    pub outline_gap: Option<Nm>,
    /// What is said of pictures.
    pub picture: picture::Options,
    /// What is said of drawings.
    pub drawing: drawing::Options,
}

/// What a board must have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Need {
    /// Something to be done, and no doubt about what.
    Job,
    AnyLayer,
}
