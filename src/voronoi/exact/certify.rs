//! Certificates: the empty circle of a vertex, the empty strip of an edge, asked of all generators
//! anew.

use rayon::prelude::*;

use super::pair::Pair;
use super::{Diagram, Edge, Vertex};
use crate::geometry::Point;
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::Sample;

/// What a certificate contradicts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// Where.
    pub at: Point,
    /// By how much a generator is nearer than those that should be nearest, or these differ, in
    /// nanometres.
    pub by: f64,
}

impl Diagram {
    /// Checks every vertex and every edge against all generators: the middle of each edge at least,
    /// and places at most `spacing` nanometres apart. Where copper is farther away than that they
    /// are so far apart that an eighth of it is no more than lies between one circle and the next.
    #[must_use]
    pub fn certify(&self, spacing: f64) -> Vec<Violation> {
        let of_vertex = |vertex: &Vertex| {
            let mut found = Vec::new();
            self.check(Spot::new(vertex.at.0, vertex.at.1), vertex.clearance, &vertex.tied, &mut found);
            found
        };
        let of_edge = |edge: &Edge| {
            let ends = [edge.from, edge.to].map(|i| self.vertices[i as usize].at);
            let [a, b] = ends.map(|(x, y)| Spot::new(x, y));
            let mut found = Vec::new();
            self.check_between(&self.pair_of(edge), (a, b), spacing, 20, &mut found);
            found
        };
        let vertices = self.vertices.par_iter().flat_map_iter(of_vertex);
        vertices.chain(self.edges.par_iter().flat_map_iter(of_edge)).collect()
    }

    fn check_between(
        &self,
        pair: &Pair,
        (a, b): (Spot, Spot),
        spacing: f64,
        left: u32,
        found: &mut Vec<Violation>,
    ) {
        let Some(Sample { at: middle, clearance }) = pair.midway(a, b) else { return };
        self.check(middle, clearance, &[pair.left, pair.right], found);
        let chord = b - a;
        if left > 0 && chord.dot(chord) > spacing * clearance.max(spacing) {
            self.check_between(pair, (a, middle), spacing, left - 1, found);
            self.check_between(pair, (middle, b), spacing, left - 1, found);
        }
    }

    fn check(&self, at: Spot, clearance: f64, tied: &[u32], found: &mut Vec<Violation>) {
        // Their feet must lie on them.
        let off = tied.iter().map(|&i| (self.forms()[i as usize].off(at) - clearance).abs());
        let mut worst = off.fold(0.0, f64::max);
        // No edge of copper, seen from whichever side, lies within an empty circle; so what lies in
        // copper is told from what lies outside, too.
        let allowed = 2.0 * self.tie;
        let room = (clearance - allowed).max(0.0);
        self.index.visit_round(at, room, |i| {
            let form = &self.forms()[i as usize];
            // The whole line or circle is nearer than the part of it that counts.
            if form.distance(at).abs() < room {
                worst = worst.max(clearance - form.off(at));
            }
        });
        if worst > allowed {
            found.push(Violation { at: at.rounded(), by: worst });
        }
    }
}
