//! The borders between differently owned pixels of one tile, placed.
//!
//! Between two pixels of different owners runs a *crack*, a unit edge between pixel corners. A
//! corner where two cracks meet only passes a boundary on; where three or four meet, regions meet,
//! and the corner is a node. At a checkerboard corner (A B / C A, where B and C may be one),
//! whoever owns the corner itself decides: if it is A, both of its pixels are joined, and one
//! boundary passes round B, another round C. If not, all four boundaries end there. Where B or C is
//! the outside, the two pixels are joined: what lies across from the outside does not reach it
//! there.
//!
//! ```text
//!     A A │ B          A A │ C          A A ╰ B      a tile owns the left and upper crack of each of its
//!     ────┘ B          ────┼────        ───╮ ───     pixels; pieces end at its border and are stitched
//!     A  ...           B B │ C          C C │ A      at the corners there (see `stitch`)
//!     two cracks:      four cracks:     a corner of A:
//!     passed on        a node           two passed on
//! ```
//!
//! Each piece is placed as it is traced, on the worker that drew the tile: cracks are sampled,
//! moved to the true boundary, and again between wherever the true boundary leaves the curve
//! between two vertices (see `span`). A piece of one curve costs three samples, whatever its
//! length.

mod crack;
mod cracks;
mod equation;
mod pixels;
mod sample;

use super::OUTSIDE;
use super::place::{Placer, Unplaced};
use super::plane::Spot;
use super::span::Vertex;

use crack::{Crack, HEADINGS, Heading};
use cracks::Cracks;
pub(super) use pixels::{APRON, Pixels};

/// A pixel corner of the picture: its key for stitching, and whether boundaries end there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) column: u32,
    pub(super) row: u32,
    /// At a checkerboard corner that passes two boundaries on, which of them.
    pub(super) branch: bool,
    pub(super) node: bool,
    /// Whether the place of the node could not be told from the pixels round it.
    pub(super) open: bool,
}

impl Corner {
    /// What tells it from others.
    pub(super) const fn key(&self) -> (u32, u32, bool) {
        (self.column, self.row, self.branch)
    }
}

/// A stretch of boundary within one tile: `vertices[first..first + len]`, both corners' places
/// included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) from: Corner,
    pub(super) to: Corner,
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) first: u32,
    pub(super) len: u32,
}

/// What a tile adds to the graph.
#[derive(Clone, Debug, Default)]
pub(super) struct Traced {
    pub(super) pieces: Vec<Piece>,
    pub(super) vertices: Vec<Vertex>,
    /// Samples that kept their pixel's place because the true one was not within reach.
    pub(super) unplaced: Unplaced,
}

/// What tracing needs to know beside the pixels.
#[derive(Clone, Copy)]
pub(super) struct Course {
    /// The place of the picture's corner (0, 0), in nanometres.
    pub(super) origin: Spot,
    /// The side of a pixel, in nanometres.
    pub(super) pitch: f64,
    /// The distance that bounds regions against the background, in nanometres.
    pub(super) level: f64,
    /// The label of what earlier cuts have cleared.
    pub(super) groove: u32,
    /// Whether the border is a frame that is cut, too.
    pub(super) framed: bool,
    /// Whether only boundaries against the background are wanted.
    pub(super) levels_only: bool,
}

/// Traces one tile.
pub(super) struct Tracer<'a> {
    pixels: Pixels<'a>,
    placer: &'a Placer<'a>,
    course: Course,
    cracks: Cracks,
    /// The cracks of the piece at hand: kept for its room.
    run: Vec<Crack>,
    traced: Traced,
}

/// All boundary pieces of a tile.
pub(super) fn trace(pixels: Pixels<'_>, placer: &Placer<'_>, course: Course) -> Traced {
    let cracks = Cracks::of(&pixels);
    let mut tracer = Tracer { pixels, placer, course, cracks, run: Vec::new(), traced: Traced::default() };
    tracer.run();
    tracer.traced
}

/// The pixels that a checkerboard corner joins, by the direction in which they lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Joined {
    /// From the upper left to the lower right.
    Falling,
    /// From the lower left to the upper right.
    Rising,
}

