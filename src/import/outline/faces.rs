//! The outermost boundary of each connected drawing.
//!
//! Every edge is walked both ways, always keeping the face on the left: at a corner the walk goes
//! on with the edge that turns most to the right. Each face comes out once; bounded ones run
//! counter-clockwise, the face around a drawing clockwise. The latter is its contour.

use std::collections::BTreeMap;

use super::edge::Edge;
use super::{Notes, area_mm2};
use crate::geometry::{Path, Point, Vector};
use crate::import::diagnostic;

/// The contour around each connected part of `edges`, counter-clockwise. No edge may lead nowhere.
pub(super) fn outermost(edges: &[Edge], notes: &mut Notes<'_>) -> Vec<Path> {
    let walks: Vec<Edge> = edges.iter().flat_map(|edge| [*edge, edge.reversed()]).collect();
    let mut leaving: BTreeMap<Point, Vec<usize>> = BTreeMap::new();
    for (index, walk) in walks.iter().enumerate() {
        leaving.entry(walk.from).or_default().push(index);
    }
    for around in leaving.values_mut() {
        around.sort_by(|&a, &b| by_direction(&walks[a], &walks[b]));
    }
    let mut walked = vec![false; walks.len()];
    let (mut contours, mut bounded) = (Vec::new(), 0_usize);
    for start in 0..walks.len() {
        if walked[start] {
            continue;
        }
        let face = face_from(start, &walks, &leaving, &mut walked);
        if area_mm2(&face) < 0.0 { contours.push(face.reversed()) } else { bounded += 1 }
    }
    if bounded > contours.len() {
        let at = walks.iter().find(|walk| leaving[&walk.from].len() > 2).map(|walk| (walk.from, walk.line));
        let message = "lines inside the outline touch it; only its outer edge is used";
        notes.add(&diagnostic::OUTLINE_PARTED, message, at);
    }
    contours
}

/// Walks round the face to the left of `start`.
fn face_from(
    start: usize,
    walks: &[Edge],
    leaving: &BTreeMap<Point, Vec<usize>>,
    walked: &mut [bool],
) -> Path {
    let mut face = Path { start: walks[start].from, segments: Vec::new() };
    let mut at = start;
    while !walked[at] {
        walked[at] = true;
        face.segments.push(walks[at].segment());
        // The way back stands in the order of directions; the one before it, clockwise, goes on
        // round this face.
        let around = &leaving[&walks[at].to];
        let back = at ^ 1;
        let place = around.iter().position(|&walk| walk == back).unwrap_or(0);
        at = around[(place + around.len() - 1) % around.len()];
    }
    face
}

/// Counter-clockwise from −x, and by bend where two edges leave in the same direction.
fn by_direction(a: &Edge, b: &Edge) -> std::cmp::Ordering {
    let (u, v) = (a.leaves(), b.leaves());
    let half = |w: Vector| w.y.get() > 0 || (w.y.get() == 0 && w.x.get() > 0);
    half(u).cmp(&half(v)).then_with(|| 0.cmp(&u.cross(v))).then_with(|| a.bend().total_cmp(&b.bend()))
}
