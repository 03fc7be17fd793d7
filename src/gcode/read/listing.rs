//! What a program does: its motions, and what had to be taken for granted to follow them.

use std::collections::BTreeMap;
use std::fmt;

use crate::geometry::{Nm, Point, Turn};

/// Where the tool is, as far as the program has said so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// To the right; none where the program does not tell it.
    pub x: Option<Nm>,
    /// Away from the operator; none where the program does not tell it.
    pub y: Option<Nm>,
    /// Up; none where the program does not tell it.
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

/// What the spindle does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spindle {
    /// It stands.
    #[default]
    Off,
    /// It turns at a speed that the program does not give: by a knob, or as the controller
    /// remembers.
    Unstated,
    /// It turns at so many revolutions per minute.
    At(u32),
}

impl Spindle {
    /// Whether it turns.
    #[must_use]
    pub const fn turns(self) -> bool {
        match self {
            Self::Off | Self::At(0) => false,
            Self::Unstated | Self::At(_) => true,
        }
    }
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
    /// What the spindle does meanwhile.
    pub spindle: Spindle,
    /// The tool in the spindle; none before the program's first T with M6.
    pub tool: Option<u32>,
    /// The line of the text, from 1.
    pub line: u32,
}

/// A code of G or M that a program has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coded {
    /// G or M.
    pub letter: char,
    /// Ten times its number: 382 for G38.2.
    pub key: u32,
    /// The line where it is first.
    pub line: u32,
    /// How often it is there.
    pub count: u32,
}

impl fmt::Display for Coded {
    /// As it is written: G38.2.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.letter, self.key / 10)?;
        match self.key % 10 {
            0 => Ok(()),
            tenth => write!(f, ".{tenth}"),
        }
    }
}

/// Where a program waits for a person, or may.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// How many motions are before it.
    pub before: usize,
    /// Its line.
    pub line: u32,
    /// How sure it is that it waits.
    pub waits: Waits,
    /// Whether it is to change the tool (M6): for one that is in already controllers do not wait.
    pub changes: bool,
    /// Whether the spindle turns meanwhile, as far as that is known.
    pub spinning: bool,
}

/// How sure it is that a code waits for a person.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waits {
    /// That is what it is for.
    Surely,
    /// M1: where somebody has switched that on; some controllers pass over it.
    OnRequest,
    /// Nobody here knows the code.
    Perhaps,
}

/// Lines of some kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tally {
    /// The first.
    pub line: u32,
    /// How many there are.
    pub count: u32,
}

/// Something about a line, as it is run, that some controllers take otherwise than it reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Odd {
    /// Coordinates and no code.
    Bare,
    /// Several codes.
    Several,
    /// Several codes of which one alone can hold: G90 and G91.
    Contrary,
    /// G80 beside a motion.
    Cancels,
    /// An arc by its radius.
    Radius,
    /// An arc whose line does not say where it ends: a full circle.
    Endless,
    /// A full circle whose line says where it ends.
    Circle,
    /// The same with G3.
    LeftCircle,
    /// An arc by a radius that is less than half the way to its end.
    ShortRadius,
    /// An arc whose ends differ in their distance from its centre by more than Mach3 takes.
    Uneven,
    /// An arc whose ends differ in it by less than Grbl's limit, but by more than its share.
    SmallUneven,
    /// An arc while coordinates are steps (G91).
    StepArc,
    /// G10 with L.
    Data,
    /// A word for which none of its codes asks.
    Unasked,
    /// The same, but for axes and for the turns of an arc.
    Idle,
    /// A dwell without P.
    Untimed,
    /// A tool above T255.
    HighTool,
}

/// A dwell whose time is behind P: controllers differ in its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dwell {
    /// A thousand times the number behind P.
    pub thousandths: u64,
    /// The line where it is first.
    pub line: u32,
    /// How often it is there.
    pub count: u32,
}

