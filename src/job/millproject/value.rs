//! The values of a pcb2gcode project: numbers with its units, lists, flags.

use crate::geometry::{Nm, nanometres};
use crate::job::Error;
use crate::job::overlap::Overlap;
use crate::job::quantity::{Length, Wait};
use crate::toolpath::Feed;

/// What bare numbers count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Units {
    /// Inches.
    Inches,
    /// Millimetres.
    Metric,
}

/// A line of a project.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry<'a> {
    pub(super) name: &'a str,
    pub(super) value: &'a str,
    pub(super) line: usize,
}

/// What is wrong with a line.
#[derive(Debug)]
pub(super) struct Wrong {
    line: usize,
    problem: String,
}

impl Wrong {
    pub(super) const fn line(&self) -> usize {
        self.line
    }

    pub(super) fn into_error(self, file: &str) -> Error {
        Error::Settings { file: file.to_owned(), line: self.line, column: 1, problem: self.problem }
    }
}

/// The options of a text, without comments.
pub(super) fn entries(text: &str) -> impl Iterator<Item = Result<Entry<'_>, Wrong>> {
    // Some editors begin a file with a mark of the order of its bytes.
    let text = text.trim_start_matches('\u{feff}');
    let lines =
        (1..).zip(text.lines()).map(|(line, text)| (line, text.split('#').next().unwrap_or_default().trim()));
    lines.filter(|(_, text)| !text.is_empty()).map(|(line, text)| {
        let (name, value) = text.split_once('=').ok_or_else(|| Wrong {
            line,
            problem: format!("`{text}`: expected option=value, as in a millproject"),
        })?;
        Ok(Entry { name: name.trim(), value: value.trim(), line })
    })
}

impl Entry<'_> {
    pub(super) fn wrong(&self, expected: &str) -> Wrong {
        Wrong { line: self.line, problem: format!("`{} = {}`: expected {expected}", self.name, self.value) }
    }

    pub(super) fn flag(&self) -> Result<bool, Wrong> {
        match self.value.to_ascii_lowercase().as_str() {
            "1" | "true" | "yes" | "on" => Ok(true),
            "0" | "false" | "no" | "off" => Ok(false),
            _ => Err(self.wrong("true or false")),
        }
    }

    pub(super) fn length(&self, units: Units) -> Result<Nm, Wrong> {
        length(self.value, units).ok_or_else(|| self.wrong("a length, such as 0.2mm or a bare number"))
    }

    /// What stands between commas, or between blanks where those do not part a number from its
    /// unit.
    pub(super) fn parts(&self) -> Vec<&str> {
        let is_unit = |part: &str| part.starts_with(|c: char| c.is_ascii_alphabetic());
        let between = |part: &str| part.split_whitespace().any(is_unit);
        let commas = self.value.split(',').map(str::trim).filter(|part| !part.is_empty());
        commas
            .flat_map(|part| if between(part) { vec![part] } else { part.split_whitespace().collect() })
            .collect()
    }

    /// Lengths between commas or blanks.
    pub(super) fn lengths(&self, units: Units) -> Result<Vec<Nm>, Wrong> {
        let parts = self.parts().into_iter();
        parts
            .map(|part| length(part, units).ok_or_else(|| self.wrong("lengths, separated by commas")))
            .collect()
    }

    /// A length above zero.
    pub(super) fn positive(&self, units: Units) -> Result<Nm, Wrong> {
        let length = self.length(units)?;
        if length > Nm::ZERO { Ok(length) } else { Err(self.wrong("a length above zero")) }
    }

    /// A width; none for one that is wider than any board.
    pub(super) fn width(&self, units: Units) -> Result<Option<Nm>, Wrong> {
        let width = with_unit(self.value, units).filter(|&nm| nm >= 0);
        let width = width.ok_or_else(|| self.wrong("a width, such as 0.5mm or a bare number"))?;
        Ok(Nm::try_new(width).ok().filter(|&width| width < ANY_BOARD))
    }

    pub(super) fn feed(&self, units: Units) -> Result<Feed, Wrong> {
        let (way, time) = per(self.value);
        let feed =
            with_unit(way, units).and_then(|way| Feed::try_new(way.checked_mul(a_minute(time)?)? / 1000));
        feed.ok_or_else(|| self.wrong("a speed above zero, such as 200mm/min or a bare number"))
    }

    /// Turns per minute, to the nearest.
    pub(super) fn turns(&self) -> Result<u32, Wrong> {
        let (turns, time) = per(self.value);
        let end = turns.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(turns.len());
        let (number, unit) = (turns[..end].trim(), turns[end..].trim());
        let is_turns = matches!(
            unit,
            "" | "rpm" | "rotation" | "rotations" | "revolution" | "revolutions" | "turn" | "turns"
        );
        // A decimal is read exactly, as any other: a turn counts a million here.
        let millionths = is_turns.then(|| nanometres(&format!("{number}mm")).ok()).flatten();
        let a_minute = millionths.zip(a_minute(time)).and_then(|(turns, times)| turns.checked_mul(times));
        let turns = a_minute.filter(|&turns| turns >= 0).map(|turns| (turns + 500_000) / 1_000_000);
        turns.and_then(|turns| u32::try_from(turns).ok()).ok_or_else(|| self.wrong("revolutions per minute"))
    }

    /// A time; a bare number counts milliseconds.
    pub(super) fn wait(&self) -> Result<Wait, Wrong> {
        let end = self.value.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(self.value.len());
        let (number, unit) = (self.value[..end].trim(), self.value[end..].trim());
        let wait = match unit {
            "" | "ms" | "millisecond" | "milliseconds" => format!("{number}ms").parse().ok(),
            "s" | "sec" | "second" | "seconds" => format!("{number}s").parse().ok(),
            _ => None,
        };
        wait.ok_or_else(|| self.wrong("a time, such as 3s"))
    }

    pub(super) fn count(&self) -> Result<u32, Wrong> {
        self.value.parse().map_err(|_| self.wrong("a whole number"))
    }

    /// A part of a kerf, or a length.
    pub(super) fn overlap(&self, units: Units) -> Result<Overlap, Wrong> {
        if self.value.ends_with('%') {
            return self.value.parse().map_err(|_| self.wrong("a length, or less than 100%"));
        }
        length(self.value, units)
            .map(|nm| Overlap::Length(Length(nm)))
            .ok_or_else(|| self.wrong("a length or a part of the cutter, such as 50%"))
    }
}

