//! Rest machining: what of the boundaries each of several tools cuts.
//!
//! Every stretch goes to the first tool whose kerf fits between the copper on both sides, and the
//! last takes what is left. A stretch fits or not from vertex to vertex: between two of them the
//! gap is never narrower than at the narrower end. What a wide tool would cut in a piece hardly
//! longer than its kerf is left to a finer one: it would only be a hole, and cost a retract.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//!   ━━━━━━━━━━━━━━━━╲         ▓▓▓▓▓    ━ wide   ─ fine
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓ ╲────────────
//!                    ▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//! ```

use crate::geometry::{Nm, Path, Point};
use crate::topology::DisjointSets;
use crate::voronoi::{Boundaries, Boundary, NodeId};

/// How long what a tool cuts in one piece must be, as a multiple of its kerf. Chosen.
const LEAST: f64 = 3.0;

/// The part of `boundaries` that each tool cuts, by their kerfs, the widest first. All parts have
/// the same nodes, some of them new, where one tool takes over from another.
#[must_use]
pub fn share(boundaries: &Boundaries, kerfs: &[Nm]) -> Vec<Boundaries> {
    let mut nodes = boundaries.nodes.clone();
    let mut parts: Vec<(usize, Boundary)> = Vec::new();
    for edge in &boundaries.edges {
        split(edge, kerfs, &mut nodes, &mut parts);
    }
    for (tool, kerf) in kerfs.iter().enumerate().take(kerfs.len().saturating_sub(1)) {
        demote(&mut parts, nodes.len(), tool, kerf.to_f64() * LEAST);
    }
    let of = |tool: usize| Boundaries {
        nodes: nodes.clone(),
        edges: parts.iter().filter(|part| part.0 == tool).map(|part| part.1.clone()).collect(),
        links: Vec::new(),
    };
    (0..kerfs.len()).map(of).collect()
}

/// How much a kerf may be wider than the gap and still fit, so that what was laid out for a kerf is
/// not lost to rounding.
const SLACK: Nm = Nm::from_um(1);

/// Whether a kerf fits a gap of twice `clearance`.
#[must_use]
pub fn fits(kerf: Nm, clearance: Nm) -> bool {
    kerf <= clearance * 2 + SLACK
}

/// The first tool that fits a gap of twice `clearance`; the last if none does.
fn fitting(clearance: Nm, kerfs: &[Nm]) -> usize {
    kerfs.iter().position(|&kerf| fits(kerf, clearance)).unwrap_or(kerfs.len().saturating_sub(1))
}

/// Adds the stretches of `edge` to `parts`, each with its tool, and the places between them to
/// `nodes`.
fn split(edge: &Boundary, kerfs: &[Nm], nodes: &mut Vec<Point>, parts: &mut Vec<(usize, Boundary)>) {
    let tools: Vec<usize> =
        edge.clearance.windows(2).map(|ends| fitting(ends[0].min(ends[1]), kerfs)).collect();
    let Some(&first) = tools.first() else { return };
    if tools.iter().all(|&tool| tool == first) {
        return parts.push((first, edge.clone()));
    }
    let mut node = |at: Point| {
        nodes.push(at);
        NodeId(u32::try_from(nodes.len() - 1).expect("below 2³² nodes"))
    };
    let ends = edge.ends.unwrap_or_else(|| {
        let start = node(edge.path.start);
        (start, start)
    });
    let (mut from, mut at, mut begin) = (0, ends.0, edge.path.start);
    for run in tools.chunk_by(|a, b| a == b) {
        let to = from + run.len();
        let segments = edge.path.segments[from..to].to_vec();
        let path = Path { start: begin, segments };
        begin = path.end();
        let end = if to == tools.len() { ends.1 } else { node(begin) };
        let clearance = edge.clearance[from..=to].to_vec();
        parts.push((run[0], Boundary { path, clearance, ends: Some((at, end)), ..edge.clone() }));
        (from, at) = (to, end);
    }
}

