//! Few lines and arcs within a tolerance of many points.
//!
//! Greedy from the start of a path: the longest line or arc whose points all stay within the
//! tolerance is taken, found by doubling and halving. A segment ends on a true point of the
//! boundary, so fitting never moves where boundaries meet. It also ends wherever the clearance has
//! a minimum, so that the narrowest place of a segment is at one of its ends.
//!
//! An arc passes three of the true points; it is taken only where it reaches half as far again as
//! the line would.
//!
//! For a tool that rises where there is less room (*adaptive depth*), clearance goes evenly from
//! one vertex to the next, as the tool's tip does:
//!
//! ```text
//!   room  ╲                 ╱      from vertex to vertex straight down, the tip would be too deep
//!          ╲_______________╱       nearly everywhere on the way to the narrowest place
//!          •               •
//! ```

use std::borrow::Cow;

use crate::geometry::{Nm, Path, Point, Segment, Turn};

use super::plane::Spot;
use super::sample::{CHORD, Sample, length};

/// Clearance may dip between vertices by this much before a vertex is kept there, in nanometres.
/// Chosen.
const DIP: f64 = 2_000.0;
/// Where the tool rises, clearance may differ so much from what lies evenly between vertices, in
/// nanometres. Chosen: a quarter of what sampling leaves.
const EVEN: f64 = 250.0;
/// Arcs outside these radii are left to lines: smaller ones are noise, of larger ones the centre
/// takes more digits than single precision holds (TinyG's). Chosen.
const RADII: std::ops::Range<f64> = 5_000.0..9.9e8;
/// Shorter arcs are left to lines, in nanometres. Chosen: a few of the last digits of any dialect,
/// so that none begins and ends on the same and goes all the way round.
const SHORTEST: f64 = 5_000.0;
/// The part of the tolerance that fitting uses. Chosen: with a quarter and what rounding takes,
/// distances to either side differ by no more than half of the tolerance, for a point off the
/// middle by t is nearer to one side than to the other by 2 t. Measured: at 0.45 they differ by 2
/// µm at one place in a hundred, at 0.27 by 1 µm.
const SHARE: f64 = 0.27;
/// A minimum is looked for at most so many vertices apart; beyond, the search would become
/// quadratic. Chosen.
const REACH: usize = 4096;

/// How points are fitted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// How far segments may leave them.
    pub(super) tolerance: Nm,
    /// Whether segments may be arcs.
    pub(super) arcs: bool,
    /// The clearances between which the tool rises as they fall, if it does.
    pub(super) rises: Option<[Nm; 2]>,
}

/// A fitted path with the clearance at its vertices: the start's, then each segment's end.
pub(super) fn fit(vertices: &[Sample], how: Fit) -> Option<(Path, Vec<Nm>)> {
    let Fit { tolerance, arcs, rises } = how;
    let rises = rises.map(|ends| ends.map(Nm::to_f64));
    let vertices = &*rises.map_or(Cow::Borrowed(vertices), |ends| Cow::Owned(with_knees(vertices, ends)));
    let start = vertices.first()?;
    let mut path = Path { start: start.at.rounded(), segments: Vec::new() };
    let mut clearance = vec![Nm::from_f64(finite(start.clearance))];
    // What sampling may already have lost counts against the tolerance.
    let tolerance = (tolerance.to_f64() * SHARE - CHORD).max(CHORD);
    let fitter = Fitter { vertices, tolerance, arcs, rises };
    let mut i = 0;
    while i + 1 < vertices.len() {
        let (j, segment) = fitter.longest(i);
        i = j;
        if segment.to() != path.end() || matches!(segment, Segment::Arc { .. }) {
            path.segments.push(segment);
            clearance.push(Nm::from_f64(finite(vertices[i].clearance)));
        }
    }
    path.segments.shrink_to_fit();
    clearance.shrink_to_fit();
    (!path.segments.is_empty()).then_some((path, clearance))
}

/// The path of few lines and arcs within `tolerance` of a polyline; none for less than two points.
pub fn fit_points(points: impl IntoIterator<Item = Point>, tolerance: Nm) -> Option<Path> {
    let vertices: Vec<Sample> =
        points.into_iter().map(|point| Sample { at: point.into(), clearance: 0.0 }).collect();
    fit(&vertices, Fit { tolerance, arcs: true, rises: None }).map(|(path, _)| path)
}

/// The samples, and between them the places where the tool begins or ends to rise: those where the
/// clearance passes one of `ends`. A straight way has samples at its ends alone, and the tip would
/// go straight from one depth to the other.
fn with_knees(samples: &[Sample], ends: [f64; 2]) -> Vec<Sample> {
    let mut all = Vec::with_capacity(samples.len());
    all.extend(samples.first());
    for pair in samples.windows(2) {
        let [from, to] = [pair[0].clearance, pair[1].clearance];
        let passes = |end: &f64| from.min(to) < *end && *end < from.max(to) && (to - from).is_finite();
        let mut parts: Vec<f64> =
            ends.into_iter().filter(passes).map(|end| (end - from) / (to - from)).collect();
        parts.sort_by(f64::total_cmp);
        all.extend(parts.into_iter().map(|part| pair[0].toward(&pair[1], part)));
        all.push(pair[1]);
    }
    all
}

