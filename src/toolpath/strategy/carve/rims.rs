//! Rims of wide places among the ways of the axis: branches that come to a rim lead on along it.
//!
//! ```text
//!   ╲                ╱
//!    ╲              ╱     ╲ ╱  branches into the corners of the area
//!     ●────rim─────●      ●    where they come to the rim, which is parted there
//!     │            │
//! ```
//!
//! A branch ends where the rim has a corner, but for the micrometre that it goes on to, and is led
//! to it: a trail goes round the rim, out into each corner and back, without a retract.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use crate::geometry::{Nm, Path, Point, Rect, RectIndex};

use super::floor::Floor;

/// A branch ends so near to a corner of a rim at most. Chosen: a micrometre of width is that much
/// of way in a corner of 2°.
const NEAR: Nm = Nm::from_um(60);

/// The rims of a pass.
pub(super) struct Rims<'a> {
    floor: &'a Floor,
    /// The rim of each corner, and its number there.
    corners: Vec<(usize, usize)>,
    by_place: RectIndex,
    /// The node at each corner that a branch comes to.
    nodes: BTreeMap<(usize, usize), u32>,
}

/// A part of a rim: all of it, or what lies between two branches.
pub(super) struct Part {
    pub(super) path: Path,
    /// The nodes at its ends; none for a rim without a branch.
    pub(super) ends: Option<(u32, u32)>,
}

impl<'a> Rims<'a> {
    pub(super) fn new(floor: &'a Floor) -> Self {
        let rings = floor.rims.iter().enumerate().filter(|(_, rim)| rim.is_closed());
        let of_rim = |(rim, path): (usize, &Path)| (0..path.segments.len()).map(move |corner| (rim, corner));
        let corners: Vec<(usize, usize)> = rings.flat_map(of_rim).collect();
        let at = |&(rim, corner): &(usize, usize)| {
            let place = vertex(&floor.rims[rim], corner);
            Rect::new(place, place)
        };
        let by_place = RectIndex::new(corners.iter().map(at));
        Self { floor, corners, by_place, nodes: BTreeMap::new() }
    }

    /// The corner next to the end of a branch, which no wall parts from it, and its node, for which
    /// `new` is taken if it had none; none where no corner is near.
    pub(super) fn corner(&mut self, end: Point, new: impl FnOnce() -> u32) -> Option<(Point, u32)> {
        let mut nearest: Option<(i64, (usize, usize))> = None;
        let _: ControlFlow<()> = self.by_place.visit(Rect::new(end, end).inflate(NEAR), |index| {
            let corner = self.corners[index];
            let off = (vertex(&self.floor.rims[corner.0], corner.1) - end).length_squared();
            nearest = Some(nearest.map_or((off, corner), |before| before.min((off, corner))));
            ControlFlow::Continue(())
        });
        let (_, corner) = nearest?;
        let place = vertex(&self.floor.rims[corner.0], corner.1);
        let leads = self.floor.room.leads(end, place);
        leads.then(|| (place, *self.nodes.entry(corner).or_insert_with(new)))
    }

    /// All rims, parted where branches come to them.
    pub(super) fn parts(self) -> Vec<Part> {
        let part = |(rim, path): (usize, &Path)| {
            let own: Vec<(usize, u32)> = self
                .nodes
                .range((rim, 0)..(rim + 1, 0))
                .map(|(&(_, corner), &node)| (corner, node))
                .collect();
            let next = own.iter().cycle().skip(1);
            let mut parts: Vec<Part> =
                own.iter().zip(next).map(|(&from, &to)| between(path, from, to)).collect();
            if parts.is_empty() {
                parts.push(Part { path: path.clone(), ends: None });
            }
            parts
        };
        self.floor.rims.iter().enumerate().flat_map(part).collect()
    }
}

/// Where a segment of a path begins.
fn vertex(path: &Path, segment: usize) -> Point {
    segment.checked_sub(1).map_or(path.start, |before| path.segments[before].to())
}

/// The part of a closed path from one corner to the next, or once round it.
fn between(path: &Path, (from, node): (usize, u32), (to, other): (usize, u32)) -> Part {
    let count = path.segments.len();
    let length = (to + count - from - 1) % count + 1;
    let segments = path.segments.iter().cycle().skip(from).take(length).copied().collect();
    Part { path: Path { start: vertex(path, from), segments }, ends: Some((node, other)) }
}
