//! Regions that seem to touch where another one passes between them.
//!
//! ```text
//!     A     A     A     A        A wedge of C thinner than a pixel is seen again where a pixel's centre happens to fall into it, and the
//!    ────●━━━━●───●┄┄            picture then has an island of C. The boundary of A and B between the two ━ is none: it lies inside C. It is
//!     C ╱   B  ╲C╱               taken out, and the borders of C are joined past it.
//!    ──╱     B  ╲    B
//! ```
//!
//! The same where pixels show two regions C and D touch, along a line or at a corner, between which
//! a third one passes in truth; and where a strip along the border is thinner than a pixel.

use super::OUTSIDE;
use super::plane::Spot;
use super::span::Vertex;
use super::stitch::Line;
use super::tip::{
    End, HALVINGS, MISPLACED, Nodes, Tips, end_vertex, open_nodes, outward, owners_at, third_at,
};
use super::trace::Corner;

/// The two pairs of ends that are to be joined past a place where two regions seem to touch, and
/// these two.
struct Joints {
    pairs: [(End, End); 2],
    apart: (u32, u32),
}

impl Tips<'_> {
    /// Takes out all lines that lie inside a third region from one open node to another, and open
    /// nodes at which two regions do not touch.
    pub(super) fn take_out_bridges(&self, lines: &mut Vec<Line>) {
        let mut nodes = open_nodes(lines);
        let mut gone = vec![false; lines.len()];
        let crossings: Vec<_> =
            nodes.iter().filter(|(_, ends)| ends.len() == 4).map(|(&key, _)| key).collect();
        for key in crossings {
            if let Some(joints) = nodes.get(&key).and_then(|ends| self.crossing_of_one(lines, ends))
                && let Some(joined) = self.past(lines, &joints)
            {
                nodes.remove(&key);
                gone_with(&mut gone, &joints);
                join(lines, &mut nodes, &joints, joined);
            }
        }
        loop {
            let before = nodes.len();
            for i in 0..lines.len() {
                if !gone[i]
                    && let Some(joints) = self.bridge(lines, &nodes, i)
                    && let Some(joined) = self.past(lines, &joints)
                {
                    lines[i].ends.iter().flat_map(|&(from, to)| [from, to]).for_each(|corner| {
                        nodes.remove(&corner.key());
                    });
                    gone[i] = true;
                    gone_with(&mut gone, &joints);
                    join(lines, &mut nodes, &joints, joined);
                }
            }
            if nodes.len() == before {
                break;
            }
        }
        let mut gone = gone.into_iter();
        lines.retain(|_| gone.next() != Some(true));
    }

    /// The ends that are to be joined past line `i`, if it lies inside a third region from one open
    /// node to another.
    fn bridge(&self, lines: &[Line], nodes: &Nodes, i: usize) -> Option<Joints> {
        let line = &lines[i];
        let (from, to) = line.ends.filter(|(from, to)| from.open && to.open)?;
        let (here, there) = (nodes.get(&from.key())?, nodes.get(&to.key())?);
        let third = third_at(lines, here, line)?;
        if from.key() == to.key() || third_at(lines, there, line)? != third {
            return None;
        }
        let joint = |owner: u32| {
            let parts = |end: &&End| {
                let other = &lines[end.line];
                end.line != i && [other.left, other.right].contains(&owner)
            };
            Some((*here.iter().find(parts)?, *there.iter().find(parts)?))
        };
        let pairs = [joint(line.left)?, joint(line.right)?];
        self.is_swallowed(line, third).then_some(Joints { pairs, apart: (line.left, line.right) })
    }

    /// The ends that are to be joined at a node of four lines between which one region lies twice,
    /// if it passes between the other two there.
    fn crossing_of_one(&self, lines: &[Line], ends: &[End]) -> Option<Joints> {
        let owners = owners_at(lines, ends);
        let has = |end: &End, owner: u32| [lines[end.line].left, lines[end.line].right].contains(&owner);
        let passing = owners.iter().copied().find(|&owner| ends.iter().all(|end| has(end, owner)))?;
        let mut others = owners.iter().copied().filter(|&owner| owner != passing);
        let (Some(a), Some(b), None) = (others.next(), others.next(), others.next()) else { return None };
        let pair = |owner: u32| {
            let mut with = ends.iter().copied().filter(|end| has(end, owner));
            Some((with.next()?, with.next()?))
        };
        let pairs = [pair(a)?, pair(b)?];
        let is_apart =
            !owners.contains(&OUTSIDE) && self.is_parted((a, b), passing, end_vertex(lines, ends[0]).at);
        is_apart.then_some(Joints { pairs, apart: (a, b) })
    }

    /// Whether a line lies in the region of `third` altogether.
    fn is_swallowed(&self, line: &Line, third: u32) -> bool {
        let mut middles = line.vertices.windows(2).map(|pair| pair[0].at.midpoint(pair[1].at));
        if line.is_border() {
            let beside = if line.left == OUTSIDE { line.right } else { line.left };
            let mut places = line.vertices.iter().map(|vertex| vertex.at).chain(middles);
            return places.all(|p| self.is_inside((beside, beside), third, p));
        }
        let inner = line.vertices[1..line.vertices.len() - 1].iter().map(|vertex| vertex.at);
        let middle = if line.vertices.len() == 2 { middles.next() } else { None };
        inner.chain(middle).all(|p| self.is_parted((line.left, line.right), third, p))
    }

    /// Whether the places near `p` that are equally far from two regions lie in the region of
    /// `third`. What the pixels show of their boundary there may not have been placed on it.
    fn is_parted(&self, pair: (u32, u32), third: u32, p: Spot) -> bool {
        self.project(pair, p).is_some_and(|middle| self.is_inside(pair, third, middle.at))
    }

    /// The lines past a bridge or a node; none where they would not follow their boundaries: it
    /// stays then, as the picture has it.
    fn past(&self, lines: &[Line], joints: &Joints) -> Option<[Line; 2]> {
        let (a, b) = joints.apart;
        let join = |(here, there): (End, End)| {
            let is_third = |owner: &u32| ![lines[here.line].left, lines[here.line].right].contains(owner);
            let third = [a, b].into_iter().find(is_third);
            self.joined(lines, (here, there), third.unwrap_or(OUTSIDE))
        };
        Some([join(joints.pairs[0])?, join(joints.pairs[1])?])
    }

    /// The line that runs up to one end and on from the other, without what lies in the region of
    /// `third` there; a loop where both are ends of one line.
    fn joined(&self, lines: &[Line], (here, there): (End, End), third: u32) -> Option<Line> {
        let first = &lines[here.line];
        if first.is_border() {
            return Some(joined_at_border(lines, (here, there)));
        }
        let (left, right) = if here.tail { (first.left, first.right) } else { (first.right, first.left) };
        let pair = (left, right);
        let clear = |end: End| {
            let mut vertices = outward(&lines[end.line], end.tail);
            // What was placed beside the node may lie on another boundary of the two.
            let is_placed = |vertex: &Vertex| {
                let [least, most] = self.spread(&[left, right], vertex.at);
                most - least <= MISPLACED && !self.is_inside(pair, third, vertex.at)
            };
            let placed = (1..vertices.len()).find(|&i| is_placed(&vertices[i]));
            vertices.split_off(placed.unwrap_or(vertices.len() - 1))
        };
        let (mut vertices, onward) = (clear(here), clear(there));
        vertices.reverse();
        let (before, after) = (vertices[vertices.len() - 1], onward[0]);
        if !self.halve(pair, before, after, HALVINGS, &mut vertices) {
            return None;
        }
        if here.line == there.line {
            // One line round: what it has beyond the gap, it has already.
            let open = vertices.iter().position(|vertex| *vertex == after).unwrap_or(0);
            vertices.drain(..open);
            vertices.push(after);
            return Some(Line { vertices, left, right, ends: None });
        }
        vertices.extend(onward);
        Some(Line { vertices, left, right, ends: far_corner(lines, here).zip(far_corner(lines, there)) })
    }
}

