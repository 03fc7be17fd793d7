//! Links: short ways from pass to pass on which the cutter stays down.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//!   ━━━━━━━━━━━━━━━┯━━━━━━━━━ pass     What lies between neighbouring passes is cleared by them. A way from the one to the
//!                  ┆ link              other that keeps off copper as they do costs its own time, there and back, and saves
//!   ━━━━━━━━━━━┯━━━┷━━━━━━━━━ pass     a retract. Passes are parted where a link begins or ends.
//! ```
//!
//! Nothing is lost where a link is cut, and nothing is missing where it is not: which ones are is
//! for the trails to choose.

use std::collections::BTreeMap;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use crate::geometry::{BoxTree, Nm, Path, Point, Segment};
use crate::topology::DisjointSets;
use crate::voronoi::part::{Cut, foot_on, part, vertex};
use crate::voronoi::plane::{Spot, sides};
use crate::voronoi::{Boundaries, Boundary, NodeId};

/// A way between two nodes that may be cut, and need not be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Link {
    /// The way.
    pub path: Path,
    /// Copper is nowhere nearer.
    pub clearance: Nm,
    /// The nodes it begins and ends at.
    pub ends: (NodeId, NodeId),
}

/// What links must keep to.
pub(super) struct Rules<'a> {
    /// How far a place is from copper that is no farther than so many nanometres.
    pub(super) clearance: &'a (dyn Fn(Spot, f64) -> f64 + Sync),
    /// Whether nothing is kept on the straight way between two places, so that it may be cut.
    pub(super) is_open: &'a (dyn Fn(Spot, Spot) -> bool + Sync),
    /// How near to copper a cut may come.
    pub(super) nearest: f64,
    /// How far passes lie apart, in nanometres: where links are looked for first.
    pub(super) step: f64,
    /// How long a link from a loose end may be: to the next pass or the one after it.
    pub(super) short: f64,
    /// How long it may be at most.
    pub(super) longest: f64,
}

/// An end that hangs loose is linked to so many others at most. Chosen: the next pass, the one
/// after it, and what ended both.
const CHOICES: usize = 3;

/// Ways shorter than this are not halved to find copper beside them, in nanometres. Chosen.
const FINE: f64 = 500.0;

/// What is looked for beyond where it must be, in nanometres: more than rounding.
const ROUNDING: f64 = 1.0;

/// A link that would part a segment so near to its end goes to the end, in nanometres. Chosen:
/// pieces as short are more words than work.
const AT_END: f64 = 10_000.0;

/// A way from a vertex of one edge to a place on another.
#[derive(Clone, Copy, Debug)]
struct Way {
    length: f64,
    /// The edge, and the index of its vertex.
    from: (usize, usize),
    /// The edge, the index of its segment, and the place.
    to: (usize, usize, Point),
}

