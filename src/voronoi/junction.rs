//! Boundaries that end on a loop, joined to it: the loop gets a node there, and the boundary is led
//! on to it.
//!
//! ```text
//!   ┃         ┃
//!   ┃ ───  →  ┣────
//!   ┃         ┃
//! ```

use rustc_hash::FxHashMap;

use crate::geometry::{Nm, Point, Rect, RectIndex, Segment};

use super::part::{Cut, foot, part};
use super::plane::Spot;
use super::{Boundaries, Boundary, NodeId};

/// Loops, and what is joined to them.
pub(super) struct Junctions {
    nodes: Vec<Point>,
    loops: Vec<Boundary>,
    /// Where each loop lies, and what is near it.
    near: RectIndex,
    /// Where each loop is parted.
    cuts: Vec<Vec<Cut>>,
    /// The nodes that stand on loops.
    known: FxHashMap<Point, NodeId>,
    others: Vec<Boundary>,
    /// How far from a loop what ends on it may end, in nanometres.
    leash: f64,
}

impl Junctions {
    pub(super) fn new(loops: Boundaries, leash: f64) -> Self {
        let Boundaries { nodes, edges, .. } = loops;
        let ends = edges.iter().filter_map(|edge| edge.ends).flat_map(|(a, b)| [a, b]);
        let known = ends.map(|node| (nodes[node.0 as usize], node)).collect();
        let reach = Nm::from_f64(leash);
        let near = RectIndex::new(edges.iter().map(|edge| edge.path.bounds().inflate(reach)));
        let cuts = vec![Vec::new(); edges.len()];
        Self { nodes, cuts, loops: edges, near, known, others: Vec::new(), leash }
    }

    /// Adds those edges of `found` that `keep` accepts. Where they meet one that is not kept they
    /// end on a loop, if one is near. `clearance` tells the distance from a point to the nearest
    /// copper of all.
    pub(super) fn add(
        &mut self,
        found: Boundaries,
        keep: impl Fn(&Boundary) -> bool,
        clearance: impl Fn(Point) -> Nm,
    ) {
        let (kept, dropped): (Vec<_>, Vec<_>) = found.edges.into_iter().partition(keep);
        let mut at_loop = vec![false; found.nodes.len()];
        for (a, b) in dropped.into_iter().filter_map(|edge| edge.ends) {
            (at_loop[a.0 as usize], at_loop[b.0 as usize]) = (true, true);
        }
        let mut used = vec![None; found.nodes.len()];
        for mut edge in kept {
            edge.ends = edge.ends.map(|ends| {
                let mut node = |NodeId(old): NodeId| {
                    let at = found.nodes[old as usize];
                    *used[old as usize].get_or_insert_with(|| self.node(at, at_loop[old as usize]))
                };
                (node(ends.0), node(ends.1))
            });
            let vertices = std::iter::once(edge.path.start).chain(edge.path.segments.iter().map(Segment::to));
            edge.clearance = vertices.zip(&edge.clearance).map(|(p, &nm)| clearance(p).min(nm)).collect();
            self.lead_on(&mut edge, &clearance);
            self.others.push(edge);
        }
    }

    /// The number of a node at `at`, or of the place nearby on a loop where it is to stand.
    fn node(&mut self, at: Point, on_loop: bool) -> NodeId {
        let near = if on_loop { self.nearest(at.into()) } else { None };
        let Some((index, segment, foot)) = near else { return push(&mut self.nodes, at) };
        let foot = foot.rounded();
        if let Some(&known) = self.known.get(&foot) {
            return known;
        }
        let node = push(&mut self.nodes, foot);
        self.known.insert(foot, node);
        self.cuts[index].push(Cut::new(&self.loops[index].path, segment, foot, node));
        node
    }

    /// The loop nearest to `p` within the leash: its index, that of its segment there, and the
    /// place.
    fn nearest(&self, p: Spot) -> Option<(usize, usize, Spot)> {
        let mut best = (self.leash, None);
        for index in self.near.touching(Rect::new(p.rounded(), p.rounded())) {
            let (segment, foot, distance) = foot(&self.loops[index].path, p);
            if distance < best.0 {
                best = (distance, Some((index, segment, foot)));
            }
        }
        best.1
    }

