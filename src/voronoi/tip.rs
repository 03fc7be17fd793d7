//! The tips of regions that taper off between two others.
//!
//! ```text
//!     A     A     A     A        A region C that ends in a wedge thinner than a pixel is last seen before its tip: the
//!    ────────●┄┄┄┄┄┄┄○────       picture's node ● lies short of the true one ○, and what the picture takes for the
//!     C  C  ╱   C ┄┄             boundary of A and B in between runs inside C.
//!    ──────╱┄┄┄┄┄  B     B
//! ```
//!
//! The true node is found by following the boundary of A and B for as long as C is nearer than
//! both, and from there both borders of C are followed back to where they were seen. Distances are
//! asked of all sites, through an index: those seen round the node need not be the nearest at the
//! tip.

use std::collections::BTreeMap;

use super::edge::Border;
use super::near::{Insides, Near};
use super::place::Unplaced;
use super::plane::Spot;
use super::seed::Sites;
use super::site::Reach;
use super::span::{Span, Vertex};
use super::stitch::Line;
use super::trace::Corner;
use super::{BACKGROUND, OUTSIDE};

/// A third region must be nearer by more than this to be one, in nanometres: what placing may be
/// off.
pub(super) const NEARER: f64 = 2.0;
/// How exactly points are placed, and at worst, in nanometres of distance difference.
pub(super) const SETTLED: f64 = 0.05;
pub(super) const ACCEPTED: f64 = 5.0;
pub(super) const STEPS: usize = 16;
/// A node is not where it belongs if distances differ by more than this, in nanometres. Chosen: a
/// twentieth of the default fitting tolerance.
pub(super) const MISPLACED: f64 = 100.0;
/// A chord from which two regions differ by more than this in their distance is none of their
/// boundary, in nanometres.
const STRAYS: f64 = 4_000.0;
/// How often the way to a tip is halved at most: to a nanometre, from a metre.
const BISECTIONS: usize = 30;
/// Samples on the way to a tip are halved at most so often.
pub(super) const HALVINGS: u32 = 10;

/// Moves nodes whose place the picture could not tell to where they belong.
pub(super) struct Tips<'a> {
    pub(super) sites: &'a Sites,
    pub(super) near: &'a Near,
    /// The insides of polygons, where there is a limit.
    pub(super) insides: Option<&'a Insides>,
    pub(super) border: &'a Border,
    /// The distance that bounds regions against the background, in nanometres.
    pub(super) level: f64,
}

/// One end of a line.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct End {
    pub(super) line: usize,
    pub(super) tail: bool,
}

