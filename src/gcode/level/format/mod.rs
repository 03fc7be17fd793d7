//! The files in which touches come: one file and one constant each, listed in [`FORMATS`], told
//! apart by what is in them.

mod bcnc;
mod candle;
mod columns;
mod grbl;
mod json;
mod opencncpilot;

use crate::geometry::Nm;

use super::error::MapError;
use super::height_map::HeightMap;
use super::touch::Touch;

/// What a file does not say of its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// The length that its numbers count.
    pub unit: Nm,
    /// Where the work's zero is in its coordinates; none where they count from there, or where it
    /// says so itself.
    pub zero: Option<[Nm; 3]>,
}

/// Millimetres from the work's zero.
impl Default for Frame {
    fn default() -> Self {
        Self { unit: Nm::from_mm(1), zero: None }
    }
}

/// Touched points.
type Touches = Vec<Touch>;

/// A kind of file with touches in it.
#[derive(Debug)]
pub struct Format {
    /// What it is, as a person says it.
    pub name: &'static str,
    recognises: fn(&str) -> bool,
    /// The touches in its own numbers, those that count from the machine's zero moved to the work's
    /// where the file says how.
    read: fn(&str, &Frame) -> Result<Touches, MapError>,
}

/// All that are read; of several that recognise a file the first reads it.
pub const FORMATS: &[Format] =
    &[opencncpilot::OPENCNCPILOT, grbl::GRBL, json::JSON, candle::CANDLE, bcnc::BCNC, columns::COLUMNS];

impl HeightMap {
    /// The map in a file, and what kind of file that is.
    ///
    /// # Errors
    ///
    /// [`MapError`] for a text that is no map, or whose touches are no grid.
    pub fn read(text: &str, frame: &Frame) -> Result<(Self, &'static Format), MapError> {
        let format = FORMATS.iter().find(|format| (format.recognises)(text)).ok_or(MapError::Unknown)?;
        let unit = frame.unit.to_f64();
        let zero = frame.zero.map_or([0.0; 3], |zero| zero.map(Nm::to_f64));
        let placed = |touch: Touch| Touch {
            place: [0, 1, 2].map(|axis| touch.place[axis] * unit - zero[axis]),
            ..touch
        };
        let touches: Vec<_> = (format.read)(text, frame)?.into_iter().map(placed).collect();
        Ok((Self::touched(&touches)?, format))
    }
}

/// The numbers of a line between blanks, commas or semicolons; none where something else is among
/// them.
fn numbers(line: &str) -> Option<Vec<f64>> {
    let parts = line.split([' ', '\t', ',', ';']).map(str::trim).filter(|part| !part.is_empty());
    let number = |part: &str| {
        let value: f64 = part.parse().ok()?;
        // Beyond a kilometre there is no machine, and `inf` and `nan` parse too.
        (value.abs() < 1e6).then_some(value)
    };
    parts.map(number).collect()
}

/// Lines that say something, with their numbers from 1.
fn content(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = (1..).zip(text.lines().map(str::trim));
    lines.filter(|(_, line)| !line.is_empty() && !line.starts_with(['#', ';', '(', '%']))
}

/// The numbers of a line that has one of these counts of them.
fn exact(line: usize, text: &str, counts: &[usize], expected: &'static str) -> Result<Vec<f64>, MapError> {
    let wrong = |expected| Err(MapError::Line { line, text: text.to_owned(), expected });
    if has_decimal_commas(text) {
        return wrong("expected decimal points in numbers, such as 0.5: a comma separates them");
    }
    match numbers(text) {
        Some(numbers) if counts.contains(&numbers.len()) => Ok(numbers),
        _ => wrong(expected),
    }
}

/// The touch of a line that has one of these counts of numbers, which begin with x, y and z.
fn touch(line: usize, text: &str, counts: &[usize], expected: &'static str) -> Result<Touch, MapError> {
    match exact(line, text, counts, expected)?[..] {
        [x, y, z, ..] => Ok(Touch { line, place: [x, y, z] }),
        _ => Err(MapError::Line { line, text: text.to_owned(), expected }),
    }
}

/// Whether commas stand within the numbers of a line: something else parts them.
fn has_decimal_commas(text: &str) -> bool {
    let is_within = |at: usize| {
        let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        digit(text[..at].chars().next_back()) && digit(text[at + 1..].chars().next())
    };
    let parts = text.split([' ', '\t', ';']).filter(|part| !part.trim_matches(',').is_empty());
    parts.count() > 1 && text.match_indices(',').any(|(at, _)| is_within(at))
}
