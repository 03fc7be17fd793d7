//! Branches that are not worth a cut are taken off leaf by leaf.
//!
//! ```text
//!        P ●          A branch that ends at P, where the disc has the radius q, and hangs at R, where it has r, is taken off if the
//!         ╱           disc at R covers what the branch does but for a little: |P − R| + q − r is no more than that. What was taken
//!   ─────● R ──────   off at R already counts for the branch that R becomes the end of.
//! ```

use crate::voronoi::exact::{Diagram, Edge};

use super::Pruning;

/// A clearance below which an edge has come to a corner, in nanometres. Chosen.
const CORNER: f64 = 1.0;

/// Whether each edge of a diagram is kept.
pub(super) fn prune(diagram: &Diagram, pruning: &Pruning) -> Vec<bool> {
    let mut pruner = Pruner::new(diagram, pruning);
    let mut open: Vec<u32> = (0_u32..).take(diagram.vertices().len()).collect();
    while let Some(leaf) = open.pop() {
        if let Some(root) = pruner.take_off(leaf) {
            open.push(root);
        }
    }
    pruner.kept
}

struct Pruner<'a> {
    diagram: &'a Diagram,
    pruning: &'a Pruning,
    kept: Vec<bool>,
    /// The edges at each vertex.
    at: Vec<Vec<u32>>,
    /// The vertices that what was taken off at each vertex ended in.
    tips: Vec<Vec<u32>>,
}

impl<'a> Pruner<'a> {
    fn new(diagram: &'a Diagram, pruning: &'a Pruning) -> Self {
        let mut at = vec![Vec::new(); diagram.vertices().len()];
        for (number, edge) in (0_u32..).zip(diagram.edges()) {
            at[edge.from as usize].push(number);
            at[edge.to as usize].push(number);
        }
        let tips = vec![Vec::new(); at.len()];
        Self { diagram, pruning, kept: vec![true; diagram.edges().len()], at, tips }
    }

    /// Takes off the edge that ends at `leaf`, if one alone does and is worth nothing; the vertex
    /// that it hung at.
    fn take_off(&mut self, leaf: u32) -> Option<u32> {
        let mut edges = self.at[leaf as usize].iter().filter(|&&edge| self.kept[edge as usize]);
        let (&number, None) = (edges.next()?, edges.next()) else { return None };
        let edge = self.diagram.edges()[number as usize];
        let root = if edge.from == leaf { edge.to } else { edge.from };
        if root == leaf {
            return None;
        }
        let mut tips = std::mem::take(&mut self.tips[leaf as usize]);
        if !self.is_blunt(&edge, leaf) {
            tips.push(leaf);
        }
        if tips.iter().any(|&tip| self.excess(tip, root) > self.pruning.loss) {
            self.tips[leaf as usize] = tips;
            return None;
        }
        self.kept[number as usize] = false;
        self.tips[root as usize].append(&mut tips);
        Some(root)
    }

    /// How far the disc at one vertex reaches beyond that at another.
    fn excess(&self, tip: u32, root: u32) -> f64 {
        let [tip, root] = [tip, root].map(|vertex| &self.diagram.vertices()[vertex as usize]);
        let (x, y) = (tip.at.0 - root.at.0, tip.at.1 - root.at.1);
        (x * x + y * y).sqrt() + tip.clearance - root.clearance
    }

    /// Whether an edge ends at a corner that is too blunt to count.
    fn is_blunt(&self, edge: &Edge, leaf: u32) -> bool {
        let vertex = &self.diagram.vertices()[leaf as usize];
        if vertex.clearance > CORNER {
            return false;
        }
        let [(ax, ay), (bx, by)] = self.diagram.away(edge, vertex.at);
        ax * bx + ay * by > self.pruning.corner
    }
}
