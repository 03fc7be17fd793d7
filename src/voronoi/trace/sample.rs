//! Samples along a piece: as few as its chords and clearance need.

use super::Tracer;
use super::crack::Crack;
use crate::voronoi::place::{Target, Vertex};
use crate::voronoi::plane::Spot;
use crate::voronoi::{BACKGROUND, OUTSIDE};

/// How far the true boundary may leave the chord between two samples, in nanometres. Chosen: a tenth of the
/// default fitting tolerance, so that fitting has the rest.
pub(in crate::voronoi) const CHORD: f64 = 200.0;
/// How far the clearance may leave its interpolation between two samples, in nanometres.
const CLEARANCE_CHORD: f64 = 1_000.0;
/// Samples between two neighbouring cracks are halved at most so often: a kink is met within 1/64 of a pixel.
const HALVINGS: u32 = 6;
/// How many cracks from the end of a piece may have to be passed over. Chosen: twice the leash.
const LOOK_AHEAD: usize = 6;

impl Tracer<'_> {
    /// Writes the vertices of a piece: its first corner, samples along its cracks, its last corner.
    pub(super) fn place(&mut self, cracks: &[Crack], start: (i32, i32), end: (i32, i32)) {
        let (left, right) = cracks[0].sides();
        let first = self.end_vertex(start);
        let last = if start == end { first } else { self.end_vertex(end) };
        self.traced.vertices.push(first);
        if self.is_wanted(self.pixels.owner(left.0, left.1), self.pixels.owner(right.0, right.1)) {
            let pairs = cracks.iter().map(|crack| {
                let (left, right) = crack.sides();
                (self.pixels.label(left.0, left.1), self.pixels.label(right.0, right.1))
            });
            let run = Run { pairs: pairs.collect(), cracks };
            if self.straight(&run, first, last) {
                self.traced.vertices.push(last);
                return;
            }
            let (head, tail) = (self.short_of(cracks, first), self.short_of_reversed(cracks, last));
            self.halve(&head.1, first, head.2, HALVINGS);
            if head.0 < tail.0 {
                self.traced.vertices.push(head.2);
                self.sample(&run, (head.0, head.2), (tail.0, tail.2));
                self.traced.vertices.push(tail.2);
                self.halve(&tail.1, tail.2, last, HALVINGS);
            }
        } // Nobody cuts along the others: their corners are enough.
        self.traced.vertices.push(last);
    }

    /// Whether one curve bounds the whole piece and its middle lies on the chord of its ends; writes the middle if so.
    fn straight(&mut self, run: &Run<'_>, first: Vertex, last: Vertex) -> bool {
        let count = run.cracks.len();
        if count < 4 || !run.is_one_curve(0, count - 1) {
            return false;
        }
        let anchor = self.anchor(run.cracks[count / 2]);
        let Some(middle) = self.placer.project(&anchor.target, anchor.at) else { return false };
        let way = last.at - first.at;
        let between = (middle.at - first.at).dot(way) > 0.0 && (last.at - middle.at).dot(way) > 0.0;
        let straight = between && is_straight(first, middle, last);
        if straight {
            self.traced.vertices.push(middle);
        }
        straight
    }

    /// Whether anybody cuts along the boundary between two owners.
    const fn is_wanted(&self, left: u32, right: u32) -> bool {
        let bare = left == BACKGROUND || right == BACKGROUND;
        if left == OUTSIDE || right == OUTSIDE {
            return self.course.framed && !bare && !self.course.levels_only;
        }
        bare || !self.course.levels_only
    }

    /// The first crack whose place lies ahead of the start of the piece, with its equation and place.
    ///
    /// Near a node a crack may be moved past it, along the continuation of the boundary that the third region cuts off;
    /// going there and back would cut into that region.
    fn short_of(&mut self, cracks: &[Crack], start: Vertex) -> (usize, Target, Vertex) {
        let mut here = self.placed_crack(cracks[0]);
        for (i, &next) in cracks.iter().enumerate().skip(1).take(LOOK_AHEAD) {
            let ahead = self.placed_crack(next);
            if (here.1.at - start.at).dot(ahead.1.at - here.1.at) > 0.0 {
                return (i - 1, here.0, here.1);
            }
            here = ahead;
        }
        (cracks.len().min(LOOK_AHEAD + 1) - 1, here.0, here.1)
    }

    /// The same from the end of the piece.
    fn short_of_reversed(&mut self, cracks: &[Crack], end: Vertex) -> (usize, Target, Vertex) {
        let tail: Vec<Crack> = cracks.iter().rev().take(LOOK_AHEAD + 1).copied().collect();
        let (i, target, vertex) = self.short_of(&tail, end);
        (cracks.len() - 1 - i, target, vertex)
    }

    fn placed_crack(&mut self, crack: Crack) -> (Target, Vertex) {
        let anchor = self.anchor(crack);
        (anchor.target, self.placed(&anchor.target, anchor.at))
    }

    /// Samples between two placed cracks until chords follow the boundary; writes what lies between.
    fn sample(&mut self, run: &Run<'_>, (i, from): (usize, Vertex), (j, to): (usize, Vertex)) {
        if j == i + 1 {
            let (a, b) = (self.anchor(run.cracks[i]), self.anchor(run.cracks[j]));
            self.halve(&a.target.join(&b.target), from, to, HALVINGS);
            return;
        }
        let middle = usize::midpoint(i, j);
        let anchor = self.anchor(run.cracks[middle]);
        let vertex = self.placed(&anchor.target, anchor.at);
        let settled = run.is_one_curve(i, j) && is_straight(from, vertex, to);
        if !settled {
            self.sample(run, (i, from), (middle, vertex));
        }
        self.traced.vertices.push(vertex);
        if !settled {
            self.sample(run, (middle, vertex), (j, to));
        }
    }

    /// Samples between two neighbouring places by halving.
    fn halve(&mut self, target: &Target, from: Vertex, to: Vertex, left: u32) {
        if left == 0 || (to.at - from.at).length() < 4.0 * CHORD {
            return;
        }
        let Some(vertex) = self.placer.project(target, from.at.midpoint(to.at)) else { return };
        if is_straight(from, vertex, to) {
            return;
        }
        // A projection that runs off along the boundary would fold the path back on itself.
        let way = to.at - from.at;
        if (vertex.at - from.at).dot(way) <= 0.0 || (to.at - vertex.at).dot(way) <= 0.0 {
            return;
        }
        self.halve(target, from, vertex, left - 1);
        self.traced.vertices.push(vertex);
        self.halve(target, vertex, to, left - 1);
    }

    pub(super) fn placed(&mut self, target: &Target, at: Spot) -> Vertex {
        self.placer.project(target, at).unwrap_or_else(|| {
            self.traced.unplaced += 1;
            Vertex { at, clearance: self.placer.clearance(target, at).max(0.0) }
        })
    }
}

/// The cracks of a piece with the labels on their left and right.
struct Run<'a> {
    cracks: &'a [Crack],
    pairs: Vec<(u32, u32)>,
}

impl Run<'_> {
    /// Whether the same two sites bound the boundary all the way from crack `i` to crack `j`.
    fn is_one_curve(&self, i: usize, j: usize) -> bool {
        self.pairs[i..=j].iter().all(|&pair| pair == self.pairs[i])
    }
}

/// Whether a sample half way lies on the chord, and its clearance on the interpolation.
fn is_straight(from: Vertex, middle: Vertex, to: Vertex) -> bool {
    middle.at.distance_to_chord(from.at, to.at) <= CHORD
        && (middle.clearance - f64::midpoint(from.clearance, to.clearance)).abs() <= CLEARANCE_CHORD
}
