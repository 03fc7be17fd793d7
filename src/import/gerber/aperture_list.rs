//! Aperture lists: what a plotter's wheel holds, in a file beside an RS-274-D Gerber file.
//!
//! There is no standard. Every program printed a table for a person at the plotter, so the table is
//! read as that person reads it: a line that has a D code, a word for a shape and one to three
//! sizes is an aperture, whatever stands around them; all else is prose, in which units and the
//! number format are looked for.
//!
//! ```text
//!  D10   ROUNDED      12.000  12.000  0.000  LINE      Protel: x, y, hole; mils
//!  D011  rectangle    0.060 x 0.075                    Eagle's wheels: inches, or a unit behind each number
//!  12    60   0       SQR                              PADS: the shape last
//!  D13   Oval  1.5mm 0.9mm  Flash                      anybody's
//! ```
//!
//! What such a line leaves open (a thermal without its gap, a circle with two sizes, an aperture
//! given twice and differently) is kept as a reason, and is an error only where the Gerber file
//! draws with it.

mod prose;
mod row;

use std::collections::BTreeMap;

use crate::board::Source;
use crate::import::design;
use crate::import::digest::sha256;
use crate::import::error::printable;

use super::aperture::Template;
use super::format::{Format, Unit};
use prose::Prose;
use row::{likely_unit, rows};

/// The apertures of an RS-274-D file, and how its numbers are written where the list says so.
#[derive(Clone, Debug)]
pub struct ApertureList {
    /// The file's name without its folder.
    pub file: String,
    pub(super) entries: BTreeMap<u32, Entry>,
    pub(super) format: Option<Format>,
    /// Whether it contradicts itself in which zeros are left out.
    pub(super) contradictory: bool,
    /// The unit of the Gerber file's coordinates.
    pub(super) unit: Unit,
    /// Which unit was taken for the sizes, where the list does not say.
    pub(super) guessed: Option<&'static str>,
    /// The file as the report lists it.
    source: Source,
}

/// An aperture, or why it is none.
#[derive(Clone, Debug)]
pub(super) enum Entry {
    Known(Template),
    Unclear { line: u32, reason: String },
}

/// The largest list that is looked at: a wheel has 24 apertures, the longest list of a program some
/// thousand. Chosen.
const MOST_BYTES: usize = 1 << 20;

impl ApertureList {
    /// Reads the list `file` with content `bytes`; none where it has no aperture.
    #[must_use]
    pub fn read(file: &str, bytes: &[u8]) -> Option<Self> {
        if bytes.len() > MOST_BYTES || bytes.contains(&b'*') && bytes.contains(&b'%') {
            return None;
        }
        let text = printable_lines(bytes);
        let rows = rows(&text);
        if rows.is_empty() {
            return None;
        }
        let prose = Prose::of(&text);
        let declared = prose.unit.or_else(|| rows.iter().find_map(|row| row.unit));
        let size_unit = declared.unwrap_or_else(|| likely_unit(&rows));
        let guessed = (declared.is_none() && rows.iter().any(|row| row.unit.is_none())).then_some(size_unit);
        let mut entries = BTreeMap::new();
        for row in &rows {
            let entry = row.entry(row.unit.unwrap_or(size_unit));
            entries
                .entry(row.code)
                .and_modify(|before| merge(before, &entry, row.line))
                .or_insert_with(|| entry.clone());
        }
        let unit = prose.unit.or(declared).unwrap_or(size_unit);
        let unit = if unit == "mm" { Unit::Millimetre } else { Unit::Inch };
        let source = Source { design: hashed(&entries), ..source(file, bytes, size_unit, entries.len()) };
        let Prose { format, contradictory, .. } = prose;
        Some(Self { file: file.to_owned(), entries, format, contradictory, unit, guessed, source })
    }

    /// Whether a file named so could be a list: only such are opened unasked.
    #[must_use]
    pub fn is_named(name: &str) -> bool {
        const EXTENSIONS: [&str; 12] =
            ["apt", "gap", "rep", "apr", "whl", "ape", "apl", "apw", "lst", "rpt", "txt", "tab"];
        let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension).to_ascii_lowercase();
        EXTENSIONS.contains(&extension.as_str())
    }

    /// The file as the report lists it.
    #[must_use]
    pub const fn source(&self) -> &Source {
        &self.source
    }
}

fn source(file: &str, bytes: &[u8], unit: &str, apertures: usize) -> Source {
    Source {
        file: file.to_owned(),
        format: "aperture-list".to_owned(),
        role: "apertures".to_owned(),
        units: unit.to_owned(),
        number_format: String::new(),
        sha256: sha256(bytes),
        design: String::new(),
        bytes: bytes.len() as u64,
        counts: BTreeMap::from([("apertures".to_owned(), apertures as u64)]),
        generator: None,
        apertures: Vec::new(),
    }
}

/// The hash of what the list has; of what it leaves unclear, the reason.
fn hashed(entries: &BTreeMap<u32, Entry>) -> String {
    let text = |entry: &Entry| match entry {
        Entry::Known(template) => template.describe(),
        Entry::Unclear { reason, .. } => reason.clone(),
    };
    let texts: Vec<(u32, String)> = entries.iter().map(|(&code, entry)| (code, text(entry))).collect();
    design::of_texts(texts.iter().map(|(code, text)| (*code, text.as_str())))
}

/// The lines, blanks and control characters as spaces.
fn printable_lines(bytes: &[u8]) -> Vec<String> {
    bytes.split(|b| matches!(b, b'\n' | b'\r')).map(|line| printable(line).to_ascii_uppercase()).collect()
}

