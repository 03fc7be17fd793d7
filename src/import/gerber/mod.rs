//! Gerber files → features: RS-274X with what thirty years of tools made of it, X2 and X3.
//!
//! ```text
//! bytes ─ lex ─▶ blocks ─ parser ─▶ commands ─▶ state ─▶ sink ─ polarity ─▶ features
//!                  words, extended               │         │
//!                       numbers, apertures, transformation, arcs, region
//!                                                          canvas, attributes
//! ```
//!
//! What a block says is told without what came before it (`command`). What is in force then
//! (`state`) is made of parts that each know one thing: what numbers mean (`numbers`), the
//! apertures (`apertures`, with `definition`, `aperture` and `aperture_macro`), the transformation,
//! how arcs are given (`arcs`, with `radii`) and the contour of a region. The state draws into the
//! `sink`. `reader` leads a file from one end to the other.
//!
//! Written for files in the wild, with the specification (Ucamco, revision 2023.08) deciding where
//! they disagree. Three choices make it both quick and forgiving. Blocks are cut at `*`, never at
//! line ends, because some tools write a file on one line. A command is told by its first two
//! characters, not by the `%` around it. And numbers go from digits to whole nanometres without a
//! float between.
//!
//! What is sloppy but clear is repaired with a warning; what would cut other copper than was meant
//! is an error: an aperture that is not defined, units that contradict each other, a number that is
//! none.

mod aperture;
mod aperture_list;
mod aperture_macro;
mod apertures;
mod arcs;
mod attributes;
mod canvas;
mod command;
mod definition;
mod distinct;
mod draw;
mod expression;
mod extended;
mod fault;
mod fields;
mod figure;
mod format;
mod lex;
mod linear;
mod numbers;
mod parser;
mod quadrants;
mod radii;
mod reader;
mod region;
mod sink;
mod state;
mod transformation;
mod words;

use crate::board::{Attributes, Feature, Source, Warning};

use super::Error;

pub use aperture_list::ApertureList;

/// Limits against files that expand beyond reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The most features, blocks and repeats expanded.
    pub features: u64,
    /// The most vertices of polygons, all features together.
    pub vertices: u64,
}

impl Default for Options {
    /// Two million features and five million vertices: chosen to stay well below a gigabyte of
    /// memory, an order of magnitude above the largest panel seen.
    fn default() -> Self {
        Self { features: 2_000_000, vertices: 5_000_000 }
    }
}

/// A Gerber file, resolved.
#[derive(Clone, Debug)]
pub struct Image {
    /// The copper (or silk, mask, outline …) in file order; polarity, blocks and repeats are
    /// resolved.
    ///
    /// An aperture of no size leaves features of radius zero: an outline is often drawn so. On a
    /// copper layer they have no area, and the caller leaves them out.
    pub features: Vec<Feature>,
    /// The attribute sets that features refer to; the first is empty.
    pub attributes: Vec<Attributes>,
    /// What is known of the file; its role is for the caller to fill in.
    pub source: Source,
    /// The X2 file function, `Copper,L1,Top`, also from KiCad's comments.
    pub function: Option<String>,
    /// What was repaired, left out or looks wrong.
    pub warnings: Vec<Warning>,
}

/// Reads the Gerber file `name` with content `bytes`.
///
/// # Errors
///
/// [`Error`] names the place and what was expected there, or says why this is no Gerber file.
pub fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Image, Error> {
    reader::read(name, bytes, None, options)
}

/// Reads an RS-274-D file, whose apertures stand in `list`, and perhaps its number format too.
///
/// # Errors
///
/// As [`read`]; also an aperture that the list does not have, or that it leaves unclear.
pub fn read_beside(name: &str, bytes: &[u8], list: &ApertureList, options: &Options) -> Result<Image, Error> {
    reader::read(name, bytes, Some(list), options)
}

/// Whether a Gerber file defines no aperture of its own (RS-274-D), though it may yet draw regions
/// alone.
#[must_use]
pub fn lacks_apertures(bytes: &[u8]) -> bool {
    let defines = |block: lex::Block<'_>| block.text.starts_with(b"ADD") || block.text.starts_with(b"ABD");
    !lex::Lexer::new(bytes).any(defines)
}

/// Whether `bytes` look like a Gerber file: by content, whatever the name.
#[must_use]
pub fn looks_like(bytes: &[u8]) -> bool {
    /// Enough for the longest comment before the first command. Chosen.
    const HEAD: usize = 1 << 16;
    let head = &bytes[..bytes.len().min(HEAD)];
    if head.starts_with(b"\x89PNG") || head.starts_with(b"PK") || head.starts_with(b"%PDF") {
        return false;
    }
    let blocks = lex::Lexer::new(head).filter(|block| block.end != lex::End::File);
    blocks.take(1000).any(|block| {
        let text = block.text;
        let command = [&b"FS"[..], b"MO", b"AD", b"AM", b"TF.", b"G04 #@!"];
        command.iter().any(|start| text.starts_with(start)) || is_operation(text)
    })
}

/// Whether `text` is a coordinate with an operation, `X1Y2D03`, or the end of a program.
fn is_operation(text: &[u8]) -> bool {
    let ends = [&b"D01"[..], b"D02", b"D03", b"D1", b"D2", b"D3"].iter().any(|end| text.ends_with(end));
    let body = |b: &u8| b.is_ascii_digit() || b"GXYIJD+-. \r\n".contains(b);
    text == b"M02" || (ends && text.iter().all(body))
}
