//! What is known of the roles of files, and what comes of it.

use super::layers::Role;
use super::selection::Need;
use crate::board::{Side, Warning};

/// Which of the gathered files is what, as indices.
#[derive(Debug, Default)]
pub(super) struct Assigned {
    pub(super) front: Option<usize>,
    pub(super) back: Option<usize>,
    pub(super) outline: Option<usize>,
    pub(super) drill: Vec<usize>,
    /// Layers that are not milled, with what they are.
    pub(super) aside: Vec<(usize, String)>,
    /// Files whose role a person chose.
    pub(super) by_hand: Vec<usize>,
    /// What the board is called.
    pub(super) name: String,
    /// Where it was looked for, for messages.
    pub(super) place: String,
    pub(super) warnings: Vec<Warning>,
    /// A copper layer whose side nothing tells, and which is taken for the front.
    pub(super) guessed: Option<usize>,
}

impl Assigned {
    /// Whether a file is taken as it is, whatever speaks against it: a person chose it, or the
    /// board is only looked at.
    pub(super) fn stands(&self, index: usize, need: Need) -> bool {
        need != Need::Job || self.by_hand.contains(&index)
    }
}

/// What is known of one file's role, and how well.
pub(super) struct Vote {
    pub(super) file: usize,
    pub(super) role: Option<Role>,
    /// The side that the witness tells, of a layer of any kind.
    pub(super) side: Option<Side>,
    pub(super) witness: Witness,
}

/// Who says so; a later one is believed before an earlier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Witness {
    /// The file's name.
    Name,
    /// Its X2 attribute.
    Function,
    /// The job file.
    Job,
}
