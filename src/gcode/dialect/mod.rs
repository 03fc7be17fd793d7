//! What controllers differ in, as data: one file and one constant each, listed in [`ALL`].

mod blend;
mod custom;
mod grbl;
mod linuxcnc;
mod mach3;
mod marlin;
mod smoothieware;
mod tinyg;

pub use blend::{Blend, ParseBlendError};
pub use custom::DialectError;

use std::borrow::Cow;

/// A text that may be built in or come from the settings.
pub type Text = Cow<'static, str>;

/// How a controller wants its programs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dialect {
    /// The name that chooses it.
    pub name: Text,
    /// What it is for, in one line.
    pub about: Text,
    /// The ending of its files, without the dot.
    pub extension: Text,
    /// Decimals of a millimetre, 1 to 6.
    pub decimals: usize,
    /// How arcs are written.
    pub arcs: Arcs,
    /// How comments are written.
    pub comments: Comments,
    /// How a dwell is written.
    pub dwell: Dwell,
    /// How tools are changed.
    pub tool_change: ToolChange,
    /// Numbers before the lines.
    pub line_numbers: LineNumbers,
    /// The most characters in a line.
    pub longest_line: usize,
    /// How far corners may be rounded off, as programs say it (G64 P); none where the controller knows no word for it.
    pub blend: Option<Blend>,
    /// The lines before everything else.
    pub start: Cow<'static, [Text]>,
    /// The lines after everything else, the tool lifted and the spindle off.
    pub end: Cow<'static, [Text]>,
    /// What turns the coolant (or the vacuum) on and off; none leaves it alone.
    pub coolant: Option<(Text, Text)>,
    /// How long the spindle is given to come up to speed, in milliseconds.
    pub spin_up: u32,
    /// What becomes of the touches of a probe.
    pub touches: Touches,
}

/// What small spindles need. Chosen.
const SPIN_UP: u32 = 3000;

/// How arcs are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arcs {
    /// With the way from the start to the centre: I and J.
    Center,
    /// With the radius: R. Arcs of half a turn and more are written in parts.
    Radius,
    /// As lines that stay within a micrometre.
    Lines,
}

/// How comments are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Comments {
    /// `(so)`
    Parentheses,
    /// `; so`
    Semicolon,
    /// Not at all.
    None,
}

/// How a dwell is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Dwell {
    /// `G4 P1.5`
    SecondsP,
    /// `G4 S1.5`
    SecondsS,
    /// `G4 P1500`
    MillisecondsP,
}

/// How tools are changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToolChange {
    /// `T2 M6`: the machine, or its dialogue, does it.
    M6,
    /// `M0` after a comment that says what to fit: the program waits.
    Pause,
    /// `M0` with the text behind it, which the machine shows.
    PauseWithText,
    /// Never within a program: each tool has a file of its own.
    Files,
}

/// What becomes of the touches of a probe (G38.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Touches {
    /// It is not known to probe.
    None,
    /// The controller reports each, and who is connected keeps them.
    Reported,
    /// They go into a file that the program names: `(PROBEOPEN …)`.
    Logged,
}

/// Numbers before the lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LineNumbers {
    /// None.
    Off,
    /// `N10`, `N20`, …
    ByTens,
}

/// Every dialect that is built in.
pub const ALL: &[Dialect] =
    &[grbl::GRBL, linuxcnc::LINUXCNC, mach3::MACH3, marlin::MARLIN, smoothieware::SMOOTHIEWARE, tinyg::TINYG];

impl Dialect {
    /// The built-in dialect of this name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<&'static Self> {
        ALL.iter().find(|dialect| dialect.name == name)
    }
}
