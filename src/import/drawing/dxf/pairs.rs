//! The text or the bytes of a DXF file as pairs of a group code and a value.
//!
//! Text has a line each. Binary files (DXF Reference, *Binary DXF Files*) have one byte a code
//! until release 12 and two after it; the kind of value goes by the code.

use std::borrow::Cow;
use std::ops::Range;

use crate::import::error::{Error, printable};

/// What a binary file begins with.
pub(super) const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// A group code with its value.
#[derive(Clone, Debug)]
pub(super) struct Pair<'a> {
    pub(super) code: i32,
    value: Value<'a>,
    /// The bytes of the value.
    pub(super) place: Range<usize>,
}

#[derive(Clone, Debug)]
enum Value<'a> {
    Text(&'a [u8]),
    Real(f64),
    Whole(i64),
}

/// A number that is none, where it stands.
#[derive(Debug)]
pub(super) struct NoNumber(pub(super) Range<usize>);

impl Pair<'_> {
    /// The value as text, without blanks round it.
    pub(super) fn text(&self) -> Cow<'_, str> {
        match self.value {
            Value::Text(bytes) => {
                let bytes = bytes.trim_ascii();
                str::from_utf8(bytes).map_or_else(|_| Cow::Owned(printable(bytes)), Cow::Borrowed)
            }
            Value::Real(real) => Cow::Owned(real.to_string()),
            Value::Whole(whole) => Cow::Owned(whole.to_string()),
        }
    }

    pub(super) fn real(&self) -> Result<f64, NoNumber> {
        let real = match self.value {
            Value::Text(_) => self.text().parse().ok(),
            Value::Real(real) => Some(real),
            #[expect(clippy::cast_precision_loss, reason = "counts and flags")]
            Value::Whole(whole) => Some(whole as f64),
        };
        real.filter(|real: &f64| real.is_finite()).ok_or_else(|| NoNumber(self.place.clone()))
    }

    pub(super) fn whole(&self) -> Result<i64, NoNumber> {
        let whole = match self.value {
            Value::Text(_) => self.text().parse().ok(),
            Value::Whole(whole) => Some(whole),
            Value::Real(_) => None,
        };
        whole.ok_or_else(|| NoNumber(self.place.clone()))
    }
}

/// All pairs of a file, in order.
pub(super) fn pairs<'a>(name: &str, bytes: &'a [u8]) -> Result<Vec<Pair<'a>>, Error> {
    if bytes.starts_with(SENTINEL) { binary(name, bytes) } else { text(name, bytes) }
}

fn text<'a>(name: &str, bytes: &'a [u8]) -> Result<Vec<Pair<'a>>, Error> {
    let mut pairs = Vec::new();
    let mut at = 0;
    while let Some(code) = line(bytes, &mut at) {
        let digits = str::from_utf8(bytes[code.clone()].trim_ascii()).ok();
        let Some(number) = digits.and_then(|digits| digits.parse::<i32>().ok()) else {
            if bytes[code.start..].trim_ascii().is_empty() {
                break;
            }
            return Err(Error::syntax(
                name,
                bytes,
                code,
                "a group code is not a number",
                "a whole number on a line of its own, and its value on the next",
                "save the drawing again",
            ));
        };
        let Some(place) = line(bytes, &mut at) else { break };
        let value = Value::Text(&bytes[place.clone()]);
        let is_end = number == 0 && bytes[place.clone()].trim_ascii() == b"EOF";
        pairs.push(Pair { code: number, value, place });
        if is_end {
            break;
        }
    }
    Ok(pairs)
}

/// The line at `at`, which moves behind its end; CR, LF and CR LF each end one.
fn line(bytes: &[u8], at: &mut usize) -> Option<Range<usize>> {
    let start = *at;
    if start >= bytes.len() {
        return None;
    }
    let length = bytes[start..].iter().position(|b| matches!(b, b'\n' | b'\r'));
    let end = length.map_or(bytes.len(), |length| start + length);
    *at = if bytes[end..].starts_with(b"\r\n") { end + 2 } else { end + 1 };
    Some(start..end)
}

fn binary<'a>(name: &str, bytes: &'a [u8]) -> Result<Vec<Pair<'a>>, Error> {
    let mut at = SENTINEL.len();
    // The first pair is (0, SECTION): a second byte of nothing is of a code of two.
    let is_wide = bytes.get(at + 1) == Some(&0);
    let mut pairs = Vec::new();
    while at < bytes.len() {
        let start = at;
        let cut_off = || {
            let what = "the binary file is truncated";
            Error::syntax(
                name,
                bytes,
                start..bytes.len(),
                what,
                "a whole value",
                "copy or export the file again",
            )
        };
        let mut take = |count: usize| {
            let taken = bytes.get(at..at.checked_add(count)?)?;
            at += count;
            Some(taken)
        };
        let code = match (is_wide, take(1).ok_or_else(cut_off)?[0]) {
            (false, 255) | (true, _) if is_wide => {
                let high = take(1).ok_or_else(cut_off)?[0];
                i32::from(u16::from_le_bytes([bytes[start], high]))
            }
            (false, 255) => {
                let wide = take(2).ok_or_else(cut_off)?;
                i32::from(u16::from_le_bytes([wide[0], wide[1]]))
            }
            (_, code) => i32::from(code),
        };
        let first = at;
        let value = binary_value(code, bytes, &mut at).ok_or_else(cut_off)?;
        let is_end = code == 0 && matches!(value, Value::Text(b"EOF"));
        pairs.push(Pair { code, value, place: first..at });
        if is_end {
            break;
        }
    }
    Ok(pairs)
}

/// The value behind `code` at `at`, which moves behind it; none where the file ends before.
fn binary_value<'a>(code: i32, bytes: &'a [u8], at: &mut usize) -> Option<Value<'a>> {
    let mut take = |count: usize| {
        let taken = bytes.get(*at..at.checked_add(count)?)?;
        *at += count;
        Some(taken)
    };
    Some(match code {
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
            Value::Real(f64::from_le_bytes(take(8)?.try_into().ok()?))
        }
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
            Value::Whole(i64::from(i16::from_le_bytes(take(2)?.try_into().ok()?)))
        }
        90..=99 | 420..=429 | 440..=459 | 1071 => {
            Value::Whole(i64::from(i32::from_le_bytes(take(4)?.try_into().ok()?)))
        }
        160..=169 => Value::Whole(i64::from_le_bytes(take(8)?.try_into().ok()?)),
        290..=299 => Value::Whole(i64::from(take(1)?[0])),
        310..=319 | 1004 => {
            let count = usize::from(take(1)?[0]);
            Value::Text(take(count)?)
        }
        _ => {
            let length = bytes.get(*at..)?.iter().position(|&b| b == 0)?;
            let text = &bytes[*at..*at + length];
            *at += length + 1;
            Value::Text(text)
        }
    })
}
