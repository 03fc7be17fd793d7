//! The boundary graph walked in few trails: what is cut in one go without a retract.
//!
//! A trail passes each edge once. A connected graph with 2k nodes of odd degree needs k trails
//! (Euler); cutting an edge a second time makes the two odd nodes at its ends even and saves a
//! trail, so odd nodes are paired along shortest ways wherever that saves time (the Chinese
//! postman's problem with an escape).
//!
//! # Sources
//!
//! C. Hierholzer, *Ueber die Möglichkeit, einen Linienzug ohne Wiederholung und ohne Unterbrechung
//! zu umfahren*, Mathematische Annalen 6, 1873. M. Guan, *Graphic programming using odd or even
//! points*, Chinese Mathematics 1, 1962. E. W. Dijkstra, *A note on two problems in connexion with
//! graphs*, Numerische Mathematik 1, 1959.

mod matching;

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use bitvec::prelude::{BitSlice, BitVec, bitvec};
use rustc_hash::FxHashMap;

use crate::topology::{DisjointSets, Groups};

use super::ordered::Ordered;

use matching::Candidate;

/// An edge of the graph.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    /// The nodes at its ends; none for a loop without a node.
    pub ends: Option<(u32, u32)>,
    /// How long cutting it takes.
    pub seconds: f64,
    /// Whether it has to be cut; one that need not be serves to save retracts.
    pub must: bool,
}

/// A link passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Step {
    /// The index of the link.
    pub link: usize,
    /// Whether from its second end to its first.
    pub backwards: bool,
}

/// The trails, in a fixed order, that together pass every link that must be cut. A link is passed
/// twice, or one passed that need not be, where that takes less than `retract` seconds and saves a
/// retract.
pub(super) fn walk(nodes: usize, links: &[Link], retract: f64) -> Vec<Vec<Step>> {
    let mut trails: Vec<Vec<Step>> = Vec::new();
    let mut passes: Vec<Pass> = Vec::new();
    for (index, link) in links.iter().enumerate() {
        match link.ends {
            Some(ends) if link.must => passes.push(Pass { link: Some(index), ends }),
            None if link.must => trails.push(vec![Step { link: index, backwards: false }]),
            _ => {}
        }
    }
    let (again, there_and_back) = joins(nodes, links, &passes, retract);
    for index in again.into_iter().chain(there_and_back.iter().flat_map(|&index| [index; 2])) {
        let ends = links[index].ends.expect("only links with ends join");
        passes.push(Pass { link: Some(index), ends });
    }
    close(nodes, &mut passes);
    trails.extend(circuits(nodes, &passes).into_iter().flat_map(|circuit| split(&circuit, &passes)));
    trails
}

/// An edge of the multigraph that is walked; without a link it stands for a retract.
#[derive(Clone, Copy, Debug)]
struct Pass {
    link: Option<usize>,
    ends: (u32, u32),
}

/// Which nodes have an odd number of passes.
fn odd(nodes: usize, passes: &[Pass]) -> BitVec {
    let mut odd = bitvec![0; nodes];
    for end in passes.iter().flat_map(|pass| [pass.ends.0 as usize, pass.ends.1 as usize]) {
        let was_odd = odd[end];
        odd.set(end, !was_odd);
    }
    odd
}

/// The links to be passed once more, and those to be passed there and back.
///
/// Odd nodes are joined in pairs where the way between takes less than `retract`; where two such
/// ways share a link, passing it neither time joins the same four nodes for less. What is then
/// closed is joined to others by links there and back ([`bridges`]).
fn joins(nodes: usize, links: &[Link], passes: &[Pass], retract: f64) -> (Vec<usize>, Vec<usize>) {
    let odd = odd(nodes, passes);
    let mut rank = vec![0; nodes];
    (0..).zip(odd.iter_ones()).for_each(|(number, node)| rank[node] = number);
    let graph = adjacency(nodes, links.iter().map(|link| link.ends));
    let (pairs, ways) = Searches::new(&graph, links, &odd, retract).pairs(&rank);
    let candidate = |&Pair { nodes: (a, b), seconds, .. }: &Pair| Candidate {
        nodes: (rank[a as usize], rank[b as usize]),
        cost: seconds,
    };
    let candidates: Vec<Candidate> = pairs.iter().map(candidate).collect();
    let mut again = vec![false; links.len()];
    let joined = matching::join(odd.count_ones(), &candidates, retract / 2.0);
    let chosen: Vec<(Pair, &[u32])> =
        joined.into_iter().map(|index| (pairs[index], ways.of(pairs[index].way as usize))).collect();
    for (_, way) in &chosen {
        way.iter().for_each(|&link| again[link as usize] ^= true);
    }
    let mut alone = odd;
    let nodes = chosen.iter().flat_map(|(pair, _)| [pair.nodes.0, pair.nodes.1]);
    nodes.for_each(|node| alone.set(node as usize, false));
    let mut part = DisjointSets::new(alone.len());
    for (link, _) in links.iter().zip(&again).filter(|(link, again)| link.must || **again) {
        if let Some((a, b)) = link.ends {
            part.union(a, b);
        }
    }
    let there_and_back = bridges(links, &again, &alone, &mut part, retract);
    spare(links, &alone, &chosen, &mut part, &mut again);
    ((0..links.len()).filter(|&link| again[link]).collect(), there_and_back)
}

