//! Algorithm 1 of the paper, SIMPLE-TOPOLOGY-RECOVER (§III-A.1): features that share a vertex are
//! one trace.
//!
//! The vertices of a flash are its centre, of a stroke or arc its two ends. The paper takes them
//! for points of the copper; with real apertures they need not be: a flashed ring is hollow at its
//! centre, and a stroke that a clear feature cut in two has each end in one of its pieces only,
//! while both pieces carry the whole axis. So a vertex counts for a feature only where its copper
//! really is there, which keeps the paper's Theorem 1 (what is joined does overlap) for everything
//! a Gerber file can say. It costs the joins of hollow flashes, which contact finds.
//!
//! The paper walks depth first; joining sets as vertices recur is the same partition without the
//! recursion, in linear time (Theorem 2).

use rustc_hash::FxHashMap;

use crate::board::{Axis, Copper, Feature, Shape};
use crate::geometry::Point;

use super::contact::Body;
use super::sets::DisjointSets;

/// The sets of features that share vertices.
pub(super) fn join(copper: &Copper) -> DisjointSets {
    let mut sets = DisjointSets::new(copper.features.len());
    let mut first_at: FxHashMap<Point, u32> = FxHashMap::default();
    first_at.reserve(copper.features.len());
    for (feature, index) in copper.features.iter().zip(0_u32..) {
        for vertex in vertices(&feature.axis).into_iter().flatten() {
            if has_copper_at(feature, vertex) {
                let first = *first_at.entry(vertex).or_insert(index);
                sets.union(first, index);
            }
        }
    }
    sets
}

/// VERTICES-OF: the places where others may join.
const fn vertices(axis: &Axis) -> [Option<Point>; 2] {
    match *axis {
        Axis::Flash(center) => [Some(center), None],
        Axis::Line(from, to) => [Some(from), Some(to)],
        Axis::Arc(arc) => [Some(arc.start), Some(arc.end)],
        Axis::Region => [None, None],
    }
}

/// Whether a vertex of the feature's axis is copper of the feature.
fn has_copper_at(feature: &Feature, vertex: Point) -> bool {
    match &feature.shape {
        Shape::Disc { center, .. } if *center == vertex => true,
        Shape::Stroke { from, to, .. } if [*from, *to].contains(&vertex) => true,
        Shape::Arc { arc, .. } if [arc.start, arc.end].contains(&vertex) => true,
        Shape::Polygon(polygon) => polygon.contains(vertex),
        // An obround flashed: the vertex is the middle of a stroke.
        other => Body::new(other).holds(vertex),
    }
}
