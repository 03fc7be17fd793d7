//! The outermost boundary of each connected drawing.
//!
//! Every edge is walked both ways, always keeping the face on the left: at a corner the walk goes
//! on with the edge that turns most to the right. Each face comes out once; bounded ones run
//! counter-clockwise, the face around a drawing clockwise. The latter is its contour.

use super::area_mm2;
use super::edge::Edge;
use super::notes::Notes;
use crate::geometry::{Path, Segment, Vector};

/// The contour around each connected part of `edges`, counter-clockwise. No edge may lead nowhere
/// or cross another, and where more than two meet all must be lines.
pub(super) fn outermost(edges: &[Edge], notes: &mut Notes<'_>) -> Vec<Path> {
    let walks = Walks::new(edges);
    let mut walked = vec![false; walks.order.len()];
    let (mut contours, mut bounded) = (Vec::new(), 0_usize);
    for start in 0..walked.len() {
        if walked[start] {
            continue;
        }
        let face = walks.face_from(start, &mut walked);
        if area_mm2(&face) < 0.0 { contours.push(face.reversed()) } else { bounded += 1 }
    }
    if bounded > contours.len() {
        let at = walks.first_of_crowd().map(|walk| (walk.from, walk.line));
        notes.parted(at);
    }
    contours
}

/// Every edge walked both ways: walk 2i is edge i, walk 2i + 1 its way back.
struct Walks<'a> {
    edges: &'a [Edge],
    /// The walks by the point that they leave, and there by direction.
    order: Vec<usize>,
    /// Where each walk stands in that order.
    place: Vec<usize>,
}

impl<'a> Walks<'a> {
    fn new(edges: &'a [Edge]) -> Self {
        let mut order: Vec<usize> = (0..2 * edges.len()).collect();
        order.sort_by(|&a, &b| {
            let (a, b) = (walk(edges, a), walk(edges, b));
            a.from.cmp(&b.from).then_with(|| by_direction(&a, &b))
        });
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, &walk)| place[walk] = at);
        Self { edges, order, place }
    }

    fn walk(&self, index: usize) -> Edge {
        walk(self.edges, index)
    }

    /// Walks round the face to the left of `start`.
    fn face_from(&self, start: usize, walked: &mut [bool]) -> Path {
        let mut face = Vec::new();
        let mut at = start;
        while !walked[at] {
            walked[at] = true;
            face.push(self.walk(at));
            // The way back stands in the order of directions; the one before it, clockwise, goes on
            // round this face.
            at = self.before(at ^ 1);
        }
        path(&face)
    }

    /// The walk from the same point that stands before `walk`; the last one before the first.
    fn before(&self, walk: usize) -> usize {
        let (place, from) = (self.place[walk], self.walk(walk).from);
        let leaves = |walk: &usize| self.walk(*walk).from == from;
        let previous = place.checked_sub(1).map(|place| self.order[place]).filter(leaves);
        let last = || self.order[place..].iter().copied().take_while(leaves).last();
        previous.or_else(last).unwrap_or(walk)
    }

    /// The first walk that leaves a point together with two others or more.
    fn first_of_crowd(&self) -> Option<Edge> {
        let groups = self.order.chunk_by(|&a, &b| self.walk(a).from == self.walk(b).from);
        groups.filter(|group| group.len() > 2).flatten().min().map(|&walk| self.walk(walk))
    }
}

/// Edge `index / 2`, back from its end where the index is odd.
fn walk(edges: &[Edge], index: usize) -> Edge {
    let edge = edges[index / 2];
    if index.is_multiple_of(2) { edge } else { edge.reversed() }
}

/// Counter-clockwise from −x. Where only two edges leave a point, which stands first is the same.
fn by_direction(a: &Edge, b: &Edge) -> std::cmp::Ordering {
    let (u, v) = (a.to - a.from, b.to - b.from);
    let half = |w: Vector| w.y.get() > 0 || (w.y.get() == 0 && w.x.get() > 0);
    half(u).cmp(&half(v)).then_with(|| 0.cmp(&u.cross(v)))
}

/// The closed path along `walks`: enough chords of one arc, one after the other, are an arc.
fn path(walks: &[Edge]) -> Path {
    /// Chosen: of fewer the ends say too little about the way round.
    const ENOUGH: usize = 3;
    let mut segments = Vec::new();
    for run in walks.chunk_by(|a, b| a.bow.is_some() && a.bow == b.bow) {
        match (run[0].bow, run.last()) {
            (Some((center, turn)), Some(last)) if run.len() >= ENOUGH => {
                segments.push(Segment::Arc { to: last.to, center, turn });
            }
            _ => segments.extend(run.iter().map(Edge::segment)),
        }
    }
    Path { start: walks[0].from, segments }
}
