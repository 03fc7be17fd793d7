//! Pieces of tiles joined into the edges of the planar graph of boundaries, while the tiles come.
//!
//! A chain is a row of pieces that hang together. It is whole when both its ends are nodes, or when
//! it closes; it then becomes a [`Line`], so that each vertex is kept once.

use std::collections::VecDeque;

use rustc_hash::FxHashMap;

use super::OUTSIDE;
use super::place::Unplaced;
use super::span::{self, Vertex};
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

impl Line {
    /// Whether it runs along the border.
    pub(super) const fn is_border(&self) -> bool {
        self.left == OUTSIDE || self.right == OUTSIDE
    }
}

/// The order of lines: those between nodes before loops, each by the first of its pieces (at its
/// nodes, or of all).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Rank {
    is_loop: bool,
    piece: u64,
}

/// Joins the pieces of all tiles as they come, in the tiles' order.
#[derive(Default)]
pub(super) struct Stitcher {
    chains: Vec<Chain>,
    /// Chains that are no longer in use.
    free: Vec<usize>,
    /// The ends of chains that another piece continues.
    loose: FxHashMap<(u32, u32, bool), End>,
    /// How many pieces have come.
    pieces: u64,
    lines: Vec<(Rank, Line)>,
    pub(super) unplaced: Unplaced,
}

/// A row of pieces from its head to its tail.
#[derive(Clone, Debug, Default)]
struct Chain {
    links: VecDeque<Link>,
}

/// A piece of a chain, with how many pieces had come before it.
#[derive(Clone, Debug)]
struct Link {
    number: u64,
    piece: Piece,
    vertices: Box<[Vertex]>,
    /// Whether the chain runs along it from its end to its beginning.
    reversed: bool,
}

impl Link {
    /// The corners in the chain's direction.
    const fn corners(&self) -> (Corner, Corner) {
        if self.reversed { (self.piece.to, self.piece.from) } else { (self.piece.from, self.piece.to) }
    }

    const fn turn(&mut self) {
        self.reversed = !self.reversed;
    }
}

impl Chain {
    fn corner(&self, tail: bool) -> Corner {
        let link = if tail { self.links.back() } else { self.links.front() };
        let (from, to) = link.expect("a chain has pieces").corners();
        if tail { to } else { from }
    }

    /// The vertex at its head or tail.
    fn end(&self, tail: bool) -> Vertex {
        let link = if tail { self.links.back() } else { self.links.front() };
        let Link { vertices, reversed, .. } = link.expect("a chain has pieces");
        vertices[if *reversed == tail { 0 } else { vertices.len() - 1 }]
    }

    fn turn(&mut self) {
        self.links.make_contiguous().reverse();
        self.links.iter_mut().for_each(Link::turn);
    }
}

/// One end of a chain.
#[derive(Clone, Copy, PartialEq, Eq)]
struct End {
    chain: usize,
    tail: bool,
}

impl Stitcher {
    pub(super) fn add(&mut self, traced: Traced) {
        for piece in traced.pieces {
            let vertices = &traced.vertices[piece.first as usize..(piece.first + piece.len) as usize];
            let link = Link { number: self.pieces, piece, vertices: vertices.into(), reversed: false };
            self.pieces += 1;
            self.hang(link);
        }
        self.unplaced = self.unplaced.join(traced.unplaced);
    }

    /// The ends of chains that nothing continues although they are no nodes: none, unless two tiles
    /// disagree on what lies between them.
    pub(super) fn torn(&self) -> Unplaced {
        let mut torn = Unplaced::default();
        for chain in self.chains.iter().filter(|chain| !chain.links.is_empty()) {
            let ends = [false, true].into_iter().filter(|&tail| !chain.corner(tail).node);
            ends.for_each(|tail| torn.add(chain.end(tail).at));
        }
        torn
    }

    /// The edges, in the order of their first pieces; what is torn ends where it does.
    pub(super) fn lines(mut self) -> Vec<Line> {
        for chain in 0..self.chains.len() {
            if !self.chains[chain].links.is_empty() {
                self.finish(chain);
            }
        }
        self.lines.sort_unstable_by_key(|(rank, _)| *rank);
        self.lines.into_iter().map(|(_, line)| line).collect()
    }

    /// Takes in a piece as a chain of its own, and joins that to those which end where it does.
    fn hang(&mut self, link: Link) {
        let chain = self.free.pop().unwrap_or_else(|| {
            self.chains.push(Chain::default());
            self.chains.len() - 1
        });
        let corners = [link.piece.from, link.piece.to];
        self.chains[chain].links.push_back(link);
        // The end that is still to be joined keeps its name while the chain is joined at the other.
        let mut end = End { chain, tail: false };
        for corner in corners {
            if !corner.node {
                match self.loose.remove(&corner.key()) {
                    None => {
                        self.loose.insert(corner.key(), end);
                    }
                    Some(other) if other.chain == end.chain => return self.finish_loop(end.chain),
                    Some(other) => end = self.join(end, other),
                }
            }
            end = End { tail: !end.tail, ..end };
        }
        let chain = &self.chains[end.chain];
        if chain.corner(false).node && chain.corner(true).node {
            self.finish(end.chain);
        }
    }

