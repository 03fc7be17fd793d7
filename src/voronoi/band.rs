//! Boundaries midway between core axes, and round the copper where it reaches across them (the
//! paper's §III-D and III-D.2).
//!
//! ```text
//!   ───── axis of A ─────
//!
//!   ╌╌╌╌╌╌╌●      ●╌╌╌╌╌╌╌╌╌
//!      ▓▓▓▓│▓▓▓▓▓▓│▓▓▓
//!      ▓▓▓▓╰──────╯▓▓▓ axis of B
//! ```
//!
//! Midway between the axes ╌ a boundary may run through the copper of a wide trace. So every region
//! holds its net's copper and a band round it at least: there the boundary runs along the edge of
//! the band, from where the one crosses the other to where it crosses it again. Where bands of two
//! nets meet, it runs midway between their copper.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::geometry::{BoxTree, Nm};
use crate::topology::DisjointSets;

use super::exact::{Chain, Diagram, WALL};
use super::plane::{Spot, spanned};
use super::sample::{Sample, length};
use super::{BEYOND, FLOOR, NOBODY};

/// What a band is wide at least, so that its edge is one. Chosen: no cutter is as true.
const LEAST: Nm = Nm::from_um(1);

/// The first number of the nodes of axes, and of places where bands cross what is between axes.
const OF_AXES: u32 = 1 << 30;
const OF_CROSSINGS: u32 = 1 << 31;

/// The copper with the band round it that belongs to its net whatever the axes say.
pub(super) struct Band {
    copper: Diagram,
    width: f64,
    /// What parts bands from each other, and their edges, which have nobody on their right.
    chains: Vec<Chain>,
}

/// A place where two chains cross: between which samples of the one, and how far from the first to
/// the second.
#[derive(Clone, Copy)]
struct Crossing {
    sample: usize,
    part: f64,
    at: Spot,
    node: u32,
    /// What lies on the other side of the one behind the place and ahead of it: of an edge the
    /// owner between axes, of what is between axes the owner of the band, or nobody.
    sides: [u32; 2],
}

impl Band {
    /// How wide it is where so much is asked for.
    pub(super) fn width(asked: Nm) -> Nm {
        asked.max(LEAST)
    }

    /// How far the wall round all copper is from it, and how narrow slits are not looked at, for a
    /// diagram that knows a band of this width.
    pub(super) fn room(width: Nm) -> (Nm, Nm) {
        (width * 3 + BEYOND, FLOOR.min(width / 2))
    }

    /// The band in a diagram of copper, with its edges and what parts it from others.
    pub(super) fn new(copper: Diagram, width: Nm, mut chains: Vec<Chain>) -> Self {
        // The wall is no copper.
        chains.retain(|chain| chain.left != WALL && chain.right != WALL);
        Self { copper, width: width.to_f64(), chains }
    }

    /// The owner of the copper in whose band a place lies, if it does.
    pub(super) fn owner_at(&self, p: Spot) -> Option<u32> {
        self.copper.owner_near(p, self.width, NOBODY).filter(|&owner| owner != NOBODY && owner != WALL)
    }

    /// The boundaries of regions that hold their band at least, of those `between` the axes, whose
    /// cells `owner` knows. With them come the distances to copper.
    pub(super) fn around(&self, between: Vec<Chain>, owner: impl Fn(Spot) -> Option<u32>) -> Vec<Chain> {
        let is_edge = |chain: &&Chain| chain.right == NOBODY;
        let edges: Vec<&Chain> = self.chains.iter().filter(is_edge).collect();
        let inner = self.chains.iter().filter(|chain| !is_edge(chain)).cloned();
        let (of_edges, of_axes) = crossings(&edges, &between);
        let mut all: Vec<Chain> = inner.collect();
        let parts = edges.into_iter().zip(of_edges);
        let parts: Vec<Part> = parts.flat_map(|(edge, found)| parted(edge.clone(), found)).collect();
        let rights = beside(&parts, &owner);
        let parts = parts.into_iter().zip(rights).filter(|((part, _), right)| *right != part.left);
        all.extend(parts.map(|((part, _), right)| Chain { right, ..part }));
        for (chain, found) in between.into_iter().zip(of_axes) {
            let ends = chain.ends.map(|ends| ends.map(|end| end + OF_AXES));
            for (part, sides) in parted(Chain { ends, ..chain }, found) {
                let by_place = || middle(&part.samples).and_then(|at| self.owner_at(at)).unwrap_or(NOBODY);
                if agreed(sides).unwrap_or_else(by_place) == NOBODY {
                    all.push(part);
                }
            }
        }
        let distance = |at: Spot| self.copper.distance(at);
        all.par_iter_mut().for_each(|chain| chain.samples = measured(&chain.samples, &distance));
        all
    }
}

