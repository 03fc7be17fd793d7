use crate::geometry::Nm;
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
    pub(super) fn into_error(self, file: &str) -> Error {
        Error::Settings { file: file.to_owned(), line: self.line, column: 1, problem: self.problem }
    }
}

/// The options of a text, without comments.
pub(super) fn entries(text: &str) -> impl Iterator<Item = Result<Entry<'_>, Wrong>> {
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

    /// The depth of a z below zero.
    pub(super) fn depth(&self, units: Units) -> Result<Nm, Wrong> {
        let depth = -self.length(units)?;
        if depth > Nm::ZERO { Ok(depth) } else { Err(self.wrong("a z below zero")) }
    }

    /// Lengths between commas or blanks.
    pub(super) fn lengths(&self, units: Units) -> Result<Vec<Nm>, Wrong> {
        let parts = self.value.split([',', ' ']).filter(|part| !part.is_empty());
        parts.map(|part| length(part, units).ok_or_else(|| self.wrong("lengths between commas"))).collect()
    }

    pub(super) fn feed(&self, units: Units) -> Result<Feed, Wrong> {
        let (way, time) = self.value.split_once('/').unwrap_or((self.value, "min"));
        let time = match time.trim() {
            "min" | "minute" | "minutes" => "min",
            "s" | "sec" | "second" | "seconds" => "s",
            _ => return Err(self.wrong("a speed, such as 200mm/min")),
        };
        let feed = with_unit(way, units).and_then(|(way, times)| {
            let feed: Feed = format!("{way}/{time}").parse().ok()?;
            Feed::try_new(feed.get().checked_mul(times)?)
        });
        feed.ok_or_else(|| self.wrong("a speed above zero, such as 200mm/min or a bare number"))
    }

    /// Turns per minute.
    pub(super) fn turns(&self) -> Result<u32, Wrong> {
        let number = self.value.trim_end_matches("rpm").trim();
        let (whole, rest) = number.split_once('.').unwrap_or((number, ""));
        let turns = whole.parse().ok().filter(|_| rest.chars().all(|c| c == '0'));
        turns.ok_or_else(|| self.wrong("turns per minute"))
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

/// A number with the units that pcb2gcode knows, or none, as a length with a unit of ours, and how many of it.
fn with_unit(text: &str, units: Units) -> Option<(String, i64)> {
    let text = text.trim();
    let end = text.find(|c: char| c.is_ascii_alphabetic() || c == '"').unwrap_or(text.len());
    let (number, unit) = (text[..end].trim(), text[end..].trim());
    let (unit, times) = match (unit, units) {
        ("", Units::Inches) | ("in" | "inch" | "inches" | "\"", _) => ("in", 1),
        ("", Units::Metric) | ("mm" | "millimeter" | "millimeters", _) => ("mm", 1),
        ("m" | "meter" | "meters", _) => ("mm", 1000),
        ("thou" | "mil" | "mils", _) => ("mil", 1),
        _ => return None,
    };
    Some((format!("{number}{unit}"), times))
}

fn length(text: &str, units: Units) -> Option<Nm> {
    let (text, times) = with_unit(text, units)?;
    let length: Nm = text.parse().ok()?;
    Nm::try_new(length.get() * times).ok()
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
        ] {
            assert_eq!(entry(text).feed(Units::Inches).expect(text).to_string(), feed, "{text}");
        }
        for (text, milliseconds) in [("2 s", 2000), ("1.5sec", 1500), ("40", 40), ("250 ms", 250)] {
            assert_eq!(entry(text).wait().expect(text), Wait { milliseconds }, "{text}");
        }
        assert!(entry("3 fortnights").wait().is_err() && entry("-1s").wait().is_err(), "no time");
        assert_eq!(entry("12000 rpm").turns().expect("turns"), 12_000, "with its unit");
        assert!(entry("-1").turns().is_err() && entry("0").feed(Units::Metric).is_err(), "no sense");
    }
}
