//! Aperture lists: what a plotter's wheel holds, in a file beside an RS-274-D Gerber file.
//!
//! There is no standard. Every program printed a table for a person at the plotter, so the table is read as that person
//! reads it: a line that has a D code, a word for a shape and one to three sizes is an aperture, whatever stands around
//! them; all else is prose, in which units and the number format are looked for.
//!
//! ```text
//!  D10   ROUNDED      12.000  12.000  0.000  LINE      Protel: x, y, hole; mils
//!  D011  rectangle    0.060 x 0.075                    Eagle's wheels: inches, or a unit behind each number
//!  12    60   0       SQR                              PADS: the shape last
//!  D13   Oval  1.5mm 0.9mm  Flash                      anybody's
//! ```
//!
//! What such a line leaves open (a thermal without its gap, a circle with two sizes, an aperture given twice and
//! differently) is kept as a reason, and is an error only where the Gerber file draws with it.

use std::collections::BTreeMap;

use crate::board::Source;
use crate::geometry::Nm;
use crate::import::digest::sha256;
use crate::import::error::printable;

use super::aperture::{Hole, Template};
use super::state::{Format, Unit, Zeros};

/// The apertures of an RS-274-D file, and how its numbers are written where the list says so.
#[derive(Clone, Debug)]
pub struct ApertureList {
    /// The file's name without its folder.
    pub file: String,
    pub(super) entries: BTreeMap<u32, Entry>,
    pub(super) format: Option<Format>,
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

/// The largest list that is looked at: a wheel has 24 apertures, the longest list of a program some thousand.
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
        let said = prose.unit.or_else(|| rows.iter().find_map(|row| row.unit));
        let size_unit = said.unwrap_or_else(|| likely_unit(&rows));
        let guessed = (said.is_none() && rows.iter().any(|row| row.unit.is_none())).then_some(size_unit);
        let mut entries = BTreeMap::new();
        for row in &rows {
            let entry = row.entry(row.unit.unwrap_or(size_unit));
            entries
                .entry(row.code)
                .and_modify(|before| merge(before, &entry, row.line))
                .or_insert_with(|| entry.clone());
        }
        let unit = prose.unit.or(said).unwrap_or(size_unit);
        let unit = if unit == "mm" { Unit::Millimetre } else { Unit::Inch };
        let source = source(file, bytes, size_unit, entries.len());
        Some(Self { file: file.to_owned(), entries, format: prose.format, unit, guessed, source })
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
        bytes: bytes.len() as u64,
        counts: BTreeMap::from([("apertures".to_owned(), apertures as u64)]),
        generator: None,
        apertures: Vec::new(),
    }
}

/// The lines, blanks and control characters as spaces.
fn printable_lines(bytes: &[u8]) -> Vec<String> {
    bytes.split(|b| matches!(b, b'\n' | b'\r')).map(|line| printable(line).to_ascii_uppercase()).collect()
}

/// A line that describes an aperture.
#[derive(Debug)]
struct Row {
    line: u32,
    code: u32,
    shape: Shape,
    /// As they are written, without their units.
    sizes: Vec<String>,
    /// The unit behind a size.
    unit: Option<&'static str>,
}

/// What a word for a shape means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Round,
    Square,
    Rectangle,
    Oval,
    Octagon,
    Ring,
    /// One that a line of a list does not describe.
    Special(&'static str),
}

/// Words for shapes. `LINE` and `DRAW` say what an aperture is for; alone they mean a round one.
const SHAPES: &[(&str, Shape)] = &[
    ("ROUND", Shape::Round),
    ("ROUNDED", Shape::Round),
    ("RND", Shape::Round),
    ("CIRCLE", Shape::Round),
    ("CIRCULAR", Shape::Round),
    ("SQUARE", Shape::Square),
    ("SQR", Shape::Square),
    ("SQRL", Shape::Square),
    ("RECTANGLE", Shape::Rectangle),
    ("RECTANGULAR", Shape::Rectangle),
    ("RECT", Shape::Rectangle),
    ("OVAL", Shape::Oval),
    ("OBLONG", Shape::Oval),
    ("OBROUND", Shape::Oval),
    ("OCTAGON", Shape::Octagon),
    ("OCTAGONAL", Shape::Octagon),
    ("ANNULUS", Shape::Ring),
    ("ANNULAR", Shape::Ring),
    ("ANNL", Shape::Ring),
    ("DONUT", Shape::Ring),
    ("THERMAL", Shape::Special("a thermal")),
    ("THER", Shape::Special("a thermal")),
    ("RELIEF", Shape::Special("a thermal")),
    ("TARGET", Shape::Special("a target")),
    ("CROSS", Shape::Special("a cross")),
];