impl Rules<'_> {
    /// Copper is no nearer to the straight way between two places, the first of which is about so
    /// far from it, than this, in nanometres; none where it is too near.
    fn keeps_off(&self, (a, about): (Spot, f64), b: Spot) -> Option<f64> {
        // Most ways that are refused are so in their middle, which says so of the whole.
        let middle = self.place(a.midpoint(b), about + (b - a).length() / 2.0 + FINE);
        let is_long = (b - a).length() >= FINE;
        if is_long && middle.1 < self.nearest {
            return None;
        }
        let ends = [a, b].map(|end| self.beside(middle, end));
        let clearance = self.at_once(ends[0], ends[1]).or_else(|| self.halved(ends[0], middle, ends[1]))?;
        (self.is_open)(a, b).then_some(clearance)
    }

    /// Copper is no nearer to the way between two places that are so far from it, if that follows
    /// from how far they are.
    fn at_once(&self, (a, at_a): (Spot, f64), (b, at_b): (Spot, f64)) -> Option<f64> {
        // Copper comes no faster than the way goes.
        let length = (b - a).length();
        let least = f64::midpoint(at_a, at_b) - length / 2.0;
        let is_off = at_a.min(at_b) >= self.nearest && (least >= self.nearest || length < FINE);
        is_off.then_some(least.max(self.nearest))
    }

    fn halved(&self, a: (Spot, f64), middle: (Spot, f64), b: (Spot, f64)) -> Option<f64> {
        if a.1.min(b.1).min(middle.1) < self.nearest {
            return None;
        }
        let half = |a: (Spot, f64), b: (Spot, f64)| {
            self.at_once(a, b).or_else(|| self.halved(a, self.beside(a, a.0.midpoint(b.0)), b))
        };
        Some(half(a, middle)?.min(half(middle, b)?))
    }

    /// A place, and how far it is from copper, up to `reach`.
    fn place(&self, at: Spot, reach: f64) -> (Spot, f64) {
        (at, (self.clearance)(at, reach).min(reach))
    }

    /// A place beside one that is so far from copper.
    fn beside(&self, (known, clearance): (Spot, f64), at: Spot) -> (Spot, f64) {
        self.place(at, clearance + (at - known).length() + ROUNDING)
    }
}

/// Segments of edges by place.
struct Segments {
    /// The edge and the segment of each box.
    places: Vec<(usize, usize)>,
    tree: BoxTree,
}

impl Segments {
    /// Those of the edges that are cut and that `keep` accepts; none where there are none.
    fn of(graph: &Boundaries, keep: impl Fn(usize) -> bool) -> Option<Self> {
        let mut places = Vec::new();
        let mut bounds = Vec::new();
        let cut = graph.edges.iter().enumerate().filter(|(_, edge)| !edge.is_border());
        for (number, edge) in cut.filter(|(number, _)| keep(*number)) {
            for (i, (from, segment)) in edge.path.steps().enumerate() {
                places.push((number, i));
                bounds.push(sides(segment.bounds(from)));
            }
        }
        let is_any = !places.is_empty();
        is_any.then(|| Self { places, tree: BoxTree::new(bounds.iter().copied()) })
    }
}

/// The edges of a graph by place, and which of them hang together.
struct Web<'a> {
    graph: &'a Boundaries,
    segments: Segments,
    /// Which edges are of one part.
    parts: DisjointSets,
}

impl<'a> Web<'a> {
    /// Those of what is cut; none where nothing is.
    fn new(graph: &'a Boundaries) -> Option<Self> {
        let segments = Segments::of(graph, |_| true)?;
        let parts = DisjointSets::new(graph.edges.len());
        let mut web = Self { graph, segments, parts };
        let mut at_node: Vec<Option<usize>> = vec![None; graph.nodes.len()];
        for (number, edge) in graph.edges.iter().enumerate().filter(|(_, edge)| !edge.is_border()) {
            for node in edge.ends.into_iter().flat_map(|(a, b)| [a, b]) {
                let known = *at_node[node.0 as usize].get_or_insert(number);
                web.unite(known, number);
            }
        }
        Some(web)
    }

    /// What stands for the part of an edge.
    fn root(&mut self, edge: usize) -> u32 {
        self.parts.find(member(edge))
    }

    /// Makes one part of those of two edges.
    fn unite(&mut self, a: usize, b: usize) {
        self.parts.union(member(a), member(b));
    }