/// Samples with their distances to copper, and between them those where it is nearest: midway
/// between axes it may be anywhere.
fn measured(samples: &[Sample], distance: &impl Fn(Spot) -> f64) -> Vec<Sample> {
    let sample = |at: Spot| Sample { at, clearance: distance(at) };
    let mut found: Vec<Sample> = Vec::with_capacity(samples.len());
    for next in samples.iter().map(|next| sample(next.at)) {
        if let Some(&last) = found.last() {
            add_nearest(last, next, &sample, &mut found);
        }
        found.push(next);
    }
    found
}

/// Adds the places between two samples where copper is nearer than on either side.
fn add_nearest(from: Sample, to: Sample, sample: &impl Fn(Spot) -> Sample, found: &mut Vec<Sample>) {
    /// Places are this far apart, in nanometres. Chosen: a fifth of what kerfs are wide.
    const STEP: f64 = 20_000.0;
    /// How much nearer it must be. Chosen: no cutter is as true.
    const NEARER: f64 = 1_000.0;
    let length = (to.at - from.at).length();
    let at = |way: f64| sample(from.toward(&to, way / length).at);
    let mut nearest = from.clearance.min(to.clearance) - NEARER;
    let (mut way, mut here, mut place) = (0.0, from.clearance, None);
    loop {
        // Distances change no faster than the place.
        way += STEP.max(here - nearest);
        if way >= length {
            break;
        }
        here = at(way).clearance;
        if here < nearest {
            (nearest, place) = (here, Some(way));
        }
    }
    let Some(place) = place else { return };
    let (mut low, mut high) = ((place - STEP).max(0.0), (place + STEP).min(length));
    while high - low > NEARER {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a).clearance < at(b).clearance { high = b } else { low = a }
    }
    let here = at(f64::midpoint(low, high));
    add_nearest(from, here, sample, found);
    found.push(here);
    add_nearest(here, to, sample, found);
}

/// A part of a chain between its crossings, with what these say of it.
type Part = (Chain, [Option<u32>; 2]);

/// Who owns what lies beside each part of the edges of bands. Parts that meet where nothing crosses
/// them lie beside one region: of the two sides of a sliver a few nanometres long, asked for by
/// themselves, each may be told that the other's band goes on there.
fn beside(parts: &[Part], owner: impl Fn(Spot) -> Option<u32>) -> Vec<u32> {
    let mut at_node: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (number, (part, _)) in (0_u32..).zip(parts) {
        for node in part.ends.into_iter().flatten().filter(|&node| node < OF_CROSSINGS) {
            at_node.entry(node).or_default().push(number);
        }
    }
    let mut regions = DisjointSets::new(parts.len());
    // Where four meet, two regions do.
    for met in at_node.values().filter(|met| met.len() == 2) {
        regions.union(met[0], met[1]);
    }
    let regions = regions.representatives();
    let mut members: BTreeMap<u32, Vec<&Part>> = BTreeMap::new();
    regions.iter().zip(parts).for_each(|(&region, part)| members.entry(region).or_default().push(part));
    let owner_of = |members: Vec<&Part>| {
        let by_place = || {
            let longest = members.iter().max_by(|a, b| length(&a.0.samples).total_cmp(&length(&b.0.samples)));
            longest.and_then(|part| middle(&part.0.samples)).and_then(&owner).unwrap_or(NOBODY)
        };
        agreed(members.iter().flat_map(|part| part.1)).unwrap_or_else(by_place)
    };
    let owners: BTreeMap<u32, u32> =
        members.into_iter().map(|(region, members)| (region, owner_of(members))).collect();
    regions.iter().map(|region| owners[region]).collect()
}

/// What crossings say of a region, if they say one thing.
fn agreed(sides: impl IntoIterator<Item = Option<u32>>) -> Option<u32> {
    let mut said = sides.into_iter().flatten();
    let first = said.next()?;
    said.all(|other| other == first).then_some(first)
}

/// The place midway along a chain.
fn middle(samples: &[Sample]) -> Option<Spot> {
    let mut left = length(samples) / 2.0;
    for pair in samples.windows(2) {
        let way = pair[1].at - pair[0].at;
        if way.length() >= left && way.length() > 0.0 {
            return Some(pair[0].at + way * (left / way.length()));
        }
        left -= way.length();
    }
    samples.first().map(|sample| sample.at)
}

/// The edges of bands lie off their place by this, in nanometres, for whoever asks what crosses
/// them, so that nothing that ends on them goes through just there. Chosen: more than rounding.
const OFF: Spot = Spot::new(0.137, 0.071);

/// The edges of bands, by place.
struct Edges<'a> {
    chains: &'a [&'a Chain],
    /// The chain of each segment, and the sample that it leads to.
    segments: Vec<(usize, usize)>,
    tree: BoxTree,
}