/// The links that need not be cut and, passed there and back, make one trail of what is closed and
/// another part; the shortest first. `alone` are the odd nodes that are not joined.
fn bridges(
    links: &[Link],
    again: &[bool],
    alone: &BitSlice,
    part: &mut DisjointSets,
    retract: f64,
) -> Vec<usize> {
    let mut is_cut = vec![false; alone.len()];
    for link in links.iter().filter(|link| link.must) {
        if let Some((a, _)) = link.ends {
            is_cut[part.find(a) as usize] = true;
        }
    }
    let mut is_open = vec![false; alone.len()];
    for node in alone.iter_ones().map(number) {
        is_open[part.find(node) as usize] = true;
    }
    let free = |&link: &usize| !links[link].must && !again[link] && 2.0 * links[link].seconds < retract;
    let mut short: Vec<usize> = (0..links.len()).filter(free).collect();
    short.sort_by(|&a, &b| links[a].seconds.total_cmp(&links[b].seconds).then(a.cmp(&b)));
    let mut chosen = Vec::new();
    for link in short {
        let Some(ends) = links[link].ends else { continue };
        let (a, b) = (part.find(ends.0) as usize, part.find(ends.1) as usize);
        // Two parts with loose ends take as many trails together as apart.
        if a != b && is_cut[a] && is_cut[b] && !(is_open[a] && is_open[b]) {
            part.union(ends.0, ends.1);
            is_open[a.min(b)] |= is_open[a.max(b)];
            chosen.push(link);
        }
    }
    chosen
}

/// Takes back the dearest join of each part whose odd nodes are all joined: with the last two left,
/// it is still one trail.
///
/// A way over links that must be cut anyway can be taken back without the part falling apart.
fn spare(
    links: &[Link],
    alone: &BitSlice,
    chosen: &[(Pair, &[u32])],
    part: &mut DisjointSets,
    again: &mut [bool],
) {
    let mut is_open = vec![false; alone.len()];
    for node in alone.iter_ones().map(number) {
        is_open[part.find(node) as usize] = true;
    }
    let mut dearest: BTreeMap<u32, (f64, &[u32])> = BTreeMap::new();
    for (pair, way) in chosen.iter().filter(|(_, way)| way.iter().all(|&link| links[link as usize].must)) {
        // What ways share is passed neither time, and would have to be again.
        let saved = way.iter().map(|&link| {
            let seconds = links[link as usize].seconds;
            if again[link as usize] { seconds } else { -seconds }
        });
        let (saved, part) = (saved.sum::<f64>(), part.find(pair.nodes.0));
        if !is_open[part as usize]
            && saved > 0.0
            && dearest.get(&part).is_none_or(|&(before, _)| saved > before)
        {
            dearest.insert(part, (saved, way));
        }
    }
    for (_, way) in dearest.values() {
        way.iter().for_each(|&link| again[link as usize] ^= true);
    }
}

/// Two odd nodes, the smaller first, and the shortest way between them.
#[derive(Clone, Copy)]
struct Pair {
    nodes: (u32, u32),
    seconds: f64,
    /// The number of the way.
    way: u32,
}

/// How many near odd nodes a search lists. Chosen, not measured against other numbers: in a ring of
/// pads, or where traces point at a centre, hundreds lie within the time of a retract.
const NEAREST: usize = 12;

/// What a search knows of a node: how far it is, and by which link from which node; of an earlier
/// search nothing counts.
#[derive(Clone, Copy, Default)]
struct Reached {
    search: u32,
    seconds: f64,
    by: Option<(u32, u32)>,
}

/// Searches for near odd nodes, one after the other, by Dijkstra's algorithm.
struct Searches<'a> {
    graph: &'a Adjacency,
    links: &'a [Link],
    odd: &'a BitSlice,
    retract: f64,
    reached: Vec<Reached>,
    queue: BinaryHeap<Reverse<(Ordered, usize)>>,
    count: u32,
    /// The links of the ways that were found.
    ways: Groups<u32>,
}