    /// The shortest way from a vertex to each edge of some `segments` within `reach` that `wanted`
    /// accepts, the nearest first.
    fn ways(
        &self,
        from: (usize, usize),
        segments: &Segments,
        reach: f64,
        wanted: impl Fn(usize) -> bool,
    ) -> Vec<Way> {
        let p = Spot::from(vertex(&self.graph.edges[from.0].path, from.1));
        let mut nearest: BTreeMap<usize, Way> = BTreeMap::new();
        let Segments { places, tree } = segments;
        tree.visit_window([p.x - reach, p.y - reach, p.x + reach, p.y + reach], |i| {
            let (edge, segment) = places[i];
            if !wanted(edge) {
                return;
            }
            let at = self.place_on((edge, segment), p);
            let length = (at - p).length();
            let known = nearest.get(&edge).map_or(reach, |way| way.length);
            if length < known {
                nearest.insert(edge, Way { length, from, to: (edge, segment, at.rounded()) });
            }
        });
        let mut ways: Vec<Way> = nearest.into_values().collect();
        ways.sort_by(Way::compare);
        ways
    }

    /// The place on a segment that is nearest to `p`, or its end nearby.
    fn place_on(&self, (edge, segment): (usize, usize), p: Spot) -> Spot {
        let path = &self.graph.edges[edge].path;
        let foot = foot_on(path, segment, p);
        let ends = [vertex(path, segment), vertex(path, segment + 1)].map(Spot::from);
        ends.into_iter().find(|&end| (end - foot).length() < AT_END).unwrap_or(foot)
    }

    /// The vertices of all edges that are cut, by edge.
    fn vertices(&self) -> Vec<(usize, usize)> {
        let edges = self.graph.edges.iter().enumerate().filter(|(_, edge)| !edge.is_border());
        edges.flat_map(|(edge, of)| (0..=of.path.segments.len()).map(move |vertex| (edge, vertex))).collect()
    }

    /// The vertices at which an edge ends alone.
    fn loose_ends(&self) -> Vec<(usize, usize)> {
        let mut count = vec![0; self.graph.nodes.len()];
        let cut = || self.graph.edges.iter().enumerate().filter(|(_, edge)| !edge.is_border());
        for (_, edge) in cut() {
            edge.ends.into_iter().flat_map(|(a, b)| [a, b]).for_each(|node| count[node.0 as usize] += 1);
        }
        let alone = |node: NodeId| count[node.0 as usize] == 1;
        let ends = cut().filter_map(|(edge, of)| of.ends.map(|ends| (edge, of.path.segments.len(), ends)));
        let both = ends.flat_map(|(edge, last, (a, b))| [(edge, 0, a), (edge, last, b)]);
        both.filter(|&(_, _, node)| alone(node)).map(|(edge, vertex, _)| (edge, vertex)).collect()
    }
}

/// The number that comes most often, of several the least.
fn largest(numbers: impl Iterator<Item = u32>) -> u32 {
    let mut count: BTreeMap<u32, usize> = BTreeMap::new();
    numbers.for_each(|number| *count.entry(number).or_default() += 1);
    count.into_iter().rev().max_by_key(|&(_, count)| count).map_or(0, |(number, _)| number)
}

fn member(edge: usize) -> u32 {
    u32::try_from(edge).expect("below 2³² edges")
}

impl Way {
    fn compare(&self, other: &Self) -> std::cmp::Ordering {
        let key = |way: &Self| (way.from, way.to.0, way.to.1, way.to.2);
        self.length.total_cmp(&other.length).then_with(|| key(self).cmp(&key(other)))
    }
}

/// The links chosen so far, and where edges are parted for them.
struct Chosen {
    nodes: Vec<Point>,
    known: FxHashMap<Point, NodeId>,
    cuts: Vec<Vec<Cut>>,
    links: Vec<Link>,
}

impl Chosen {
    fn node(&mut self, at: Point) -> NodeId {
        let next = NodeId(u32::try_from(self.nodes.len()).expect("below 2³² nodes"));
        let node = *self.known.entry(at).or_insert(next);
        if node == next {
            self.nodes.push(at);
        }
        node
    }

