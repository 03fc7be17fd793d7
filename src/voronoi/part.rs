//! Boundaries parted at places along them, which become nodes.
//!
//! ```text
//!   ╭──────────╮        ╭─────●────╮
//!   │          │   ─▶   │     2    │   A loop without a node begins at its first cut.
//!   ╰──────────╯        ╰──●───────╯
//! ```

use crate::geometry::{Path, Point, Segment};

use super::plane::{Span, Spot};
use super::{Boundary, NodeId};

/// A place on a boundary where it is to be parted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    segment: usize,
    /// How far along the segment, in nanometres.
    along: f64,
    node: NodeId,
}

impl Cut {
    /// The place `at` on the segment of `path` with this index, where `node` stands.
    pub(super) fn new(path: &Path, segment: usize, at: Point, node: NodeId) -> Self {
        let from = vertex(path, segment);
        let along = if at == from { 0.0 } else { path.segments[segment].ending(at).length(from) };
        Self { segment, along, node }
    }
}

/// The point of `path` nearest to `p`: the index of its segment, the point, and how far it is, in
/// nanometres.
pub(super) fn foot(path: &Path, p: Spot) -> (usize, Spot, f64) {
    let mut best = (0, path.start.into(), f64::INFINITY);
    for index in 0..path.segments.len() {
        let foot = foot_on(path, index, p);
        let distance = (p - foot).length();
        if distance < best.2 {
            best = (index, foot, distance);
        }
    }
    best
}

/// What lies so near to an end of a segment is that end, and between two cuts so near to each other
/// the way is straight, in nanometres: of a part of an arc, a nanometre long, rounding would make
/// all of a circle. Chosen.
const SAME: f64 = 1_000.0;

/// The point nearest to `p` of the segment of `path` with this index.
pub(super) fn foot_on(path: &Path, index: usize, p: Spot) -> Spot {
    let (from, segment) = (vertex(path, index), &path.segments[index]);
    let foot = Span::new(from, segment).foot(p);
    let ends = [from, segment.to()].map(Spot::from);
    ends.into_iter().find(|&end| (end - foot).length() < SAME).unwrap_or(foot)
}

/// Parts `edge` at its cuts into edges from node to node; one without a node is parted into a loop
/// with one at least. Where nothing is cut it stays as it is.
pub(super) fn part(mut edge: Boundary, mut cuts: Vec<Cut>, nodes: &[Point], parts: &mut Vec<Boundary>) {
    cuts.sort_by(|a, b| a.segment.cmp(&b.segment).then(a.along.total_cmp(&b.along)));
    if cuts.is_empty() {
        return parts.push(edge);
    }
    let mut marks = mark(&mut edge, &cuts, nodes);
    let ends = edge.ends.unwrap_or_else(|| {
        let (first, node) = marks.remove(0);
        begin_at(&mut edge, first);
        marks.iter_mut().for_each(|(vertex, _)| *vertex -= first);
        (node, node)
    });
    let mut start = (0, ends.0);
    for end in marks.into_iter().chain([(edge.path.segments.len(), ends.1)]) {
        if end.0 > start.0 {
            let segments = edge.path.segments[start.0..end.0].to_vec();
            let path = Path { start: vertex(&edge.path, start.0), segments };
            let clearance = edge.clearance[start.0..=end.0].to_vec();
            parts.push(Boundary { path, clearance, ends: Some((start.1, end.1)), ..edge.clone() });
        }
        start = end;
    }
}

/// Gives the path a vertex at each cut; their indices, with the nodes.
fn mark(edge: &mut Boundary, cuts: &[Cut], nodes: &[Point]) -> Vec<(usize, NodeId)> {
    let mut marks = Vec::with_capacity(cuts.len());
    let mut added = 0;
    let mut before: Option<Cut> = None;
    for cut in cuts {
        let (at, index) = (nodes[cut.node.0 as usize], cut.segment + added);
        let segment = edge.path.segments[index];
        let is_after = |before: Cut| before.segment == cut.segment && cut.along - before.along < SAME;
        let is_short = before.replace(*cut).is_some_and(is_after);
        if at == vertex(&edge.path, index) {
            marks.push((index, cut.node));
        } else if at == segment.to() {
            marks.push((index + 1, cut.node));
        } else {
            let first = if is_short { Segment::Line { to: at } } else { segment.ending(at) };
            edge.path.segments.insert(index, first);
            edge.clearance.insert(index + 1, edge.clearance[index].min(edge.clearance[index + 1]));
            marks.push((index + 1, cut.node));
            added += 1;
        }
    }
    marks
}

/// The vertex of `path` with this index: the start, then the ends of the segments.
pub(super) fn vertex(path: &Path, index: usize) -> Point {
    index.checked_sub(1).map_or(path.start, |before| path.segments[before].to())
}

/// Turns a loop so that it begins at the vertex with this index.
fn begin_at(edge: &mut Boundary, first: usize) {
    edge.path.start = vertex(&edge.path, first);
    edge.path.segments.rotate_left(first);
    edge.clearance.pop();
    edge.clearance.rotate_left(first);
    edge.clearance.push(edge.clearance[0]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Nm, Turn, Vector};
    use crate::voronoi::Owner;

    /// Two links met an arc a nanometre apart, and between them the cutter went all the way round.
    #[test]
    fn between_two_cuts_a_nanometre_apart_no_arc_is_a_circle() {
        let center = Point::new(Nm::new(123_716_201), Nm::new(-132_999_535));
        let start = Point::new(Nm::new(122_609_120), Nm::new(-132_999_535));
        let to = Point::new(Nm::new(124_200_300), Nm::new(-133_995_200));
        let arc = Segment::Arc { to, center, turn: Turn::CounterClockwise };
        let path = Path { start, segments: vec![arc] };
        let length = path.length();
        let near = Point::new(Nm::new(124_114_074), Nm::new(-134_032_675));
        let places = (-2..=2).flat_map(|x| (-2..=2).map(move |y| Vector::new(Nm::new(x), Nm::new(y))));
        for nodes in places.map(|way| [near, near + way]) {
            let cuts = [0, 1].map(|node| Cut::new(&path, 0, nodes[node as usize], NodeId(node)));
            let edge = Boundary {
                path: path.clone(),
                clearance: vec![Nm::from_um(100); 2],
                left: Owner::Background,
                right: Owner::Background,
                ends: Some((NodeId(2), NodeId(3))),
            };
            let mut parts = Vec::new();
            part(edge, cuts.to_vec(), &nodes, &mut parts);
            let whole: f64 = parts.iter().map(|part| part.path.length()).sum();
            assert!((whole - length).abs() < 10.0, "{whole} of {length} nm in {} parts", parts.len());
        }
    }
}
