//! Boundaries along the board's edge follow it.
//!
//! ```text
//!   ╭───────○           A border line is traced in pixels, and along an outline, where nobody cuts with the isolating tool, sampled
//!   │      ╱│           at the tiles' borders only: its chords would cut corners ○. Its ends are true, and so is the border,
//!   ●┄┄┄┄┄╯ │           which is known; so the way in between is the border's own.
//!           ●
//! ```

use crate::geometry::Nm;

use super::OUTSIDE;
use super::edge::Border;

use super::plane::{Spot, nearest_on_chord};
use super::span::Vertex;
use super::stitch::Line;

/// A place on a ring of the border: how far along it lies.
#[derive(Clone, Copy)]
struct Place {
    ring: u32,
    /// The edge, by its first vertex.
    edge: usize,
    at: Spot,
}

impl Border {
    /// Makes all lines beside the outside, which were seen in pixels of `pitch`, run along the
    /// border between their ends.
    pub(super) fn follow(&self, lines: &mut [Line], pitch: Nm) {
        for line in lines.iter_mut().filter(|line| line.is_border()) {
            if let Some(way) = self.way(line, pitch) {
                let [first, last] = line.vertices[0].chord(line.vertices[line.vertices.len() - 1]);
                let corners = way.into_iter().map(|at| Vertex::new(at, self.clearance.to_f64()));
                line.vertices = std::iter::once(first).chain(corners).chain([last]).collect();
            }
        }
    }

    /// The corners of the border between the ends of a line; none where its ends lie on different
    /// rings, or where the border takes quite another way than the pixels saw, as between two ends
    /// in one place.
    fn way(&self, line: &Line, pitch: Nm) -> Option<Vec<Spot>> {
        let (first, last) = (line.vertices.first()?.at, line.vertices.last()?.at);
        let (mut from, mut to) = (self.nearest(first)?, self.nearest(last)?);
        if from.ring != to.ring {
            return None;
        }
        // Rings have the board on their left.
        let backwards = line.left == OUTSIDE;
        if backwards {
            std::mem::swap(&mut from, &mut to);
        }
        let ring = self.rings.ring(from.ring);
        let next = |edge: usize| (edge + 1) % ring.len();
        let along = |place: Place| (place.at - ring[place.edge]).length();
        let (mut way, mut edge) = (Vec::new(), from.edge);
        while edge != to.edge || (way.is_empty() && (line.ends.is_none() || along(to) <= along(from))) {
            edge = next(edge);
            way.push(ring[edge]);
        }
        if backwards {
            way.reverse();
        }
        let length = |spots: &mut dyn Iterator<Item = Spot>| {
            let mut before = first;
            spots.map(|at| (at - std::mem::replace(&mut before, at)).length()).sum::<f64>()
        };
        let seen = length(&mut line.vertices.iter().map(|vertex| vertex.at));
        let found = length(&mut way.iter().copied().chain([last]));
        // A corner that a tile's chord cuts off makes the way longer by less than a half; ends are
        // seen within some pixels.
        (found <= 2.0 * seen + 4.0 * pitch.to_f64()).then_some(way)
    }

    fn nearest(&self, p: Spot) -> Option<Place> {
        let mut nearest: (f64, Option<Place>) = (f64::INFINITY, None);
        for number in 0..self.ring_count {
            let ring = self.rings.ring(number);
            for (edge, (&a, &b)) in ring.iter().zip(ring.iter().cycle().skip(1)).enumerate() {
                let at = nearest_on_chord(p, a, b);
                let distance = (p - at).dot(p - at);
                if distance < nearest.0 {
                    nearest = (distance, Some(Place { ring: number, edge, at }));
                }
            }
        }
        nearest.1
    }
}