impl<'a> Edges<'a> {
    fn new(chains: &'a [&'a Chain]) -> Self {
        let of = |(i, chain): (usize, &&'a Chain)| (1..chain.samples.len()).map(move |to| (i, to));
        let segments: Vec<(usize, usize)> = chains.iter().enumerate().flat_map(of).collect();
        let tree = BoxTree::new(segments.iter().map(|&place| {
            let [a, b] = ends(chains, place);
            spanned(a, b)
        }));
        Self { chains, segments, tree }
    }

    /// Shows where the way from `p` to `q` crosses: which segment, how far along the way and along
    /// the segment, whether the way leaves the band, and whether the segment goes to its left.
    fn crossed(&self, [p, q]: [Spot; 2], mut show: impl FnMut((usize, usize), [f64; 2], [bool; 2])) {
        let is_left = |from: Spot, to: Spot, at: Spot| (to - from).cross(at - from) > 0.0;
        for i in self.tree.within(spanned(p, q)) {
            let [a, b] = ends(self.chains, self.segments[i]);
            if is_left(a, b, p) != is_left(a, b, q) && is_left(p, q, a) != is_left(p, q, b) {
                let (way, side) = (q - p, b - a);
                let part = (side.cross(a - p) / side.cross(way)).clamp(0.0, 1.0);
                let along = ((p + way * part - a).length() / side.length()).min(1.0);
                show(self.segments[i], [part, along], [is_left(a, b, p), is_left(p, q, b)]);
            }
        }
    }
}

/// The ends of the segment of a chain that leads to a sample.
fn ends(chains: &[&Chain], (chain, to): (usize, usize)) -> [Spot; 2] {
    let samples = &chains[chain].samples;
    [samples[to - 1].at + OFF, samples[to].at + OFF]
}

/// Where the edges of bands and what is between axes cross each other, by chain of the one and of
/// the other, in their order.
fn crossings(edges: &[&Chain], between: &[Chain]) -> (Vec<Vec<Crossing>>, Vec<Vec<Crossing>>) {
    let by_place = Edges::new(edges);
    let mut of_edges = vec![Vec::new(); edges.len()];
    let mut of_axes = vec![Vec::new(); between.len()];
    let mut new = OF_CROSSINGS;
    for (chain, of_chain) in between.iter().zip(&mut of_axes) {
        for (sample, pair) in chain.samples.windows(2).enumerate() {
            let (p, q) = (pair[0].at, pair[1].at);
            by_place.crossed([p, q], |(edge, to), [part, along], [leaves, is_leftward]| {
                let (band, (left, right)) = (edges[edge].left, (chain.left, chain.right));
                let sides = if leaves { [band, NOBODY] } else { [NOBODY, band] };
                let of_edge = if is_leftward { [right, left] } else { [left, right] };
                let at = p + (q - p) * part;
                let crossing = Crossing { sample, part, at, node: new, sides };
                of_chain.push(crossing);
                of_edges[edge].push(Crossing { sample: to - 1, part: along, sides: of_edge, ..crossing });
                new += 1;
            });
        }
    }
    for found in of_edges.iter_mut().chain(&mut of_axes) {
        found.sort_by(|a, b| {
            a.sample.cmp(&b.sample).then(a.part.total_cmp(&b.part)).then(a.node.cmp(&b.node))
        });
    }
    (of_edges, of_axes)
}

/// The parts of a chain between its crossings, with what these say of each.
fn parted(chain: Chain, crossings: Vec<Crossing>) -> Vec<Part> {
    let (Some(&first), Some(&last)) = (crossings.first(), crossings.last()) else {
        return vec![(chain, [None; 2])];
    };
    let Chain { left, right, samples, ends } = chain;
    let sample =
        |crossing: Crossing| Sample { at: crossing.at, clearance: samples[crossing.sample].clearance };
    let part = |samples, ends, sides| (Chain { left, right, samples, ends: Some(ends) }, sides);
    let ([before, _], [_, after]) = (first.sides, last.sides);
    let mut parts = Vec::with_capacity(crossings.len() + 1);
    for pair in crossings.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let mut between = vec![sample(from)];
        between.extend_from_slice(&samples[from.sample + 1..=to.sample.max(from.sample)]);
        between.push(sample(to));
        parts.push(part(between, [from.node, to.node], [Some(from.sides[1]), Some(to.sides[0])]));
    }
    let mut head = samples[..=first.sample].to_vec();
    head.push(sample(first));
    let mut tail = vec![sample(last)];
    tail.extend_from_slice(&samples[last.sample + 1..]);
    match ends {
        Some([from, to]) => {
            parts.insert(0, part(head, [from, first.node], [None, Some(before)]));
            parts.push(part(tail, [last.node, to], [Some(after), None]));
        }
        // A loop: its beginning and its end are one part.
        None => {
            tail.extend_from_slice(&head[1..]);
            parts.push(part(tail, [last.node, first.node], [Some(after), Some(before)]));
        }
    }
    parts
}
