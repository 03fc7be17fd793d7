//! The report as data: what `NAME.json` holds.
//!
//! Lengths are millimetres with the decimals of a nanometre, times are seconds. Keys come in the
//! order of these types, lists in the order of the board, so two runs over the same files give the
//! same bytes. There is no clock, path or host in it.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::board::diagnostic;
use crate::board::{Diagnostic, Side, Source, SourceSpan, Warning, Words};
use crate::toolpath::Statistics;

pub use super::quantity::{Millimetres, Place, SCHEMA_VERSION};

use super::colours::ColoursEntry;
use super::coupling::CouplingEntry;
use super::quantity::json;
use super::stages::Stage;

/// Everything that is known after a job.
#[derive(Clone, Debug, Serialize)]
pub struct Document {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// The program and its version.
    pub generator: String,
    /// The board's name.
    pub board: String,
    /// Its width and height.
    pub size_mm: Option<[Millimetres; 2]>,
    /// The files that were read.
    pub sources: Vec<Source>,
    /// Files and folders beside them that are no layer of a board.
    pub ignored: Vec<String>,
    /// The copper that was isolated, front first.
    pub layers: Vec<LayerEntry>,
    /// How many nets the assembled board has, its sides joined through plated holes.
    pub electrical_nets: Option<usize>,
    /// Holes by drill.
    pub drills: Vec<DrillEntry>,
    /// The programs that were written.
    pub programs: Vec<ProgramEntry>,
    /// What a person does between them and within them.
    pub tool_changes: ToolChanges,
    /// All programs together, tool changes included.
    pub total: Figures,
    /// The files that were written beside this one, where they were.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outputs: Vec<OutputEntry>,
    /// What came of milling them on a picture, where that was done.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verification: Option<super::Verdict>,
    /// What a person must know.
    pub warnings: Vec<WarningEntry>,
    /// How long each stage took, where that is asked for (`-vv`): never in a file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<Stage>,
    /// The settings, by the names of their options.
    pub settings: BTreeMap<String, String>,
}

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, serde::Deserialize)]
pub struct OutputEntry {
    /// Its name.
    pub file: String,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

/// One layer of copper.
#[derive(Clone, Debug, Serialize)]
pub struct LayerEntry {
    /// Which.
    pub side: Side,
    /// Pieces of copper in the file.
    pub features: usize,
    /// Islands of copper, by number.
    pub nets: Vec<NetEntry>,
    /// How they were found by colours, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translucency: Option<ColoursEntry>,
    /// The narrowest place between two of them.
    pub smallest_gap: Option<GapEntry>,
    /// Boundaries between the regions of two nets: Voronoi edges in a row.
    pub boundaries: usize,
    /// Voronoi vertices: where three or more of them meet, or where one ends.
    pub vertices: usize,
    /// Their length, without what runs along the board's edge.
    pub boundary_length_mm: Millimetres,
    /// The frame cut round the copper, where there is no outline.
    pub frame_length_mm: Option<Millimetres>,
    /// Gaps narrower than the kerf by a negligible amount: a hundredth of it at most.
    #[serde(skip_serializing_if = "is_none")]
    pub negligible_gaps: usize,
    /// What `--strategy auto` tried, and took.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strategy: Option<StrategyEntry>,
    /// Which nets are coupled most, where regions part them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<CouplingEntry>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde asks")]
const fn is_none(count: &usize) -> bool {
    *count == 0
}

/// Plans that were made of a layer, and the fastest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StrategyEntry {
    /// How many nets have a loop.
    pub outlined_nets: usize,
    /// How long the machine runs for this side, to a tenth.
    pub seconds: f64,
    /// The same with a region for every net that was free to have one.
    pub voronoi_seconds: f64,
    /// The same with a loop round each of them.
    pub outline_seconds: f64,
    /// How many plans were made.
    pub plans: usize,
}

/// One island of copper.
#[derive(Clone, Debug, Serialize)]
pub struct NetEntry {
    /// What people call it.
    pub name: String,
    /// Whether a file gives it that name; else it is a number.
    pub named: bool,
    /// Pieces of copper in it.
    pub features: usize,
}

/// The narrowest place between two nets.
#[derive(Clone, Debug, Serialize)]
pub struct GapEntry {
    /// How wide.
    pub width_mm: Millimetres,
    /// The two nets.
    pub between: [String; 2],
    /// Its middle.
    pub at: Place,
}

/// The holes of one drill.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DrillEntry {
    /// Its diameter.
    pub diameter_mm: Millimetres,
    /// Plain holes.
    pub holes: usize,
    /// Slots and routed contours.
    pub slots: usize,
}