/// The line along the border that runs up to one end and on from the other: its way in between is
/// the border's own.
fn joined_at_border(lines: &[Line], (here, there): (End, End)) -> Line {
    let first = &lines[here.line];
    let (left, right) = if here.tail { (first.left, first.right) } else { (first.right, first.left) };
    let mut vertices = outward(first, here.tail);
    vertices.reverse();
    if here.line == there.line {
        return Line { vertices, left, right, ends: None };
    }
    vertices.extend(outward(&lines[there.line], there.tail));
    Line { vertices, left, right, ends: far_corner(lines, here).zip(far_corner(lines, there)) }
}

/// Marks the second lines of pairs, which the first ones take up.
fn gone_with(gone: &mut [bool], joints: &Joints) {
    joints.pairs.iter().for_each(|(here, there)| gone[there.line] |= here.line != there.line);
}

/// Puts the lines that were joined in place of the first of each pair.
fn join(lines: &mut [Line], nodes: &mut Nodes, joints: &Joints, joined: [Line; 2]) {
    for (&(here, there), joined) in joints.pairs.iter().zip(joined) {
        // It begins at the far end of the first, and ends at that of the second.
        for (near, tail) in [(here, false), (there, true)] {
            let Some(corner) = far_corner(lines, near) else { continue };
            let far = End { tail: !near.tail, ..near };
            let named = nodes.get_mut(&corner.key()).into_iter().flatten().find(|end| **end == far);
            named.into_iter().for_each(|end| *end = End { line: here.line, tail });
        }
        lines[here.line] = joined;
    }
}

/// The corner of the other end of a line.
fn far_corner(lines: &[Line], end: End) -> Option<Corner> {
    lines[end.line].ends.map(|(from, to)| if end.tail { from } else { to })
}
