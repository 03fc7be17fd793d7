//! Parts of the medial axis of the free space, by how far copper is from them.

use rustc_hash::FxHashMap;

use super::course::COURSE;
use super::{Diagram, Edge, WALL};
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::Sample;

/// A place on the medial axis.
#[derive(Clone, Copy, Debug)]
pub(in crate::voronoi) struct OnAxis {
    pub(in crate::voronoi) sample: Sample,
    /// The edge of the diagram that it lies on.
    pub(in crate::voronoi) edge: u32,
}

/// A part of the medial axis, without branches.
pub(in crate::voronoi) struct Axis {
    /// The owners on its left and right where it begins.
    pub(in crate::voronoi) owners: [u32; 2],
    /// Places along it; chords follow the axis.
    pub(in crate::voronoi) places: Vec<OnAxis>,
}

/// A part of an edge, with the vertices that it begins and ends at, if it does.
struct Part {
    places: Vec<OnAxis>,
    ends: [Option<u32>; 2],
}

impl OnAxis {
    /// The place so far, from 0 to 1, on the way to another.
    pub(in crate::voronoi) fn toward(&self, other: &Self, part: f64) -> Self {
        Self { sample: self.sample.toward(&other.sample, part), edge: other.edge }
    }
}

impl Diagram {
    /// The parts of the edges between owners that are `wanted` on which the clearance lies between
    /// two numbers of any of the `ranges`, which are in order and apart; one after the other where
    /// no more than two meet.
    pub(in crate::voronoi) fn axes_between(
        &self,
        ranges: &[[f64; 2]],
        wanted: impl Fn(u32, u32) -> bool,
    ) -> Vec<Axis> {
        let (mut parts, mut samples) = (Vec::new(), Vec::new());
        for (number, edge) in (0_u32..).zip(&self.edges) {
            let [left, right] = [edge.left, edge.right].map(|generator| self.owner(generator));
            if left != WALL && right != WALL && wanted(left, right) && self.may_reach(edge, ranges) {
                samples.clear();
                self.add_samples(edge, COURSE, &mut samples);
                let on_edge = |&sample: &Sample| OnAxis { sample, edge: number };
                let places: Vec<OnAxis> = samples.iter().map(on_edge).collect();
                cut(&places, ranges, [edge.from, edge.to], &mut parts);
            }
        }
        self.joined(&parts)
    }

    /// The middles of round spaces, which no edge leads to, where copper is as far as any of the
    /// `ranges` says, each with the owner all round it, if that is `wanted`.
    pub(in crate::voronoi) fn middles_between(
        &self,
        ranges: &[[f64; 2]],
        wanted: impl Fn(u32, u32) -> bool,
    ) -> Vec<(Sample, u32)> {
        let lone = (0_u32..).zip(self.leaving.iter()).filter(|(_, leaving)| leaving.is_empty());
        let middle = |(vertex, _)| {
            let sample = self.sample_at(vertex);
            let owner = self.owner(*self.vertices[vertex as usize].tied.first()?);
            let is_within = ranges.iter().any(|&[from, to]| (from..to).contains(&sample.clearance));
            (is_within && owner != WALL && wanted(owner, owner)).then_some((sample, owner))
        };
        lone.filter_map(middle).collect()
    }

    /// The unit vectors straight away from the copper on either side.
    pub(in crate::voronoi) fn away_at(&self, place: &OnAxis) -> [Spot; 2] {
        let edge = &self.edges[place.edge as usize];
        [edge.left, edge.right].map(|generator| self.forms()[generator as usize].away(place.sample.at))
    }

    /// Whether the clearance along an edge may lie in any of some ranges: it changes no faster than
    /// the place, and edges turn by less than half a turn.
    fn may_reach(&self, edge: &Edge, ranges: &[[f64; 2]]) -> bool {
        let [a, b] = [edge.from, edge.to].map(|vertex| &self.vertices[vertex as usize]);
        let (x, y) = (b.at.0 - a.at.0, b.at.1 - a.at.1);
        let reach = 2.0 * (x * x + y * y).sqrt();
        let (low, high) = (a.clearance.min(b.clearance) - reach, a.clearance.max(b.clearance) + reach);
        ranges.iter().any(|&[from, to]| low < to && high > from)
    }

    /// Parts one after the other where two meet.
    fn joined(&self, parts: &[Part]) -> Vec<Axis> {
        let mut at: FxHashMap<u32, Vec<(usize, usize)>> = FxHashMap::default();
        for (number, part) in parts.iter().enumerate() {
            for (end, vertex) in part.ends.iter().enumerate() {
                vertex.iter().for_each(|&vertex| at.entry(vertex).or_default().push((number, end)));
            }
        }
        // What goes on at an end of a part, and with which of its ends.
        let next = |number: usize, end: usize| match at.get(&parts[number].ends[end]?)?[..] {
            [one, other] => [one, other].into_iter().find(|&next| next != (number, end)),
            _ => None,
        };
        let mut seen = vec![false; parts.len()];
        let mut axes = Vec::new();
        let ends = || (0..parts.len()).flat_map(|number| [(number, 0), (number, 1)]);
        // First what begins somewhere, then what is left: loops.
        let begins = |&(number, end): &(usize, usize)| next(number, end).is_none();
        for (first, end) in ends().filter(begins).chain(ends()) {
            let (mut number, mut entry) = (first, end);
            let mut places: Vec<OnAxis> = Vec::new();
            while !std::mem::replace(&mut seen[number], true) {
                let mut part = parts[number].places.clone();
                if entry == 1 {
                    part.reverse();
                }
                places.extend(part.into_iter().skip(usize::from(!places.is_empty())));
                let Some(onward) = next(number, 1 - entry) else { break };
                (number, entry) = onward;
            }
            if let Some(&OnAxis { edge, .. }) = places.first() {
                let edge = &self.edges[edge as usize];
                let mut owners = [edge.left, edge.right].map(|generator| self.owner(generator));
                if end == 1 {
                    owners.reverse();
                }
                axes.push(Axis { owners, places });
            }
        }
        axes
    }
}

/// Adds the parts of an edge within any range.
fn cut(places: &[OnAxis], ranges: &[[f64; 2]], [from, to]: [u32; 2], parts: &mut Vec<Part>) {
    for &[low, high] in ranges {
        let is_within = |place: &OnAxis| (low..high).contains(&place.sample.clearance);
        let mut open =
            is_within(&places[0]).then(|| Part { places: vec![places[0]], ends: [Some(from), None] });
        for pair in places.windows(2) {
            let [a, b] = [&pair[0], &pair[1]];
            let [before, after] = [a.sample.clearance, b.sample.clearance];
            let crossing = |level: f64| a.toward(b, (level - before) / (after - before));
            let passes = |level: f64| (before < level) != (after < level);
            let [entry, exit] = if before <= after { [low, high] } else { [high, low] };
            if open.is_none() && passes(entry) {
                open = Some(Part { places: vec![crossing(entry)], ends: [None; 2] });
            }
            if let Some(mut part) = open.take() {
                if passes(exit) {
                    part.places.push(crossing(exit));
                    parts.push(part);
                } else {
                    part.places.push(*b);
                    open = Some(part);
                }
            }
        }
        if let Some(mut part) = open {
            part.ends[1] = Some(to);
            parts.push(part);
        }
    }
}
