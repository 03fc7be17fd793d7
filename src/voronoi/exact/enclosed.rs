//! Free space that one owner alone encloses: where there is nothing to be parted.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓        What lies above a level falls into parts. A part is one piece of the
//!   ▓▓ ╭──────╮ ▓▓ ╭────────      medial axis, for the axis of connected space is connected; and who
//!   ▓▓ │one A │ ▓▓ │ A and B      encloses the part is whose edges that piece runs between.
//!   ▓▓ ╰──────╯ ▓▓ ╰────────
//!   ▓▓▓▓▓▓ A ▓▓▓▓▓   ▓▓ B ▓▓
//! ```

use crate::topology::DisjointSets;
use crate::voronoi::plane::Spot;

use super::Diagram;
use super::chain::Chain;
use super::level::Crossings;

/// Who encloses a part of the space above a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Around {
    Nobody,
    One(u32),
    Several,
}

impl Around {
    const fn and(self, owner: u32) -> Self {
        match self {
            Self::Nobody => Self::One(owner),
            Self::One(known) if known == owner => self,
            Self::One(_) | Self::Several => Self::Several,
        }
    }
}

/// The parts of the space above a level.
pub(super) struct Parts {
    /// The part of each vertex, then of each crossing.
    part: Vec<u32>,
    around: Vec<Around>,
}

impl Parts {
    /// Whether a vertex above the level, or a crossing behind all vertices, lies in a part that one
    /// owner alone encloses.
    pub(super) fn is_enclosed(&self, place: u32) -> bool {
        self.around[self.part[place as usize] as usize] != Around::Several
    }
}

/// The space above a level, and which of it one owner alone encloses.
pub(in crate::voronoi) struct Above {
    crossings: Crossings,
    parts: Parts,
}

impl Diagram {
    /// The space above a level, in nanometres.
    pub(in crate::voronoi) fn above(&self, level: f64) -> Above {
        let crossings = self.crossings(level);
        let parts = self.parts_above(&crossings);
        Above { crossings, parts }
    }

    /// Whether a place on an edge above a level, or where the edge crosses it, lies where one owner
    /// alone encloses the space above it.
    pub(in crate::voronoi) fn is_enclosed(&self, (edge, place): (u32, Spot), above: &Above) -> bool {
        let begin = self.edges[edge as usize].from;
        // Edges turn by less than half a turn: who goes along one goes away from its beginning. The
        // crossing behind a place above the level is where the clearance rises to it.
        let way = |at: Spot| (at - self.sample_at(begin).at).length();
        let is_behind = |&crossing: &usize| way(above.crossings.at(crossing)) <= way(place);
        let risen = above.crossings.of(edge).take_while(is_behind).last();
        above.parts.is_enclosed(risen.map_or(begin, |crossing| self.node(crossing)))
    }

    /// The curves where copper is `level` nanometres away, cut where owners meet, with copper on
    /// their left and `nobody` on their right; with `open`, which is no higher, not those of parts
    /// of that space that one owner alone encloses. None where the graph contradicts itself.
    pub(in crate::voronoi) fn curves_at(
        &self,
        level: f64,
        nobody: u32,
        open: Option<&Above>,
    ) -> Option<Vec<Chain>> {
        let crossings = self.crossings(level);
        let is_enclosed = |place: u32, open: &Above| match (place as usize).checked_sub(self.vertices.len()) {
            Some(crossing) => self.is_enclosed((crossings.edge_of(crossing), crossings.at(crossing)), open),
            None => open.parts.is_enclosed(place),
        };
        let wanted = |place: u32| open.is_none_or(|open| !is_enclosed(place, open));
        self.level_chains(&crossings, true, nobody, wanted)
    }

    /// The parts of the space above the level of `crossings`.
    pub(super) fn parts_above(&self, crossings: &Crossings) -> Parts {
        let mut parts = DisjointSets::new(self.vertices.len() + crossings.len());
        let mut above = Vec::new();
        for number in (0_u32..).take(self.edges.len()) {
            self.stretches_above(number, crossings, |from, to| above.push((number, from, to)));
        }
        for &(_, from, to) in &above {
            parts.union(from, to);
        }
        let part = parts.representatives();
        let mut around = vec![Around::Nobody; part.len()];
        for (number, from, _) in above {
            let edge = &self.edges[number as usize];
            let known = &mut around[part[from as usize] as usize];
            *known = known.and(self.owner(edge.left)).and(self.owner(edge.right));
        }
        Parts { part, around }
    }

    /// Shows the ends of the stretches of an edge that lie above a level: vertices, and crossings
    /// behind them.
    fn stretches_above(&self, number: u32, crossings: &Crossings, mut show: impl FnMut(u32, u32)) {
        let edge = &self.edges[number as usize];
        let is_above = |vertex: u32| self.vertices[vertex as usize].clearance > crossings.level();
        let mut from = is_above(edge.from).then_some(edge.from);
        for crossing in crossings.of(number) {
            let here = self.node(crossing);
            match from.take() {
                Some(from) => show(from, here),
                None => from = Some(here),
            }
        }
        if let Some(from) = from {
            show(from, edge.to);
        }
    }
}
