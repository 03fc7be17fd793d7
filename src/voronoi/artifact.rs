//! Stubs and slivers: what is too small to be cut, merged with what lies beside it.
//!
//! ```text
//!     ╲ stub ╱            ╲  ╱          A stub is a line between two nodes that are closer than half the fitting tolerance: one
//!      ●────●      ─▶      ●            node stands for both. No line but the stub goes, and where it went there still is
//!     ╱      ╲            ╱  ╲          a point, so what was parted stays parted.
//!
//!    A  ╭─╮ bare          A             A sliver is a pocket of bare board beyond the limit in the region of one net, smaller than two
//!       ╰─╯        ─▶                   pixels each way: pixels see it or not by chance. It is left to that net; no other is near.
//! ```
//!
//! Fitting takes the other half of the tolerance, so what ends at a merged node stays within all of
//! it. Ends that hang loose, which others call stubs, there are none: every region's border closes.

use std::collections::BTreeMap;

use crate::board::Warning;
use crate::geometry::Nm;

use super::span::Vertex;
use super::stitch::Line;
use super::trace::Corner;
use super::{BACKGROUND, OUTSIDE};

/// Stubs and slivers are smaller than this.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    /// The distance of a stub's ends.
    pub(super) stub: Nm,
    /// The width and the height of a sliver.
    pub(super) sliver: Nm,
}

/// What tells a node from others.
type Key = (u32, u32, bool);

impl Sizes {
    /// Merges all that is smaller; a warning says how many there were.
    pub(super) fn merge(self, lines: &mut Vec<Line>) -> Option<Warning> {
        let all = lines.len();
        lines.retain(|line| !self.is_sliver(line));
        let slivers = all - lines.len();
        let stubs = self.merge_stubs(lines);
        let message = format!(
            "{stubs} boundary stubs shorter than {:.3} mm and {slivers} pockets of bare board smaller than {:.3} mm were merged with what lies beside them",
            self.stub, self.sliver
        );
        (stubs + slivers > 0).then(|| Warning::new("boundary-artifacts", message))
    }

    /// Whether a line goes round a small pocket in the region of a net.
    fn is_sliver(self, line: &Line) -> bool {
        let (low, high) = (line.left.min(line.right), line.left.max(line.right));
        if line.ends.is_some() || low != BACKGROUND || high <= OUTSIDE {
            return false;
        }
        let extent = |of: fn(&Vertex) -> f64| {
            let [least, most] = line.vertices.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], range);
            most - least
        };
        let size = self.sliver.to_f64();
        let is_pocket = (twice_area(line) > 0.0) == (line.left == BACKGROUND);
        is_pocket && extent(|vertex| vertex.at.x) < size && extent(|vertex| vertex.at.y) < size
    }

    /// Makes one node of the ends of every stub; returns how many there were.
    fn merge_stubs(self, lines: &mut Vec<Line>) -> usize {
        let mut moved: BTreeMap<Key, (Corner, Vertex)> = BTreeMap::new();
        let all = lines.len();
        lines.retain(|line| {
            let Some((from, to)) = line.ends else { return true };
            let place = |corner: Corner, vertex: Vertex| resolved(&moved, corner).unwrap_or((corner, vertex));
            let (first, last) = (line.vertices[0], line.vertices[line.vertices.len() - 1]);
            let ((here, first), (there, last)) = (place(from, first), place(to, last));
            let is_stub = here.key() != there.key() && self.is_short(first, last, line);
            if is_stub {
                moved.insert(there.key(), (here, first));
            }
            !is_stub
        });
        for line in lines.iter_mut() {
            let Some((from, to)) = line.ends else { continue };
            let last = line.vertices.len() - 1;
            for (corner, vertex, tail) in [(from, 0, false), (to, last, true)] {
                if let (Some((node, at)), Some(ends)) = (resolved(&moved, corner), &mut line.ends) {
                    // Its course stays its own: the node is in another place, not on another curve.
                    line.vertices[vertex].at = at.at;
                    *(if tail { &mut ends.1 } else { &mut ends.0 }) = node;
                }
            }
        }
        all - lines.len()
    }

    /// Whether a line stays as near to its ends as these are to each other, which is near enough.
    fn is_short(self, first: Vertex, last: Vertex, line: &Line) -> bool {
        let size = self.stub.to_f64();
        let is_near = |vertex: &Vertex| (vertex.at - first.at).length() < size;
        is_near(&last) && line.vertices.iter().all(is_near)
    }
}

