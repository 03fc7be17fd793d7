//! Islands of a region that tapers off between two others.
//!
//! ```text
//!     A     A     A     A        A wedge of C thinner than a pixel is seen again where a pixel's centre happens to fall into it, and the
//!    ────●━━━━●───●┄┄            picture then has an island of C. The boundary of A and B between the two ━ is none: it lies inside C. It is
//!     C ╱   B  ╲C╱               taken out, and the borders of C are joined past it.
//!    ──╱     B  ╲    B
//! ```

use super::OUTSIDE;
use super::stitch::Line;
use super::tip::{End, HALVINGS, Nodes, Tips, open_nodes, outward, third_owner};
use super::trace::Corner;

/// The two pairs of ends that are to be joined past a line.
type Joints = [(End, End); 2];

impl Tips<'_> {
    /// Takes out all lines that lie inside a third region from one open node to another.
    pub(super) fn take_out_bridges(&self, lines: &mut Vec<Line>) {
        let mut nodes = open_nodes(lines);
        let mut gone = vec![false; lines.len()];
        loop {
            let before = nodes.len();
            for i in 0..lines.len() {
                if !gone[i]
                    && let Some(joints) = self.bridge(lines, &nodes, i)
                    && let Some(joined) = self.past(lines, i, joints)
                {
                    take_out(lines, &mut nodes, i, joints, joined);
                    gone[i] = true;
                    joints.iter().for_each(|(here, there)| gone[there.line] |= here.line != there.line);
                }
            }
            if nodes.len() == before {
                break;
            }
        }
        let mut gone = gone.into_iter();
        lines.retain(|_| gone.next() != Some(true));
    }

    /// The ends that are to be joined past line `i`, if it lies inside a third region from one open node to another.
    fn bridge(&self, lines: &[Line], nodes: &Nodes, i: usize) -> Option<Joints> {
        let line = &lines[i];
        let (from, to) = line.ends.filter(|(from, to)| from.open && to.open)?;
        let (here, there) = (nodes.get(&from.key())?, nodes.get(&to.key())?);
        let third = third_owner(lines, here, line)?;
        if from.key() == to.key() || third_owner(lines, there, line)? != third {
            return None;
        }
        let joint = |owner: u32| {
            let parts = |end: &&End| {
                let other = &lines[end.line];
                end.line != i && [other.left, other.right].contains(&owner)
            };
            Some((*here.iter().find(parts)?, *there.iter().find(parts)?))
        };
        let joints = [joint(line.left)?, joint(line.right)?];
        self.is_swallowed(line, third).then_some(joints)
    }

    /// Whether a line lies in the region of `third` altogether.
    fn is_swallowed(&self, line: &Line, third: u32) -> bool {
        let pair = (line.left, line.right);
        let inner = &line.vertices[1..line.vertices.len() - 1];
        if inner.is_empty() {
            let middle = line.vertices[0].at.midpoint(line.vertices[line.vertices.len() - 1].at);
            return self.project(pair, middle).is_some_and(|middle| self.is_inside(pair, third, middle.at));
        }
        inner.iter().all(|vertex| self.is_inside(pair, third, vertex.at))
    }

    /// The lines past a bridge; none where they would not follow their boundaries: the bridge stays then, as the picture has it.
    fn past(&self, lines: &[Line], bridge: usize, joints: Joints) -> Option<[Line; 2]> {
        let Line { left, right, .. } = lines[bridge];
        let join = |(here, there): (End, End)| {
            let is_third = |owner: &u32| ![lines[here.line].left, lines[here.line].right].contains(owner);
            let third = [left, right].into_iter().find(is_third);
            self.joined(lines, (here, there), third.unwrap_or(OUTSIDE))
        };
        Some([join(joints[0])?, join(joints[1])?])
    }

    /// The line that runs up to one end and on from the other, without what lies in the region of `third` there; a loop where both are
    /// ends of one line.
    fn joined(&self, lines: &[Line], (here, there): (End, End), third: u32) -> Option<Line> {
        let first = &lines[here.line];
        let (left, right) = if here.tail { (first.left, first.right) } else { (first.right, first.left) };
        let pair = (left, right);
        let clear = |end: End| {
            let mut vertices = outward(&lines[end.line], end.tail);
            let clear = self.first_clear(&vertices, pair, third).unwrap_or(vertices.len() - 1);
            vertices.split_off(clear)
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

/// Puts the lines that were joined in place of the first of each pair.
fn take_out(lines: &mut [Line], nodes: &mut Nodes, bridge: usize, joints: Joints, joined: [Line; 2]) {
    for corner in lines[bridge].ends.into_iter().flat_map(|(from, to)| [from, to]) {
        nodes.remove(&corner.key());
    }
    for ((here, there), joined) in joints.into_iter().zip(joined) {
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
