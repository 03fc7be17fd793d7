//! Vertices along a piece: as few as its curves need.
//!
//! A piece is halved until a probe half way lies on the curve between the vertices on either side
//! (see [`span`](crate::voronoi::span)). Where these lie on different curves, the corner where the
//! one goes over into the other is looked for first: it is where two equations hold.

use super::Tracer;
use super::crack::Crack;
use crate::voronoi::place::{Curve, Placed, Target};
use crate::voronoi::plane::Spot;
use crate::voronoi::span::{CHORD, Span, Vertex};
use crate::voronoi::{BACKGROUND, OUTSIDE};

/// Between two neighbouring cracks the way is halved at most so often: a corner is met within 1/64
/// of a pixel.
const HALVINGS: u32 = 6;
/// A crack so close to a station may be moved past it: beyond a node, along the continuation of the
/// boundary that the third region cuts off. Going there and back would cut into that region.
/// Chosen: twice the leash.
const LOOK_AHEAD: usize = 6;

/// A place on a piece with the crack at or about which it lies.
type Station = (usize, Placed);

impl Tracer<'_> {
    /// Writes the vertices of a piece: its first corner, what its curves need in between, its last
    /// corner. Says whether the corners' places are open.
    pub(super) fn place(&mut self, cracks: &[Crack], start: (i32, i32), end: (i32, i32)) -> (bool, bool) {
        let last_crack = cracks[cracks.len() - 1].reversed();
        let (first, first_open) = self.end_vertex(start, cracks[0]);
        let closed = start == end && self.branch(cracks[0]) == self.branch(last_crack);
        let (last, last_open) = if closed { (first, first_open) } else { self.end_vertex(end, last_crack) };
        let (left, right) = cracks[0].sides();
        if !self.is_wanted(self.pixels.owner(left.0, left.1), self.pixels.owner(right.0, right.1)) {
            // Nobody cuts along these: their corners are enough.
            self.traced.vertices.extend(first.vertex.chord(last.vertex));
            return (first_open, last_open);
        }
        self.traced.vertices.push(first.vertex);
        if closed {
            self.round(cracks, first);
        } else {
            self.sample(cracks, (0, first), (cracks.len() - 1, last), HALVINGS);
        }
        self.traced.vertices.push(last.vertex);
        (first_open, last_open)
    }

    /// Whether anybody cuts along the boundary between two owners.
    pub(super) const fn is_wanted(&self, left: u32, right: u32) -> bool {
        let bare = left == BACKGROUND || right == BACKGROUND;
        if left == OUTSIDE || right == OUTSIDE {
            return self.course.framed && !bare && !self.course.levels_only;
        }
        bare || !self.course.levels_only
    }

    /// Samples a loop in three parts.
    fn round(&mut self, run: &[Crack], start: Placed) {
        let last = run.len() - 1;
        let mut from = (0, start);
        for stop in [last / 3, 2 * last / 3] {
            let mut anchor = self.anchor(run[stop]);
            let placed = self.placed(&mut anchor.target, anchor.at);
            self.sample(run, from, (stop, placed), HALVINGS);
            self.traced.vertices.push(placed.vertex);
            from = (stop, placed);
        }
        self.sample(run, from, (last, start), HALVINGS);
    }

    /// Writes what the way needs between two stations. Between neighbouring cracks it is halved
    /// `left` times at most.
    fn sample(&mut self, run: &[Crack], from: Station, to: Station, left: u32) {
        self.sample_again(run, from, to, (left, false));
    }

    /// The same, knowing whether a probe of the way of which this is a half found nothing.
    fn sample_again(
        &mut self,
        run: &[Crack],
        (i, from): Station,
        (j, to): Station,
        (left, found_nothing): (u32, bool),
    ) {
        if left == 0 || (to.vertex.at - from.vertex.at).length() < 4.0 * CHORD {
            return;
        }
        if let Some((k, [before, after])) = self.kink(run, (i, from), (j, to)) {
            self.sample(run, (i, from), (k, before), left);
            self.traced.vertices.push(before.vertex);
            if !before.vertex.is_smooth_with(after.vertex) {
                self.traced.vertices.push(after.vertex);
            }
            return self.sample(run, (k, after), (j, to), left);
        }
        let Some((k, probe)) = self.probe(run, (i, from), (j, to)) else {
            return self.traced.vertices.extend(from.vertex.chord(to.vertex));
        };
        let is_settled = self.is_plain(run, (i, from), (j, to)) && self.is_settled(from, probe, to);
        let is_sure = || {
            found_nothing
                || !self.placer.is_angular(probe.curve)
                || self.placer.is_one_part([from, probe, to])
        };
        if is_settled && is_sure() {
            return self.traced.vertices.push(probe.vertex);
        }
        let left = if j > i + 1 { left } else { left - 1 };
        self.sample_again(run, (i, from), (k, probe), (left, is_settled));
        self.traced.vertices.push(probe.vertex);
        self.sample_again(run, (k, probe), (j, to), (left, is_settled));
    }

    /// Whether the pixels between two stations show no other curves than theirs. A pixel inside
    /// copper may have the label of any of several sites.
    fn is_plain(&self, run: &[Crack], (i, from): Station, (j, to): Station) -> bool {
        let shows = |(left, right): (u32, u32), curve: Curve| match curve {
            Curve::Between(a, b) => (left, right) == (a, b) || (left, right) == (b, a),
            Curve::At(a) => left == a || right == a,
            Curve::Border => true,
        };
        let is_telling =
            matches!(from.curve, Curve::Between(..)) || self.course.level >= 2.0 * self.course.pitch;
        let plain = |&crack: &Crack| {
            let labels = self.labels(crack);
            shows(labels, from.curve) || shows(labels, to.curve)
        };
        j <= i + 1 || (is_telling && run[i..=j].iter().all(plain))
    }

    /// Whether nothing is to be found between two places and the probe half way.
    fn is_settled(&self, from: Placed, probe: Placed, to: Placed) -> bool {
        let is_one_curve =
            from.curve == to.curve || self.placer.is_smooth(from.curve, to.curve, probe.vertex.at);
        is_one_curve
            && (probe.curve == from.curve || probe.curve == to.curve)
            && Span::new(from.vertex, to.vertex).holds(probe.vertex)
    }

    /// The corner between two stations on different curves, if it can be told, on either.
    fn kink(&self, run: &[Crack], (i, from): Station, (j, to): Station) -> Option<(usize, [Placed; 2])> {
        if from.curve == to.curve || !self.is_plain(run, (i, from), (j, to)) {
            return None;
        }
        let change = (i..j).find(|&k| self.labels(run[k]) != self.labels(run[k + 1]));
        let near = change.map_or_else(|| from.vertex.at.midpoint(to.vertex.at), |k| self.middle(run[k]));
        let corner = self.placer.kink(from.curve, to.curve, self.course.level, near)?;
        let away = |k: &usize| (self.middle(run[*k]) - corner[0].vertex.at).length();
        let k = (i..j).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(i);
        corner[0].vertex.is_between(from.vertex, to.vertex).then_some((k, corner))
    }

    /// A place between two stations, if there is one.
    fn probe(&mut self, run: &[Crack], (i, from): Station, (j, to): Station) -> Option<Station> {
        let middle = usize::midpoint(i, j);
        if j > i + 1 {
            let mut anchor = self.anchor(run[middle]);
            let placed = self.project(&mut anchor.target, anchor.at);
            let onward = |placed: &Placed| {
                placed.vertex.is_between(from.vertex, to.vertex)
                    || (middle - i > LOOK_AHEAD && j - middle > LOOK_AHEAD)
                    || [from, to]
                        .iter()
                        .all(|end| (end.vertex.at - anchor.at).length() > 2.0 * self.placer.leash)
            };
            if let Some(placed) = placed.filter(onward) {
                return Some((middle, placed));
            }
        }
        let mut target = self.placer.either(from.curve, to.curve, self.course.level);
        let placed = self.project(&mut target, from.vertex.at.midpoint(to.vertex.at))?;
        placed.vertex.is_between(from.vertex, to.vertex).then_some((middle, placed))
    }

    fn labels(&self, crack: Crack) -> (u32, u32) {
        let (left, right) = crack.sides();
        (self.pixels.label(left.0, left.1), self.pixels.label(right.0, right.1))
    }

    fn project(&self, target: &mut Target, at: Spot) -> Option<Placed> {
        let vertex = self.placer.project(target, at)?;
        Some(self.placer.on_curve(target, vertex))
    }

    /// The place of a boundary point near `at`, or `at` itself where there is none.
    pub(super) fn placed(&mut self, target: &mut Target, at: Spot) -> Placed {
        self.project(target, at).unwrap_or_else(|| {
            self.traced.unplaced.add(at);
            let clearance = self.placer.clearance(target, at).max(0.0);
            self.placer.on_curve(target, Vertex::new(at, clearance))
        })
    }
}
