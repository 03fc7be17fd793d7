//! The lines between regions with the clearance along them.

use serde::Serialize;

use crate::geometry::{Segment, Turn};
use crate::voronoi::{Boundaries, Boundary, Owner};

use crate::report::ink::{Ink, place, um};

/// A line between two regions: the owner on its left, the owner on its right, and its way.
///
/// An owner is a net's number, -1 beyond the edge, -2 where nobody owns the board. The way begins
/// with the start and the distance to copper there (`s x y clearance`); then come lines (`l dx dy`)
/// and arcs (`a dx dy i j` against the clock, `c` with it, the centre from the start), each with
/// how much the clearance grows.
#[derive(Clone, Debug, Serialize)]
pub struct Edge(pub i64, pub i64, pub String);

/// All lines of a side.
pub(super) fn edges(boundaries: &Boundaries) -> Vec<Edge> {
    boundaries.edges.iter().map(edge).collect()
}

fn edge(boundary: &Boundary) -> Edge {
    let mut ink = Ink::default();
    let mut clearance = boundary.clearance.iter().map(|&distance| um(distance));
    let mut before = clearance.next().unwrap_or(0);
    ink.step('s', place(boundary.path.start), &[before]);
    for (_, segment) in boundary.path.steps() {
        let distance = clearance.next().unwrap_or(before);
        let grown = distance - before;
        before = distance;
        match *segment {
            Segment::Line { to } => ink.step('l', place(to), &[grown]),
            Segment::Arc { to, center, turn } => {
                let [i, j] = ink.to(place(center));
                ink.step(letter(turn), place(to), &[i, j, grown]);
            }
        }
    }
    Edge(owner(boundary.left), owner(boundary.right), ink.into_text())
}

/// How an arc is written.
pub(super) const fn letter(turn: Turn) -> char {
    match turn {
        Turn::CounterClockwise => 'a',
        Turn::Clockwise => 'c',
    }
}

fn owner(owner: Owner) -> i64 {
    match owner {
        Owner::Net(net) => i64::from(net.0),
        Owner::Outside => -1,
        Owner::Background => -2,
    }
}
