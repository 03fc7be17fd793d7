//! Level sets: where copper is just so far away, cell by cell.
//!
//! ```text
//!    ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓         Where the clearance along an edge passes the level, the curve crosses it: × where it rises
//!    ───×─ ─ ─ ─ ─ ─×──           above it, × where it falls below again. Between the two the border of a cell lies above the
//!   ╲   │           │   ╱         level, and the curve runs below it: a parallel of each generator in turn, from the foot of
//!    ╲  │  above    │  ╱  edge    one vertex to that of the next.
//! ```
//!
//! Who follows the borders of a face meets rises and falls in turn, because every vertex has one
//! clearance; and each crossing falls for one of the two faces of its edge and rises for the other.
//! So level sets close whatever rounding does, and their parts are lines and arcs.
//!
//! M. Held, *On the Computational Geometry of Pocket Machining*, LNCS 500, Springer 1991, ch. 4
//! (offset curves from the diagram).

use std::sync::OnceLock;

use super::chain::Chain;
use super::course::COURSE;
use super::parallel::{Leg, between, joined};
use super::{Diagram, Edge, Kind, Link, NOBODY};
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::Sample;

/// A level lies above its number by this much, in nanometres, so that what is exactly so wide on a
/// grid is on one side of it. Chosen: more than rounding, less than the grid.
const ABOVE: f64 = 0.3;

/// Directions are one if their cosine is no less. Chosen: a hundredth of a degree.
const SAME: f64 = 1.0 - 1e-8;

/// Where a level set crosses an edge.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    edge: u32,
    at: Spot,
    /// Whether the clearance rises there, from the edge's beginning to its end.
    rises: bool,
}

/// The crossings of a level with all edges.
pub(super) struct Crossings {
    level: f64,
    all: Vec<Crossing>,
    /// The crossings of edge `i`, in its order: `all[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
}

impl Crossings {
    /// How many there are.
    pub(super) const fn len(&self) -> usize {
        self.all.len()
    }

    /// The clearance that is crossed, in nanometres.
    pub(super) const fn level(&self) -> f64 {
        self.level
    }

    /// Where one is.
    pub(super) fn at(&self, crossing: usize) -> Spot {
        self.all[crossing].at
    }

    /// The edge that one is on.
    pub(super) fn edge_of(&self, crossing: usize) -> u32 {
        self.all[crossing].edge
    }

    /// Those of an edge, in its order.
    pub(super) fn of(&self, edge: u32) -> std::ops::Range<usize> {
        self.starts[edge as usize]..self.starts[edge as usize + 1]
    }

    /// The next crossing along a link behind `after`, or the first.
    fn next(&self, (edge, reversed): Link, after: Option<usize>) -> Option<usize> {
        let range = self.of(edge);
        let next = match (after, reversed) {
            (None, false) => range.start,
            (None, true) => range.end.checked_sub(1)?,
            (Some(at), false) => at + 1,
            (Some(at), true) => at.checked_sub(1)?,
        };
        range.contains(&next).then_some(next)
    }

    /// The link along which the clearance rises at a crossing.
    fn rising(&self, crossing: usize) -> Link {
        let Crossing { edge, rises, .. } = self.all[crossing];
        (edge, !rises)
    }
}

/// A closed curve where copper is equally far away, with the copper on its left.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelCurve {
    /// The owner of the copper where it begins.
    pub owner: u32,
    /// Places along it in nanometres, the last of which is the first; chords stay within 150 nm of
    /// it.
    pub course: Vec<(f64, f64)>,
}

impl Diagram {
    /// Where copper is `level` nanometres away, if something encloses the free space
    /// ([`Space::Within`](super::Space::Within)). None where the graph contradicts itself: never,
    /// unless the program is at fault.
    ///
    /// # Panics
    ///
    /// If the diagram has boundaries between owners alone ([`Kind::Owners`]).
    #[must_use]
    pub fn level_set(&self, level: f64) -> Option<Vec<LevelCurve>> {
        assert_ne!(self.kind, Kind::Owners, "level sets cross all edges of the free space");
        let chains = self.level_chains(&self.crossings(level), false, NOBODY, |_| true)?;
        let curve = |Chain { left: owner, samples, .. }| {
            let course = samples.into_iter().map(|Sample { at, .. }| (at.x, at.y)).collect();
            LevelCurve { owner, course }
        };
        Some(chains.into_iter().map(curve).collect())
    }

