//! The machine's head while a section is planned.
//!
//! Its few methods are the only way to make moves, so no strategy can plan an unsafe one.

use crate::geometry::{Nm, Path, Point, Segment};

use super::feed::Feed;
use super::heights::Heights;
use super::program::{Move, Position};

/// The machine's head while a section is planned. Its methods are the only way to make moves, so
/// what a [`Section`](super::Section) guarantees holds by construction: sideways below the safe
/// height is always a feed, a rapid is level at the safe height or straight up or down, no feed
/// goes down faster than a plunge, however much sideways it goes, and the last move is a retract.
pub(super) struct Head {
    heights: Heights,
    plunge: Feed,
    at: Option<Position>,
    moves: Vec<Move>,
}

impl Head {
    /// At the safe height over an unknown place.
    pub(super) fn new(heights: Heights, plunge: Feed) -> Self {
        Self { heights, plunge, at: None, moves: Vec::new() }
    }

    /// Makes room for so many moves.
    pub(super) fn reserve(&mut self, moves: usize) {
        self.moves.reserve_exact(moves);
    }

    /// To the safe height over `point`, by way of the safe height.
    pub(super) fn over(&mut self, point: Point) {
        self.retract();
        let to = Position::over(point, self.heights.safe);
        if self.at != Some(to) {
            self.at = Some(to);
            self.moves.push(Move::Rapid { to });
        }
    }

    /// Straight down to `depth` below the surface: fast down to the approach height, then at the
    /// plunge feed.
    pub(super) fn plunge(&mut self, depth: Nm) {
        let at = self.at.expect("the head is over a point before it plunges");
        if at.z > self.heights.approach {
            self.rapid_to(self.heights.approach);
        }
        self.feed_to(Position { z: -depth, ..at }, self.plunge);
    }

    /// Down to `depth` over `point`: a plunge where the head is over it, and else, when it is down
    /// already, straight there at `feed`.
    pub(super) fn reach(&mut self, point: Point, depth: Nm, feed: Feed) {
        match self.at {
            Some(at) if at.point() != point => self.feed_to(Position::over(point, -depth), feed),
            _ => self.plunge(depth),
        }
    }

    /// Straight to `to`, at `feed`, or slower where it goes down.
    pub(super) fn feed_to(&mut self, to: Position, feed: Feed) {
        if self.at != Some(to) {
            let feed = self.feed_down(&Segment::Line { to: to.point() }, to.z, feed);
            self.at = Some(to);
            self.moves.push(Move::Feed { to, feed });
        }
    }

    /// One segment from where the head is, ending at `depth` below the surface; at `feed`, or
    /// slower where it goes down.
    pub(super) fn cut(&mut self, segment: &Segment, depth: Nm, feed: Feed) {
        let to = Position::over(segment.to(), -depth);
        match *segment {
            Segment::Line { .. } => self.feed_to(to, feed),
            Segment::Arc { center, turn, .. } => {
                let feed = self.feed_down(segment, to.z, feed);
                self.at = Some(to);
                self.moves.push(Move::Arc { to, center, turn, feed });
            }
        }
    }

    /// `feed`, or what keeps the head from going down along `segment` to `z` faster than it
    /// plunges.
    fn feed_down(&self, segment: &Segment, z: Nm, feed: Feed) -> Feed {
        let Some(at) = self.at.filter(|at| at.z > z) else { return feed };
        let (along, down) = (segment.length(at.point()), (at.z - z).to_f64());
        feed.min(self.plunge.times((along * along + down * down).sqrt() / down))
    }

    /// Along `path`, which begins where the head is, level at the depth the head has.
    pub(super) fn follow(&mut self, path: &Path, feed: Feed) {
        let depth = -self.at.expect("the head is at the path's start").z;
        for segment in &path.segments {
            self.cut(segment, depth, feed);
        }
    }

    /// Along `path`, which begins where the head is, evenly from the depth that the head has to
    /// `depth`.
    pub(super) fn descend(&mut self, path: &Path, depth: Nm, feed: Feed) {
        let from = -self.at.expect("the head is at the path's start").z;
        let whole = path.length().max(1.0);
        let mut gone = 0.0;
        for (start, segment) in path.steps() {
            gone += segment.length(start);
            let reached = from + Nm::from_f64((depth - from).to_f64() * (gone / whole).min(1.0));
            self.cut(segment, reached, feed);
        }
    }

    /// Straight up or down to `z` as fast as it goes; through air.
    pub(super) fn rapid_to(&mut self, z: Nm) {
        if let Some(at) = self.at.filter(|at| at.z != z) {
            let to = Position { z, ..at };
            self.at = Some(to);
            self.moves.push(Move::Rapid { to });
        }
    }

    /// Straight up to the safe height, if it is not there.
    pub(super) fn retract(&mut self) {
        self.rapid_to(self.heights.safe);
    }

    /// Where it is; none before the first move.
    pub(super) const fn at(&self) -> Option<Position> {
        self.at
    }

    /// Stay where it is.
    pub(super) fn dwell(&mut self, milliseconds: u32) {
        self.moves.push(Move::Dwell { milliseconds });
    }

    /// All moves, retracted at the end.
    pub(super) fn finish(mut self) -> Vec<Move> {
        self.retract();
        self.moves
    }
}
