//! What the way consists of: cuts, links, grooves.

use std::f64::consts::PI;

use crate::geometry::{Point, Segment, Turn};
use crate::toolpath::strategy::pocket::course::{Spot, distance};
use crate::voronoi::medial::Place;

/// A part of the way, seen from above, from where the one before ended.
#[derive(Clone, Debug)]
pub(super) enum Piece {
    /// At the depth of the pass.
    Cut(Vec<Segment>),
    /// Through what is cleared.
    Link(Vec<Segment>),
    /// There and back in layers: what the tool mills in its full width.
    Groove(Vec<Spot>),
    /// The same for a way that ends where it began, or clear of it.
    Layers(Vec<Segment>),
}

/// An arc round a centre from an angle on, in parts that are no full circles.
pub(super) fn arc(center: Spot, radius: f64, from: f64, turned: f64) -> Vec<Segment> {
    let parts = (turned.abs() / (1.2 * PI)).ceil().max(1.0);
    let turn = if turned > 0.0 { Turn::CounterClockwise } else { Turn::Clockwise };
    let mut path = Vec::new();
    let mut part = 1.0;
    while part <= parts {
        let (up, right) = libm::sincos(from + turned * part / parts);
        let to = Point::from_f64(center.0 + radius * right, center.1 + radius * up);
        path.push(Segment::Arc { to, center: Point::from_f64(center.0, center.1), turn });
        part += 1.0;
    }
    path
}

/// From a circle to another without a corner, both left and met the way they go round: an arc
/// within the first, a line that touches both arcs, and an arc within the second; and places along
/// it. None where they are too near.
///
/// ```text
///        ╭──╮──────────╭──╮        G. Elber, E. Cohen, S. Drake, *MATHSM: Medial axis transform toward high speed machining of
///        │  ┆          ┆  │        pockets*, Computer-Aided Design 37 (2005), sect. 3: bi-tangents join the cuts.
///        ●                 ●
/// ```
pub(super) fn tangent_link(
    circles: [Place; 2],
    angles: [f64; 2],
    turn: Turn,
) -> Option<(Vec<Segment>, Vec<Spot>)> {
    let on = |i: usize, radius: f64| {
        let (up, right) = libm::sincos(angles[i]);
        (circles[i].at.0 + radius * right, circles[i].at.1 + radius * up)
    };
    let [start, end] = [0, 1].map(|i| on(i, circles[i].clearance));
    let radius = (circles[0].clearance.min(circles[1].clearance) * 0.5).min(distance(start, end) * 0.2);
    let [first, last] = [0, 1].map(|i| on(i, circles[i].clearance - radius));
    let far = distance(first, last);
    if far < radius || radius < 2_000.0 {
        return None;
    }
    let way = ((last.0 - first.0) / far, (last.1 - first.1) / far);
    let out = match turn {
        Turn::CounterClockwise => (way.1, -way.0),
        Turn::Clockwise => (-way.1, way.0),
    };
    let [leaves, arrives] = [first, last].map(|(x, y)| (x + radius * out.0, y + radius * out.1));
    let [center, other] = [first, last].map(|(x, y)| Point::from_f64(x, y));
    let [to, at, then] = [leaves, arrives, end].map(|(x, y)| Point::from_f64(x, y));
    let path = vec![
        Segment::Arc { to, center, turn },
        Segment::Line { to: at },
        Segment::Arc { to: then, center: other, turn },
    ];
    // An arc that turns by nearly all is one that ends behind its beginning.
    let turned = |from: Spot, segment: &Segment| {
        segment.arc(Point::from_f64(from.0, from.1)).map_or(0.0, |arc| arc.sweep().abs())
    };
    let most = 1.5 * PI;
    if turned(start, &path[0]) > most || turned(arrives, &path[2]) > most {
        return None;
    }
    let middle = path[2].arc(at).map_or(end, |arc| arc.at(0.5));
    Some((path, vec![leaves, arrives, middle, end]))
}

/// A way with fewer corners: from each place straight to the farthest that `is_clear`, found by
/// doubling.
pub(super) fn pulled(way: &[Spot], mut is_clear: impl FnMut(Spot, Spot) -> bool) -> Vec<Spot> {
    let mut found = vec![way[0]];
    let mut i = 0;
    while i + 1 < way.len() {
        let mut next = i + 1;
        let mut ahead = way.len() - 1 - i;
        while ahead > 1 {
            if is_clear(way[i], way[i + ahead]) {
                next = i + ahead;
                break;
            }
            ahead = ahead * 3 / 4;
        }
        found.push(way[next]);
        i = next;
    }
    found.dedup_by(|b, a| distance(*a, *b) < 1.0);
    found
}
