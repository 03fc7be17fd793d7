//! The files that a board was read from, for the report and for program headers.

use std::collections::BTreeMap;

/// How one aperture or drill of a file is used.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct ApertureUse {
    /// Its name in the file: `D10`, `T1`.
    pub name: String,
    /// What it is, as people say it: `circle 0.25 mm`, `rectangle 1.5 × 0.6 mm`, `macro RoundRect`,
    /// `drill 0.8 mm`.
    pub what: String,
    /// How often it was flashed or drilled.
    pub flashes: u64,
    /// How often it was drawn or routed with.
    pub draws: u64,
}

/// A file that was read, as the report lists it. Not its folder: outputs carry no path of a
/// machine.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Source {
    /// The file's name without its folder.
    pub file: String,
    /// What it is: `gerber-x2`, `gerber-x`, `gerber-d`, `excellon`, …
    pub format: String,
    /// What it was taken for: `front-copper`, `back-copper`, `outline`, `drill`, or `ignored` with
    /// the reason.
    pub role: String,
    /// `mm` or `inch`, as the file has it.
    pub units: String,
    /// The number format, as people write it: `4.6 leading zeros omitted, absolute`.
    pub number_format: String,
    /// SHA-256 of the file's bytes, in hexadecimal; of a text of two bytes a character, of its
    /// UTF-8.
    pub sha256: String,
    /// SHA-256 of what was read from it, in hexadecimal: the same for the same design, whatever its
    /// comments and dates say. Empty for a file that was left aside.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub design: String,
    /// The length in bytes.
    pub bytes: u64,
    /// Counts by name: flashes, strokes, arcs, regions, holes, slots, …
    pub counts: BTreeMap<String, u64>,
    /// The program that wrote it, where it says so.
    pub generator: Option<String>,
    /// Apertures or drills and their use, by number.
    pub apertures: Vec<ApertureUse>,
}