    /// Joins the chain of the caller to another at these ends, the shorter to the longer.
    fn join(&mut self, end: End, other: End) -> End {
        let shorter_first = self.chains[end.chain].links.len() <= self.chains[other.chain].links.len();
        let (from, into) = if shorter_first { (end, other) } else { (other, end) };
        let mut moved = std::mem::take(&mut self.chains[from.chain]);
        self.free.push(from.chain);
        // What is put at a tail runs from the joint on, what is put at a head runs towards it.
        if from.tail == into.tail {
            moved.turn();
        }
        let grown = &mut self.chains[into.chain];
        if into.tail {
            grown.links.extend(moved.links);
        } else {
            moved.links.into_iter().rev().for_each(|link| grown.links.push_front(link));
        }
        let far = self.chains[into.chain].corner(into.tail);
        if let Some(loose) = self.loose.get_mut(&far.key()).filter(|loose| loose.chain == from.chain) {
            *loose = into;
        }
        // The opposite of the end returned is where the caller's chain has its other end now.
        if shorter_first { End { tail: !into.tail, ..into } } else { into }
    }

    /// Lets go of a chain from node to node. It begins at that of its ends whose piece came first.
    fn finish(&mut self, chain: usize) {
        let mut chain = self.release(chain);
        let (head, tail) = (&chain.links[0], &chain.links[chain.links.len() - 1]);
        let backward = if chain.links.len() == 1 { head.reversed } else { tail.number < head.number };
        if backward {
            chain.turn();
        }
        let ends = Some((chain.corner(false), chain.corner(true)));
        self.emit(&chain, false, ends);
    }

    /// Lets go of a chain that has closed. It begins with the piece that came first, in that
    /// piece's direction.
    fn finish_loop(&mut self, chain: usize) {
        let mut chain = self.release(chain);
        let first = |chain: &Chain| {
            let numbered = (0..).zip(&chain.links).min_by_key(|(_, link)| link.number);
            numbered.map_or((0, false), |(at, link)| (at, link.reversed))
        };
        if first(&chain).1 {
            chain.turn();
        }
        chain.links.rotate_left(first(&chain).0);
        self.emit(&chain, true, None);
    }

    fn release(&mut self, chain: usize) -> Chain {
        self.free.push(chain);
        std::mem::take(&mut self.chains[chain])
    }

    fn emit(&mut self, chain: &Chain, is_loop: bool, ends: Option<(Corner, Corner)>) {
        let Link { number, piece, reversed, .. } = chain.links[0];
        let (left, right) = if reversed { (piece.right, piece.left) } else { (piece.left, piece.right) };
        let mut vertices = Vec::with_capacity(chain.links.iter().map(|link| link.vertices.len()).sum());
        for link in &chain.links {
            let skip = usize::from(!vertices.is_empty());
            if link.reversed {
                vertices.extend(link.vertices.iter().rev().skip(skip));
            } else {
                vertices.extend(link.vertices.iter().skip(skip));
            }
        }
        span::thin(&mut vertices);
        self.lines.push((Rank { is_loop, piece: number }, Line { vertices, left, right, ends }));
    }
}

#[cfg(test)]
mod tests {
    use super::super::plane::Spot;
    use super::*;

    /// A piece between two corners on one row; those at odd columns are nodes.
    fn piece(from: u32, to: u32) -> Traced {
        let corner =
            |column: u32| Corner { column, row: 0, branch: false, node: column % 2 == 1, open: false };
        let vertices = [from, to].map(|column| Vertex::new(Spot::new(f64::from(column), 0.0), 1e5)).to_vec();
        let piece = Piece { from: corner(from), to: corner(to), left: 2, right: 3, first: 0, len: 2 };
        Traced { pieces: vec![piece], vertices, ..Traced::default() }
    }

    #[test]
    fn pieces_become_one_line_in_any_order() {
        for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0]] {
            let pieces = [(1, 4), (6, 4), (6, 9)];
            let mut stitcher = Stitcher::default();
            order.into_iter().for_each(|i: usize| stitcher.add(piece(pieces[i].0, pieces[i].1)));
            assert_eq!(stitcher.torn().count, 0, "nothing is torn");
            let lines = stitcher.lines();
            assert_eq!(lines.len(), 1, "{order:?}: {lines:?}");
        }
    }

    #[test]
    fn what_is_torn_is_told_and_kept() {
        let mut stitcher = Stitcher::default();
        stitcher.add(piece(1, 4));
        stitcher.add(piece(4, 6));
        let torn = stitcher.torn();
        assert_eq!((torn.count, torn.first), (1, Some(Spot::new(6.0, 0.0))), "at column 6");
        let lines = stitcher.lines();
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!(lines[0].ends.is_some(), "it ends there");
    }
}