/// Clearances from nowhere (a path along the border) are the largest length.
fn finite(clearance: f64) -> f64 {
    clearance.min(Nm::MAX.to_f64())
}

struct Fitter<'a> {
    vertices: &'a [Sample],
    tolerance: f64,
    arcs: bool,
    rises: Option<[f64; 2]>,
}

impl Fitter<'_> {
    /// The vertex that the best segment from vertex `i` reaches, and the segment.
    fn longest(&self, i: usize) -> (usize, Segment) {
        let end = self.next_minimum(i);
        let end = self.rises.map_or(end, |[least, most]| {
            let room = |vertex: &Sample| vertex.clearance.clamp(least, most);
            farthest(i + 1, end, |j| is_even(&self.vertices[i..=j], room))
        });
        let line = farthest(i + 1, end, |j| self.is_line(i, j));
        let straight = Segment::Line { to: self.point(line) };
        if !self.arcs || line == end {
            return (line, straight);
        }
        let arc = farthest((i + 2).min(end), end, |j| self.arc(i, j).is_some());
        let reach = |j: usize| (self.vertices[j].at - self.vertices[i].at).length();
        match self.arc(i, arc) {
            Some(segment) if arc > line && reach(arc) > (1.5 * reach(line)).max(SHORTEST) => (arc, segment),
            _ => (line, straight),
        }
    }

    fn point(&self, i: usize) -> Point {
        self.vertices[i].at.rounded()
    }

    /// The next vertex after `i` at which the clearance stops falling by more than [`DIP`], or the
    /// last.
    fn next_minimum(&self, i: usize) -> usize {
        let last = (self.vertices.len() - 1).min(i + REACH);
        let (mut lowest, mut at) = (self.vertices[i].clearance, i);
        for j in i + 1..=last {
            let here = self.vertices[j].clearance;
            if here < lowest {
                (lowest, at) = (here, j);
            } else if here > lowest + DIP && at > i && self.vertices[i].clearance > lowest + DIP {
                return at;
            }
        }
        last
    }

    /// Whether all vertices between `i` and `j` lie on the chord.
    fn is_line(&self, i: usize, j: usize) -> bool {
        let (a, b) = (self.vertices[i].at, self.vertices[j].at);
        self.vertices[i + 1..j].iter().all(|vertex| vertex.at.distance_to_chord(a, b) <= self.tolerance)
    }

    /// The arc from vertex `i` to vertex `j` through one between, if all vertices and the chords
    /// between them lie on it.
    fn arc(&self, i: usize, j: usize) -> Option<Segment> {
        if j < i + 2 {
            return None;
        }
        let (a, m, b) = (self.vertices[i].at, self.vertices[usize::midpoint(i, j)].at, self.vertices[j].at);
        let center = circle(a, m, b)?.rounded();
        let middle = Spot::from(center);
        let radius = f64::midpoint((a - middle).length(), (b - middle).length());
        let turn = (m - a).cross(b - m).signum();
        if !RADII.contains(&radius) {
            return None;
        }
        // Less than half a turn, always the same way round.
        let half = (a - middle).cross(b - middle) * turn > 0.0;
        let fits = self.vertices[i..=j].windows(2).all(|pair| {
            let (p, q) = (pair[0].at, pair[1].at);
            let onward = (p - middle).cross(q - middle) * turn > 0.0;
            // Of a chord the middle is nearest to the centre.
            let is_on = |at: Spot| ((at - middle).length() - radius).abs() <= self.tolerance;
            onward && is_on(q) && is_on(p.midpoint(q))
        });
        let turn = if turn > 0.0 { Turn::CounterClockwise } else { Turn::Clockwise };
        (half && fits).then(|| Segment::Arc { to: self.point(j), center, turn })
    }
}

/// Whether what `room` says of places goes evenly along the way from the first to the last.
fn is_even(vertices: &[Sample], room: impl Fn(&Sample) -> f64) -> bool {
    let steps = vertices.windows(2).map(|pair| (pair[1].at - pair[0].at).length());
    let whole = length(vertices);
    let (first, last) = (room(&vertices[0]), room(&vertices[vertices.len() - 1]));
    let mut gone = 0.0;
    vertices[1..].iter().zip(steps).all(|(vertex, step)| {
        gone += step;
        (first + (last - first) * (gone / whole.max(1.0)) - room(vertex)).abs() <= EVEN
    })
}

