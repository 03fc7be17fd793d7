//! Text → motions, from the specification, for anybody's programs; it shares no code with the writer.
//!
//! Read are the words that mean the same on every controller (NIST RS274/NGC version 3 §3, and what Grbl and
//! LinuxCNC document): modal G0–G3 with I J K-less centres or R, the drilling cycles G81–G83, G20/G21, G90/G91,
//! G90.1/G91.1, G98/G99, G4, M3/M4/M5, tools, pauses and the end. What would move the machine in a way that the text
//! alone does not tell (G92, G28, G53, variables, other planes, cutter compensation) is refused with the reason; silence would be
//! worse.

mod error;
mod interpret;
pub(super) mod lex;

pub use error::ReadError;
pub use interpret::read;

use crate::geometry::{Nm, Point, Turn};

/// Where the tool is, as far as the program has said so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// To the right; none before the program's first x.
    pub x: Option<Nm>,
    /// Away from the operator; none before the program's first y.
    pub y: Option<Nm>,
    /// Up; none before the program's first z.
    pub z: Option<Nm>,
}

impl Place {
    /// The point in the plane, once both coordinates are known.
    #[must_use]
    pub fn point(self) -> Option<Point> {
        Some(Point::new(self.x?, self.y?))
    }
}

/// How a motion runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// As fast as the machine goes, not necessarily in a straight line.
    Rapid,
    /// Straight, at the feed.
    Feed,
    /// Round a centre at the feed; a full turn where it ends over its start.
    Arc {
        /// The point it runs round.
        center: Point,
        /// Which way.
        turn: Turn,
    },
}

/// One motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motion {
    /// How it runs.
    pub way: Way,
    /// Where it begins.
    pub from: Place,
    /// Where it ends.
    pub to: Place,
    /// The feed in nanometres per minute; none before the program's first F.
    pub feed: Option<i64>,
    /// Revolutions per minute while it runs; none with the spindle off.
    pub spindle: Option<u32>,
    /// The tool in the spindle; none before the program's first T with M6.
    pub tool: Option<u32>,
    /// The line of the text, from 1.
    pub line: u32,
}

/// What a program does.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// Every motion, in order.
    pub motions: Vec<Motion>,
    /// Where the program waits for a person or changes tools: the number of motions before it, and its line.
    pub stops: Vec<(usize, u32)>,
    /// How long it dwells, in milliseconds.
    pub dwell: u64,
    /// The line that ends it (M2 or M30); none where the text just stops.
    pub end: Option<u32>,
    /// Whether the spindle still turns at the end.
    pub spinning: bool,
}