/// A program for the machine.
#[derive(Clone, Debug, Serialize)]
pub struct ProgramEntry {
    /// The file's name.
    pub file: String,
    /// What it does.
    pub title: String,
    /// The tools it takes, in order.
    pub tools: Vec<String>,
    /// What it amounts to.
    #[serde(flatten)]
    pub figures: Figures,
}

/// What programs amount to.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Figures {
    /// The length of all cuts.
    pub cut_mm: Millimetres,
    /// The length of all rapids.
    pub rapid_mm: Millimetres,
    /// How often the tool retracts to the safe height.
    pub retracts: u64,
    /// How long the machine runs, to a tenth; a program's without tool changes.
    pub seconds: f64,
}

/// How often a tool is changed from the first program to the last, and how long that takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ToolChanges {
    /// How often; the first tool is in the machine.
    pub count: u32,
    /// How long all of them take, in seconds, as the machine's profile says.
    pub seconds: f64,
}

/// What would have been right, and what to do about what is not.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Help {
    /// What was expected at the place of the warning.
    pub expected: Words,
    /// What a person can do, in the words of an order.
    pub advice: Words,
}

/// A warning with its places.
#[derive(Clone, Debug, Serialize)]
pub struct WarningEntry {
    /// Its kind, by its code.
    #[serde(rename = "code")]
    pub kind: &'static Diagnostic,
    /// The sentence.
    pub message: String,
    /// The side it concerns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<Side>,
    /// The place on the board.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Place>,
    /// The place in a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceSpan>,
    /// What was expected there, and what to do about it.
    #[serde(flatten)]
    pub help: Option<Help>,
    /// How large: how much copper goes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_mm: Option<Millimetres>,
    /// Where else it is so, and no worse.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub places: Vec<Place>,
}

impl Help {
    /// What helps with a file; what planning notices, its sentence says.
    fn of(kind: &Diagnostic) -> Option<Self> {
        (kind.stage == diagnostic::Stage::Files)
            .then_some(Self { expected: kind.effect, advice: kind.advice })
    }
}

impl From<&Warning> for WarningEntry {
    fn from(warning: &Warning) -> Self {
        Self {
            kind: warning.kind,
            message: warning.text(),
            side: warning.side,
            at: warning.at.map(Place::from),
            source: warning.source.clone(),
            help: Help::of(warning.kind),
            size_mm: warning.size.map(Millimetres),
            places: Vec::new(),
        }
    }
}

impl From<&Statistics> for Figures {
    fn from(statistics: &Statistics) -> Self {
        Self {
            cut_mm: Millimetres(statistics.cut_length),
            rapid_mm: Millimetres(statistics.rapid_length),
            retracts: statistics.retracts,
            seconds: (statistics.seconds * 10.0).round() / 10.0,
        }
    }
}

impl Figures {
    /// All together, with the time for tool changes.
    pub fn sum<'a>(all: impl IntoIterator<Item = &'a Statistics>, changes: ToolChanges) -> Self {
        let mut sum = Statistics { seconds: changes.seconds, ..Statistics::default() };
        for one in all {
            sum.cut_length += one.cut_length;
            sum.rapid_length += one.rapid_length;
            sum.retracts += one.retracts;
            sum.seconds += one.seconds;
        }
        Self::from(&sum)
    }
}

impl Document {
    /// As JSON text, indented, ended by a line feed.
    #[must_use]
    pub fn to_json(&self) -> String {
        json(self)
    }
}
