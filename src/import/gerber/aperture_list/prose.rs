//! The lines of a list that are no apertures: they may say the unit and the number format.

use crate::import::gerber::format::{Format, Zeros};

use super::row::{row, unit_of};

/// What the lines say that are no apertures.
#[derive(Debug, Default)]
pub(super) struct Prose {
    /// None where nothing or several are named.
    pub(super) unit: Option<&'static str>,
    pub(super) format: Option<Format>,
    /// Whether they contradict each other in which zeros are left out; then there is no format.
    pub(super) contradictory: bool,
}

impl Prose {
    pub(super) fn of(text: &[String]) -> Self {
        let all = || text.iter().filter(|line| row(0, line, true).is_none() && row(0, line, false).is_none());
        let mut units: Vec<&'static str> = all().flat_map(|line| units(line)).collect();
        units.sort_unstable();
        units.dedup();
        let unit = if let [unit] = units[..] { Some(unit) } else { None };
        let digits = all().filter(|line| line.contains("FORMAT")).find_map(|line| digits(line));
        // Whether any line says that such zeros are left out, and whether any denies it.
        let says = |what: &str| {
            let told = all().filter(|line| line.contains(what)).filter_map(|line| omits(line));
            told.fold([false, false], |[yes, no], omits| [yes || omits, no || !omits])
        };
        let (leading, trailing) = (says("LEADING"), says("TRAILING"));
        // Where leading zeros are written, trailing ones may be left out: either way the digits are
        // aligned at the first.
        let zeros = match (leading, trailing) {
            ([true, false], [false, _]) | ([false, false], [false, _]) | ([false, true], [false, true]) => {
                Some(Zeros::Leading)
            }
            ([false, _], [true, false]) | ([false, true], [false, false]) => Some(Zeros::Trailing),
            _ => None,
        };
        let incremental = all().any(|line| line.contains("INCREMENTAL") && !line.contains("ABSOLUTE"));
        let format = |(zeros, digits)| Format { zeros, incremental, x: digits, y: digits };
        Self { unit, format: zeros.zip(digits).map(format), contradictory: zeros.is_none() }
    }
}

/// The units that a line names. `IN` is a word of prose besides: it is one where nothing else is
/// said, or of units: `IN`, `UNITS: IN`. None of `METRIC: OFF`.
fn units(line: &str) -> impl Iterator<Item = &'static str> {
    let words: Vec<&str> =
        line.split(|c: char| !c.is_ascii_alphanumeric()).filter(|w| !w.is_empty()).collect();
    let is_of_units = words.iter().all(|word| matches!(*word, "IN" | "UNIT" | "UNITS" | "ARE"));
    // What is denied is none.
    let is_denied = matches!(words[..], [_, "OFF" | "NO"]);
    let named = move |word: &&str| (*word != "IN" || is_of_units) && !is_denied;
    words.into_iter().filter(named).filter_map(unit_of)
}

/// Whether a line about zeros says that they are left out; none where it says neither.
fn omits(line: &str) -> Option<bool> {
    let verb = ["SUPPRESS", "OMIT", "REMOVE"].iter().any(|word| line.contains(word));
    // `NO.` is a number.
    let has = |words: &[&str]| {
        line.split(|c: char| !c.is_ascii_alphanumeric() && c != '.').any(|w| words.contains(&w))
    };
    if verb { Some(!has(&["OFF", "NO", "NOT", "NONE"])) } else { has(&["OFF"]).then_some(true) }
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