    /// Draws lines from the ends of a boundary to its nodes, where these have moved.
    fn lead_on(&self, edge: &mut Boundary, clearance: impl Fn(Point) -> Nm) {
        let Some((from, to)) = edge.ends.map(|(a, b)| (self.nodes[a.0 as usize], self.nodes[b.0 as usize]))
        else {
            return;
        };
        if edge.path.end() != to {
            edge.path.segments.push(Segment::Line { to });
            edge.clearance.push(clearance(to));
        }
        if edge.path.start != from {
            edge.path.segments.insert(0, Segment::Line { to: edge.path.start });
            edge.path.start = from;
            edge.clearance.insert(0, clearance(from));
        }
    }

    /// The graph.
    pub(super) fn finish(self) -> Boundaries {
        let mut edges = Vec::with_capacity(self.loops.len() + self.others.len());
        for (edge, cuts) in self.loops.into_iter().zip(self.cuts) {
            part(edge, cuts, &self.nodes, &mut edges);
        }
        edges.extend(self.others);
        Boundaries { nodes: self.nodes, edges, links: Vec::new() }
    }
}

fn push(nodes: &mut Vec<Point>, at: Point) -> NodeId {
    nodes.push(at);
    NodeId(u32::try_from(nodes.len() - 1).expect("below 2³² nodes"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Path, Turn};
    use crate::topology::NetId;
    use crate::voronoi::Owner;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    fn edge(path: Path, ends: Option<(u32, u32)>) -> Boundary {
        let clearance = vec![Nm::from_um(100); path.segments.len() + 1];
        let ends = ends.map(|(a, b)| (NodeId(a), NodeId(b)));
        Boundary { path, clearance, left: Owner::Net(NetId(0)), right: Owner::Background, ends }
    }

    /// A circle of one millimetre round zero, and lines that end near it at x = 1000 and y = 1000.
    fn joined(ends: &[Point]) -> Boundaries {
        let start = at(-1000, 0);
        let circle = Segment::Arc { to: start, center: at(0, 0), turn: Turn::CounterClockwise };
        let circle = edge(Path { start, segments: vec![circle] }, None);
        let mut junctions =
            Junctions::new(Boundaries { edges: vec![circle], ..Boundaries::default() }, 30_000.0);
        let far = at(3000, 3000);
        let line = |(index, &from): (u32, &Point)| {
            edge(Path::polyline([from, far]).expect("points"), Some((index, u32::MAX)))
        };
        let mut edges: Vec<_> = (0..).zip(ends).map(line).collect();
        let last = u32::try_from(ends.len()).expect("few");
        edges.iter_mut().for_each(|edge| edge.ends = edge.ends.map(|(a, _)| (a, NodeId(last))));
        // What is not kept marks the nodes that stand on the loop.
        let mark = |index: u32| Boundary {
            right: Owner::Outside,
            ..edge(Path::polyline([far]).expect("a point"), Some((index, index)))
        };
        edges.extend((0..last).map(mark));
        let nodes = ends.iter().copied().chain([far]).collect();
        junctions.add(
            Boundaries { nodes, edges, links: vec![] },
            |edge| !edge.is_border(),
            |_| Nm::from_um(70),
        );
        junctions.finish()
    }

    #[test]
    fn a_loop_is_parted_where_boundaries_end_and_keeps_its_length() {
        let graph = joined(&[at(1010, 0), at(0, 990)]);
        assert_eq!(graph.edges.len(), 4, "two halves of the loop, two lines");
        let (halves, lines) = graph.edges.split_at(2);
        let length: f64 = halves.iter().map(|half| half.path.length()).sum();
        assert!((length / 1e6 - core::f64::consts::TAU).abs() < 1e-6, "{length}");
        for line in lines {
            let (from, _) = line.ends.expect("ends");
            assert_eq!(graph.nodes[from.0 as usize], line.path.start, "begins at its node");
            assert_eq!((line.path.segments.len(), line.clearance.len()), (2, 3), "led on to the loop");
            let meets = halves.iter().filter(|half| half.ends.is_some_and(|(a, b)| a == from || b == from));
            assert_eq!(meets.count(), 2, "both halves meet there");
        }
    }

    #[test]
    fn boundaries_that_end_at_one_place_share_its_node_and_far_ones_stay() {
        let graph = joined(&[at(1010, 0), at(1020, 0), at(1500, 0)]);
        let starts: Vec<_> = graph.edges[1..].iter().map(|edge| edge.path.start).collect();
        assert_eq!(starts, [at(1000, 0), at(1000, 0), at(1500, 0)], "the third is no neighbour of the loop");
        assert_eq!(graph.edges[0].ends.map(|(a, b)| a == b), Some(true), "a loop with one node");
    }
}
