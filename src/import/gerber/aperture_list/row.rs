//! A line of a list that is an aperture: its code, the word for its shape, its sizes.

use crate::geometry::Nm;
use crate::import::gerber::aperture::{Hole, Template};

use super::Entry;

/// A line that describes an aperture.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) line: u32,
    pub(super) code: u32,
    shape: Shape,
    /// As they are written, without their units.
    sizes: Vec<String>,
    /// The unit behind a size.
    pub(super) unit: Option<&'static str>,
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

/// The lines that are apertures. Where any has its code with a `D`, all must; else the first number
/// is the code.
pub(super) fn rows(text: &[String]) -> Vec<Row> {
    let read = |with_d: bool| -> Vec<Row> {
        (1..).zip(text).filter_map(|(line, text)| row(line, text, with_d)).collect()
    };
    let rows = read(true);
    if rows.is_empty() { read(false) } else { rows }
}

/// `text` as an aperture, in a list that writes codes with a `D` or without.
pub(super) fn row(line: u32, text: &str, with_d: bool) -> Option<Row> {
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
pub(super) fn unit_of(word: &str) -> Option<&'static str> {
    Some(match word {
        "MM" | "MILLIMETER" | "MILLIMETERS" | "MILLIMETRE" | "MILLIMETRES" | "METRIC" => "mm",
        "MIL" | "MILS" | "THOU" => "mil",
        "IN" | "INCH" | "INCHES" | "\"" => "in",
        _ => return None,
    })
}

/// The unit by the middle size: wheels hold from 5 mils to 250, which in inches is below an eighth.
pub(super) fn likely_unit(rows: &[Row]) -> &'static str {
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
    pub(super) fn entry(&self, unit: &str) -> Entry {
        let unclear = |reason: &str| Entry::Unclear { line: self.line, reason: reason.to_owned() };
        let lengths: Option<Vec<Nm>> =
            self.sizes.iter().take(3).map(|size| format!("{size}{unit}").parse().ok()).collect();
        let Some(lengths) = lengths else { return unclear("its size cannot be read") };
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
            Shape::Square if three && second != Nm::ZERO => {
                Template::Rectangle { width: first, height: second, hole }
            }
            Shape::Square | Shape::Octagon if second != Nm::ZERO && second != first => {
                return unclear("it is as wide as high, but has two sizes");
            }
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
            Shape::Special(what) => return unclear(&format!("{what}, whose shape the list does not define")),
        })
    }
}

/// An octagon as wide as `size` between its sides, two of them upright.
fn octagon(size: Nm, hole: Hole) -> Template {
    let diameter = Nm::from_f64(size.to_f64() / libm::cos(std::f64::consts::FRAC_PI_8));
    Template::Polygon { diameter, vertices: 8, rotation: 22.5, hole }
}
