//! How large a drawing is: the unit that its page is measured in, or that a person says.

use usvg::roxmltree;

use crate::board::{Warning, Words};
use crate::import::diagnostic;
use crate::import::drawing::{Options, Place, Unit};
use crate::import::error::Error;

/// Units that are of one length on any page, and px, which CSS makes a 96th inch; in nanometres.
const ABSOLUTE: [(&str, f64); 7] = [
    ("mm", 1e6),
    ("cm", 1e7),
    ("in", 25.4e6),
    ("pt", 25.4e6 / 72.0),
    ("pc", 25.4e6 / 6.0),
    ("q", 0.25e6),
    ("px", 25.4e6 / 96.0),
];

const HINT: Words = Words::of("set its unit: {unit} mm, {unit} in, {unit} 0.1mm or {unit} 90dpi");

/// Sizes of a page that differ by less, as a part, are one. Chosen: `usvg` rounds to single
/// precision.
const SAME: f64 = 1e-4;

/// From a page of pixels to nanometres.
#[derive(Clone, Debug)]
pub(super) struct Size {
    /// The length of a pixel of the page.
    pub(super) pixel: Unit,
    /// What the page is measured in.
    pub(super) name: String,
    /// The page's height in pixels.
    height: f64,
}

impl Size {
    pub(super) fn of(
        name: &str,
        xml: &roxmltree::Document<'_>,
        tree: &usvg::Tree,
        options: &Options,
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, Error> {
        let root = xml.root_element();
        let height = f64::from(tree.size().height());
        if let Some(unit) = options.unit {
            let pixel = Unit::of_nanometres(unit.nanometres() / pixels_a_unit(&root, tree));
            let pixel = pixel.unwrap_or(unit);
            return Ok(Self { pixel, name: "as given".to_owned(), height });
        }
        let sizes = ["width", "height"].map(|side| root.attribute(side).map(measure));
        let length = |(number, unit): &(f64, String)| {
            let (_, nanometres) = ABSOLUTE.into_iter().find(|(known, _)| known == unit)?;
            Some((number * nanometres, unit.clone()))
        };
        let pixels = [f64::from(tree.size().width()), height];
        let told =
            sizes.iter().zip(pixels).find_map(|(size, pixels)| Some((length(size.as_ref()?)?, pixels)));
        if told.is_some() && sizes.iter().flatten().any(|(_, unit)| unit == "%") {
            let what = "the size of the drawing is unknown: one side of its page is a part of something";
            return Err(Error::content(name, what, HINT));
        }
        if let Some(((length, name), pixels)) = told {
            // What `usvg` does not read, as `1 mm`, `1MM` or `4q`, it takes from the view box.
            let ratio = length / pixels / Unit::PIXEL.nanometres();
            let own = Unit::of_nanometres(length / pixels).filter(|_| (ratio - 1.0).abs() > SAME);
            return Ok(Self { pixel: own.unwrap_or(Unit::PIXEL), name, height });
        }
        let is_plain = |size: &Option<(f64, String)>| {
            size.as_ref().is_some_and(|(number, unit)| unit.is_empty() && number.is_finite())
        };
        if !sizes.iter().any(is_plain) {
            let what = "the size of the drawing is unknown: its page has no width in mm, in or px";
            return Err(Error::content(name, what, HINT));
        }
        let message = "the width of the page has no unit: it is read as pixels of 1/96 inch";
        warnings.push(diagnostic::SVG_UNIT_ASSUMED.warning(message));
        Ok(Self { pixel: Unit::PIXEL, name: "px".to_owned(), height })
    }

    /// A point of the page in nanometres, y up.
    pub(super) fn place(&self, (x, y): Place) -> Place {
        (x * self.pixel.nanometres(), (self.height - y) * self.pixel.nanometres())
    }
}

/// A number and its unit in small letters.
fn measure(text: &str) -> (f64, String) {
    let text = text.trim();
    let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-');
    let end = text.find(|c: char| !is_number(c)).unwrap_or(text.len());
    // An exponent is followed by a digit, a unit by a letter: `1e2`, `1em`.
    let rest = &text[end..];
    let has_exponent = rest.starts_with(['e', 'E']) && rest[1..].starts_with(|c: char| is_number(c));
    let end = if has_exponent {
        let tail = &rest[1..];
        end + 1 + tail.find(|c: char| !is_number(c)).unwrap_or(tail.len())
    } else {
        end
    };
    (text[..end].parse().unwrap_or(f64::NAN), text[end..].trim().to_ascii_lowercase())
}

/// How many pixels of the page a unit of the drawing is.
fn pixels_a_unit(root: &roxmltree::Node<'_, '_>, tree: &usvg::Tree) -> f64 {
    let numbers = |text: &str| -> Option<[f64; 4]> {
        let parts = text.split(|c: char| c.is_whitespace() || c == ',').filter(|part| !part.is_empty());
        parts.map(|part| part.parse().ok()).collect::<Option<Vec<f64>>>()?.try_into().ok()
    };
    let Some([_, _, width, height]) = root.attribute("viewBox").and_then(numbers) else { return 1.0 };
    let (x, y) = (f64::from(tree.size().width()) / width, f64::from(tree.size().height()) / height);
    let aspect = root.attribute("preserveAspectRatio").unwrap_or_default();
    let scale = if aspect.contains("slice") { x.max(y) } else { x.min(y) };
    if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
}