/// How the numbers of a line count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counting {
    /// Nanometres in a unit (G20, G21).
    pub unit: i64,
    /// Whether coordinates count from where the tool is (G91).
    pub incremental: bool,
    /// Whether the centres of arcs count from the zero (G90.1).
    pub absolute_centers: bool,
    /// Whether coordinates are those of a drilling cycle.
    pub cycle: bool,
}

/// As a program begins.
impl Default for Counting {
    fn default() -> Self {
        Self { unit: 1_000_000, incremental: false, absolute_centers: false, cycle: false }
    }
}

/// Something that the text leaves open or that was passed over, and what was assumed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Whether the judgement depends on it; else it is only worth knowing.
    pub warns: bool,
    /// Where it occurs first.
    pub line: u32,
    /// How often it occurs.
    pub count: u32,
    /// One sentence without a full stop.
    pub message: String,
}

/// What a program does.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// Every motion, in order.
    pub motions: Vec<Motion>,
    /// Where it waits for a person, or may, in order.
    pub stops: Vec<Stop>,
    /// How long it dwells, in milliseconds.
    pub dwell: u64,
    /// Its dwells by P, in the order of their first occurrence.
    pub dwells: Vec<Dwell>,
    /// The line that ends it (M2 or M30); none where the text just stops.
    pub end: Option<u32>,
    /// The line of the first code behind that end, but for what ends it once more and what belongs
    /// to a subprogram; none where nothing is there.
    pub behind_end: Option<u32>,
    /// Whether the spindle still turns at the end.
    pub spinning: bool,
    /// What was assumed, in the order of its first occurrence.
    pub notes: Vec<Note>,
    /// Its codes, in the order of their first occurrence.
    pub codes: Vec<Coded>,
    /// How numbers count, and the line from which on they do, in the order in which it is run.
    pub countings: Vec<(u32, Counting)>,
    /// Lines that some controllers take otherwise than they read.
    pub odd: BTreeMap<Odd, Tally>,
    /// The first line, and why, from which on places are not the numbers of the text one for one (a
    /// subprogram, an expression, a moved zero), or a feed holds for a motion as a whole; none
    /// where the text can be changed line by line.
    pub indirect: Option<(u32, &'static str)>,
}

impl Listing {
    /// Notes something once, and counts how often it occurs.
    pub(super) fn note(&mut self, warns: bool, line: u32, message: impl Into<String>) {
        let message = message.into();
        match self.notes.iter_mut().find(|note| note.message == message) {
            Some(note) => note.count += 1,
            None => self.notes.push(Note { warns, line, count: 1, message }),
        }
    }

    /// Counts a code.
    pub(super) fn code(&mut self, letter: char, key: u32, line: u32) {
        match self.codes.iter_mut().find(|code| (code.letter, code.key) == (letter, key)) {
            Some(code) => code.count += 1,
            None => self.codes.push(Coded { letter, key, line, count: 1 }),
        }
    }

    /// Counts a line.
    pub(super) fn is_odd(&mut self, odd: Odd, line: u32) {
        self.odd.entry(odd).or_insert(Tally { line, count: 0 }).count += 1;
    }

    /// Counts a dwell.
    pub(super) fn waits(&mut self, thousandths: u64, line: u32) {
        match self.dwells.iter_mut().find(|dwell| dwell.thousandths == thousandths) {
            Some(dwell) => dwell.count += 1,
            None => self.dwells.push(Dwell { thousandths, line, count: 1 }),
        }
    }

    /// How the numbers of a line count, where that is not as before.
    pub(super) fn counts(&mut self, line: u32, counting: Counting) {
        if self.countings.last().is_none_or(|(_, before)| *before != counting) {
            self.countings.push((line, counting));
        }
    }

    /// Remembers where places are no longer the numbers of the text.
    pub(super) fn is_indirect(&mut self, line: u32, why: &'static str) {
        self.indirect.get_or_insert((line, why));
    }
}
