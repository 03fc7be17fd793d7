//! Certificates: the empty circle of a vertex, the empty strip of an edge, asked of all generators
//! anew.

use rayon::prelude::*;

use super::{Diagram, Edge, Vertex};
use crate::geometry::Point;
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::{CLEARANCE_CHORD, Sample};

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
    /// Points along an edge from its beginning to its end, with the distance to copper: chords stay
    /// within `tolerance` nanometres of it, but none is shorter than a nanometre.
    #[must_use]
    pub fn course(&self, edge: &Edge, tolerance: f64) -> Vec<((f64, f64), f64)> {
        let samples = self.samples_within(edge, [tolerance, CLEARANCE_CHORD]).into_iter();
        samples.map(|Sample { at, clearance }| ((at.x, at.y), clearance)).collect()
    }

    /// The same, with how far chords may leave the place and the distance.
    pub(super) fn samples_within(&self, edge: &Edge, tolerances: [f64; 2]) -> Vec<Sample> {
        let mut samples = Vec::new();
        self.add_samples(edge, tolerances, &mut samples);
        samples
    }

    /// Adds the same to others.
    pub(super) fn add_samples(&self, edge: &Edge, tolerances: [f64; 2], samples: &mut Vec<Sample>) {
        let (from, to) = (self.sample_at(edge.from), self.sample_at(edge.to));
        samples.push(from);
        self.halve(edge, (from, to), tolerances, 16, samples);
        samples.push(to);
    }

    /// A vertex as a place on its edges.
    pub(super) fn sample_at(&self, vertex: u32) -> Sample {
        let Vertex { at: (x, y), clearance, .. } = self.vertices[vertex as usize];
        Sample { at: Spot::new(x, y), clearance }
    }

    /// The place midway between two of an edge, by the foot on one of its generators.
    ///
    /// Between lines, and between corners that all but meet, the edge is straight, and its middle
    /// that of the chord: where lines turn by a hundred thousandth, or corners lie a nanometre
    /// apart, feet a fraction of a nanometre apart are those of places far apart.
    pub(super) fn midway(&self, edge: &Edge, a: Spot, b: Spot) -> Option<Sample> {
        let pair = self.pair(edge.left, edge.right);
        if pair.is_straight() {
            let at = a.midpoint(b);
            return Some(Sample { at, clearance: pair.forms[0].distance(at) });
        }
        let main = pair.main(a.midpoint(b));
        let form = &pair.forms[main];
        let middle = form.place(a).halfway(form.place(b), pair.sense(main))?;
        pair.at(main, middle).map(|(at, clearance)| Sample { at, clearance })
    }

    pub(super) fn halve(
        &self,
        edge: &Edge,
        (a, b): (Sample, Sample),
        tolerances: [f64; 2],
        left: u32,
        samples: &mut Vec<Sample>,
    ) {
        if left == 0 || (b.at - a.at).length() < 1.0 {
            return;
        }
        let Some(middle) = self.midway(edge, a.at, b.at) else { return };
        let is_off = middle.at.distance_to_chord(a.at, b.at) > tolerances[0];
        let straight = f64::midpoint(a.clearance, b.clearance);
        if is_off || (middle.clearance - straight).abs() > tolerances[1] {
            self.halve(edge, (a, middle), tolerances, left - 1, samples);
            samples.push(middle);
            self.halve(edge, (middle, b), tolerances, left - 1, samples);
        }
    }

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
            self.check_between(edge, (a, b), spacing, 20, &mut found);
            found
        };
        let vertices = self.vertices.par_iter().flat_map_iter(of_vertex);
        vertices.chain(self.edges.par_iter().flat_map_iter(of_edge)).collect()
    }

    fn check_between(
        &self,
        edge: &Edge,
        (a, b): (Spot, Spot),
        spacing: f64,
        left: u32,
        found: &mut Vec<Violation>,
    ) {
        let Some(Sample { at: middle, clearance }) = self.midway(edge, a, b) else { return };
        self.check(middle, clearance, &[edge.left, edge.right], found);
        let chord = b - a;
        if left > 0 && chord.dot(chord) > spacing * clearance.max(spacing) {
            self.check_between(edge, (a, middle), spacing, left - 1, found);
            self.check_between(edge, (middle, b), spacing, left - 1, found);
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