impl Tips<'_> {
    /// Extends lines to the true places of their open nodes; returns the nodes that are not where
    /// their regions are equally far.
    pub(super) fn extend(&self, lines: &mut Vec<Line>) -> Unplaced {
        self.part(lines);
        self.take_out_bridges(lines);
        open_nodes(lines).values().for_each(|ends| self.node(lines, ends));
        self.cross(lines);
        self.trim(lines);
        self.look_again(lines);
        self.misplaced(lines)
    }

    /// Extends the lines of one level to where they end between two nets.
    pub(super) fn extend_level(&self, lines: &mut [Line]) {
        open_nodes(lines).values().for_each(|ends| self.end_of_level(lines, ends));
        self.look_again(lines);
    }

    /// Leads the lines round two nets to where both are as far as the level. There may be several
    /// such places; that one belongs to the lines to which they come without meeting anything.
    fn end_of_level(&self, lines: &mut [Line], ends: &[End]) {
        let &[BACKGROUND, a, b] = owners_at(lines, ends).as_slice() else { return };
        let Some(place) = self.equally_far([a, b, BACKGROUND], end_vertex(lines, ends[0]).at) else { return };
        if a == OUTSIDE {
            return;
        }
        let ways = ends.iter().map(|&end| Some((end, self.way_to(&lines[end.line], end.tail, place)?)));
        let Some(ways) = ways.collect::<Option<Vec<_>>>() else { return };
        if ways.iter().flat_map(|(_, way)| &way.vertices).all(|vertex| self.is_off_copper(vertex.at)) {
            ways.into_iter().for_each(|(end, way)| way.put(&mut lines[end.line], end.tail));
        }
    }

    /// Whether nothing is nearer to a place than the level.
    fn is_off_copper(&self, p: Spot) -> bool {
        self.near.nearer(self.sites, p, self.level - NEARER, |_, _| true).is_none()
    }

    /// The nodes from which not all regions that meet there are equally far.
    fn misplaced(&self, lines: &[Line]) -> Unplaced {
        let mut unplaced = Unplaced::default();
        for ends in nodes(lines, |_| true).values() {
            let node = end_vertex(lines, ends[0]).at;
            let mut owners = owners_at(lines, ends);
            let at_border = owners.contains(&OUTSIDE);
            owners.retain(|&owner| owner != OUTSIDE);
            let [least, most] = self.spread(&owners, node);
            if most - least > MISPLACED || (at_border && self.border.distance(node).abs() > MISPLACED) {
                unplaced.add(node);
            }
        }
        unplaced
    }

    /// How far the nearest and the farthest of several regions are from a place.
    pub(super) fn spread(&self, owners: &[u32], p: Spot) -> [f64; 2] {
        owners
            .iter()
            .map(|&owner| self.reach(owner, p).distance)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], distance| {
                [least.min(distance), most.max(distance)]
            })
    }

    /// Moves the node at which three lines end to its place, if that can be found; those at the
    /// border are left.
    fn node(&self, lines: &mut [Line], ends: &[End]) {
        if owners_at(lines, ends).contains(&OUTSIDE) {
            return;
        }
        let found = ends.iter().find_map(|end| {
            let line = &lines[end.line];
            let third = third_at(lines, ends, line)?;
            self.tip(&outward(line, end.tail), (line.left, line.right), third)
        });
        let Some(tip) = found else { return };
        let led: Option<Vec<Vec<Vertex>>> = ends
            .iter()
            .map(|end| {
                let line = &lines[end.line];
                let vertices = outward(line, end.tail);
                let Some(third) = third_at(lines, ends, line) else { return Some(vertices) };
                self.led_to(&vertices, tip, (line.left, line.right), third)
            })
            .collect();
        for (end, mut vertices) in ends.iter().zip(led.into_iter().flatten()) {
            if end.tail {
                vertices.reverse();
            }
            lines[end.line].vertices = vertices;
        }
    }

    /// Where the boundary of `pair` emerges from the region of `third`, if it begins in there.
    fn tip(&self, vertices: &[Vertex], pair: (u32, u32), third: u32) -> Option<Vertex> {
        let clear = self.first_clear(vertices, pair, third)?;
        let mut inside = self.project(pair, vertices[clear - 1].at)?;
        let mut outside = self.project(pair, vertices[clear].at)?;
        if !self.is_inside(pair, third, inside.at) {
            return None;
        }
        for _ in 0..BISECTIONS {
            let middle = self.project(pair, inside.at.midpoint(outside.at))?;
            if self.is_inside(pair, third, middle.at) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        let nearest = self.near.reach(self.sites, outside.at, |_| true).distance.min(self.level);
        (nearest >= outside.clearance() - ACCEPTED).then_some(outside)
    }

    /// The first vertex after the node that does not lie in the region of `third`.
    pub(super) fn first_clear(&self, vertices: &[Vertex], pair: (u32, u32), third: u32) -> Option<usize> {
        (1..vertices.len()).find(|&i| !self.is_inside(pair, third, vertices[i].at))
    }

    /// The line from `tip` to the end of `vertices`, along the boundary of `pair`, without what
    /// lies in the region of `third`.
    fn led_to(&self, vertices: &[Vertex], tip: Vertex, pair: (u32, u32), third: u32) -> Option<Vec<Vertex>> {
        let clear = self.first_clear(vertices, pair, third).unwrap_or(vertices.len() - 1);
        let tip = self.on_course(pair, tip);
        let mut led = vec![tip];
        let follows = self.halve(pair, tip, vertices[clear], HALVINGS, &mut led);
        led.extend(&vertices[clear..]);
        follows.then_some(led)
    }

    /// Samples between two places by halving; whether they follow the boundary of `pair`.
    pub(super) fn halve(
        &self,
        pair: (u32, u32),
        from: Vertex,
        to: Vertex,
        left: u32,
        samples: &mut Vec<Vertex>,
    ) -> bool {
        let onward = |middle: &Vertex| left > 0 && middle.is_between(from, to);
        let middle = from.at.midpoint(to.at);
        let Some(middle) = self.project(pair, middle).filter(onward) else {
            samples.extend(from.chord(to));
            let [least, most] = self.spread(&[pair.0, pair.1], middle);
            return most - least <= STRAYS;
        };
        let settled = Span::new(from, to).holds(middle);
        let before = settled || self.halve(pair, from, middle, left - 1, samples);
        samples.push(middle);
        let after = settled || self.halve(pair, middle, to, left - 1, samples);
        before && after
    }

    /// A node with the course that the boundary of two regions has there.
    pub(super) fn on_course(&self, (a, b): (u32, u32), node: Vertex) -> Vertex {
        let (a, b) = (self.reach(a, node.at), self.reach(b, node.at));
        if (a.distance - b.distance).abs() > ACCEPTED {
            return Vertex::new(node.at, node.clearance());
        }
        Vertex::across(node.at, node.clearance(), a.away - b.away, a.away)
    }

    pub(super) fn is_inside(&self, pair: (u32, u32), third: u32, p: Spot) -> bool {
        let other = self.reach(pair.0, p).distance.min(self.reach(pair.1, p).distance);
        self.reach(third, p).distance < other - NEARER
    }

    pub(super) fn reach(&self, owner: u32, p: Spot) -> Reach {
        if owner == BACKGROUND {
            return Reach { distance: self.level, away: Spot::default() };
        }
        let outside = self.near.reach_of(self.sites, p, owner);
        // A limit curve that is sought inside a polygon may seem to be found there, beside
        // something else of the same net.
        let inside = self.insides.as_ref().and_then(|insides| insides.reach(self.sites, p, owner));
        inside.unwrap_or(outside)
    }

    /// The point near `from` that is equally far from both.
    pub(super) fn project(&self, (a, b): (u32, u32), from: Spot) -> Option<Vertex> {
        let mut p = from;
        for step in 0..STEPS {
            let (a, b) = (self.reach(a, p), self.reach(b, p));
            let (miss, slope) = (a.distance - b.distance, a.away - b.away);
            let steepness = slope.dot(slope);
            if miss.abs() <= SETTLED || (step + 1 == STEPS && miss.abs() <= ACCEPTED) {
                return Some(Vertex::across(p, a.distance.min(b.distance), slope, a.away));
            }
            if steepness < 1e-6 || !steepness.is_finite() {
                return None;
            }
            p = p - slope * (miss / steepness);
        }
        None
    }
}

