//! What controllers differ in, as data: a constant each, relatives in one file, listed in [`ALL`].

mod blend;
mod custom;
mod grbl;
mod linuxcnc;
mod mach;
mod printer;
mod smoothieware;
mod tinyg;

pub use blend::{Blend, ParseBlendError};
pub use custom::DialectError;

use std::borrow::Cow;

use crate::geometry::{Nm, Point};
use crate::toolpath::Feed;

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
    /// How the controller checks that an arc's two ends are as far from its centre.
    pub arc_check: ArcCheck,
    /// Which rapids say their speed.
    pub rapids: Rapids,
    /// That speed, level and then straight up or down.
    pub rapid: [Feed; 2],
    /// How comments are written.
    pub comments: Comments,
    /// Whether the controller shows some comments to its operator.
    pub messages: Messages,
    /// How a dwell is written.
    pub dwell: Dwell,
    /// How tools are changed unless a person says otherwise.
    pub tool_change: ToolChange,
    /// The ways of changing tools that hold: the machine stands still until the tool is changed.
    pub changes: Cow<'static, [ToolChange]>,
    /// What makes it wait for a person, for [`ToolChange::Pause`].
    pub pause: Text,
    /// What turns the spindle on, before the S.
    pub spindle: Text,
    /// Numbers before the lines.
    pub line_numbers: LineNumbers,
    /// The most characters in a line.
    pub longest_line: usize,
    /// How far corners may be rounded off, as programs say it (G64 P); none where the controller
    /// knows no word for it.
    pub blend: Option<Blend>,
    /// The lines before everything else.
    pub start: Cow<'static, [Text]>,
    /// The lines after everything else, the tool retracted and the spindle off.
    pub end: Cow<'static, [Text]>,
    /// What turns the coolant (or the vacuum) on and off; none leaves it alone.
    pub coolant: Option<(Text, Text)>,
    /// How long the spindle is given to come up to speed, in milliseconds.
    pub spin_up: u32,
    /// What becomes of the touches of a probe.
    pub touches: Touches,
    /// What the place that a probe goes to counts from.
    pub probes_from: ProbesFrom,
    /// The words, before Z, that say how high the tool is once a probe has touched something; none
    /// where no program can say it.
    pub sets_height: Option<Text>,
    /// Why programs do not probe, or do not set zero by a touch, where they do not.
    pub no_probe: Option<Text>,
    /// Where each tool is touched off after it was fitted; none for not at all.
    pub touch_off: Option<TouchOff>,
    /// What a person must have set for the programs to run as they are meant, for their headers.
    pub condition: Option<Text>,
    /// G-code of the user's own.
    pub own: OwnCode,
}

/// G-code of the user's own, line by line as it stands in programs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OwnCode {
    /// Before everything else; what the dialect says of units and modes comes after it.
    pub before: Vec<String>,
    /// At each change of tools within a program, the tool retracted and the spindle off.
    pub at_tool_change: Vec<String>,
    /// At the end, the tool retracted and the spindle off.
    pub after: Vec<String>,
}

impl OwnCode {
    const NONE: Self = Self { before: Vec::new(), at_tool_change: Vec::new(), after: Vec::new() };
}

/// A plate that each tool touches after it was fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TouchOff {
    /// Where it is touched.
    pub at: Point,
    /// How high it lies there above the work's zero.
    pub height: Nm,
}

/// What small spindles need. Chosen.
const SPIN_UP: u32 = 3000;

/// The speeds of rapids, level and straight up or down, where programs must say them. Chosen: what
/// the small engravers are sold with.
const RAPID: [Feed; 2] = [Feed::from_mm_per_min(1500), Feed::from_mm_per_min(600)];

/// Files alone: nothing makes the machine wait for a person within a program, or what does lets
/// nobody set zero.
const FILES: Cow<'static, [ToolChange]> = Cow::Borrowed(&[ToolChange::Files]);

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

/// How the radii at an arc's two ends are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcCheck {
    /// They may differ by some micrometres, however small the arc is.
    Absolute,
    /// By a thousandth of the radius too.
    Relative,
}

/// Which rapids carry an F.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rapids {
    /// None: the controller knows how fast its axes go.
    Unfed,
    /// The first: rapids have a feed of their own, which stays.
    FirstFed,
    /// Each: rapids and cuts share one feed.
    Fed,
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

/// Which comments the operator sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Messages {
    /// None, as far as is known.
    Hidden,
    /// `(MSG, so)`
    Msg,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToolChange {
    /// `T2 M6`: the machine, or its dialogue, does it.
    M6,
    /// `M0`, or what the dialect has for it, after a comment that says what to fit: the program
    /// waits.
    Pause,
    /// `M0` with the text behind it, which the machine shows.
    PauseWithText,
    /// Never within a program: each tool has a file of its own.
    Files,
}

impl ToolChange {
    /// How it is asked for.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::M6 => "m6",
            Self::Pause => "pause",
            Self::PauseWithText => "pause-with-text",
            Self::Files => "files",
        }
    }
}

/// What becomes of the touches of a probe (G38.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Touches {
    /// It is not known to probe.
    None,
    /// The controller reports each, and who is connected keeps them.
    Reported,
    /// The same as JSON, `{"prb":…}`.
    ReportedJson,
    /// They go into a file that the program names: `(PROBEOPEN …)`.
    Logged,
}

/// What the place that a probe (G38.2) goes to counts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProbesFrom {
    /// The work's zero, as of all moves.
    Work,
    /// The machine's zero, whatever G54 and G91 say; G28.3 and G92 move it.
    Machine,
    /// Where the tool is, whatever G90 says.
    Here,
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
pub const ALL: &[Dialect] = &[
    grbl::GRBL,
    grbl::GRBLHAL,
    grbl::FLUIDNC,
    linuxcnc::LINUXCNC,
    mach::MACH3,
    mach::MACH4,
    printer::MARLIN,
    printer::REPRAPFIRMWARE,
    printer::KLIPPER,
    smoothieware::SMOOTHIEWARE,
    tinyg::TINYG,
    tinyg::G2CORE,
];

impl Dialect {
    /// The built-in dialect of this name, in capitals or not.
    #[must_use]
    pub fn by_name(name: &str) -> Option<&'static Self> {
        ALL.iter().find(|dialect| dialect.name.eq_ignore_ascii_case(name))
    }

    /// The names of all that are built in, with commas between.
    #[must_use]
    pub fn names() -> String {
        ALL.iter().map(|dialect| dialect.name.as_ref()).collect::<Vec<_>>().join(", ")
    }
}