impl<'a> Searches<'a> {
    fn new(graph: &'a Adjacency, links: &'a [Link], odd: &'a BitSlice, retract: f64) -> Self {
        let reached = vec![Reached::default(); odd.len()];
        let (queue, ways) = (BinaryHeap::new(), Groups::default());
        Self { graph, links, odd, retract, reached, queue, count: 0, ways }
    }

    /// Near odd nodes by two, each two once, in their order; and the links of the ways between.
    fn pairs(mut self, rank: &[usize]) -> (Vec<Pair>, Groups<u32>) {
        // By the rank of the node they were found from.
        let mut found: Groups<Pair> = Groups::default();
        for from in self.odd.iter_ones() {
            let known = |to: usize| {
                let of_other = if to < from { found.of(rank[to]) } else { &[] };
                of_other.iter().any(|pair| pair.nodes.1 as usize == from)
            };
            let near = self.near(from, known);
            found.push(near);
        }
        let mut pairs: Vec<Pair> = found.iter().flatten().copied().collect();
        pairs.sort_by_key(|pair| pair.nodes);
        (pairs, self.ways)
    }

    /// `from` with the nearest odd nodes within `retract` seconds, but for those with which it is
    /// `known` to be a pair: both of two near nodes may find the other.
    fn near(&mut self, from: usize, known: impl Fn(usize) -> bool) -> Vec<Pair> {
        self.count += 1;
        self.queue.clear();
        self.reach(from, 0.0, None);
        let (mut pairs, mut count) = (Vec::new(), 0);
        while let Some(Reverse((Ordered(seconds), node))) = self.queue.pop() {
            if self.reached[node].seconds < seconds {
                continue;
            }
            if self.odd[node] && node != from {
                if !known(node) {
                    let (nodes, way) =
                        ((number(from.min(node)), number(from.max(node))), self.way_back(node));
                    pairs.push(Pair { nodes, seconds, way: self.ways.push(way) });
                }
                count += 1;
                if count == NEAREST {
                    break;
                }
            }
            let graph = self.graph;
            for &(link, next) in graph.of(node) {
                let longer = seconds + self.links[link as usize].seconds.max(0.0);
                if longer < self.retract {
                    self.reach(next as usize, longer, Some((link, number(node))));
                }
            }
        }
        pairs
    }

    /// Notes how far a node is, if that is nearer than is known.
    fn reach(&mut self, node: usize, seconds: f64, by: Option<(u32, u32)>) {
        let known = &mut self.reached[node];
        if known.search < self.count || seconds < known.seconds {
            *known = Reached { search: self.count, seconds, by };
            self.queue.push(Reverse((Ordered(seconds), node)));
        }
    }

    /// The links from `node` back to where the search began.
    fn way_back(&self, mut node: usize) -> Vec<u32> {
        let mut way = Vec::new();
        while let Some((link, before)) = self.reached[node].by {
            way.push(link);
            node = before as usize;
        }
        way
    }
}

/// Which edges meet at which node, each with the node at its other end.
type Adjacency = Groups<(u32, u32)>;

/// The adjacency of edges given by their ends, in order; those without ends are left out.
fn adjacency(nodes: usize, edges: impl Iterator<Item = Option<(u32, u32)>> + Clone) -> Adjacency {
    let both =
        (0_u32..).zip(edges).filter_map(|(edge, ends)| ends.map(|(a, b)| [(a, (edge, b)), (b, (edge, a))]));
    Groups::new(nodes, both.flatten())
}

/// Adds retracts between the odd nodes of each connected part, so that all nodes are even.
fn close(nodes: usize, passes: &mut Vec<Pass>) {
    let mut part = DisjointSets::new(nodes);
    for pass in passes.iter() {
        part.union(pass.ends.0, pass.ends.1);
    }
    let odd = odd(nodes, passes);
    let mut waiting: FxHashMap<u32, u32> = FxHashMap::default();
    for node in odd.iter_ones().map(number) {
        let part = part.find(node);
        match waiting.remove(&part) {
            None => _ = waiting.insert(part, node),
            Some(other) => passes.push(Pass { link: None, ends: (other, node) }),
        }
    }
}

fn number(node: usize) -> u32 {
    u32::try_from(node).expect("nodes are numbered in 32 bits")
}

/// A pass in a circuit: its index, and whether from its second end to its first.
type Walked = (usize, bool);

