//! Pieces of tiles joined into the planar graph of boundaries.

use rustc_hash::FxHashMap;

use super::place::Vertex;
use super::trace::{Corner, Piece, Traced};

/// An edge of the graph before fitting: its vertices from node to node, or round.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub(super) vertices: Vec<Vertex>,
    pub(super) left: u32,
    pub(super) right: u32,
    /// The corners of the nodes at its ends; none for a loop.
    pub(super) ends: Option<(Corner, Corner)>,
}

/// Joins the pieces of all tiles as they come, in the tiles' order.
#[derive(Default)]
pub(super) struct Stitcher {
    pieces: Vec<Piece>,
    vertices: Vec<Vertex>,
    pub(super) unplaced: u32,
}

/// One end of a piece.
#[derive(Clone, Copy)]
struct End {
    piece: u32,
    tail: bool,
}

impl Stitcher {
    pub(super) fn add(&mut self, traced: Traced) {
        let offset = count(self.vertices.len());
        self.vertices.extend(traced.vertices);
        self.pieces
            .extend(traced.pieces.into_iter().map(|piece| Piece { first: piece.first + offset, ..piece }));
        self.unplaced += traced.unplaced;
    }

    /// The edges, in the order of their first pieces.
    pub(super) fn lines(self) -> Vec<Line> {
        let mut partners: FxHashMap<(u32, u32, bool), [Option<End>; 2]> = FxHashMap::default();
        for (i, piece) in self.pieces.iter().enumerate() {
            for (corner, tail) in [(piece.from, false), (piece.to, true)] {
                if !corner.node {
                    let pair = partners.entry(corner.key()).or_default();
                    pair[usize::from(pair[0].is_some())] = Some(End { piece: count(i), tail });
                }
            }
        }
        let mut used = vec![false; self.pieces.len()];
        let mut lines = Vec::new();
        for start_at_nodes in [true, false] {
            for i in 0..self.pieces.len() {
                let piece = self.pieces[i];
                if used[i] || (start_at_nodes && !piece.from.node && !piece.to.node) {
                    continue;
                }
                let forward = !start_at_nodes || piece.from.node;
                lines.push(self.line(&partners, &mut used, End { piece: count(i), tail: !forward }));
            }
        }
        lines
    }

    /// Walks from one end of a piece, entering each next piece at the end that lies there.
    fn line(
        &self,
        partners: &FxHashMap<(u32, u32, bool), [Option<End>; 2]>,
        used: &mut [bool],
        start: End,
    ) -> Line {
        let first = self.pieces[start.piece as usize];
        let (left, right) = if start.tail { (first.right, first.left) } else { (first.left, first.right) };
        let from = if start.tail { first.to } else { first.from };
        let mut vertices = Vec::new();
        let mut entered = start;
        loop {
            let piece = self.pieces[entered.piece as usize];
            used[entered.piece as usize] = true;
            let own = &self.vertices[piece.first as usize..(piece.first + piece.len) as usize];
            let skip = usize::from(!vertices.is_empty());
            if entered.tail {
                vertices.extend(own.iter().rev().skip(skip));
            } else {
                vertices.extend(own.iter().skip(skip));
            }
            let exit = if entered.tail { piece.from } else { piece.to };
            if exit.node {
                return Line { vertices, left, right, ends: Some((from, exit)) };
            }
            let leaving = |end: &End| end.piece == entered.piece && end.tail != entered.tail;
            let next = partners[&exit.key()].iter().flatten().find(|end| !leaving(end)).copied();
            match next {
                Some(next) if !used[next.piece as usize] => entered = next,
                _ => return Line { vertices, left, right, ends: None },
            }
        }
    }
}

fn count(n: usize) -> u32 {
    u32::try_from(n).expect("below 2³² pieces and vertices")
}
