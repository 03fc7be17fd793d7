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
    /// Writes the vertices of a piece: its first corner, samples along its cracks, its last corner. Says whether the corners' places are open.
    pub(super) fn place(&mut self, cracks: &[Crack], start: (i32, i32), end: (i32, i32)) -> (bool, bool) {
        let last_crack = cracks[cracks.len() - 1].reversed();
        let (first, first_open) = self.end_vertex(start, cracks[0]);
        let closed = start == end && self.branch(cracks[0]) == self.branch(last_crack);
        let (last, last_open) = if closed { (first, first_open) } else { self.end_vertex(end, last_crack) };
        self.traced.vertices.push(first);
        self.between(cracks, first, last);
        self.traced.vertices.push(last);
        (first_open, last_open)
    }

    /// Writes what lies between the corners of a piece.
    fn between(&mut self, cracks: &[Crack], first: Vertex, last: Vertex) {
        let (left, right) = cracks[0].sides();
        if self.is_wanted(self.pixels.owner(left.0, left.1), self.pixels.owner(right.0, right.1)) {
            let pairs = cracks.iter().map(|crack| {
                let (left, right) = crack.sides();
                (self.pixels.label(left.0, left.1), self.pixels.label(right.0, right.1))
            });
            let run = Run { pairs: pairs.collect(), cracks };
            if self.straight(&run, first, last) {
                return;
            }
            let (mut head, mut tail) = (self.short_of(cracks, first), self.short_of_reversed(cracks, last));
            if head.0 < tail.0 {
                self.halve(&mut head.1, first, head.2, HALVINGS);
                self.traced.vertices.push(head.2);
                self.sample(&run, (head.0, head.2), (tail.0, tail.2));
                self.traced.vertices.push(tail.2);
                self.halve(&mut tail.1, tail.2, last, HALVINGS);
            } else {
                self.halve(&mut head.1.join(&tail.1), first, last, HALVINGS);
            }
        } // Nobody cuts along the others: their corners are enough.
    }

    /// Whether one curve bounds the whole piece and its middle lies on the chord of its ends; writes the middle if so.
    fn straight(&mut self, run: &Run<'_>, first: Vertex, last: Vertex) -> bool {
        let count = run.cracks.len();
        if count < 4 || !run.is_one_curve(0, count - 1) {
            return false;
        }
        let mut anchor = self.anchor(run.cracks[count / 2]);
        let Some((middle, slope)) = self.placer.project_sloped(&mut anchor.target, anchor.at) else {
            return false;
        };
        let way = last.at - first.at;
        let between = (middle.at - first.at).dot(way) > 0.0 && (last.at - middle.at).dot(way) > 0.0;
        let straight = between && is_straight(first, (middle, slope), last);
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
        let mut anchor = self.anchor(crack);
        let vertex = self.placed(&mut anchor.target, anchor.at);
        (anchor.target, vertex)
    }

    /// Samples between two placed cracks until chords follow the boundary; writes what lies between.
    fn sample(&mut self, run: &Run<'_>, (i, from): (usize, Vertex), (j, to): (usize, Vertex)) {
        if j == i + 1 {
            let [a, b] = [i, j].map(|k| self.anchor(run.cracks[k]).target);
            self.halve(&mut a.join(&b), from, to, HALVINGS);
            return;
        }
        let middle = usize::midpoint(i, j);
        let mut anchor = self.anchor(run.cracks[middle]);
        let sloped = self.placer.project_sloped(&mut anchor.target, anchor.at);
        let vertex = match sloped {
            Some((vertex, _)) => vertex,
            None => self.placed(&mut anchor.target, anchor.at),
        };
        let settled = run.is_one_curve(i, j) && sloped.is_some_and(|sloped| is_straight(from, sloped, to));
        if !settled {
            self.sample(run, (i, from), (middle, vertex));
        }
        self.traced.vertices.push(vertex);
        if !settled {
            self.sample(run, (middle, vertex), (j, to));
        }
    }

    /// Samples between two neighbouring places by halving.
    fn halve(&mut self, target: &mut Target, from: Vertex, to: Vertex, left: u32) {
        if left == 0 || (to.at - from.at).length() < 4.0 * CHORD {
            return;
        }
        let Some(sloped) = self.placer.project_sloped(target, from.at.midpoint(to.at)) else { return };
        let vertex = sloped.0;
        if is_straight(from, sloped, to) {
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

    pub(super) fn placed(&mut self, target: &mut Target, at: Spot) -> Vertex {
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

/// Whether a sample half way lies on the chord and runs along it, and its clearance on the interpolation.
///
/// `across` is a vector across the boundary at the sample. A boundary that bends one way and then the other may cross its chord half way; then it
/// does so at an angle. A cubic that crosses at an angle whose sine is s leaves a chord of length L by 0.19 s L.
pub(in crate::voronoi) fn is_straight(from: Vertex, (middle, across): (Vertex, Spot), to: Vertex) -> bool {
    let skew = across.dot(to.at - from.at).abs();
    middle.at.distance_to_chord(from.at, to.at) <= CHORD
        && 0.19 * skew <= CHORD * across.length()
        && (middle.clearance - f64::midpoint(from.clearance, to.clearance)).abs() <= CLEARANCE_CHORD
}