/// The same code twice: fine where it is the same aperture, as a list by purpose has it.
fn merge(before: &mut Entry, again: &Entry, line: u32) {
    let same = match (&*before, again) {
        (Entry::Known(a), Entry::Known(b)) => a.describe() == b.describe(),
        _ => false,
    };
    if !same {
        *before = Entry::Unclear { line, reason: "it is defined twice, differently".to_owned() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::gerber::format::Zeros;

    fn described(text: &str) -> Vec<String> {
        let list = ApertureList::read("f.apt", text.as_bytes()).expect("a list");
        let what = |entry: &Entry| match entry {
            Entry::Known(template) => template.describe(),
            Entry::Unclear { reason, .. } => format!("unclear: {reason}"),
        };
        list.entries.iter().map(|(code, entry)| format!("D{code} {}", what(entry))).collect()
    }

    #[test]
    fn every_layout_comes_to_the_same() {
        let expected = ["D10 circle 0.254 mm", "D11 rectangle 1.524 × 1.905 mm"];
        for text in [
            "D10  ROUNDED 10.000 10.000 0.000 LINE\nD11 RECTANGULAR 60.000 75.000 0.000 FLASH\n",
            "D010 round 0.010\r\nD010 draw 0.010\r\nD011 rectangle 0.060 x 0.075\r\n",
            "Position Width\n10 10 0 LINE\n11 60 75 RECTANGLE\n",
            "D10 Circle 0.254mm\nD11 Rect 1.524mm X 1.905mm\n",
            "1  D10  R10  Round  Draw\n2  D11  60x75  Rect  Flash\n",
            "CIRCLE 10 D10\nRECTANGLE 60 75 D11\n",
        ] {
            assert_eq!(described(text), expected, "{text}");
        }
    }

    #[test]
    fn what_a_line_leaves_open_is_kept_as_the_reason() {
        let unclear = described(
            "D20 Thermal Round 90 60\nD21 circle 50 30\nD22 round 5\nD22 round 6\nD23 square 60 100\n",
        );
        assert!(unclear.iter().all(|what| what.contains("unclear")), "{unclear:?}");
    }

    #[test]
    fn the_format_stands_in_the_prose() {
        let list = ApertureList::read(
            "f.rep",
            b"Data format 2.3, inch, absolute\nleading zeros suppressed\n10 circle trace 0.050\n",
        )
        .expect("a list");
        let format = list.format.expect("a format");
        assert_eq!((format.x, format.zeros, format.incremental), ((2, 3), Zeros::Leading, false), "2.3");
        assert!(list.guessed.is_none(), "the unit is named");
    }

    #[test]
    fn units_are_named_whatever_the_prose_is() {
        let size = |prose: &str| {
            let text = format!("{prose}\nD10 ROUND 0.5\n");
            let list = ApertureList::read("f.apt", text.as_bytes()).expect("a list");
            (described(&text)[0].clone(), list.guessed.is_some())
        };
        let of = |mm: &str, is_guessed: bool| (format!("D10 circle {mm} mm"), is_guessed);
        for (prose, expected) in [
            ("Apertures used in job TOP", of("0.5", true)),
            ("All sizes are in mm.", of("0.5", false)),
            ("Sizes in mils.", of("0.0127", false)),
            ("Units: in", of("12.7", false)),
            ("METRIC: OFF\nUNITS: INCH", of("12.7", false)),
            ("Format 2.3, metric, no zero suppression", of("0.5", false)),
        ] {
            assert_eq!(size(prose), expected, "{prose}");
        }
    }

    #[test]
    fn squares_of_three_sizes_are_rectangles() {
        let found = described("D10 SQUARE 60 100 0\nD11 OCTAGON 60 100 0\nD12 SQUARE 60 60 0\nUnits: mil\n");
        assert_eq!(found[0], "D10 rectangle 1.524 × 2.54 mm", "x, y and hole");
        assert!(found[1].contains("unclear"), "{found:?}");
        assert_eq!(found[2], "D12 rectangle 1.524 × 1.524 mm", "a square");
    }

    #[test]
    fn what_a_line_denies_is_not_said() {
        let zeros = |prose: &str| {
            let text = format!("FORMAT 2.3\n{prose}\nD10 ROUND 60\n");
            let list = ApertureList::read("f.apt", text.as_bytes()).expect("a list");
            assert_eq!(list.format.is_none(), list.contradictory, "{prose}");
            list.format.map(|format| format.zeros)
        };
        for (prose, expected) in [
            ("LEADING ZERO SUPPRESSION: ON\nTRAILING ZERO SUPPRESSION: OFF", Some(Zeros::Leading)),
            ("Suppress trailing zeros: no", Some(Zeros::Leading)),
            ("Leading zeros omitted: none\nTrailing zeros omitted", Some(Zeros::Trailing)),
            ("Leading zero suppression off", Some(Zeros::Trailing)),
            ("Trailing zeros off", Some(Zeros::Trailing)),
            ("Leading zeros suppressed\nTrailing zeros suppressed", None),
            ("Suppress trailing zeros: no\nTrailing zeros suppressed", None),
        ] {
            assert_eq!(zeros(prose), expected, "{prose}");
        }
    }

    #[test]
    fn prose_is_no_list() {
        for text in ["", "D10 is used for traces, see page 12\n", "the round hole 10 is 3 mm wide, D11\nx"] {
            let list = ApertureList::read("f.txt", text.as_bytes());
            assert!(list.is_none(), "{text}: {list:?}");
        }
    }
}