    fn add(&mut self, graph: &Boundaries, way: &Way, clearance: f64) {
        let (edge, at_vertex) = way.from;
        let path = &graph.edges[edge].path;
        let (from, to) = (vertex(path, at_vertex), way.to.2);
        let ends = (self.node(from), self.node(to));
        self.cuts[edge].push(Cut::new(path, at_vertex.min(path.segments.len() - 1), from, ends.0));
        let (edge, segment, _) = way.to;
        self.cuts[edge].push(Cut::new(&graph.edges[edge].path, segment, to, ends.1));
        if from != to {
            let path = Path { start: from, segments: vec![Segment::Line { to }] };
            self.links.push(Link { path, clearance: Nm::from_f64(clearance.floor()), ends });
        }
    }
}

impl Boundaries {
    /// The same with links between its parts, and from ends that hang loose.
    pub(super) fn linked(mut self, rules: &Rules<'_>) -> Self {
        self.merge_nodes();
        let Some(mut web) = Web::new(&self) else { return self };
        let nodes = self.nodes.clone();
        let known = (0_u32..).zip(&nodes).map(|(node, &at)| (at, NodeId(node))).collect();
        let mut chosen = Chosen { nodes, known, cuts: vec![Vec::new(); self.edges.len()], links: Vec::new() };
        let keeps_off = |way: &Way| {
            let (Boundary { path, clearance, .. }, at) = (&self.edges[way.from.0], way.from.1);
            rules.keeps_off((vertex(path, at).into(), clearance[at].to_f64()), way.to.2.into())
        };
        let loose = web.loose_ends().into_par_iter().flat_map_iter(|from| {
            let ways = web.ways(from, &web.segments, rules.short, |edge| edge != from.0).into_iter();
            ways.filter_map(|way| keeps_off(&way).map(|clearance| (way, clearance))).take(CHOICES)
        });
        for (way, clearance) in loose.collect::<Vec<_>>() {
            web.unite(way.from.0, way.to.0);
            chosen.add(&self, &way, clearance);
        }
        let (mut tried, mut reach) = (0.0, (rules.step + FINE).min(rules.longest));
        loop {
            let part = web.parts.clone().representatives();
            // Mostly one part has nearly all: from there only the others are looked for.
            let largest = largest(web.segments.places.iter().map(|&(edge, _)| part[edge]));
            let Some(others) = Segments::of(&self, |edge| part[edge] != largest) else { break };
            let between = web.vertices().into_par_iter().flat_map_iter(|from| {
                let home = part[from.0];
                let segments = if home == largest { &others } else { &web.segments };
                let ways = web.ways(from, segments, reach, |edge| part[edge] != home);
                // The others were tried before: what parts them has not changed.
                ways.into_iter().filter(|way| way.length >= tried)
            });
            let mut ways: Vec<Way> = between.collect();
            ways.sort_by(Way::compare);
            for way in ways {
                if web.root(way.from.0) != web.root(way.to.0)
                    && let Some(clearance) = keeps_off(&way)
                {
                    web.unite(way.from.0, way.to.0);
                    chosen.add(&self, &way, clearance);
                }
            }
            if reach >= rules.longest {
                break;
            }
            (tried, reach) = (reach, (reach * 2.0).min(rules.longest));
        }
        let Chosen { nodes, cuts, links, .. } = chosen;
        let mut edges = Vec::with_capacity(self.edges.len());
        for (edge, cuts) in self.edges.into_iter().zip(cuts) {
            part(edge, cuts, &nodes, &mut edges);
        }
        Self { nodes, edges, links }
    }

    /// Makes one node of those that stand in one place.
    fn merge_nodes(&mut self) {
        let mut known: FxHashMap<Point, NodeId> = FxHashMap::default();
        let numbers = (0_u32..).zip(&self.nodes);
        let same: Vec<NodeId> = numbers.map(|(node, &at)| *known.entry(at).or_insert(NodeId(node))).collect();
        let same = |node: NodeId| same[node.0 as usize];
        self.edges.iter_mut().for_each(|edge| edge.ends = edge.ends.map(|(a, b)| (same(a), same(b))));
    }
}