/// The ends of lines at each node, by its corner.
pub(super) type Nodes = BTreeMap<(u32, u32, bool), Vec<End>>;

/// The nodes that are `wanted`.
pub(super) fn nodes(lines: &[Line], wanted: impl Fn(&Corner) -> bool) -> Nodes {
    let mut nodes = Nodes::new();
    for (i, line) in lines.iter().enumerate() {
        for (corner, tail) in line.ends.iter().flat_map(|&(from, to)| [(from, false), (to, true)]) {
            if wanted(&corner) {
                nodes.entry(corner.key()).or_default().push(End { line: i, tail });
            }
        }
    }
    nodes
}

/// The nodes whose place the picture could not tell.
pub(super) fn open_nodes(lines: &[Line]) -> Nodes {
    nodes(lines, |corner| corner.open)
}

/// The region at a node of three lines and three owners that is not beside `line`; none where that
/// is the outside.
pub(super) fn third_at(lines: &[Line], ends: &[End], line: &Line) -> Option<u32> {
    let owners = owners_at(lines, ends);
    let third = owners.iter().copied().find(|&owner| owner != line.left && owner != line.right);
    third.filter(|&third| ends.len() == 3 && owners.len() == 3 && third != OUTSIDE)
}

/// Whose regions meet at a node, each once.
pub(super) fn owners_at(lines: &[Line], ends: &[End]) -> Vec<u32> {
    let mut owners: Vec<u32> =
        ends.iter().flat_map(|end| [lines[end.line].left, lines[end.line].right]).collect();
    owners.sort_unstable();
    owners.dedup();
    owners
}

/// The vertex at one end of a line.
pub(super) fn end_vertex(lines: &[Line], end: End) -> Vertex {
    let vertices = &lines[end.line].vertices;
    vertices[if end.tail { vertices.len() - 1 } else { 0 }]
}

/// The vertices of a line from one of its ends on.
pub(super) fn outward(line: &Line, tail: bool) -> Vec<Vertex> {
    let mut vertices = line.vertices.clone();
    if tail {
        vertices.reverse();
    }
    vertices
}
