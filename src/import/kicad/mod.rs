//! KiCad boards (`.kicad_pcb`, versions 4 to 10) → copper of both sides, the edge and the holes.
//!
//! ```text
//! bytes ─ tree ─▶ nodes ─ reader ─▶ features and holes ─▶ Layout
//!                           │
//!                           └─ pad, track, zone, graphic, text, each with its shapes
//! ```
//!
//! What is read is what KiCad plots, so that a board and its Gerber files give the same nets and
//! the same copper: the written areas of zones and not their outlines, pads as their shapes, the
//! coordinates of the page or of the auxiliary origin, whichever the board's own plot settings say.
//! Numbers become whole nanometres without a float between.
//!
//! Texts on copper are drawn with letters of our own. What is not read is said: dimensions,
//! pictures. A board whose zones are not filled is an error.

mod curve;
mod footprint;
mod frame;
mod graphic;
mod head;
mod layers;
mod letter;
mod lettering;
mod number;
mod pad;
mod pad_shape;
mod reader;
mod ring;
mod stroke_font;
mod text;
mod track;
mod tree;
mod zone;

use std::collections::{BTreeMap, BTreeSet};

use super::error::Error;
use super::gerber::Image;
use super::{design, diagnostic, digest};
use crate::board::{Hole, Plating, Source, Warning};
use crate::geometry::Nm;
use reader::{Reader, Sheet};
use tree::{Node, Tree};

/// A board as KiCad saved it.
#[derive(Clone, Debug)]
pub struct Layout {
    /// The copper of the front, perhaps none.
    pub front: Image,
    /// The copper of the back, seen from the front, perhaps none.
    pub back: Image,
    /// The lines of the edge, perhaps none.
    pub edge: Image,
    /// Holes and slots, in file order.
    pub holes: Vec<Hole>,
    /// What is known of the holes' source.
    pub drill: Source,
    /// How thick the board is, where the file says so.
    pub thickness: Option<Nm>,
    /// How many layers of copper lie between the outer ones.
    pub inner: usize,
    /// What was left out or looks wrong.
    pub warnings: Vec<Warning>,
}

/// The newest version of the format that is known: that of KiCad 10.
const NEWEST: u32 = 20_260_206;

/// Whether `bytes` begin like a KiCad board.
#[must_use]
pub fn looks_like(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"(kicad_pcb")
}

/// Reads the board `name` with content `bytes`.
///
/// # Errors
///
/// [`Error`] names the place and what was expected there: a file that was cut off, a number that is
/// none, zones that are not filled.
pub fn read(name: &str, bytes: &[u8]) -> Result<Layout, Error> {
    let tree = Tree::read(name, bytes)?;
    let mut reader = Reader::new(name, bytes);
    reader.board(&tree)?;
    let root = tree.root();
    let version = root.find("version").and_then(|version| version.argument(0));
    if let Some(version) = version.filter(|_| reader.version > NEWEST) {
        let message = "the board was saved by a KiCad newer than 10, whose format voromill does not know";
        reader.warnings.add(&diagnostic::KICAD_VERSION, version.place(), message);
    }
    let thickness = match root.find("general").and_then(|general| general.find("thickness")) {
        Some(list) => Some(reader.length(list, 0)?).filter(|&thickness| thickness > Nm::ZERO),
        None => None,
    };
    number_tools(&mut reader.holes);
    let source = Source {
        file: name.to_owned(),
        format: "kicad-pcb".to_owned(),
        role: String::new(),
        units: "mm".to_owned(),
        number_format: version.map_or_else(String::new, |version| format!("version {}", version.text())),
        sha256: digest::sha256(bytes),
        design: String::new(),
        bytes: bytes.len() as u64,
        counts: BTreeMap::new(),
        generator: generator(root),
        apertures: Vec::new(),
    };
    // One file is one design, whichever part of it a program is made from.
    let parts = [
        design::of_features(&reader.front.features, &reader.front.attributes),
        design::of_features(&reader.back.features, &reader.back.attributes),
        design::of_features(&reader.edge.features, &reader.edge.attributes),
        design::of_holes(&reader.holes),
    ];
    let source = Source { design: design::of_texts((1..).zip(parts.iter().map(String::as_str))), ..source };
    let slots = reader.holes.iter().filter(|hole| hole.is_slot()).count() as u64;
    let holes = [("holes", reader.holes.len() as u64 - slots), ("slots", slots)];
    let drill = Source {
        counts: holes.into_iter().map(|(what, count)| (what.to_owned(), count)).collect(),
        ..source.clone()
    };
    let image = |sheet: Sheet| {
        let source = Source {
            counts: BTreeMap::from([("features".to_owned(), sheet.features.len() as u64)]),
            ..source.clone()
        };
        let Sheet { features, attributes, .. } = sheet;
        Image { features, attributes, source, function: None, warnings: Vec::new() }
    };
    Ok(Layout {
        front: image(reader.front),
        back: image(reader.back),
        edge: image(reader.edge),
        holes: reader.holes,
        drill,
        thickness,
        inner: inner_layers(root),
        warnings: reader.warnings.finish(),
    })
}

/// Numbers the drills as KiCad does: plated ones first, small ones first.
fn number_tools(holes: &mut [Hole]) {
    let tool = |hole: &Hole| (hole.plating != Plating::Plated, hole.diameter);
    let tools: BTreeSet<_> = holes.iter().map(tool).collect();
    let numbers: BTreeMap<_, u32> = tools.into_iter().zip(1..).collect();
    for hole in holes {
        hole.tool = numbers[&tool(hole)];
    }
}

/// The program that wrote the board: `pcbnew 9.0`, `pcbnew 4.0.6`.
fn generator(root: Node<'_>) -> Option<String> {
    let list = root.find("generator").or_else(|| root.find("host"))?;
    let version = root.find("generator_version").and_then(|version| version.argument(0));
    let words = list.arguments().chain(version).map(|word| word.text().into_owned());
    Some(words.collect::<Vec<_>>().join(" "))
}

/// How many inner layers of copper the board has.
fn inner_layers(root: Node<'_>) -> usize {
    let Some(layers) = root.find("layers") else { return 0 };
    let is_inner = |layer: &Node<'_>| {
        let name = layer.argument(0).map(|name| name.text().into_owned()).unwrap_or_default();
        name.ends_with(".Cu") && !matches!(name.as_str(), "F.Cu" | "B.Cu")
    };
    layers.arguments().filter(|layer| layer.is_list()).filter(is_inner).count()
}