impl Tracer<'_> {
    fn run(&mut self) {
        for crack in self.cracks.open() {
            for end in [(crack.x, crack.y), crack.end()] {
                if self.is_end(end) {
                    self.pieces_from(end);
                }
            }
        }
        for crack in self.cracks.open() {
            if self.cracks.is_open(crack) {
                self.piece(crack);
            }
        }
    }

    /// Whether pieces end at this corner: on the tile's border, and at nodes.
    fn is_end(&self, (x, y): (i32, i32)) -> bool {
        x == 0 || y == 0 || x == self.pixels.width || y == self.pixels.height || self.is_node((x, y))
    }

    fn is_node(&self, at: (i32, i32)) -> bool {
        self.cracks.degree(at) > 2 && self.joined(at).is_none()
    }

    /// Which pixels round a checkerboard corner are joined, because their owner has the corner,
    /// too.
    fn joined(&self, at: (i32, i32)) -> Option<Joined> {
        let (x, y) = at;
        let owner = |x: i32, y: i32| self.pixels.owner(x, y);
        let (upper, lower) = ([owner(x - 1, y - 1), owner(x, y - 1)], [owner(x - 1, y), owner(x, y)]);
        let falling = (upper[0] == lower[1]).then_some((upper[0], Joined::Falling));
        let rising = (upper[1] == lower[0]).then_some((upper[1], Joined::Rising));
        let four =
            upper[0] != upper[1] && upper[0] != lower[0] && lower[1] != upper[1] && lower[1] != lower[0];
        if !four || (falling.is_none() && rising.is_none()) {
            return None;
        }
        if upper.contains(&OUTSIDE) || lower.contains(&OUTSIDE) {
            // The region between the two ends before it comes to the border, or reaches it by less
            // than a pixel.
            let alone = if rising.is_none() { falling } else { rising.xor(falling) };
            return alone.filter(|(owner, _)| *owner != OUTSIDE).map(|(_, joined)| joined);
        }
        let here = self.placer.owner(self.spot(f64::from(x), f64::from(y)), self.course.level)?;
        [falling, rising].into_iter().flatten().find(|(owner, _)| *owner == here).map(|(_, joined)| joined)
    }

    /// Which of two boundaries leaves a checkerboard corner by this crack: that to the north, or
    /// that to the south.
    fn branch(&self, crack: Crack) -> bool {
        match (self.joined((crack.x, crack.y)), crack.heading) {
            (None, _) | (Some(_), Heading::North) => false,
            (Some(_), Heading::South) => true,
            (Some(joined), Heading::East) => joined == Joined::Rising,
            (Some(joined), Heading::West) => joined == Joined::Falling,
        }
    }

    fn pieces_from(&mut self, (x, y): (i32, i32)) {
        for heading in HEADINGS {
            let crack = Crack { x, y, heading };
            if self.cracks.is_open(crack) {
                self.piece(crack);
            }
        }
    }

    /// Follows the boundary from `first` to where it ends or closes, and places it.
    fn piece(&mut self, first: Crack) {
        let mut cracks = std::mem::take(&mut self.run);
        cracks.clear();
        cracks.push(first);
        self.cracks.take(first);
        let start = (first.x, first.y);
        let mut at = first.end();
        while at != start && !self.is_end(at) {
            let Some(next) = self.next(cracks[cracks.len() - 1]) else { break };
            self.cracks.take(next);
            cracks.push(next);
            at = next.end();
        }
        self.add(&cracks, start, at);
        self.run = cracks;
    }

    /// Places the piece along `cracks` from corner to corner, if anybody asks for it.
    fn add(&mut self, cracks: &[Crack], start: (i32, i32), end: (i32, i32)) {
        let (first, last) = (cracks[0], cracks[cracks.len() - 1]);
        let (left, right) = first.sides();
        let (left, right) = (self.pixels.owner(left.0, left.1), self.pixels.owner(right.0, right.1));
        if self.course.levels_only && !self.is_wanted(left, right) {
            return;
        }
        let first_vertex = self.traced.vertices.len();
        let (from_open, to_open) = self.place(cracks, start, end);
        let count = |n: usize| u32::try_from(n).expect("a tile has few vertices");
        let piece = Piece {
            from: self.corner(first, from_open),
            to: self.corner(last.reversed(), to_open),
            left,
            right,
            first: count(first_vertex),
            len: count(self.traced.vertices.len() - first_vertex),
        };
        self.traced.pieces.push(piece);
    }

    /// The crack that goes on from the end of another.
    fn next(&self, crack: Crack) -> Option<Crack> {
        let back = crack.reversed();
        let onward = |heading: &Heading| Crack { heading: *heading, ..back };
        let mut free = HEADINGS.iter().map(onward).filter(|&next| self.cracks.is_open(next));
        let first = free.next()?;
        match free.next() {
            None => Some(first),
            Some(second) => {
                [first, second].into_iter().chain(free).find(|&next| self.branch(next) == self.branch(back))
            }
        }
    }

    /// The corner from which a crack leaves.
    #[expect(clippy::cast_sign_loss, reason = "corners of the tile are not negative")]
    fn corner(&self, crack: Crack, open: bool) -> Corner {
        Corner {
            column: self.pixels.column0 + crack.x as u32,
            row: self.pixels.row0 + crack.y as u32,
            branch: self.branch(crack),
            node: self.is_node((crack.x, crack.y)),
            open,
        }
    }

    /// The place of a position in the tile's pixels.
    fn spot(&self, x: f64, y: f64) -> Spot {
        let (column, row) = (f64::from(self.pixels.column0) + x, f64::from(self.pixels.row0) + y);
        let Course { origin, pitch, .. } = self.course;
        Spot::new(origin.x + column * pitch, origin.y - row * pitch)
    }
}