/// The largest j in `least..=most` up to which `holds` is seen to hold, by doubling and then
/// halving; at least `least`.
fn farthest(least: usize, most: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut good, mut step) = (least, 1);
    let mut bad = most + 1;
    while good + step <= most {
        if holds(good + step) {
            good += step;
            step *= 2;
        } else {
            bad = good + step;
            break;
        }
    }
    bad = bad.min(most + 1);
    while good + 1 < bad {
        let middle = usize::midpoint(good, bad);
        if holds(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}

/// The centre of the circle through three points; none where they lie on a line.
fn circle(a: Spot, b: Spot, c: Spot) -> Option<Spot> {
    let (ab, ac) = (b - a, c - a);
    let twice = 2.0 * ab.cross(ac);
    if twice.abs() < 1.0 {
        return None;
    }
    let (bb, cc) = (ab.dot(ab), ac.dot(ac));
    Some(a + Spot::new(ac.y * bb - ab.y * cc, ab.x * cc - ac.x * bb) * (1.0 / twice))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIT: Fit = Fit { tolerance: Nm::from_um(2), arcs: true, rises: None };

    fn vertex(x: f64, y: f64, clearance: f64) -> Sample {
        Sample { at: Spot::new(x, y), clearance }
    }

    #[test]
    fn points_of_a_circle_become_one_arc() {
        let points: Vec<_> = (0..=40_u32)
            .map(|i| libm::sincos(f64::from(i) * 0.05))
            .map(|(sin, cos)| vertex(1e6 * cos, 1e6 * sin, 1e5))
            .collect();
        let (path, clearance) = fit(&points, FIT).expect("a path");
        assert_eq!(path.segments.len(), 1, "{path:?}");
        assert_eq!(clearance.len(), 2, "one at each vertex");
        let (lines, _) = fit(&points, Fit { arcs: false, ..FIT }).expect("a path");
        assert!(lines.segments.len() > 10, "{} lines", lines.segments.len());
    }

    #[test]
    fn points_of_a_wide_circle_become_one_arc() {
        // 60 mm of an edge with a radius of 380 mm, in chords that leave it by a quarter of a
        // micrometre.
        let points = (0..=70_u32).map(|i| libm::sincos(f64::from(i) * 0.0023));
        let points = points.map(|(sin, cos)| Point::from_f64(3.8e8 * cos, 3.8e8 * sin));
        let path = fit_points(points, Nm::from_um(4)).expect("a path");
        assert!(matches!(path.segments[..], [Segment::Arc { .. }]), "{path:?}");
    }

    #[test]
    fn a_corner_is_kept() {
        let points =
            [vertex(0.0, 0.0, 1e5), vertex(5e5, 0.0, 1e5), vertex(1e6, 0.0, 1e5), vertex(1e6, 1e6, 1e5)];
        let (path, _) = fit(&points, FIT).expect("a path");
        assert_eq!(path.segments.len(), 2, "{path:?}");
    }

    #[test]
    fn where_the_tool_rises_clearance_goes_evenly_from_vertex_to_vertex() {
        // Between both ends nearly all is as narrow as the narrowest place.
        let room = |x: f64| (8e4 - 0.3 * x).max(6.51e4 - x / 5e3).max(8e4 - 0.3 * (5e5 - x));
        let points: Vec<Sample> =
            (0..=50_u32).map(|i| f64::from(i) * 1e4).map(|x| vertex(x, 0.0, room(x))).collect();
        let vertices = |rises: Option<[Nm; 2]>| {
            let (path, clearance) = fit(&points, Fit { rises, ..FIT }).expect("a path");
            let at = path.steps().map(|(from, _)| from.x.get() / 1000);
            at.zip(clearance).map(|(x, room)| (x, room.get() / 1000)).collect::<Vec<_>>()
        };
        assert_eq!(vertices(None), [(0, 80), (450, 65)], "the narrowest place alone");
        assert_eq!(vertices(Some([60, 90].map(Nm::from_um))), [(0, 80), (50, 65), (450, 65)]);
        // What is deep enough for all of the tool is even.
        assert_eq!(vertices(Some([50, 60].map(Nm::from_um))), [(0, 80), (450, 65)]);
    }

    #[test]
    fn where_the_tool_begins_and_ends_to_rise_is_a_vertex_of_a_straight_way() {
        let points = [vertex(0.0, 0.0, 2e4), vertex(1e6, 0.0, 1.2e5), vertex(2e6, 0.0, 2e4)];
        let rises = Some([50, 100].map(Nm::from_um));
        let (path, clearance) = fit(&points, Fit { rises, ..FIT }).expect("a path");
        let ends = path.segments.iter().map(|segment| segment.to().x.get() / 1000);
        let found: Vec<_> = ends.zip(&clearance[1..]).map(|(x, room)| (x, room.get() / 1000)).collect();
        // Between 800 and 1200 µm the tool is as deep as it goes; the narrow ends are even.
        for expected in [(300, 50), (800, 100), (1200, 100), (1700, 50), (2000, 20)] {
            assert!(found.contains(&expected), "{expected:?}: {found:?}");
        }
    }

    #[test]
    fn the_narrowest_place_is_a_vertex() {
        let points = [vertex(0.0, 0.0, 3e5), vertex(5e5, 0.0, 1e5), vertex(1e6, 0.0, 3e5)];
        let (path, clearance) = fit(&points, FIT).expect("a path");
        assert_eq!(path.segments.len(), 2, "straight, but split");
        assert_eq!(clearance[1], Nm::from_um(100), "the narrowest");
    }
}
