//! What hangs together: the connected pieces of a picture, found row by row.
//!
//! A row of pixels is kept as runs of one label; only the row above is remembered. Runs that share
//! an edge are joined (union-find), so memory follows the number of regions, not of pixels.

use crate::geometry::Rect;
use crate::grid::Grid;
use crate::topology::DisjointSets;

/// A label's share of a connected piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// The piece, from 0.
    pub(super) piece: u32,
    pub(super) label: u32,
    pub(super) pixels: u64,
    pub(super) extent: Extent,
}

/// Columns and rows, the last included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Extent {
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) right: u32,
    pub(super) bottom: u32,
}

impl Extent {
    /// The place on the board, of pixels of `grid`.
    pub(super) fn rect(self, grid: &Grid) -> Rect {
        let corner = |column: u32, row: u32| grid.corner(i64::from(column), i64::from(row));
        Rect::new(corner(self.left, self.top), corner(self.right + 1, self.bottom + 1))
    }

    pub(super) fn union(self, other: Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// Neighbouring pixels of one label in a row.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub(super) start: u32,
    /// The column after the last.
    pub(super) end: u32,
    pub(super) label: u32,
}

/// Pixels of one label that hang together, as far as is known.
struct Node {
    label: u32,
    pixels: u64,
    extent: Extent,
}

/// Joins runs, row by row.
#[derive(Default)]
pub(super) struct Joiner {
    nodes: Vec<Node>,
    /// Which nodes are of one piece.
    pieces: DisjointSets,
    /// The row above: its runs and their nodes.
    above: Vec<(Run, u32)>,
}

impl Joiner {
    /// The runs of the row that was taken last, each with what stands for its region; see
    /// [`find`](Self::find).
    pub(super) fn last(&self) -> &[(Run, u32)] {
        &self.above
    }

    /// Takes the next row, the one below the row before.
    pub(super) fn row(&mut self, row: u32, runs: &[Run]) {
        let above = std::mem::take(&mut self.above);
        let mut now: Vec<(Run, u32)> = Vec::with_capacity(runs.len());
        let mut first = 0;
        for &run in runs {
            while above.get(first).is_some_and(|(other, _)| other.end <= run.start) {
                first += 1;
            }
            let touching = || above[first..].iter().take_while(|(other, _)| other.start < run.end);
            let same = touching().find(|(other, _)| other.label == run.label).map(|(_, node)| *node);
            let extent = Extent { left: run.start, top: row, right: run.end - 1, bottom: row };
            let node = same.unwrap_or_else(|| self.node(run.label, extent));
            let own = &mut self.nodes[node as usize];
            own.pixels += u64::from(run.end - run.start);
            own.extent = own.extent.union(extent);
            for (_, other) in touching() {
                self.pieces.union(node, *other);
            }
            if let Some((_, left)) = now.last().filter(|(left, _)| left.end == run.start) {
                self.pieces.union(node, *left);
            }
            now.push((run, node));
        }
        self.above = now;
    }

    fn node(&mut self, label: u32, extent: Extent) -> u32 {
        self.nodes.push(Node { label, pixels: 0, extent });
        self.pieces.push()
    }

    /// The piece that a region belongs to, as far as rows were taken.
    pub(super) fn find(&mut self, node: u32) -> u32 {
        self.pieces.find(node)
    }

    /// All nodes of a label in a piece as one part.
    pub(super) fn parts(self) -> Vec<Part> {
        let part = |(Node { label, pixels, extent }, piece)| Part { piece, label, pixels, extent };
        let mut parts: Vec<Part> =
            self.nodes.into_iter().zip(self.pieces.representatives()).map(part).collect();
        parts.sort_unstable_by_key(|part| (part.piece, part.label));
        parts.dedup_by(|next, part| {
            let same = (next.piece, next.label) == (part.piece, part.label);
            if same {
                part.pixels += next.pixels;
                part.extent = part.extent.union(next.extent);
            }
            same
        });
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_with_a_door_parts_nothing() {
        let run = |(start, end, label)| Run { start, end, label };
        for (bottom, expected) in [(200, 2), (199, 1)] {
            let mut joiner = Joiner::default();
            for row in 0..200 {
                let clad: &[(u32, u32, u32)] =
                    if row < bottom { &[(0, 100, 0), (110, 300, 0)] } else { &[(0, 300, 0)] };
                let nets =
                    [(0, 20, 0), (20, 90, 5), (90, 100, 0), (110, 200, 0), (200, 290, 6), (290, 300, 0)];
                let runs = if (20..90).contains(&row) { &nets[..] } else { clad };
                joiner.row(row, &runs.iter().copied().map(run).collect::<Vec<_>>());
            }
            let parts = joiner.parts();
            let count = parts.chunk_by(|a, b| a.piece == b.piece).count();
            assert_eq!(count, expected, "a wall down to row {bottom}");
            let five = parts.iter().find(|part| part.label == 5).expect("a part");
            assert_eq!(five.pixels, 70 * 70, "its pixels");
            assert_eq!(five.extent, Extent { left: 20, top: 20, right: 89, bottom: 89 }, "its place");
        }
    }
}