/// The closed walks that together take every pass once (Hierholzer), one for each connected part.
fn circuits(nodes: usize, passes: &[Pass]) -> Vec<Vec<Walked>> {
    let graph = adjacency(nodes, passes.iter().map(|pass| Some(pass.ends)));
    let (mut taken, mut next) = (vec![false; passes.len()], vec![0; nodes]);
    let mut circuits = Vec::new();
    for start in 0..nodes {
        let mut circuit = Vec::new();
        let mut stack: Vec<(usize, Option<Walked>)> = vec![(start, None)];
        while let Some(&(node, arrived)) = stack.last() {
            let edges = graph.of(node);
            while next[node] < edges.len() && taken[edges[next[node]].0 as usize] {
                next[node] += 1;
            }
            if let Some(&(pass, to)) = edges.get(next[node]) {
                let pass = pass as usize;
                taken[pass] = true;
                stack.push((to as usize, Some((pass, passes[pass].ends.0 as usize != node))));
            } else {
                circuit.extend(arrived);
                stack.pop();
            }
        }
        circuit.reverse();
        if !circuit.is_empty() {
            circuits.push(circuit);
        }
    }
    circuits
}

/// The trails of a circuit between its retracts.
fn split(circuit: &[Walked], passes: &[Pass]) -> Vec<Vec<Step>> {
    let first_retract = circuit.iter().position(|&(pass, _)| passes[pass].link.is_none());
    let (before, after) = circuit.split_at(first_retract.unwrap_or(0));
    let mut trails = vec![Vec::new()];
    for &(pass, backwards) in after.iter().chain(before) {
        match passes[pass].link {
            Some(link) => trails.last_mut().expect("never empty").push(Step { link, backwards }),
            None => trails.push(Vec::new()),
        }
    }
    trails.retain(|trail| !trail.is_empty());
    trails
}

#[cfg(test)]
mod tests {
    use super::*;

    fn link(a: u32, b: u32, seconds: f64) -> Link {
        Link { ends: Some((a, b)), seconds, must: true }
    }

    fn times(trails: &[Vec<Step>], link: usize) -> usize {
        trails.iter().flatten().filter(|step| step.link == link).count()
    }

    #[test]
    fn a_star_of_three_needs_two_trails_or_a_second_cut() {
        let star = [link(0, 1, 1.0), link(0, 2, 2.0), link(0, 3, 9.0)];
        assert_eq!(walk(4, &star, 0.5).len(), 2, "four odd nodes, two trails");
        let trails = walk(4, &star, 1.5);
        assert_eq!((trails.len(), times(&trails, 0)), (1, 2), "the shortest arm is cut twice");
    }

    #[test]
    fn what_is_one_trail_anyway_is_not_cut_twice() {
        assert_eq!(
            walk(2, &[link(0, 1, 1.0)], 5.0),
            [[Step { link: 0, backwards: false }]],
            "one edge, once"
        );
        let star = [link(0, 1, 1.0), link(0, 2, 2.0), link(0, 3, 3.0)];
        let trails = walk(4, &star, 50.0);
        assert_eq!((trails.len(), trails[0].len()), (1, 4), "of two joins the dearer is spared");
        assert_eq!(times(&trails, 0), 2, "the shortest arm is what is cut twice");
    }

    #[test]
    fn a_link_that_need_not_be_cut_serves_only_to_save_a_retract() {
        let mut square = [link(0, 1, 1.0), link(2, 3, 1.0), link(1, 2, 0.1), link(3, 0, 5.0)];
        (square[2].must, square[3].must) = (false, false);
        let trails = walk(4, &square, 0.5);
        assert_eq!((trails.len(), times(&trails, 2), times(&trails, 3)), (1, 1, 0), "by the short way alone");
    }

    #[test]
    fn closed_parts_are_joined_there_and_back_and_open_ones_are_not() {
        let optional = |a, b, seconds| Link { must: false, ..link(a, b, seconds) };
        let rings =
            [link(0, 0, 3.0), link(1, 1, 3.0), link(2, 2, 3.0), optional(0, 1, 0.2), optional(1, 2, 2.0)];
        let trails = walk(3, &rings, 1.0);
        assert_eq!((trails.len(), times(&trails, 3), times(&trails, 4)), (2, 2, 0), "where it saves time");
        let bars =
            [link(0, 1, 3.0), link(2, 3, 3.0), optional(1, 4, 0.1), link(4, 4, 1.0), optional(0, 2, 9.0)];
        let trails = walk(5, &bars, 5.0);
        assert_eq!((trails.len(), times(&trails, 2)), (2, 2), "a ring and a bar, but not two bars");
        let way_out = [link(0, 0, 3.0), optional(0, 1, 0.1)];
        assert_eq!(walk(2, &way_out, 5.0).concat().len(), 1, "not where nothing is cut");
    }

    #[test]
    fn a_loop_is_a_trail_of_its_own() {
        let ring = Link { ends: None, seconds: 1.0, must: true };
        let at_node = link(0, 0, 1.0);
        assert_eq!(walk(1, &[ring, at_node], 1.0).len(), 2, "one with and one without a node");
    }
}
