//! Pieces of tiles joined into the edges of the planar graph of boundaries, while the tiles come.
//!
//! A chain is a row of pieces that hang together. It is whole when both its ends are nodes, or when it closes; it then becomes a
//! [`Line`], so that each vertex is kept once.

use std::collections::VecDeque;

use rustc_hash::FxHashMap;

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

/// The order of lines: those between nodes before loops, each by the first of its pieces (at its nodes, or of all).
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
    pub(super) unplaced: u32,
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
        self.unplaced += traced.unplaced;
    }

    /// The edges, in the order of their first pieces.
    pub(super) fn lines(mut self) -> Vec<Line> {
        debug_assert!(self.loose.is_empty(), "every piece goes on at every corner that is no node");
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

    /// Lets go of a chain that has closed. It begins with the piece that came first, in that piece's direction.
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