/// Gives what `tool` would cut in pieces shorter than `least` to the next.
fn demote(parts: &mut [(usize, Boundary)], nodes: usize, tool: usize, least: f64) {
    let mut pieces = DisjointSets::new(nodes);
    let own = |part: &(usize, Boundary)| part.0 == tool;
    for (_, part) in parts.iter().filter(|part| own(part)) {
        if let Some((a, b)) = part.ends {
            pieces.union(a.0, b.0);
        }
    }
    let mut lengths = vec![0.0; nodes];
    for (_, part) in parts.iter().filter(|part| own(part)) {
        if let Some((a, _)) = part.ends {
            lengths[pieces.find(a.0) as usize] += part.path.length();
        }
    }
    for part in parts.iter_mut().filter(|part| part.0 == tool) {
        let length = match part.1.ends {
            Some((a, _)) => lengths[pieces.find(a.0) as usize],
            None => part.1.path.length(),
        };
        part.0 += usize::from(length < least);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::NetId;
    use crate::voronoi::Owner;

    /// A straight boundary with a vertex every millimetre.
    fn edge(clearance: &[i64], ends: Option<(u32, u32)>) -> Boundary {
        let points = (0..).zip(clearance).map(|(i, _)| Point::new(Nm::from_mm(i), Nm::ZERO));
        Boundary {
            path: Path::polyline(points).expect("points"),
            clearance: clearance.iter().map(|&um| Nm::from_um(um)).collect(),
            left: Owner::Net(NetId(0)),
            right: Owner::Net(NetId(1)),
            ends: ends.map(|(a, b)| (NodeId(a), NodeId(b))),
        }
    }

    const KERFS: [Nm; 2] = [Nm::from_um(800), Nm::from_um(150)];

    fn lengths(parts: &[Boundaries]) -> Vec<f64> {
        parts.iter().map(|part| part.edges.iter().map(|edge| edge.path.length() / 1e6).sum()).collect()
    }

    #[test]
    fn each_stretch_goes_to_the_widest_tool_that_fits_and_the_rest_to_the_last() {
        let nodes = vec![Point::default(), Point::new(Nm::from_mm(9), Nm::ZERO)];
        let edge = edge(&[500, 500, 500, 500, 500, 300, 300, 20, 300, 300], Some((0, 1)));
        let parts = share(&Boundaries { nodes, edges: vec![edge], links: vec![] }, &KERFS);
        assert_eq!(lengths(&parts), [4.0, 5.0], "the fine one has the narrow end");
        assert_eq!(
            parts[0].edges[0].ends.map(|ends| ends.1),
            parts[1].edges[0].ends.map(|ends| ends.0),
            "they meet"
        );
        assert_eq!(parts[0].nodes[2], Point::new(Nm::from_mm(4), Nm::ZERO), "where it gets narrow");
    }

    #[test]
    fn a_piece_hardly_longer_than_its_kerf_is_left_to_the_finer_tool() {
        let nodes = vec![Point::default(), Point::new(Nm::from_mm(4), Nm::ZERO)];
        let edge = edge(&[300, 500, 500, 300, 300], Some((0, 1)));
        let parts = share(&Boundaries { nodes, edges: vec![edge], links: vec![] }, &KERFS);
        assert_eq!(lengths(&parts), [0.0, 4.0], "one millimetre is no more than a hole");
    }

    #[test]
    fn a_loop_is_cut_open_only_where_tools_change() {
        let whole = share(
            &Boundaries { edges: vec![edge(&[500, 500, 500, 500], None)], ..Boundaries::default() },
            &KERFS,
        );
        assert_eq!((lengths(&whole), whole[0].edges[0].ends), (vec![3.0, 0.0], None), "it stays a loop");
        let parts = share(
            &Boundaries { edges: vec![edge(&[500, 500, 500, 500, 300], None)], ..Boundaries::default() },
            &KERFS,
        );
        assert_eq!(lengths(&parts), [3.0, 1.0], "it has two ends now");
        assert!(parts.iter().all(|part| part.edges[0].ends.is_some()), "with nodes");
    }
}
