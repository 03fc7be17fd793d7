//! Filled areas of the profile layer that overlap each other, or what lines enclose: what they
//! cover together is the board.

use super::chords;
use super::edge::Edge;
use super::nest;
use super::notes::Notes;
use crate::board::polarity;
use crate::geometry::{Path, Point, Polygon, RectIndex};
use crate::import::diagnostic;

/// Overlaps below this, in mm², are what rounding leaves. Chosen.
const NOTHING: f64 = 1e-6;

/// The contours; of those that overlap in part the edge of what they cover together, in straight
/// lines.
pub(super) fn united(contours: Vec<Path>, notes: &mut Notes<'_>) -> Vec<Path> {
    let rings: Vec<Polygon> = contours.iter().filter_map(nest::ring).map(counter_clockwise).collect();
    if rings.len() != contours.len() || rings.len() > nest::MOST {
        return contours;
    }
    let mut group: Vec<usize> = (0..rings.len()).collect();
    for [a, b] in meeting(&rings) {
        if group[a] != group[b] && overlap(&rings[a], &rings[b]) {
            let [from, to] = [group[a].max(group[b]), group[a].min(group[b])];
            group.iter_mut().filter(|of| **of == from).for_each(|of| *of = to);
        }
    }
    let mut united = Vec::new();
    for (first, contour) in contours.iter().enumerate().filter(|&(i, _)| group[i] == i) {
        let members: Vec<&Polygon> =
            (first..rings.len()).filter(|&i| group[i] == first).map(|i| &rings[i]).collect();
        if members.len() < 2 {
            united.push(contour.clone());
            continue;
        }
        let message =
            format!("{} areas of the outline overlap: what they cover together is used", members.len());
        notes.add(&diagnostic::OUTLINE_PARTED, message, notes.place(contour.start));
        let pieces = polarity::union(members);
        let closed = |ring: &Vec<Point>| Path::polyline(ring.iter().chain(ring.first()).copied());
        united.extend(pieces.iter().flat_map(Polygon::contours).filter_map(closed));
    }
    united
}

fn counter_clockwise(ring: Polygon) -> Polygon {
    if ring.area_mm2() > 0.0 {
        return ring;
    }
    let turned = ring.contours().iter().map(|ring| ring.iter().rev().copied().collect()).collect();
    Polygon::new(turned).unwrap_or(ring)
}

/// The pairs of rings of which edges cross, or one ends on the other.
fn meeting(rings: &[Polygon]) -> Vec<[usize; 2]> {
    let of = |(number, ring): (usize, &Polygon)| {
        ring.edges().map(move |(from, to)| (number, Edge::line(from, to, 0))).collect::<Vec<_>>()
    };
    let edges: Vec<(usize, Edge)> = rings.iter().enumerate().flat_map(of).collect();
    let index = RectIndex::new(edges.iter().map(|(_, edge)| edge.bounds()));
    let mut found = Vec::new();
    for &(a, edge) in &edges {
        let others = index.touching(edge.bounds()).into_iter().map(|i| edges[i]);
        let meet = others.filter(|&(b, other)| a < b && !chords::places(edge, other).is_empty());
        found.extend(meet.map(|(b, _)| [a, b]));
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Whether two rings cover something together, and each something alone.
fn overlap(a: &Polygon, b: &Polygon) -> bool {
    let both: f64 = polarity::intersection(a, b).iter().map(Polygon::area_mm2).sum();
    both > NOTHING && both < a.area_mm2().min(b.area_mm2()) - NOTHING
}
