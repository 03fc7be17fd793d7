//! Drawings in which more than two lines meet, as chords that meet at their ends alone.
//!
//! Which of two lines that nearly coincide lies outside cannot be told from their directions where
//! they meet: both are bent there to a common end. So arcs become chords, as fine as any copper,
//! and chords are parted where they cross or pass within half a nanometre of an end, to which they
//! are bent, until none does: snap rounding (Hobby, Practical segment intersection with finite
//! precision output, 1999).

use std::ops::ControlFlow;

use super::edge::{self, Edge};
use super::heal;
use crate::board::FLATTEN;
use crate::geometry::{Point, RectIndex, cross};

/// How often chords are parted at most: bent ones may cross others. Chosen; three times do nearly
/// always.
const ROUNDS: usize = 16;

/// The most chords that are parted; drawings of more are taken as they are. Chosen.
const MOST: usize = 1_000_000;

/// The edges; those of drawings in which more than two meet anywhere as chords.
pub(super) fn of_crowded(edges: Vec<Edge>) -> Vec<Edge> {
    let crowded = crowded(&edges);
    if !crowded.contains(&true) {
        return edges;
    }
    let (mut chords, mut plain) = (Vec::new(), Vec::new());
    for (edge, is_crowded) in edges.iter().zip(crowded) {
        if is_crowded { chords.extend(flattened(edge)) } else { plain.push(*edge) }
    }
    edge::drop_doubles(&mut chords);
    for _ in 0..ROUNDS {
        let Some(cuts) = cuts(&chords) else { break };
        chords = chords.iter().zip(cuts).flat_map(|(chord, cuts)| parted(*chord, cuts)).collect();
        edge::drop_doubles(&mut chords);
    }
    // What became the same from end to end leads nowhere now.
    heal::drop_dead_ends(&mut chords);
    chords.extend(plain);
    chords
}

/// Which edges are connected to a point where more than two end.
fn crowded(edges: &[Edge]) -> Vec<bool> {
    let meeting = heal::meeting(edges);
    let groups = || meeting.chunk_by(|a, b| a.0 == b.0);
    let mut crowded = vec![false; edges.len()];
    let mut next: Vec<usize> =
        groups().filter(|group| group.len() > 2).flatten().map(|&(_, edge)| edge).collect();
    while let Some(edge) = next.pop() {
        if std::mem::replace(&mut crowded[edge], true) {
            continue;
        }
        for end in [edges[edge].from, edges[edge].to] {
            let first = meeting.partition_point(|other| other.0 < end);
            let here = meeting[first..].iter().take_while(|other| other.0 == end);
            next.extend(here.map(|&(_, other)| other).filter(|&other| !crowded[other]));
        }
    }
    crowded
}

/// The chords of an arc; a line as it is.
fn flattened(edge: &Edge) -> Vec<Edge> {
    let Some(arc) = edge.as_arc() else { return vec![*edge] };
    let mut from = edge.from;
    let chord = |to: Point| {
        let chord = Edge { from, to, round: None, bow: edge.round, ..*edge };
        from = to;
        chord
    };
    arc.flatten(FLATTEN).map(chord).filter(|chord| chord.from != chord.to).collect()
}

/// Where each chord is to be parted; none where no chord is, or where too many cross.
fn cuts(chords: &[Edge]) -> Option<Vec<Vec<Point>>> {
    let index = (chords.len() <= MOST).then(|| RectIndex::new(chords.iter().map(Edge::bounds)))?;
    let mut cuts = vec![Vec::new(); chords.len()];
    let mut found = 0;
    for (i, chord) in chords.iter().enumerate() {
        let visited = index.visit(chord.bounds(), |j| {
            if i < j {
                found += meet(chords, [i, j], &mut cuts);
            }
            if found > edge::MOST_CROSSINGS { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        if visited.is_break() {
            return None;
        }
    }
    (found > 0).then_some(cuts)
}

/// Notes where two chords cross, or one ends on the other; in how many places.
fn meet(chords: &[Edge], pair: [usize; 2], cuts: &mut [Vec<Point>]) -> usize {
    let [a, b] = pair.map(|i| chords[i]);
    let places = places(a, b);
    let mut found = 0;
    for (i, chord) in pair.into_iter().zip([a, b]) {
        let within = places.iter().filter(|&&p| p != chord.from && p != chord.to);
        let before = cuts[i].len();
        cuts[i].extend(within);
        found += cuts[i].len() - before;
    }
    found
}

/// Where two chords cross, or one ends on the other.
pub(super) fn places(a: Edge, b: Edge) -> Vec<Point> {
    let mut places: Vec<Point> = [b.from, b.to].into_iter().filter(|&p| lies_on(a, p)).collect();
    places.extend([a.from, a.to].into_iter().filter(|&p| lies_on(b, p)));
    if places.is_empty() && cross((a.from, a.to), (b.from, b.to)) {
        places.extend(edge::line_and_line(&a, &b));
    }
    places
}

/// Whether a chord passes a point within half a nanometre each way, and it is at neither end.
fn lies_on(chord: Edge, p: Point) -> bool {
    let (way, to) = (chord.to - chord.from, p - chord.from);
    let (along, off) = (way.dot(to), i128::from(way.cross(to)));
    along > 0 && along < way.length_squared() && 2 * off * off <= i128::from(way.length_squared())
}

/// A chord in parts.
fn parted(chord: Edge, mut cuts: Vec<Point>) -> Vec<Edge> {
    let way = chord.to - chord.from;
    cuts.sort_by_key(|&p| (way.dot(p - chord.from), p));
    cuts.dedup();
    let ends = cuts.iter().copied().chain([chord.to]);
    let begins = [chord.from].into_iter().chain(cuts.iter().copied());
    begins.zip(ends).map(|(from, to)| Edge { from, to, ..chord }).collect()
}
