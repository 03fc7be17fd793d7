//! The lines of a list that are no apertures: they may say the unit and the number format.

use crate::import::gerber::format::{Format, Zeros};

use super::row::{row, unit_of};

/// What the lines say that are no apertures.
#[derive(Debug, Default)]
pub(super) struct Prose {
    /// None where nothing or several are named.
    pub(super) unit: Option<&'static str>,
    pub(super) format: Option<Format>,
}

impl Prose {
    pub(super) fn of(text: &[String]) -> Self {
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
