//! A planned program: sections of moves by one tool each, valid once built.

use crate::geometry::{Nm, Point, Rect, Segment, Turn};

use super::feed::Feed;
use super::tool::Tool;

/// A place of the tool's tip in machine coordinates: z is zero at the surface of the board, up is
/// positive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Position {
    /// To the right.
    pub x: Nm,
    /// Away from the operator.
    pub y: Nm,
    /// Up.
    pub z: Nm,
}

impl Position {
    /// The place at height `z` over `point`.
    #[must_use]
    pub const fn over(point: Point, z: Nm) -> Self {
        Self { x: point.x, y: point.y, z }
    }

    /// The place on the board below or above it.
    #[must_use]
    pub const fn point(self) -> Point {
        Point::new(self.x, self.y)
    }
}

/// A planned motion, from where the one before it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// As fast as the machine goes, through air alone; straight up, straight down, or level at the
    /// safe height.
    Rapid {
        /// Where it ends.
        to: Position,
    },
    /// Straight, at a feed.
    Feed {
        /// Where it ends.
        to: Position,
        /// How fast.
        feed: Feed,
    },
    /// Round a centre in the plane, evenly up or down where the heights differ; a full turn where
    /// start and end lie over the same point.
    Arc {
        /// Where it ends.
        to: Position,
        /// The point it runs round.
        center: Point,
        /// Which way.
        turn: Turn,
        /// How fast.
        feed: Feed,
    },
    /// Stay for a while.
    Dwell {
        /// For how long.
        milliseconds: u32,
    },
}

impl Move {
    /// Where it ends; none for a dwell.
    #[must_use]
    pub const fn to(&self) -> Option<Position> {
        match *self {
            Self::Rapid { to } | Self::Feed { to, .. } | Self::Arc { to, .. } => Some(to),
            Self::Dwell { .. } => None,
        }
    }
}

/// What one tool does, from a tool change to the next.
///
/// # Guarantees
///
/// The tool stands at the safe height before the first move and after the last. The first move is a
/// rapid there, level; below the safe height only feeds go sideways.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// The tool.
    pub tool: Tool,
    /// What is done, as the operator reads it: `isolate front`, `drill 0.8 mm, 14 holes`.
    pub label: String,
    /// The motions.
    pub moves: Vec<Move>,
}

impl Section {
    /// The rectangle that holds all that the tool cuts, as wide as it is there.
    fn milled(&self) -> Option<Rect> {
        let ends = self.moves.iter().filter(|step| step.to().is_some());
        let cut = ends.clone().zip(ends.skip(1)).filter_map(|(before, step)| {
            let (from, to) = (before.to()?, step.to()?);
            let depth = -from.z.min(to.z);
            let way = match *step {
                Move::Arc { center, turn, .. } => Segment::Arc { to: to.point(), center, turn },
                _ => Segment::Line { to: to.point() },
            };
            let cuts = depth > Nm::ZERO;
            cuts.then(|| way.bounds(from.point()).inflate(self.tool.width_at(depth) / 2))
        });
        cut.reduce(Rect::union)
    }
}

/// One program for the machine: everything that is done in one clamping of one side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// What it makes, as the operator reads it: `NAME front isolation`.
    pub title: String,
    /// What the operator must know before the start: the mirror axis, where zero is, what to clamp.
    pub notes: Vec<String>,
    /// The height at which everything may be crossed.
    pub safe: Nm,
    /// One after another, with a tool change before each.
    pub sections: Vec<Section>,
}

impl Program {
    /// The rectangle that holds all that its tools cut, as wide as they are there; none where they
    /// cut nothing.
    #[must_use]
    pub fn milled(&self) -> Option<Rect> {
        self.sections.iter().filter_map(Section::milled).reduce(Rect::union)
    }

    /// A program for each tool, in the order in which they are first needed.
    #[must_use]
    pub fn by_tool(self) -> Vec<Self> {
        let mut programs: Vec<Self> = Vec::new();
        let Self { title, notes, safe, sections } = self;
        for section in sections {
            match programs.iter_mut().find(|program| program.sections[0].tool == section.tool) {
                Some(program) => program.sections.push(section),
                None => programs.push(Self {
                    title: title.clone(),
                    notes: notes.clone(),
                    safe,
                    sections: vec![section],
                }),
            }
        }
        if programs.is_empty() { vec![Self { title, notes, safe, sections: Vec::new() }] } else { programs }
    }
}
