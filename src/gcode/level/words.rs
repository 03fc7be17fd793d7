//! A line → words: a letter and a number each.

use crate::gcode::read::ReadError;

/// A decimal number, exactly: `mantissa` / 10^`decimals`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Number {
    pub(super) mantissa: i64,
    pub(super) decimals: u32,
}

impl Number {
    /// The number of `unit`s it stands for, in whole ones, halves away from zero; none beyond an
    /// `i64`.
    pub(super) fn times(self, unit: i64) -> Option<i64> {
        let scale = 10_i128.pow(self.decimals);
        let scaled = i128::from(self.mantissa) * i128::from(unit);
        let half = scale / 2 * scaled.signum();
        i64::try_from((scaled + half) / scale).ok()
    }
}

/// A letter, its number, and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub(super) letter: char,
    pub(super) number: Number,
    pub(super) column: u32,
    pub(super) text: &'a str,
}

/// How many characters of an offending text an error shows. Chosen: more than any word, less than a
/// line of a terminal.
const SHOWN: usize = 40;

/// Makes errors that point into a line.
#[derive(Clone, Copy)]
pub(super) struct Pointer<'a> {
    pub(super) line: u32,
    pub(super) source: &'a str,
}

impl Pointer<'_> {
    pub(super) fn error(self, column: u32, text: &str, expected: impl Into<String>) -> ReadError {
        let mut shown: String = text.chars().take(SHOWN).collect();
        if shown.len() < text.len() {
            shown.push('…');
        }
        ReadError { line: self.line, column, text: shown, expected: expected.into() }
    }
}

/// The words of a line, without comments.
pub(super) fn words<'a>(pointer: Pointer<'a>) -> Result<Vec<Word<'a>>, ReadError> {
    let source = pointer.source;
    let bytes = source.as_bytes();
    let (mut at, mut words) = (0, Vec::new());
    while let Some(&byte) = bytes.get(at) {
        let column = u32::try_from(at + 1).unwrap_or(u32::MAX);
        match byte {
            b' ' | b'\t' | b'\r' | b'%' => at += 1,
            b'/' if words.is_empty() => at += 1,
            b';' => break,
            b'(' => match source[at..].find(')') {
                Some(length) => at += length + 1,
                None => {
                    return Err(pointer.error(column, &source[at..], "expected a `)` that ends the comment"));
                }
            },
            b'a'..=b'z' | b'A'..=b'Z' => match word(source, at) {
                Some((number, end)) => {
                    let letter = char::from(byte.to_ascii_uppercase());
                    words.push(Word { letter, number, column, text: &source[at..end] });
                    at = end;
                }
                None if shows_text(&words) => break,
                None => return Err(pointer.error(column, rest(source, at), reason(bytes, at))),
            },
            _ => {
                let what = match byte {
                    b'#' | b'[' => "variables and expressions are not supported",
                    b'$' => "this is a setting of the controller, not a program",
                    _ => "expected a letter and a number, such as X1.5",
                };
                return Err(pointer.error(column, rest(source, at), what));
            }
        }
    }
    Ok(words)
}

/// Whether what follows the words so far is a text for the operator (Marlin's
/// `M0 insert the drill`).
fn shows_text(words: &[Word<'_>]) -> bool {
    words.last().is_some_and(|word| {
        word.letter == 'M' && word.number.decimals == 0 && matches!(word.number.mantissa, 0 | 1 | 117)
    })
}

/// The text from `at` up to the next blank.
fn rest(source: &str, at: usize) -> &str {
    source[at..].split_whitespace().next().unwrap_or_default()
}

fn reason(bytes: &[u8], at: usize) -> &'static str {
    match bytes[at + 1..].iter().find(|byte| !byte.is_ascii_whitespace()) {
        Some(b'#' | b'[') => "variables and expressions are not supported",
        _ => "expected a number of at most 15 digits after the letter",
    }
}

/// The number after the letter at `at`, and where it ends. Blanks within are ignored, as the
/// controllers do.
fn word(source: &str, at: usize) -> Option<(Number, usize)> {
    let bytes = source.as_bytes();
    let (mut end, mut negative, mut signed, mut digits, mut mantissa) = (at + 1, false, false, 0_u32, 0_i64);
    let mut decimals: Option<u32> = None;
    let mut last = end;
    while let Some(&byte) = bytes.get(end) {
        match byte {
            b' ' | b'\t' => {}
            b'-' | b'+' if digits == 0 && !signed && decimals.is_none() => {
                (negative, signed) = (byte == b'-', true)
            }
            b'.' if decimals.is_none() => decimals = Some(0),
            b'0'..=b'9' if digits < 15 => {
                mantissa = mantissa * 10 + i64::from(byte - b'0');
                digits += 1;
                decimals = decimals.map(|count| count + 1);
            }
            b'0'..=b'9' => return None,
            _ => break,
        }
        end += 1;
        if !matches!(byte, b' ' | b'\t') {
            last = end;
        }
    }
    let number =
        Number { mantissa: if negative { -mantissa } else { mantissa }, decimals: decimals.unwrap_or(0) };
    (digits > 0).then_some((number, last))
}