/// The node that a corner's node was merged into, if it was.
fn resolved(moved: &BTreeMap<Key, (Corner, Vertex)>, corner: Corner) -> Option<(Corner, Vertex)> {
    let mut found = *moved.get(&corner.key())?;
    while let Some(&next) = moved.get(&found.0.key()) {
        found = next;
    }
    Some(found)
}

fn range([least, most]: [f64; 2], value: f64) -> [f64; 2] {
    [least.min(value), most.max(value)]
}

/// Twice the area inside a loop, counter-clockwise positive.
fn twice_area(line: &Line) -> f64 {
    let origin = line.vertices[0].at;
    line.vertices.windows(2).map(|pair| (pair[0].at - origin).cross(pair[1].at - origin)).sum()
}

#[cfg(test)]
mod tests {
    use super::super::plane::Spot;
    use super::*;

    const SIZES: Sizes = Sizes { stub: Nm::new(2_000), sliver: Nm::new(50_000) };

    fn line(points: &[(f64, f64)], (left, right): (u32, u32), nodes: Option<(u32, u32)>) -> Line {
        let vertex = |&(x, y): &(f64, f64)| Vertex::new(Spot::new(x, y), 1e5);
        let corner = |column: u32| Corner { column, row: 0, branch: false, node: true, open: false };
        let ends = nodes.map(|(from, to)| (corner(from), corner(to)));
        Line { vertices: points.iter().map(vertex).collect(), left, right, ends }
    }

    #[test]
    fn a_stub_becomes_a_node() {
        let mut lines = vec![
            line(&[(-9e4, 9e4), (0.0, 0.0)], (2, 3), Some((1, 2))),
            line(&[(0.0, 0.0), (1_500.0, 0.0)], (4, 3), Some((2, 3))),
            line(&[(1_500.0, 0.0), (9e4, 9e4)], (2, 4), Some((3, 4))),
        ];
        let warning = SIZES.merge(&mut lines).expect("one stub");
        assert!(warning.message.starts_with("1 boundary stubs"), "{}", warning.message);
        assert_eq!(lines.len(), 2, "the others stay: {lines:?}");
        let ends = |line: &Line| line.ends.expect("nodes");
        assert_eq!(ends(&lines[0]).1.key(), ends(&lines[1]).0.key(), "at one node");
        assert_eq!(lines[0].vertices[1].at, lines[1].vertices[0].at, "in one place");
    }

    #[test]
    fn stubs_in_a_row_do_not_wander() {
        let node = |n: u32| (f64::from(n) * 1_500.0, 0.0);
        let mut lines: Vec<Line> =
            (0..4).map(|n| line(&[node(n), node(n + 1)], (2, 3), Some((n, n + 1)))).collect();
        assert!(SIZES.merge(&mut lines).is_some(), "there are stubs");
        let (first, last) = (lines[0].vertices[0], lines[lines.len() - 1].vertices[1]);
        assert!((last.at - first.at).length() >= 3_000.0, "the row is nearly as long: {lines:?}");
    }

    #[test]
    fn a_small_pocket_goes_and_a_small_net_stays() {
        let square = [(0.0, 0.0), (4e4, 0.0), (4e4, 4e4), (0.0, 4e4), (0.0, 0.0)];
        let mut lines = vec![
            line(&square, (BACKGROUND, 2), None),
            line(&square, (2, BACKGROUND), None),
            line(&square.map(|(x, y)| (2.0 * x, 2.0 * y)), (BACKGROUND, 2), None),
        ];
        assert!(SIZES.merge(&mut lines).is_some(), "there is a sliver");
        assert_eq!(lines.len(), 2, "a net, and a large pocket: {lines:?}");
        assert!(lines.iter().all(|line| line.left == 2 || line.vertices[1].at.x > 5e4), "{lines:?}");
    }
}
