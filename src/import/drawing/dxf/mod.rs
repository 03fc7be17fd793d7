//! DXF drawings → [`Artwork`](crate::artwork::Artwork): text and binary, release 12 to 2018.
//!
//! ```text
//!  bytes ─ pairs ─▶ codes and values ─ file ─▶ unit, layers, blocks, entities ─ entity ─▶ Artwork
//!                                                   hatch, curve, wide, frame ───┘
//! ```
//!
//! A reader of our own: the crate `dxf` 0.6.2, tried on the 67 drawings that this was written
//! against, drops hatches and the dimensions of old files without a word and stops at what stands
//! between sections. What is not read here is counted and warned of by the name of its entity.
//!
//! # Source
//!
//! Autodesk, *DXF Reference*, 2018.

mod curve;
mod entity;
mod file;
mod frame;
mod hatch;
mod pairs;
mod vertex;
mod wide;

use std::collections::BTreeMap;
use std::ops::Range;

use crate::board::{Source, Words};
use crate::import::diagnostic;
use crate::import::digest;
use crate::import::drawing::{Drawing, Options, Unit};
use crate::import::error::Error;
use entity::{Refusal, Sheet};
use file::Dxf;
use pairs::{NoNumber, SENTINEL};

/// The largest file that is read. Chosen: pairs take ten times that, and drawings of boards have a
/// hundredth.
const MOST_BYTES: usize = 128 << 20;

/// Whether `bytes` are a DXF drawing: binary, or beginning with a section or a comment before one.
#[must_use]
pub fn looks_like(bytes: &[u8]) -> bool {
    if bytes.starts_with(SENTINEL) {
        return true;
    }
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]).into_owned();
    let mut lines = head.lines().map(str::trim);
    loop {
        match (lines.next(), lines.next()) {
            (Some("999"), Some(_)) => {}
            (Some("0"), Some(word)) => return word == "SECTION",
            _ => return false,
        }
    }
}

/// Reads the drawing `name` with content `bytes`.
///
/// # Errors
///
/// [`Error`] for what is no DXF or is cut off, for a number that is none, for a drawing that does
/// not say how long its unit is, and for one that shows nothing.
pub fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Drawing, Error> {
    if bytes.len() > MOST_BYTES {
        let what = format!("a drawing of {} MB is too large", bytes.len() >> 20);
        return Err(Error::content(name, what, "simplify the drawing"));
    }
    let pairs = pairs::pairs(name, bytes)?;
    let dxf = Dxf::read(name, bytes, &pairs)?;
    let unit = unit(name, &dxf, options)?;
    let sheet = entity::drawn(&dxf, unit.nanometres()).map_err(|refusal| match refusal {
        Refusal::NoNumber(NoNumber(place)) => no_number(name, bytes, place),
        Refusal::Beyond(at) => {
            let what = "an entity lies more than 1073 mm from the origin";
            let hint = Words::of("set the unit with {unit}, or move the drawing to the origin");
            Error::syntax(name, bytes, at..at + 1, what, "coordinates within ±1073 mm", hint)
        }
        Refusal::TooMany => {
            let what = "the drawing has more than two million entities, or four million lines and arcs";
            Error::content(name, what, "insert fewer blocks")
        }
    })?;
    let left_out: Vec<String> =
        sheet.left_out.iter().map(|(what, count)| format!("{count} {what}")).collect();
    if sheet.layers.count() == 0 {
        let why = if left_out.is_empty() { String::new() } else { format!(": {}", left_out.join(", ")) };
        let hint = "expected lines, arcs, polylines, splines or hatches in model space";
        return Err(Error::content(name, format!("nothing is drawn in the DXF{why}"), hint));
    }
    let mut warnings = Vec::new();
    if !left_out.is_empty() {
        warnings
            .push(diagnostic::DXF_LEFT_OUT.warning(format!("left out of {name}: {}", left_out.join(", "))));
    }
    if !dxf.is_whole {
        let message = format!("{name} does not end with EOF; something may be missing");
        warnings.push(diagnostic::DXF_NO_END.warning(message));
    }
    let source = source(name, bytes, &dxf, unit, &sheet);
    Ok(Drawing { artwork: sheet.layers.into_artwork(), source, warnings })
}

/// An error for what should be a number.
fn no_number(name: &str, bytes: &[u8], place: Range<usize>) -> Error {
    let hint = "export the drawing again with decimal points instead of commas";
    Error::syntax(name, bytes, place, "this is not a number", "a number such as 12.5", hint)
}

/// What a person says, or the file.
fn unit(name: &str, dxf: &Dxf<'_>, options: &Options) -> Result<Unit, Error> {
    options.unit.or(dxf.unit.map(|(unit, _)| unit)).ok_or_else(|| {
        let what = "the drawing does not declare its unit ($INSUNITS)";
        Error::content(name, what, Words::of("set it: {unit} mm, {unit} in or {unit} 0.1mm"))
    })
}

fn source(name: &str, bytes: &[u8], dxf: &Dxf<'_>, unit: Unit, sheet: &Sheet) -> Source {
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    for entity in &dxf.entities {
        *counts.entry(entity.kind.clone()).or_insert(0) += 1;
    }
    counts.insert("figures".to_owned(), sheet.layers.count());
    let sha256 = digest::sha256(bytes);
    let version = dxf.version.as_deref().unwrap_or("unknown version");
    Source {
        file: name.to_owned(),
        format: if bytes.starts_with(SENTINEL) { "dxf-binary" } else { "dxf" }.to_owned(),
        role: String::new(),
        units: dxf.unit.map_or("as given", |(_, name)| name).to_owned(),
        number_format: format!("{version}, unit {unit}"),
        design: sha256.clone(),
        sha256,
        bytes: bytes.len() as u64,
        counts,
        generator: None,
        apertures: Vec::new(),
    }
}