/// The lines that are apertures. Where any has its code with a `D`, all must; else the first number is the code.
fn rows(text: &[String]) -> Vec<Row> {
    let read = |with_d: bool| -> Vec<Row> {
        (1..).zip(text).filter_map(|(line, text)| row(line, text, with_d)).collect()
    };
    let rows = read(true);
    if rows.is_empty() { read(false) } else { rows }
}

fn row(line: u32, text: &str, with_d: bool) -> Option<Row> {
    let words: Vec<&str> = text
        .split(|c: char| c.is_whitespace() || ",;|:=()[]".contains(c))
        .filter(|w| !w.is_empty())
        .collect();
    let code_of = |word: &str| {
        let digits = if with_d { word.strip_prefix('D')? } else { word };
        let plain = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
        plain.then(|| digits.parse::<u32>().ok()).flatten().filter(|code| (10..10_000).contains(code))
    };
    let (at, code) = words.iter().enumerate().find_map(|(at, word)| Some((at, code_of(word)?)))?;
    if !with_d && at > 0 {
        return None; // a number somewhere in a sentence
    }
    let known = |word: &&str| SHAPES.iter().find(|(name, _)| name == word).map(|&(_, shape)| shape);
    let shapes: Vec<Shape> = words.iter().filter_map(known).collect();
    // A thermal is called round or square besides.
    let special = shapes.iter().find(|shape| matches!(shape, Shape::Special(_)));
    let shape = special.or(shapes.first()).copied();
    let shape =
        shape.or_else(|| words.iter().any(|w| matches!(*w, "LINE" | "DRAW")).then_some(Shape::Round))?;
    // Behind the shape may stand what is no size, such as how often the aperture is used.
    let behind = &words[at + 1..];
    let tells = |word: &&&str| known(word).is_some() || matches!(**word, "LINE" | "DRAW");
    let shape_at = behind.iter().position(|word| tells(&word)).unwrap_or(0);
    // `CIRCLE 10 D10`, and not a sentence that ends with a code.
    let turned = at > 0 && known(&words[0]).is_some();
    let places = [&behind[..shape_at], behind, if turned { &words[..at] } else { &[] }];
    let (sizes, unit) = places.into_iter().map(sizes).find(|(sizes, _)| !sizes.is_empty())?;
    Some(Row { line, code, shape, sizes, unit })
}

/// The numbers among `words`, `60`, `0.060X0.075`, `1.5MM`, `R10`; and the unit behind any.
fn sizes(words: &[&str]) -> (Vec<String>, Option<&'static str>) {
    let mut sizes = Vec::new();
    let mut unit = None;
    for part in words.iter().flat_map(|word| word.split('X')) {
        let start = part.trim_start_matches(['R', 'S']);
        let end = start.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(start.len());
        let (number, rest) = start.split_at(end);
        let is_number =
            number.bytes().any(|b| b.is_ascii_digit()) && number.bytes().filter(|&b| b == b'.').count() < 2;
        if is_number && (rest.is_empty() || unit_of(rest).is_some()) {
            sizes.push(number.to_owned());
            unit = unit.or(unit_of(rest));
        } else if !sizes.is_empty() {
            unit = unit.or(unit_of(part));
        }
    }
    (sizes, unit)
}

/// The unit that a word names, as [`Nm`] reads it.
fn unit_of(word: &str) -> Option<&'static str> {
    Some(match word {
        "MM" | "MILLIMETER" | "MILLIMETERS" | "MILLIMETRE" | "MILLIMETRES" | "METRIC" => "mm",
        "MIL" | "MILS" | "THOU" => "mil",
        "IN" | "INCH" | "INCHES" | "\"" => "in",
        _ => return None,
    })
}

/// The unit by the middle size: wheels hold from 5 mils to 250, which in inches is below an eighth.
fn likely_unit(rows: &[Row]) -> &'static str {
    let value = |text: &String| text.parse::<f64>().ok().filter(|size| *size > 0.0);
    let mut sizes: Vec<f64> = rows.iter().filter_map(|row| value(row.sizes.first()?)).collect();
    sizes.sort_by(f64::total_cmp);
    match sizes.get(sizes.len() / 2) {
        Some(size) if *size < 0.125 => "in",
        Some(size) if *size < 4.0 => "mm",
        _ => "mil",
    }
}

