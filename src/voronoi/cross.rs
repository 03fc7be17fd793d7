//! Where four regions all but meet.
//!
//! ```text
//!     A ╲   C   ╱ B         A ╲   C   ╱ B        Between the two nodes C and D touch, or A and B do. Where the nodes lie closer
//!        ●─────●               ╲    ╱            together than pixels can tell, the picture has what the pixels chanced to show,
//!     A ╱   D   ╲ B             ●             and each of its nodes, placed where its three regions are equally far, lies in
//!                               │                the region of the fourth. Then the other two touch.
//!                               ●
//!                              ╱ ╲
//! ```
//!
//! And where four regions meet at one corner of the pixels, one node stands for both. The outside
//! may be one of the four: then a region ends in a tip just before the border, or just reaches it.

use super::OUTSIDE;
use super::plane::Spot;
use super::site::Reach;
use super::span::Vertex;
use super::stitch::Line;
use super::tip::{ACCEPTED, End, NEARER, Nodes, SETTLED, STEPS, Tips, end_vertex, nodes, third_at};
use super::trace::Corner;

/// Crossing over one boundary may let the next one: rounds at most. Chosen: more than one is rare.
const ROUNDS: usize = 4;

/// A boundary between two nodes that belongs between the other two regions there.
struct Crossing {
    line: usize,
    /// The regions on its left and right, at its start and at its end.
    regions: [u32; 4],
    /// Its new nodes: with the region on the left, and with that on the right.
    places: [Vertex; 2],
}