    /// The generator on the left of a link.
    fn left_of(&self, (edge, reversed): Link) -> u32 {
        let edge = &self.edges[edge as usize];
        if reversed { edge.right } else { edge.left }
    }

    /// The link that goes on along the face on the left.
    fn onward(&self, link: Link) -> Option<Link> {
        let leaving = self.leaving.of(self.target(link) as usize);
        let back = leaving.iter().position(|&other| other == (link.0, !link.1))?;
        Some(leaving[(back + leaving.len() - 1) % leaving.len()])
    }

    /// Where a level crosses edges.
    pub(super) fn crossings(&self, level: f64) -> Crossings {
        let mut found = Crossings { level: level + ABOVE, all: Vec::new(), starts: vec![0] };
        for (number, edge) in (0_u32..).zip(&self.edges) {
            self.cross(number, edge, &mut found);
            found.starts.push(found.all.len());
        }
        found
    }

    fn cross(&self, number: u32, edge: &Edge, found: &mut Crossings) {
        let (from, to) = (self.sample_at(edge.from), self.sample_at(edge.to));
        let reach = (to.at - from.at).length();
        let (low, high) = (from.clearance.min(to.clearance), from.clearance.max(to.clearance));
        // Clearance changes no faster than place, and edges turn by less than half a turn.
        if low - 2.0 * reach > found.level || high + 2.0 * reach < found.level {
            return;
        }
        let stretches = self.stretches.get_or_init(|| vec![OnceLock::new(); self.edges.len()]);
        let pair = self.pair_of(edge);
        for ends in stretches[number as usize].get_or_init(|| pair.stretches(from, to)).windows(2) {
            let [a, b] = [ends[0], ends[1]];
            let rises = b.clearance > found.level;
            if (a.clearance > found.level) != rises {
                let at = pair.crossing(a, b, found.level);
                found.all.push(Crossing { edge: number, at, rises });
            }
        }
    }

    /// The legs of the level set from a crossing to the next.
    fn legs(&self, crossings: &Crossings, from: usize) -> Option<Vec<Leg>> {
        let mut link = crossings.rising(from);
        let mut legs = vec![];
        let (mut at, mut after) = (crossings.all[from].at, Some(from));
        for _ in 0..2 * self.edges.len() + 2 {
            let generator = self.left_of(link);
            if let Some(end) = crossings.next(link, after) {
                legs.push(Leg { generator, from: at, to: crossings.all[end].at, crossing: Some(end) });
                return Some(joined(legs, self.forms()));
            }
            let to = self.sample_at(self.target(link)).at;
            legs.push(Leg { generator, from: at, to, crossing: None });
            let onward = self.onward(link)?;
            self.add_hollow(link, onward, &mut legs);
            (link, at, after) = (onward, to, None);
        }
        None
    }

    /// Adds what lies between the generators on the left of two links, the second of which goes on
    /// where the first ends: hollow arcs round that place.
    fn add_hollow(&self, link: Link, onward: Link, legs: &mut Vec<Leg>) {
        let vertex = self.target(link);
        let at = self.sample_at(vertex).at;
        let [first, last] = [link, onward].map(|link| self.left_of(link));
        let hollow = |&i: &u32| i != first && i != last && self.forms()[i as usize].around(at).is_some();
        let mut arcs: Vec<u32> = self.vertices[vertex as usize].tied.iter().copied().filter(hollow).collect();
        if first == last {
            return;
        }
        let mut toward = self.forms()[first as usize].away(at) * -1.0;
        loop {
            let begins_here = |&i: &u32| match self.forms()[i as usize].around(at) {
                Some(Some([_, begin])) => begin.dot(toward) > SAME,
                Some(None) | None => false,
            };
            let Some(found) = arcs.iter().position(begins_here) else { break };
            let generator = arcs.remove(found);
            legs.push(Leg { generator, from: at, to: at, crossing: None });
            if let Some(Some([end, _])) = self.forms()[generator as usize].around(at) {
                toward = end;
            }
        }
    }