impl Row {
    /// The aperture, its sizes in `unit`.
    fn entry(&self, unit: &str) -> Entry {
        let unclear = |reason: &str| Entry::Unclear { line: self.line, reason: reason.to_owned() };
        let lengths: Option<Vec<Nm>> =
            self.sizes.iter().take(3).map(|size| format!("{size}{unit}").parse().ok()).collect();
        let Some(lengths) = lengths else { return unclear("its size is none") };
        let (first, second) = (lengths[0], lengths.get(1).copied().unwrap_or(Nm::ZERO));
        // Three sizes are x, y and the hole.
        let hole = match lengths.get(2) {
            Some(hole) if *hole > Nm::ZERO => Hole::Round(*hole),
            _ => Hole::None,
        };
        let three = lengths.len() == 3;
        Entry::Known(match self.shape {
            Shape::Round if second == Nm::ZERO || second == first => {
                Template::Circle { diameter: first, hole }
            }
            Shape::Round if three => Template::Obround { width: first, height: second, hole },
            Shape::Round => return unclear("it is round, but has two sizes"),
            Shape::Square => Template::Rectangle { width: first, height: first, hole },
            Shape::Rectangle | Shape::Oval if second == Nm::ZERO => {
                return unclear("it has a width, but no height");
            }
            Shape::Rectangle => Template::Rectangle { width: first, height: second, hole },
            Shape::Oval => Template::Obround { width: first, height: second, hole },
            Shape::Octagon => octagon(first, hole),
            Shape::Ring if second == Nm::ZERO => Template::Circle { diameter: first, hole: Hole::None },
            Shape::Ring => {
                Template::Circle { diameter: first.max(second), hole: Hole::Round(first.min(second)) }
            }
            Shape::Special(what) => return unclear(&format!("{what}, which a list does not describe")),
        })
    }
}

/// An octagon as wide as `size` between its sides, two of them upright.
fn octagon(size: Nm, hole: Hole) -> Template {
    let diameter = Nm::from_f64(size.to_f64() / libm::cos(std::f64::consts::FRAC_PI_8));
    Template::Polygon { diameter, vertices: 8, rotation: 22.5, hole }
}

/// The same code twice: fine where it is the same aperture, as a list by purpose has it.
fn merge(before: &mut Entry, again: &Entry, line: u32) {
    let same = match (&*before, again) {
        (Entry::Known(a), Entry::Known(b)) => a.describe() == b.describe(),
        _ => false,
    };
    if !same {
        *before = Entry::Unclear { line, reason: "it stands there twice, and differs".to_owned() };
    }
}

/// What the lines say that are no apertures.
#[derive(Debug, Default)]
struct Prose {
    /// None where nothing or several are named.
    unit: Option<&'static str>,
    format: Option<Format>,
}

impl Prose {
    fn of(text: &[String]) -> Self {
        let all = || text.iter().filter(|line| row(0, line, true).is_none() && row(0, line, false).is_none());
        let words = |line: &str| -> Vec<String> {
            line.split(|c: char| !c.is_ascii_alphanumeric() && c != '.').map(str::to_owned).collect()
        };
        let mut units: Vec<&'static str> =
            all().flat_map(|line| words(line)).filter_map(|word| unit_of(&word)).collect();
        // `in` is a word of prose besides.
        if units.iter().any(|unit| *unit != "in") {
            units.retain(|unit| *unit != "in");
        }
        units.sort_unstable();
        units.dedup();
        let unit = if let [unit] = units[..] { Some(unit) } else { None };
        let digits = all().filter(|line| line.contains("FORMAT")).find_map(|line| digits(line));
        let says = |what: &str| {
            let omits =
                |line: &&String| ["SUPPRESS", "OMIT", "OFF", "REMOVE"].iter().any(|word| line.contains(word));
            all().filter(omits).any(|line| line.contains(what))
        };
        let zeros = if says("TRAILING") { Zeros::Trailing } else { Zeros::Leading };
        let incremental = all().any(|line| line.contains("INCREMENTAL") && !line.contains("ABSOLUTE"));
        Self { unit, format: digits.map(|digits| Format { zeros, incremental, x: digits, y: digits }) }
    }
}

/// `2.3`, `2:4`: digits before and after the point.
fn digits(line: &str) -> Option<(u32, u32)> {
    let found = line.as_bytes().windows(3).enumerate().find(|(at, window)| {
        let alone = |byte: Option<&u8>| byte.is_none_or(|b| !b.is_ascii_digit() && *b != b'.');
        let before = at.checked_sub(1).and_then(|at| line.as_bytes().get(at));
        matches!(window, [b'0'..=b'6', b'.' | b':', b'0'..=b'6'])
            && alone(before)
            && alone(line.as_bytes().get(at + 3))
    })?;
    Some((u32::from(found.1[0] - b'0'), u32::from(found.1[2] - b'0')))
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let unclear = described("D20 Thermal Round 90 60\nD21 circle 50 30\nD22 round 5\nD22 round 6\n");
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
    fn prose_is_no_list() {
        for text in ["", "D10 is used for traces, see page 12\n", "the round hole 10 is 3 mm wide, D11\nx"] {
            let list = ApertureList::read("f.txt", text.as_bytes());
            assert!(list.is_none(), "{text}: {list:?}");
        }
    }
}