impl Tips<'_> {
    /// Turns the boundaries that part the wrong two regions of four.
    pub(super) fn cross(&self, lines: &mut [Line]) {
        let mut nodes = nodes(lines, |_| true);
        for _ in 0..ROUNDS {
            let mut crossed = false;
            for line in 0..lines.len() {
                if let Some(crossing) = self.crossing(lines, &nodes, line) {
                    self.turn(lines, &mut nodes, &crossing);
                    crossed = true;
                }
            }
            if !crossed {
                return;
            }
        }
    }

    fn crossing(&self, lines: &[Line], nodes: &Nodes, i: usize) -> Option<Crossing> {
        let line = &lines[i];
        let (from, to) = line.ends?;
        let (here, there) = (from.key(), to.key());
        if here == there || line.is_border() {
            return None;
        }
        let (first, last) = (line.vertices[0], line.vertices[line.vertices.len() - 1]);
        let behind = third_at(lines, &nodes[&here], line)?;
        let ahead = third_at(lines, &nodes[&there], line)?;
        if behind == ahead || !self.is_nearer(first, ahead) || !self.is_nearer(last, behind) {
            return None;
        }
        let middle = first.at.midpoint(last.at);
        let place = |third: u32| self.equally_far([behind, ahead, third], middle);
        let places = [place(line.left)?, place(line.right)?];
        Some(Crossing { line: i, regions: [line.left, line.right, behind, ahead], places })
    }

    /// Puts a boundary of the regions behind and ahead in place of one of those on its left and
    /// right.
    fn turn(&self, lines: &mut [Line], nodes: &mut Nodes, crossing: &Crossing) {
        let Crossing { line: turned, regions: [left, _, behind, ahead], places } = crossing;
        let Some((from, to)) = lines[*turned].ends else { return };
        let keys = [from.key(), to.key()];
        let others: Vec<End> =
            keys.iter().flat_map(|key| &nodes[key]).filter(|end| end.line != *turned).copied().collect();
        let mut met = [vec![End { line: *turned, tail: false }], vec![End { line: *turned, tail: true }]];
        for end in others {
            let line = &lines[end.line];
            let side = usize::from(line.left != *left && line.right != *left);
            self.move_end(lines, end, [from, to][side], places[side]);
            met[side].push(end);
        }
        let pair = (*ahead, *behind);
        let vertices = self.between(pair, places[0], places[1]);
        lines[*turned] = Line { vertices, left: pair.0, right: pair.1, ends: Some((from, to)) };
        for (key, ends) in keys.into_iter().zip(met) {
            nodes.insert(key, ends);
        }
    }

    /// Parts nodes of four regions that truly are two.
    pub(super) fn part(&self, lines: &mut Vec<Line>) {
        let mut nodes = nodes(lines, |_| true);
        for i in 0..lines.len() {
            for corner in lines[i].ends.into_iter().flat_map(|(from, to)| [from, to]) {
                let Some(ends) = nodes.get(&corner.key()).filter(|ends| ends.len() == 4) else { continue };
                let Some(([a, b, c, _], places)) = self.parted(lines, ends) else { continue };
                let corners = [false, true].map(|branch| Corner { branch, open: false, ..corner });
                for end in nodes.remove(&corner.key()).into_iter().flatten() {
                    let side = usize::from(lines[end.line].left != b && lines[end.line].right != b);
                    self.move_end(lines, end, corners[side], places[side]);
                }
                let vertices = self.between((a, c), places[0], places[1]);
                lines.push(Line { vertices, left: a, right: c, ends: Some((corners[0], corners[1])) });
            }
        }
    }

    /// Four regions round a node, counter-clockwise, of which the first and the third touch, and
    /// the two places where they meet the second and the fourth; none where all four meet in one
    /// point. The outside may be one of them.
    fn parted(&self, lines: &[Line], ends: &[End]) -> Option<([u32; 4], [Vertex; 2])> {
        let [a, b, c, d] = regions_round(lines, ends)?;
        // Where the picture has one node, it stands where three of the regions are equally far: the
        // fourth may be nearer, or farther.
        let node = end_vertex(lines, ends[0]);
        let nets: Vec<u32> = [a, b, c, d].into_iter().filter(|&owner| owner != OUTSIDE).collect();
        let [least, most] = self.spread(&nets, node.at);
        if most - least <= ACCEPTED {
            return None;
        }
        // What is farther off than the copper is another node.
        let is_here = |place: &Vertex| nets.len() == 4 || (place.at - node.at).length() < least;
        let place = |owners: [u32; 3]| self.equally_far(owners, node.at).filter(is_here);
        [[a, b, c, d], [b, c, d, a]].into_iter().find_map(|[a, b, c, d]| {
            let first = place([a, b, c])?;
            let second = place([a, c, d])?;
            let true_places = !self.is_nearer(first, d) && !self.is_nearer(second, b);
            true_places.then_some(([a, b, c, d], [first, second]))
        })
    }

    /// Makes an end of a line lie at another node.
    fn move_end(&self, lines: &mut [Line], end: End, corner: Corner, place: Vertex) {
        let line = &mut lines[end.line];
        if let Some(ends) = &mut line.ends {
            *(if end.tail { &mut ends.1 } else { &mut ends.0 }) = corner;
        }
        if line.is_border() {
            // Its way is the border's own.
            let last = line.vertices.len() - 1;
            line.vertices[if end.tail { last } else { 0 }] = place;
        } else {
            self.lead(line, end.tail, place);
        }
    }

    /// Whether a region is nearer to a place than those whose boundaries meet there; whether it
    /// lies beyond the border, if that is the outside.
    fn is_nearer(&self, place: Vertex, owner: u32) -> bool {
        if owner == OUTSIDE {
            return self.border.distance(place.at) > NEARER;
        }
        let bound = place.clearance() - NEARER;
        self.near.nearer(self.sites, place.at, bound, |_, other| other == owner).is_some()
    }

    /// The place near `from` that is equally far from three regions; on the border, if the outside
    /// is one of them.
    pub(super) fn equally_far(&self, mut owners: [u32; 3], from: Spot) -> Option<Vertex> {
        owners.sort_unstable_by_key(|&owner| owner == OUTSIDE);
        let mut p = from;
        for _ in 0..STEPS {
            let [a, b] = [owners[0], owners[1]].map(|owner| self.reach(owner, p));
            let (first, across) = (a.distance - b.distance, a.away - b.away);
            let third = self.third(owners[2], p, a);
            let (second, along) = (third.distance, third.away);
            if first.abs() <= SETTLED && second.abs() <= SETTLED {
                return Some(Vertex::new(p, a.distance.min(b.distance)));
            }
            let determinant = across.cross(along);
            if determinant.abs() < 1e-6 || !determinant.is_finite() {
                return None;
            }
            let step = Spot::new(first * along.y - second * across.y, second * across.x - first * along.x);
            p = p - step * (1.0 / determinant);
        }
        None
    }

    /// How much nearer than `other` a region is to a place, or how far that lies beyond the border,
    /// and which way it grows.
    fn third(&self, owner: u32, p: Spot, other: Reach) -> Reach {
        if owner == OUTSIDE {
            return self.border.reach(p);
        }
        let reach = self.reach(owner, p);
        Reach { distance: other.distance - reach.distance, away: other.away - reach.away }
    }
}

/// Four different regions round a node, counter-clockwise; none where there are others than four.
fn regions_round(lines: &[Line], ends: &[End]) -> Option<[u32; 4]> {
    // Seen from the node, a line parts the region on its right from the next one counter-clockwise
    // on its left.
    let sides = |end: &End| {
        let line = &lines[end.line];
        if end.tail { (line.left, line.right) } else { (line.right, line.left) }
    };
    let after = |owner: u32| ends.iter().map(sides).find(|(right, _)| *right == owner).map(|(_, left)| left);
    let a = sides(ends.first()?).0;
    let (b, c) = (after(a)?, after(after(a)?)?);
    let d = after(c)?;
    let ring = [a, b, c, d];
    let different = (0..4).all(|i| !ring[i + 1..].contains(&ring[i]));
    (after(d)? == a && different).then_some(ring)
}
