//! Where all copper is cleared, and where none is but what isolates.
//!
//! ```text
//!    ╭───────────────╮      Passes go on from those beside every net, as far as there is room, where the axis of the cutter is in
//!    │   ▓▓▓   ┌─────┼──    what is to be cleared: areas, and the regions of nets. One pass runs along the edge of the areas, at
//!    │   ▓▓▓   │ kept│      which the others end: so it is as straight as what was asked for, half a kerf farther out. In areas
//!    ╰─────────┴─────╯      that are kept no pass runs, nor any that would reach into one; one runs round them.
//! ```

use rayon::prelude::*;

use crate::board::FLATTEN;
use crate::board::polarity::{offset, union};
use crate::geometry::{Nm, Polygon};
use crate::topology::NetId;
use crate::voronoi::clip::{Fence, Node, Piece};
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::Sample;
use crate::voronoi::{BACKGROUND, Owner};

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

/// Along an edge places no farther apart are looked at, in nanometres, and no nearer. Both chosen:
/// far below a kerf, and what no program can tell.
const STEP: f64 = 20_000.0;
const LEAST: f64 = 100.0;

/// Ways may begin and end so far within what is kept, in nanometres. Chosen: more than fitting may
/// take.
const END: f64 = 10_000.0;

/// What is known of the space that passes run in.
#[derive(Clone, Copy)]
pub(super) struct Room<'a> {
    /// How far copper is, in nanometres; within it zero.
    pub(super) clearance: &'a (dyn Fn(Spot) -> f64 + Sync),
    /// Whose region a place is in.
    pub(super) owner: &'a (dyn Fn(Spot) -> Option<NetId> + Sync),
    /// No pass comes nearer to copper.
    pub(super) nearest: f64,
    /// What is no farther from copper is cleared everywhere.
    pub(super) farthest: f64,
}

/// Where the axis of a cutter may run while it clears.
pub(super) struct Zone<'a> {
    nets: &'a [NetId],
    areas: Option<Fence>,
    kept: Option<Fence>,
}

impl<'a> Zone<'a> {
    /// For a cutter of this kerf.
    pub(super) fn new(clearing: &'a Clearing, kerf: Nm) -> Self {
        let fence = |areas: &[Polygon]| (!areas.is_empty()).then(|| Fence::around(areas));
        let kept = union(&clearing.kept);
        let kept: Vec<Polygon> = kept.par_iter().flat_map(|area| offset(area, kerf / 2, FLATTEN)).collect();
        Self { nets: &clearing.nets, areas: fence(&union(&clearing.areas)), kept: fence(&union(&kept)) }
    }

    /// Passes along the edges of areas that are cleared, and round those that are kept where it is
    /// cleared beside them, on `board`.
    pub(super) fn edges(&self, board: &Fence, room: &Room<'_>) -> Vec<Piece> {
        let Room { clearance, nearest, .. } = *room;
        let rings = |fence: &Option<Fence>| fence.iter().flat_map(Fence::rings).collect::<Vec<_>>();
        let round = |ring: &Vec<Spot>| along(ring, clearance, nearest, f64::INFINITY);
        let edges: Vec<Piece> = rings(&self.areas).par_iter().flat_map_iter(round).collect();
        let beside = |at: Spot| if self.is_cleared(at, room) { clearance(at) } else { 0.0 };
        // What is to be cleared ends anywhere.
        let round = |ring: &Vec<Spot>| along(ring, beside, nearest, STEP);
        let kept: Vec<Piece> = rings(&self.kept).par_iter().flat_map_iter(round).collect();
        let all = self.open(edges).into_par_iter().chain(kept);
        all.flat_map_iter(|piece| board.parts(piece, true)).collect()
    }