/// Wider than any board. Chosen: pcb2gcode's users write metres where they mean that all is to be
/// cleared.
const ANY_BOARD: Nm = Nm::from_mm(1000);

/// A quantity and the time that it is counted in, a minute where none is said: `200mm/s`,
/// `30 rotations per second`.
fn per(text: &str) -> (&str, &str) {
    let parts = text.split_once('/').or_else(|| text.split_once(" per "));
    let (quantity, time) = parts.unwrap_or((text, "min"));
    (quantity.trim(), time.trim())
}

/// How often a minute has this time.
fn a_minute(time: &str) -> Option<i64> {
    match time {
        "min" | "minute" | "minutes" => Some(1),
        "s" | "sec" | "second" | "seconds" => Some(60),
        _ => None,
    }
}

/// The nanometres of a number with the units that pcb2gcode knows, or none.
fn with_unit(text: &str, units: Units) -> Option<i64> {
    let text = text.trim();
    let end = text.find(|c: char| c.is_ascii_alphabetic() || c == '"').unwrap_or(text.len());
    let (number, unit) = (text[..end].trim(), text[end..].trim());
    let (unit, times) = match (unit, units) {
        ("", Units::Inches) | ("in" | "inch" | "inches" | "\"", _) => ("in", 1),
        ("", Units::Metric) | ("mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres", _) => {
            ("mm", 1)
        }
        ("cm" | "centimeter" | "centimeters", _) => ("cm", 1),
        ("m" | "meter" | "meters" | "metre" | "metres", _) => ("mm", 1000),
        ("um" | "micrometer" | "micrometers", _) => ("um", 1),
        ("thou" | "mil" | "mils", _) => ("mil", 1),
        _ => return None,
    };
    nanometres(&format!("{number}{unit}")).ok()?.checked_mul(times)
}

fn length(text: &str, units: Units) -> Option<Nm> {
    Nm::try_new(with_unit(text, units)?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bare_numbers_are_inches_unless_the_project_is_metric() {
        for (text, units, nm) in [
            ("0.1", Units::Inches, 2_540_000),
            ("0.1", Units::Metric, 100_000),
            ("-.5mm", Units::Inches, -500_000),
            ("8 mil", Units::Metric, 203_200),
            ("0.002m", Units::Inches, 2_000_000),
        ] {
            assert_eq!(length(text, units), Some(Nm::new(nm)), "{text}");
        }
        for text in ["", "mm", "1 furlong", "1e3", "--1", "500 m"] {
            assert_eq!(length(text, Units::Metric), None, "{text}");
        }
    }

    #[test]
    fn speeds_and_turns_carry_units_or_none() {
        let entry = |value| Entry { name: "x", value, line: 1 };
        for (text, feed) in [
            ("10", "254mm/min"),
            ("5mm/s", "300mm/min"),
            ("200mm/min", "200mm/min"),
            ("60", "1524mm/min"),
            ("1.5 m/min", "1500mm/min"),
            ("10 thou/second", "15.24mm/min"),
            ("3 inches per minute", "76.2mm/min"),
        ] {
            assert_eq!(entry(text).feed(Units::Inches).expect(text).to_string(), feed, "{text}");
        }
        for (text, milliseconds) in [("2 s", 2000), ("1.5sec", 1500), ("40", 40), ("250 ms", 250)] {
            assert_eq!(entry(text).wait().expect(text), Wait { milliseconds }, "{text}");
        }
        assert!(entry("3 fortnights").wait().is_err() && entry("-1s").wait().is_err(), "no time");
        for (text, turns) in [
            ("12000 rpm", 12_000),
            ("200rotations/second", 12_000),
            ("0.5 rotations per second", 30),
            ("1000.4", 1000),
        ] {
            assert_eq!(entry(text).turns().expect(text), turns, "{text}");
        }
        assert!(entry("12 hertz").turns().is_err() && entry("3 rpm/hour").turns().is_err(), "no turns");
        assert_eq!(entry("2000mm").width(Units::Inches).expect("a width"), None, "everything");
        assert_eq!(entry("15").width(Units::Metric).expect("a width"), Some(Nm::from_mm(15)), "a width");
        assert!(entry("-1").width(Units::Metric).is_err(), "no width");
        for text in ["1mm,2mm", "1 mm, 2 mm", "1mm 2mm", "0.1 cm,2"] {
            let both = vec![Nm::from_mm(1), Nm::from_mm(2)];
            assert_eq!(entry(text).lengths(Units::Metric).expect(text), both, "{text}");
        }
        assert!(entry("-1").turns().is_err() && entry("0").feed(Units::Metric).is_err(), "no sense");
    }
}
