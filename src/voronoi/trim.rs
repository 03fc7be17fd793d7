//! Lines between their nodes, and no farther.
//!
//! Samples near a node may have been placed past it, along the continuation of the boundary that
//! another region or the outside cuts off; going there and back would cut into that region. And a
//! node that was moved since has left a gap.

use super::span::Vertex;
use super::stitch::Line;
use super::tip::{HALVINGS, NEARER, Tips};

impl Tips<'_> {
    /// Takes out what lines have beyond the nodes at their ends, where another region or the
    /// outside begins.
    pub(super) fn trim(&self, lines: &mut [Line]) {
        let corners = lines.iter().filter(|line| line.is_border()).filter_map(|line| line.ends);
        let mut border: Vec<_> = corners.flat_map(|(from, to)| [from.key(), to.key()]).collect();
        border.sort_unstable();
        for line in lines.iter_mut().filter(|line| !line.is_border()) {
            let Some((from, to)) = line.ends else { continue };
            for (corner, tail) in [(from, false), (to, true)] {
                let at_border = border.binary_search(&corner.key()).is_ok();
                let onset = self.onset(line, tail, at_border);
                if onset > 1 {
                    self.lead_on(line, tail, vertex(line, tail, 0), onset);
                }
            }
        }
    }

    /// Makes one end of a line begin at a node.
    pub(super) fn lead(&self, line: &mut Line, tail: bool, node: Vertex) {
        let onset = self.onset(line, tail, false);
        self.lead_on(line, tail, node, onset);
    }

    /// The way on which one end of a line comes to begin at a node; none where it does not follow
    /// the boundary of the line's regions.
    pub(super) fn way_to(&self, line: &Line, tail: bool, node: Vertex) -> Option<Way> {
        let onset = self.onset(line, tail, false);
        let (vertices, follows) = self.follow((line.left, line.right), node, vertex(line, tail, onset));
        follows.then_some(Way { onset, vertices })
    }

    /// Writes the boundary of `pair` from one place to another.
    pub(super) fn between(&self, pair: (u32, u32), from: Vertex, to: Vertex) -> Vec<Vertex> {
        self.follow(pair, from, to).0
    }

    /// The same, and whether it is that boundary all along.
    fn follow(&self, pair: (u32, u32), from: Vertex, to: Vertex) -> (Vec<Vertex>, bool) {
        let (from, to) = (self.on_course(pair, from), self.on_course(pair, to));
        let mut vertices = vec![from];
        let follows = self.halve(pair, from, to, HALVINGS, &mut vertices);
        vertices.push(to);
        (vertices, follows)
    }

    /// The first vertex after the node at one end of a line that lies between its two regions; the
    /// other end, where none does.
    fn onset(&self, line: &Line, tail: bool, at_border: bool) -> usize {
        let pair = (line.left, line.right);
        let is_beyond = |vertex: Vertex| {
            (at_border && self.border.distance(vertex.at) > NEARER) || self.lies_elsewhere(pair, vertex)
        };
        let last = line.vertices.len() - 1;
        (1..last).find(|&i| !is_beyond(vertex(line, tail, i))).unwrap_or(last)
    }

    /// Puts the way from `node` to vertex `onset`, counted from one end of a line, in place of what
    /// lies there.
    fn lead_on(&self, line: &mut Line, tail: bool, node: Vertex, onset: usize) {
        let vertices = self.between((line.left, line.right), node, vertex(line, tail, onset));
        Way { onset, vertices }.put(line, tail);
    }

    /// Whether a point of the boundary of two regions lies in the region of any other.
    fn lies_elsewhere(&self, (a, b): (u32, u32), vertex: Vertex) -> bool {
        let other = |_, owner: u32| owner != a && owner != b;
        self.near.nearer(self.sites, vertex.at, vertex.clearance() - NEARER, other).is_some()
    }
}

/// A new way from a node to a vertex of a line, counted from one of its ends.
pub(super) struct Way {
    onset: usize,
    pub(super) vertices: Vec<Vertex>,
}

impl Way {
    /// Puts it in place of what lies there.
    pub(super) fn put(mut self, line: &mut Line, tail: bool) {
        if tail {
            self.vertices.reverse();
            line.vertices.splice(line.vertices.len() - 1 - self.onset.., self.vertices);
        } else {
            line.vertices.splice(..=self.onset, self.vertices);
        }
    }
}

/// A vertex of a line, counted from one of its ends.
fn vertex(line: &Line, tail: bool, i: usize) -> Vertex {
    line.vertices[if tail { line.vertices.len() - 1 - i } else { i }]
}
