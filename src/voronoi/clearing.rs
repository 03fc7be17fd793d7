//! Where all copper is cleared, and where none is but what isolates.
//!
//! ```text
//!    ╭───────────────╮      Passes go on from those beside every net, as far as there is room, where the axis of the cutter is in
//!    │   ▓▓▓   ┌─────┼──    what is to be cleared: areas, each a little larger, so that the nearest pass to every place of it is,
//!    │   ▓▓▓   │ kept│      and the regions of nets. In areas that are kept no pass runs, nor any that would reach into one.
//!    ╰─────────┴─────╯
//! ```

use rayon::prelude::*;

use crate::board::FLATTEN;
use crate::board::polarity::{offset, union};
use crate::geometry::{Nm, Polygon};
use crate::topology::NetId;

use super::Owner;
use super::clip::{Fence, Piece};

/// What is cleared beside the gaps round nets, and what is not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Clearing {
    /// The nets whose regions are cleared, rising.
    pub nets: Vec<NetId>,
    /// Where everything is cleared, on the board.
    pub areas: Vec<Polygon>,
    /// Where no pass clears anything, on the board: the cuts that isolate run there all the same.
    pub kept: Vec<Polygon>,
}

impl Clearing {
    /// Whether anything is cleared.
    #[must_use]
    pub const fn is_wanted(&self) -> bool {
        !self.nets.is_empty() || !self.areas.is_empty()
    }
}

/// Where the axis of a cutter may run while it clears.
pub(super) struct Zone<'a> {
    nets: &'a [NetId],
    areas: Option<Fence>,
    kept: Option<Fence>,
}

impl<'a> Zone<'a> {
    /// For a cutter of this kerf, the passes of which are no farther apart than `step`.
    pub(super) fn new(clearing: &'a Clearing, kerf: Nm, step: Nm) -> Self {
        let fence = |areas: &[Polygon], by: Nm| {
            let whole = union(areas);
            let grown: Vec<Polygon> = whole.par_iter().flat_map(|area| offset(area, by, FLATTEN)).collect();
            (!grown.is_empty()).then(|| Fence::around(&union(&grown)))
        };
        Self {
            nets: &clearing.nets,
            areas: fence(&clearing.areas, step / 2),
            kept: fence(&clearing.kept, kerf / 2),
        }
    }

    /// What of passes lies where anything may be cleared.
    pub(super) fn open(&self, pieces: Vec<Piece>) -> Vec<Piece> {
        match &self.kept {
            Some(kept) => pieces.into_par_iter().flat_map_iter(|piece| kept.parts(piece, false)).collect(),
            None => pieces,
        }
    }

    /// What of passes lies where everything is cleared.
    pub(super) fn cleared(&self, pieces: Vec<Piece>) -> Vec<Piece> {
        let (mut all, others): (Vec<Piece>, Vec<Piece>) =
            pieces.into_par_iter().partition(|piece| self.is_of_cleared_nets(piece));
        if let Some(areas) = &self.areas {
            all.par_extend(others.into_par_iter().flat_map_iter(|piece| areas.parts(piece, true)));
        }
        self.open(all)
    }

    /// What of passes lies elsewhere.
    pub(super) fn beside(&self, mut pieces: Vec<Piece>) -> Vec<Piece> {
        pieces.retain(|piece| !self.is_of_cleared_nets(piece));
        let open = self.open(pieces);
        match &self.areas {
            Some(areas) => open.into_par_iter().flat_map_iter(|piece| areas.parts(piece, false)).collect(),
            None => open,
        }
    }

    /// Whether the copper on one side of it is that of a net that is cleared.
    fn is_of_cleared_nets(&self, piece: &Piece) -> bool {
        let owners = [piece.left, piece.right].map(Owner::from_number);
        owners.iter().any(|owner| matches!(owner, Owner::Net(net) if self.nets.binary_search(net).is_ok()))
    }
}
