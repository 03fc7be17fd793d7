//! Files → drawings, by what their content looks like.

use std::path::{Path, PathBuf};

use super::sheet::{Drawing, Options};
use super::{dxf, roles, svg};
use crate::import::archive::{name_of, read_file};
use crate::import::error::Error;

/// A kind of file that is a drawing.
pub struct Format {
    /// What it is called.
    pub name: &'static str,
    looks_like: fn(&[u8]) -> bool,
    read: fn(&str, &[u8], &Options) -> Result<Drawing, Error>,
}

/// Every kind of drawing: a folder each.
pub const FORMATS: &[Format] = &[
    Format { name: "svg", looks_like: svg::looks_like, read: svg::read },
    Format { name: "dxf", looks_like: dxf::looks_like, read: dxf::read },
];

/// Whether `bytes` are a drawing.
#[must_use]
pub fn looks_like(bytes: &[u8]) -> bool {
    format(bytes).is_some()
}

fn format(bytes: &[u8]) -> Option<&'static Format> {
    FORMATS.iter().find(|format| (format.looks_like)(bytes))
}

/// Reads the drawing `name` with content `bytes`.
///
/// # Errors
///
/// [`Error`] for what is no drawing, and what the readers say of one.
pub fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Drawing, Error> {
    match format(bytes) {
        Some(format) => (format.read)(name, bytes, options),
        None => Err(Error::content(name, "this is not a drawing", "expected an SVG or a DXF file")),
    }
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
        drawing.artwork = roles::layer(drawing.artwork, &shown, &layer)?;
    }
    Ok(drawing)
}

/// The file that a path names, of which a layer may be meant: `plate.svg#Holes`.
#[must_use]
pub fn file_of(path: &Path) -> PathBuf {
    split(path).0
}

/// A file and the layer behind `#`, where there is no file of the whole name.
pub(in crate::import) fn split(path: &Path) -> (PathBuf, Option<String>) {
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