    /// The closed chains where copper is `level` nanometres away, with the copper on their left;
    /// with `nodes`, cut where boundaries between owners cross them. Of those without a node only
    /// what `wanted` accepts, by a vertex above or a crossing behind all vertices. None where the
    /// graph contradicts itself: never, unless the program is at fault.
    pub(super) fn level_chains(
        &self,
        crossings: &Crossings,
        nodes: bool,
        nobody: u32,
        wanted: impl Fn(u32) -> bool,
    ) -> Option<Vec<Chain>> {
        debug_assert_ne!(self.kind, Kind::Owners, "level sets cross all edges of the free space");
        let mut chains = Vec::new();
        let is_node = |crossing: usize| {
            let edge = &self.edges[crossings.all[crossing].edge as usize];
            nodes && self.owner(edge.left) != self.owner(edge.right)
        };
        let mut seen = vec![false; crossings.all.len()];
        let firsts = (0..seen.len()).filter(|&i| is_node(i)).chain((0..seen.len()).filter(|&i| !is_node(i)));
        for first in firsts {
            let (mut legs, mut at) = (Vec::new(), first);
            while !seen[at] {
                seen[at] = true;
                let next = self.legs(crossings, at)?;
                at = next.last()?.crossing?;
                legs.extend(next);
                if is_node(at) {
                    break;
                }
            }
            if let Some(leg) = legs.first()
                && wanted(self.node(first))
            {
                let ends = is_node(first).then(|| [first, at].map(|i| self.node(i)));
                let left = self.owner(leg.generator);
                let samples = self.leg_samples(&legs, crossings.level - ABOVE, first == at);
                let samples = between(samples, [first, at].map(|i| crossings.all[i].at));
                chains.push(Chain { left, right: nobody, samples, ends });
            }
        }
        for legs in self.whole_faces(crossings, wanted)? {
            let left = self.owner(legs[0].generator);
            let mut samples = self.leg_samples(&legs, crossings.level - ABOVE, true);
            if let Some(&Sample { at, .. }) = samples.first() {
                samples = between(samples, [at, at]);
            }
            chains.push(Chain { left, right: nobody, samples, ends: None });
        }
        Some(chains)
    }

    /// The number of the node at a crossing.
    pub(super) fn node(&self, crossing: usize) -> u32 {
        u32::try_from(self.vertices.len() + crossing).expect("below 2³² nodes")
    }

    /// The legs of the loops that cross no edge, of those that are wanted.
    fn whole_faces(&self, crossings: &Crossings, wanted: impl Fn(u32) -> bool) -> Option<Vec<Vec<Leg>>> {
        let mut found = Vec::new();
        let mut seen = vec![[false; 2]; self.edges.len()];
        let links = (0_u32..).take(self.edges.len()).flat_map(|edge| [(edge, false), (edge, true)]);
        let is_above = |link: Link| {
            self.vertices[self.target(link) as usize].clearance > crossings.level
                && crossings.of(link.0).is_empty()
        };
        let mut face = Vec::new();
        for first in links {
            // Who comes to a link that was seen comes to where that face lies below the level.
            face.clear();
            let mut link = first;
            while is_above(link) && !std::mem::replace(&mut seen[link.0 as usize][usize::from(link.1)], true)
            {
                face.push(link);
                link = self.onward(link)?;
            }
            if link == first && !face.is_empty() && wanted(self.target(first)) {
                let mut legs = Vec::with_capacity(face.len());
                for (i, &link) in face.iter().enumerate() {
                    let [from, to] =
                        [(link.0, !link.1), link].map(|link| self.sample_at(self.target(link)).at);
                    legs.push(Leg { generator: self.left_of(link), from, to, crossing: None });
                    self.add_hollow(link, face[(i + 1) % face.len()], &mut legs);
                }
                // What begins within a generator's part ends there, too.
                let turns = legs.windows(2).position(|pair| pair[0].generator != pair[1].generator);
                legs.rotate_left(turns.map_or(0, |at| at + 1));
                found.push(joined(legs, self.forms()));
            }
        }
        found.extend(
            (0_u32..).zip(self.leaving.iter()).filter(|(_, leaving)| leaving.is_empty()).filter_map(
                |(vertex, _)| {
                    let is_above = self.sample_at(vertex).clearance > crossings.level && wanted(vertex);
                    is_above.then(|| self.rounds(vertex)).flatten()
                },
            ),
        );
        Some(found)
    }

