//! What each G and M code means, in one table.
//!
//! After NIST RS274/NGC version 3 §3.5 and §3.6, and where that says nothing LinuxCNC, Grbl 1.1,
//! Marlin 2 and Mach3. A code that moves nothing and changes no later motion is passed over; one of
//! which nobody here knows that is refused.

use crate::geometry::Turn;

use super::frame::Plane;
use super::listing::Waits;

/// The modal group of motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Mode {
    #[default]
    None,
    Rapid,
    Feed,
    Arc(Turn),
    Cycle(Cycle),
    /// A probe: until it touches, at the farthest to the place.
    Probe,
    /// G33 and G33.1: K for each turn of the spindle; the second comes back.
    Synchronous {
        returns: bool,
    },
    Curve(Curve),
}

/// The drilling cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cycle {
    /// G81, and with a dwell G82.
    Drill { dwells: bool },
    /// G83: up to R after each peck.
    Peck,
    /// G73: up a little after each peck.
    Break,
    /// G74 and G84: in and out at the feed, with the spindle.
    Tap,
    /// G85 and G89: in and out at the feed.
    Bore { dwells: bool },
    /// G86: out as a rapid, with the spindle stopped.
    Stop,
}

/// The curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Curve {
    /// G5: I J and P Q are the tangents.
    Cubic,
    /// G5.1: I J is the control point.
    Quadratic,
    /// G5.2: control points with weights.
    Nurbs,
}

/// What a coordinate counts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Distance {
    #[default]
    Absolute,
    Incremental,
}

/// What an F means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum FeedMode {
    #[default]
    PerMinute,
    /// G93: the motion takes a minute divided by F.
    Inverse,
    /// G95.
    PerTurn,
}

/// What takes the axis words of a line for something else than a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Special {
    /// G10: sets coordinate systems or the tool table.
    Data,
    /// G28 and G30: by a place to one that only the machine knows.
    Home,
    /// G52: moves all systems by so much.
    Local,
    /// G92: the tool is at these coordinates.
    Here,
    /// G92.1, G92.2: no longer; the latter keeps it for G92.3.
    Drop { keep: bool },
    /// G92.3.
    Restore,
    /// G43.1, G43.2, G28.1, G30.1: values that move nothing on the board.
    Ignored,
}

/// What a code means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    Motion(Mode),
    /// G5.3.
    EndCurve,
    Plane(Plane),
    /// Nanometres in a unit.
    Unit(i64),
    Distance(Distance),
    Centers(Distance),
    FeedMode(FeedMode),
    /// G98 and G99.
    ToInitial(bool),
    Dwell,
    /// A coordinate system, from 0.
    System(usize),
    /// G53.
    MachineCoordinates,
    Special(Special),
    /// Cutter compensation.
    Compensation(bool),
    Spindle(bool),
    /// M4.
    Backwards,
    ToolChange,
    /// M61.
    SetTool,
    Stop(Waits),
    End,
    Call,
    Return,
    Save {
        again: bool,
    },
    Restore,
    Nothing,
    /// Not known; it is none that moves anything.
    Unknown,
    Refused(&'static str),
}

impl Meaning {
    /// The modal group: of each, a line has one code at most (NIST RS274/NGC §3.4, LinuxCNC, Grbl).
    /// None for codes outside of all, and for those that nothing here depends on.
    pub(super) const fn group(self) -> Option<u8> {
        Some(match self {
            Self::Dwell | Self::Special(_) | Self::MachineCoordinates => 0,
            Self::Motion(_) | Self::EndCurve => 1,
            Self::Plane(_) => 2,
            Self::Distance(_) => 3,
            Self::Centers(_) => 4,
            Self::FeedMode(_) => 5,
            Self::Unit(_) => 6,
            Self::Compensation(_) => 7,
            Self::ToInitial(_) => 10,
            Self::System(_) => 12,
            Self::Stop(_) | Self::End => 24,
            Self::ToolChange | Self::SetTool => 26,
            Self::Spindle(_) | Self::Backwards => 27,
            _ => return None,
        })
    }
}

/// What the code of a letter means, `key` being ten times its number.
pub(super) fn meaning(letter: char, key: u32) -> Meaning {
    if letter == 'G' { of_g(key) } else { of_m(key) }
}

