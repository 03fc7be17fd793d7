//! What is asked of an edge: places along it, and the directions away from its two generators.

use super::{Diagram, Edge};
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::Sample;

impl Diagram {
    /// Points along an edge from its beginning to its end, with the distance to the generators:
    /// chords stay within `tolerance` nanometres of the place and of the distance, but none is
    /// shorter than a nanometre.
    #[must_use]
    pub fn profile(&self, edge: &Edge, tolerance: f64) -> Vec<((f64, f64), f64)> {
        let samples = self.samples_within(edge, [tolerance; 2]).into_iter();
        samples.map(|Sample { at, clearance }| ((at.x, at.y), clearance)).collect()
    }

    /// The unit vectors straight away from the generators on the left and on the right of an edge,
    /// at a place on it.
    #[must_use]
    pub fn away(&self, edge: &Edge, (x, y): (f64, f64)) -> [(f64, f64); 2] {
        [edge.left, edge.right].map(|generator| {
            let away = self.forms()[generator as usize].away(Spot::new(x, y));
            (away.x, away.y)
        })
    }
}