    /// The legs along the hollow arcs round a vertex that no edge leaves: all the way round.
    fn rounds(&self, vertex: u32) -> Option<Vec<Leg>> {
        let at = self.sample_at(vertex).at;
        let tied = self.vertices[vertex as usize].tied.iter().copied();
        let mut arcs: Vec<u32> = tied.filter(|&i| self.forms()[i as usize].around(at).is_some()).collect();
        let leg = |generator: u32| Leg { generator, from: at, to: at, crossing: None };
        let mut legs = vec![leg(arcs.pop()?)];
        while let Some(Some([end, _])) = self.forms()[legs[legs.len() - 1].generator as usize].around(at) {
            let begins_here = |&i: &u32| {
                let around = self.forms()[i as usize].around(at).flatten();
                around.is_some_and(|[_, begin]| begin.dot(end) > SAME)
            };
            let Some(next) = arcs.iter().position(begins_here) else { break };
            legs.push(leg(arcs.remove(next)));
        }
        Some(legs)
    }

    /// The boundaries between owners where copper is nearer than `level` nanometres, and the curves
    /// where it is just so far from it, which have `nobody` on their right; without `enclosed` not
    /// those of space that one owner alone encloses. None where the graph contradicts itself.
    pub(in crate::voronoi) fn limited_chains(
        &self,
        level: f64,
        nobody: u32,
        enclosed: bool,
    ) -> Option<Vec<Chain>> {
        let crossings = self.crossings(level);
        let mut chains = self.chains_below(&crossings);
        let parts = (!enclosed).then(|| self.parts_above(&crossings));
        let wanted = |place: u32| parts.as_ref().is_none_or(|parts| !parts.is_enclosed(place));
        chains.extend(self.level_chains(&crossings, true, nobody, wanted)?);
        Some(chains)
    }

    /// The chains between owners, as far as they lie below the level.
    fn chains_below(&self, crossings: &Crossings) -> Vec<Chain> {
        let mut chains = Vec::new();
        for (row, is_loop) in self.rows() {
            let (left, right) = self.sides(row[0]);
            let source = self.target((row[0].0, !row[0].1));
            let mut parts: Vec<(Vec<Sample>, [u32; 2])> = Vec::new();
            let mut open: Option<(Vec<Sample>, u32)> = None;
            let begins_below = self.sample_at(source).clearance <= crossings.level;
            if begins_below {
                open = Some((vec![self.sample_at(source)], source));
            }
            for &link in &row {
                let mut at = self.sample_at(self.target((link.0, !link.1)));
                let mut next = crossings.next(link, None);
                while let Some(crossing) = next {
                    let to = Sample { at: crossings.all[crossing].at, clearance: crossings.level - ABOVE };
                    match open.take() {
                        Some((mut samples, from)) => {
                            self.extend(link, (at, to), &mut samples);
                            parts.push((samples, [from, self.node(crossing)]));
                        }
                        None => open = Some((vec![to], self.node(crossing))),
                    }
                    (at, next) = (to, crossings.next(link, Some(crossing)));
                }
                if let Some((samples, _)) = &mut open {
                    self.extend(link, (at, self.sample_at(self.target(link))), samples);
                }
            }
            let end = self.target(row[row.len() - 1]);
            let whole = parts.is_empty();
            match open {
                Some((samples, _)) if is_loop && whole => {
                    chains.push(Chain { left, right, samples, ends: None });
                }
                // What a loop ends with goes on at its beginning.
                Some((mut samples, from)) if is_loop && begins_below => {
                    let (first, ends) = parts.remove(0);
                    samples.extend_from_slice(&first[1..]);
                    parts.push((samples, [from, ends[1]]));
                }
                Some((samples, from)) => parts.push((samples, [from, end])),
                None => {}
            }
            let parts = parts.into_iter();
            chains.extend(parts.map(|(samples, ends)| Chain { left, right, samples, ends: Some(ends) }));
        }
        chains
    }

    /// Adds the places along a link behind the first of two up to the second.
    fn extend(&self, link: Link, (from, to): (Sample, Sample), samples: &mut Vec<Sample>) {
        let pair = self.pair_of(&self.edges[link.0 as usize]);
        if link.1 {
            let mut between = Vec::new();
            pair.halve((to, from), COURSE, 16, &mut between);
            samples.extend(between.into_iter().rev());
        } else {
            pair.halve((from, to), COURSE, 16, samples);
        }
        samples.push(to);
    }
}