fn of_g(key: u32) -> Meaning {
    use Meaning::{Centers, Compensation, Motion, Nothing, Refused};
    match key {
        0 => Motion(Mode::Rapid),
        10 => Motion(Mode::Feed),
        20 => Motion(Mode::Arc(Turn::Clockwise)),
        30 => Motion(Mode::Arc(Turn::CounterClockwise)),
        40 => Meaning::Dwell,
        50 => Motion(Mode::Curve(Curve::Cubic)),
        51 => Motion(Mode::Curve(Curve::Quadratic)),
        52 => Motion(Mode::Curve(Curve::Nurbs)),
        53 => Meaning::EndCurve,
        100 => Meaning::Special(Special::Data),
        170 => Meaning::Plane(Plane::Xy),
        180 => Meaning::Plane(Plane::Zx),
        190 => Meaning::Plane(Plane::Yz),
        200 => Meaning::Unit(25_400_000),
        210 => Meaning::Unit(1_000_000),
        280 | 300 => Meaning::Special(Special::Home),
        310 | 382..=385 => Motion(Mode::Probe),
        330 => Motion(Mode::Synchronous { returns: false }),
        331 => Motion(Mode::Synchronous { returns: true }),
        281 | 301 | 431 | 432 => Meaning::Special(Special::Ignored),
        400 => Compensation(false),
        410 | 411 | 420 | 421 => Compensation(true),
        520 => Meaning::Special(Special::Local),
        530 => Meaning::MachineCoordinates,
        540 | 550 | 560 | 570 | 580 | 590 => Meaning::System((key as usize - 540) / 10),
        591..=593 => Meaning::System(key as usize - 585),
        730 => Motion(Mode::Cycle(Cycle::Break)),
        740 | 840 => Motion(Mode::Cycle(Cycle::Tap)),
        800 => Motion(Mode::None),
        810 => Motion(Mode::Cycle(Cycle::Drill { dwells: false })),
        820 => Motion(Mode::Cycle(Cycle::Drill { dwells: true })),
        830 => Motion(Mode::Cycle(Cycle::Peck)),
        850 => Motion(Mode::Cycle(Cycle::Bore { dwells: false })),
        860 => Motion(Mode::Cycle(Cycle::Stop)),
        890 => Motion(Mode::Cycle(Cycle::Bore { dwells: true })),
        900 => Meaning::Distance(Distance::Absolute),
        910 => Meaning::Distance(Distance::Incremental),
        901 => Centers(Distance::Absolute),
        911 => Centers(Distance::Incremental),
        920 => Meaning::Special(Special::Here),
        921 => Meaning::Special(Special::Drop { keep: false }),
        922 => Meaning::Special(Special::Drop { keep: true }),
        923 => Meaning::Special(Special::Restore),
        930 => Meaning::FeedMode(FeedMode::Inverse),
        940 => Meaning::FeedMode(FeedMode::PerMinute),
        950 => Meaning::FeedMode(FeedMode::PerTurn),
        980 => Meaning::ToInitial(true),
        990 => Meaning::ToInitial(false),
        // Radii on a lathe, exact stop, tool length, blending, no scaling, no rotation, no polar
        // coordinates, spindle modes.
        80 | 90 | 150 | 430 | 490 | 500 | 600 | 610 | 611 | 640 | 690 | 960 | 970 => Nothing,
        70 => Refused("diameters on a lathe"),
        120 | 130 => Refused("a circular pocket, which controllers mill differently"),
        160 => Refused("Fanuc polar coordinates are not supported"),
        510 => Refused("scaled coordinates are not supported"),
        680 => Refused("rotated coordinates are not supported"),
        760 | 870 | 880 => Refused("a cycle whose motion depends on the controller"),
        _ => Refused("an unknown code, which may move the machine"),
    }
}

fn of_m(key: u32) -> Meaning {
    use Meaning::{Nothing, Refused};
    match key {
        0 | 250 | 600 | 2260 | 6000 | 6010 => Meaning::Stop(Waits::Surely),
        10 => Meaning::Stop(Waits::OnRequest),
        20 | 300 => Meaning::End,
        30 => Meaning::Spindle(true),
        40 => Meaning::Backwards,
        50 => Meaning::Spindle(false),
        60 => Meaning::ToolChange,
        610 => Meaning::SetTool,
        // Coolant, overrides, outputs, what Marlin and Grbl say, wait for or switch.
        70..=99
        | 170..=190
        | 230..=289
        | 480..=539
        | 560
        | 620..=689
        | 820..=849
        | 1040..=1199
        | 1400..=1419
        | 1900
        | 2000..=2059
        | 2200..=2219
        | 4000
        | 9500 => Nothing,
        470 | 970 => Refused("a jump to another line is not supported"),
        700 => Meaning::Save { again: false },
        710 => Nothing,
        720 => Meaning::Restore,
        730 => Meaning::Save { again: true },
        980 => Meaning::Call,
        990 => Meaning::Return,
        _ => Meaning::Unknown,
    }
}