    /// What of the edge of `board` a pass may run along.
    pub(super) fn rims(&self, board: &Fence, room: &Room<'_>) -> Vec<Piece> {
        let round = |ring: &Vec<Spot>| along(ring, room.clearance, room.nearest, f64::INFINITY);
        self.open(board.rings().par_iter().flat_map_iter(round).collect())
    }

    /// Whether everything is cleared at a place.
    pub(super) fn is_cleared(&self, at: Spot, room: &Room<'_>) -> bool {
        (room.clearance)(at) <= room.farthest
            || self.areas.as_ref().is_some_and(|areas| areas.holds(at))
            || (room.owner)(at).is_some_and(|net| self.nets.binary_search(&net).is_ok())
    }

    /// What of passes lies where anything may be cleared.
    pub(super) fn open(&self, pieces: Vec<Piece>) -> Vec<Piece> {
        match &self.kept {
            Some(kept) => pieces.into_par_iter().flat_map_iter(|piece| kept.parts(piece, false)).collect(),
            None => pieces,
        }
    }

    /// Whether the straight way between two passes lies where anything may be cleared.
    pub(super) fn is_open(&self, a: Spot, b: Spot) -> bool {
        // Passes round what is kept are true to the tolerance of fitting alone.
        let end = (b - a) * (END / (b - a).length()).min(0.5);
        self.kept.as_ref().is_none_or(|kept| kept.is_beyond(a + end, b - end))
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

/// The parts of a closed line from which copper is no nearer than `nearest`; looked at in steps of
/// at most so many nanometres.
fn along(ring: &[Spot], clearance: impl Fn(Spot) -> f64, nearest: f64, longest: f64) -> Vec<Piece> {
    let sample = |at: Spot| Sample { at, clearance: clearance(at) };
    let is_open = |sample: &Sample| sample.clearance >= nearest;
    let mut runs: Vec<Vec<Sample>> = Vec::new();
    let mut last: Option<Sample> = None;
    let mut go = |next: Sample| {
        let before = last.replace(next).filter(|before| is_open(before) != is_open(&next));
        if let Some(before) = before {
            let (inner, outer) = if is_open(&next) { (next, before) } else { (before, next) };
            let edge = edge_of(inner, outer, sample, nearest);
            if is_open(&next) {
                runs.push(vec![edge]);
            } else if let Some(run) = runs.last_mut() {
                run.push(edge);
            }
        }
        if is_open(&next) {
            match runs.last_mut() {
                Some(run) => run.push(next),
                None => runs.push(vec![next]),
            }
        }
    };
    for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let length = (b - a).length();
        let mut part = 0.0;
        while part < length {
            let at = sample(a + (b - a) * (part / length));
            go(at);
            // Distances change no faster than the way goes.
            part += STEP.max((at.clearance - nearest).abs() / 2.0).min(longest);
        }
    }
    let Some(first) = ring.first().map(|&at| sample(at)) else { return Vec::new() };
    go(first);
    let is_whole = runs.len() == 1 && runs[0][0] == first && runs[0].last() == Some(&first);
    // What begins where the ring ends goes on there.
    if !is_whole && runs.len() > 1 && is_open(&first) {
        let mut end = runs.pop().unwrap_or_default();
        end.extend(runs[0].drain(1..));
        runs[0] = end;
    }
    let piece = |samples| Piece {
        left: BACKGROUND,
        right: BACKGROUND,
        samples,
        ends: (!is_whole).then_some([Node::END; 2]),
    };
    runs.into_iter().filter(|run| run.len() > 1).map(piece).collect()
}

/// Where between an open place and one that is not copper is as near as it may be.
fn edge_of(mut inner: Sample, outer: Sample, sample: impl Fn(Spot) -> Sample, nearest: f64) -> Sample {
    let mut outer = outer.at;
    while (outer - inner.at).length() > LEAST {
        let middle = sample(inner.at.midpoint(outer));
        if middle.clearance >= nearest {
            inner = middle;
        } else {
            outer = middle.at;
        }
    }
    inner
}
