//! Drawings (SVG, DXF) → [`Artwork`], and drawings as layers of a board.
//!
//! A drawing tells by the names of its layers which of them are copper, edge and holes, in the
//! words that Gerber files have; or a person tells, with `--front x.svg` for all of a drawing or
//! `--front x.svg#Layer` for one layer of it. Where neither does, what covers an area is copper,
//! and bare lines are the edge and its holes.

mod board;
mod contour;
mod told;
mod unit;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::archive::{name_of, read_file};
use super::error::Error;
use super::layers::{self, Role};
use super::{dxf, svg};
use crate::artwork::Artwork;
use crate::board::{Side, Source, Warning};

pub(super) use board::load;
pub(in crate::import) use contour::{Contour, Place};
pub use unit::Unit;

/// What a person says of drawings.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How long one unit is, whatever the file says.
    pub unit: Option<Unit>,
    /// The content of fonts for texts, the first one first.
    pub fonts: Vec<Arc<Vec<u8>>>,
}

/// A drawing with what is known of its file.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// What is drawn.
    pub artwork: Artwork,
    /// The file; its role is for the caller to fill in.
    pub source: Source,
    /// What was left out or assumed.
    pub warnings: Vec<Warning>,
}

/// Whether `bytes` are a drawing.
#[must_use]
pub fn looks_like(bytes: &[u8]) -> bool {
    svg::looks_like(bytes) || dxf::looks_like(bytes)
}

/// Reads the drawing `name` with content `bytes`.
///
/// # Errors
///
/// [`Error`] for what is no drawing, and what the readers say of one.
pub fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Drawing, Error> {
    if svg::looks_like(bytes) {
        return svg::read(name, bytes, options);
    }
    if dxf::looks_like(bytes) {
        return dxf::read(name, bytes, options);
    }
    Err(Error::content(name, "this is no drawing", "expected an SVG or a DXF file"))
}

/// Reads the drawing `path`, or with `#LAYER` behind its name one layer of it.
///
/// # Errors
///
/// A path that cannot be read, a layer that is not there, and what [`read`] says.
pub fn open(path: &Path, options: &Options) -> Result<Drawing, Error> {
    let (file, layer) = split(path);
    let shown = file.display().to_string();
    let mut drawing = read(&name_of(&file), &read_file(&file, &shown)?, options)?;
    if let Some(layer) = layer {
        let kept = told::layer(&drawing.artwork, &shown, &layer)?.clone();
        drawing.artwork.layers = vec![kept];
    }
    Ok(drawing)
}

/// A file and the layer behind `#`, where there is no file of the whole name.
fn split(path: &Path) -> (PathBuf, Option<String>) {
    let whole = (path.to_path_buf(), None);
    if path.exists() {
        return whole;
    }
    let text = path.to_string_lossy();
    match text.rsplit_once('#') {
        Some((file, layer)) if !layer.is_empty() => (PathBuf::from(file), Some(layer.to_owned())),
        _ => whole,
    }
}

/// What a layer is for, by its name; none where that does not tell.
pub(in crate::import) fn role_of(name: &str) -> Option<Role> {
    // Fritzing numbers copper from below.
    match name.to_ascii_lowercase().as_str() {
        "copper0" => return Some(Role::Copper(Side::Back)),
        // One side drawn by itself, as `draw --stage copper` does.
        "copper1" | "copper" => return Some(Role::Copper(Side::Front)),
        "hole" | "drills" | "bohrungen" => return Some(Role::Drill),
        "board" => return Some(Role::Outline),
        _ => {}
    }
    // As a file of no known extension.
    let role = layers::role_by_name(&format!("{}.layer", name.replace('.', "_")), 0);
    role.filter(|role| !matches!(role, Role::Group(_)))
}
