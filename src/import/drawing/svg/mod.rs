//! SVG drawings → [`Artwork`](crate::artwork::Artwork), by the crate `usvg`, which resolves styles,
//! transforms, uses and units.
//!
//! ```text
//!  bytes ─ document ─▶ groups with names, size, counts ─ usvg ─▶ paths ─ paint ─▶ Artwork
//! ```
//!
//! What is painted counts: fills by their rule, strokes with caps, joins and dashes, cut where a
//! clipping path or a mask ends. White erases what was painted before it, where anything else is
//! painted at all. y points up; the lower left corner of the page is zero.
//!
//! # Sources
//!
//! Scalable Vector Graphics (SVG) 2, W3C candidate recommendation, 2018; CSS Values and Units 3 for
//! the pixel of a 96th inch. `usvg` computes in 32-bit floats: 8 nm at 100 mm.

mod document;
mod paint;
mod references;
mod size;
mod window;

use std::collections::BTreeMap;
use std::sync::Arc;

use usvg::fontdb;

use crate::board::{Source, Words};
use crate::import::diagnostic;
use crate::import::digest;
use crate::import::drawing::{Drawing, Options};
use crate::import::error::Error;
use document::Document;
use size::Size;

/// Whether `bytes` are an SVG drawing: XML whose first element is `svg`.
#[must_use]
pub fn looks_like(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(4096)];
    let text = String::from_utf8_lossy(head);
    let mut rest = text.trim_start_matches('\u{feff}').trim_start();
    while rest.starts_with("<?") || rest.starts_with("<!") {
        let end = if rest.starts_with("<!--") { "-->" } else { ">" };
        // A document type may hold entities in brackets.
        let end = if rest.starts_with("<!DOCTYPE") && rest[..rest.find('>').unwrap_or(0)].contains('[') {
            "]"
        } else {
            end
        };
        let Some(at) = rest.find(end) else { return rest.starts_with("<!DOCTYPE svg") };
        rest = rest[at + end.len()..].trim_start_matches('>').trim_start();
    }
    let name = rest.strip_prefix('<').unwrap_or_default();
    let name = name.split(|c: char| c.is_whitespace() || c == '>' || c == '/').next().unwrap_or_default();
    name == "svg" || name.ends_with(":svg")
}

/// Reads the drawing `name` with content `bytes`.
///
/// # Errors
///
/// [`Error`] for what is no SVG, does not say how long its unit is, or shows nothing.
pub fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Drawing, Error> {
    let document = Document::read(name, bytes)?;
    let xml = document.parse(name)?;
    references::check(name, &xml)?;
    let usvg = settings(name, options)?;
    let tree = usvg::Tree::from_xmltree(&xml, &usvg).map_err(|error| {
        let what = format!("the SVG cannot be read: {error}");
        Error::content(name, what, "open it in a drawing program and save it as plain SVG")
    })?;
    let mut warnings = Vec::new();
    let size = Size::of(name, &xml, &tree, options, &mut warnings)?;
    let painted = paint::painted(name, &tree, &document, &size)?;
    let left_out = painted.left_out(&document, options);
    if painted.layers.count() == 0 {
        let why = if left_out.is_empty() { String::new() } else { format!(": {}", left_out.join(", ")) };
        let hint = if document.texts > 0 && options.fonts.is_empty() {
            Words::of("choose a font for its texts with {font} FILE, or convert them to paths")
        } else {
            Words::of("check that the drawing has visible paths")
        };
        return Err(Error::content(name, format!("nothing is drawn in the SVG{why}"), hint));
    }
    if !left_out.is_empty() {
        warnings
            .push(diagnostic::SVG_LEFT_OUT.warning(format!("left out of {name}: {}", left_out.join(", "))));
    }
    let unscaled = (document.unscaled > 0)
        .then(|| format!("{} strokes that keep their width when scaled", document.unscaled));
    let kinds = painted.effects.iter().map(|(what, count)| format!("{count} {what}"));
    let kinds: Vec<String> = kinds.chain(unscaled).collect();
    if !kinds.is_empty() {
        let message = format!("not followed in {name}: {}", kinds.join(", "));
        warnings.push(diagnostic::SVG_EFFECTS.warning(message));
    }
    if painted.erased > 0 {
        let message = format!("{} white shapes of {name} erase what lies below them", painted.erased);
        warnings.push(diagnostic::SVG_WHITE.warning(message));
    }
    let source = source(name, bytes, &document, &size, painted.layers.count());
    Ok(Drawing { artwork: painted.layers.into_artwork(), source, warnings })
}

/// Texts take the font that a person named; nothing is read from the machine.
fn settings<'a>(name: &str, options: &Options) -> Result<usvg::Options<'a>, Error> {
    let mut usvg = usvg::Options::default();
    usvg.image_href_resolver.resolve_string = Box::new(|_, _| None);
    usvg.image_href_resolver.resolve_data = Box::new(|_, _, _| None);
    let mut fonts = fontdb::Database::new();
    for font in &options.fonts {
        let before = fonts.len();
        fonts.load_font_data(font.as_ref().clone());
        if fonts.len() == before {
            let what = Words::of("a file given with {font} is not a font");
            return Err(Error::content(name, what, "give a TrueType or OpenType font"));
        }
    }
    let faces: Vec<fontdb::ID> = fonts.faces().map(|face| face.id).collect();
    let first = faces.first().copied();
    usvg.fontdb = Arc::new(fonts);
    usvg.font_resolver.select_font = Box::new(move |_, _| first);
    usvg.font_resolver.select_fallback =
        Box::new(move |_, used, _| faces.iter().copied().find(|face| !used.contains(face)));
    Ok(usvg)
}

fn source(name: &str, bytes: &[u8], document: &Document, size: &Size, figures: u64) -> Source {
    let sha256 = digest::sha256(bytes);
    let mut counts: BTreeMap<String, u64> = document.counts.clone();
    counts.insert("figures".to_owned(), figures);
    Source {
        file: name.to_owned(),
        format: "svg".to_owned(),
        role: String::new(),
        units: size.name.clone(),
        number_format: format!("a pixel is {}", size.pixel),
        design: sha256.clone(),
        sha256,
        bytes: bytes.len() as u64,
        counts,
        generator: document.generator.clone(),
        apertures: Vec::new(),
    }
}
