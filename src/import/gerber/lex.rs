//! Bytes → blocks → words.
//!
//! A Gerber file is a stream of blocks that end with `*`; line ends mean nothing (specification
//! §3.2). The `%` that brackets extended commands is not needed to tell them from the rest: they
//! begin with two letters, all other blocks with a letter and a number. So a `%` too many or too
//! few cannot turn the meaning of what follows, and is only looked at where an aperture macro ends.

use std::borrow::Cow;
use std::ops::Range;

/// A piece of the file up to a `*`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block<'a> {
    /// Its text, without white space before it and without the `*`; may hold line ends.
    pub(super) text: &'a [u8],
    /// Where the text begins in the file.
    pub(super) start: usize,
    /// The line on which it begins, from 1.
    pub(super) line: u32,
    /// How many `%` stand before it.
    pub(super) percents: u32,
    /// What ended it.
    pub(super) end: End,
}

impl Block<'_> {
    /// The bytes of the file it covers.
    pub(super) const fn place(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }
}

/// What ended a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// A `*`, as it should be.
    Star,
    /// A `%` before any `*`.
    Percent,
    /// The end of the file.
    File,
}

/// Cuts a file into blocks.
#[derive(Clone, Debug)]
pub(super) struct Lexer<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u32,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Self { bytes, at, line: 1 }
    }

    /// Whether the next thing that is not white space is a `%`: the end of an extended command.
    pub(super) fn percent_follows(&mut self) -> bool {
        while self.at < self.bytes.len() && is_blank(self.bytes[self.at]) {
            self.step();
        }
        self.bytes.get(self.at) == Some(&b'%')
    }

    /// How many bytes have been read.
    pub(super) const fn position(&self) -> usize {
        self.at
    }

    fn step(&mut self) {
        let byte = self.bytes[self.at];
        self.at += 1;
        if byte == b'\n' || (byte == b'\r' && self.bytes.get(self.at) != Some(&b'\n')) {
            self.line = self.line.saturating_add(1);
        }
    }
}

impl<'a> Iterator for Lexer<'a> {
    type Item = Block<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut percents = 0;
        while let Some(&byte) = self.bytes.get(self.at).filter(|&&b| is_blank(b) || b == b'%') {
            percents += u32::from(byte == b'%');
            self.step();
        }
        let (start, line) = (self.at, self.line);
        if start == self.bytes.len() {
            return None;
        }
        let is_comment = comment(unnumbered(&self.bytes[start..])).is_some();
        let end = loop {
            match self.bytes.get(self.at) {
                None => break End::File,
                Some(b'*') => break End::Star,
                // A comment may speak of per cents; a `%` that begins a line is none of it.
                Some(b'%') if !is_comment || self.bytes[..self.at].ends_with(b"\n") => break End::Percent,
                Some(_) => self.step(),
            }
        };
        let text = &self.bytes[start..self.at];
        if end == End::Star {
            self.at += 1;
        }
        Some(Block { text, start, line, percents, end })
    }
}

/// What G04 says, which `text` begins with; none for another word. Not read as a number, because a
/// comment may begin with digits: G04 is it as most write it, with any number of zeros (§8.3.3).
pub(super) fn comment(text: &[u8]) -> Option<&[u8]> {
    let digits = text.strip_prefix(b"G").or_else(|| text.strip_prefix(b"g"))?;
    let zeros = digits.iter().take_while(|&&b| b == b'0').count();
    let rest = digits[zeros..].strip_prefix(b"4")?;
    (!rest.first().is_some_and(u8::is_ascii_digit)).then_some(rest)
}

/// `text` behind the number of its block, where it has one: `N10`.
fn unnumbered(text: &[u8]) -> &[u8] {
    let Some(rest) = text.strip_prefix(b"N").or_else(|| text.strip_prefix(b"n")) else { return text };
    let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
    if digits == 0 { text } else { rest[digits..].trim_ascii_start() }
}

/// The text without line ends, which may stand anywhere in a command.
pub(super) fn one_line(text: &[u8]) -> Cow<'_, [u8]> {
    let is_end = |b: &u8| matches!(b, b'\r' | b'\n' | 0);
    if text.iter().any(is_end) {
        Cow::Owned(text.iter().copied().filter(|b| !is_end(b)).collect())
    } else {
        Cow::Borrowed(text)
    }
}

/// White space, and the NUL and SUB bytes that paper tapes and DOS left in files.
pub(super) const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c | 0 | 0x1a)
}

/// A decimal number as it is written; what it means depends on the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Number {
    /// Its first 18 digits, zeros before the first of them left aside, with the sign.
    pub(super) mantissa: i64,
    /// How many digits there are.
    pub(super) digits: u32,
    /// How many of the mantissa's stand after the point; none without a point.
    pub(super) decimals: Option<u32>,
    /// How many digits before the point the mantissa does not hold. Those after the point that it
    /// does not hold are below any rounding.
    pub(super) beyond: u32,
}

/// From here on a further digit may be more than an `i64` holds.
const FULL: i64 = 10_i64.pow(17);

impl Number {
    /// Reads a number at the start of `text`: the number and how many bytes it takes. None where
    /// there is none.
    ///
    /// White space within it is skipped, for files cut into lines of fixed length.
    pub(super) fn read(text: &[u8]) -> Option<(Self, usize)> {
        let (mut mantissa, mut digits, mut decimals, mut beyond) = (0_i64, 0_u32, None, 0_u32);
        let (mut negative, mut signed, mut length) = (false, false, 0);
        for (i, &byte) in text.iter().enumerate() {
            match byte {
                b'0'..=b'9' => {
                    digits = digits.saturating_add(1);
                    if mantissa < FULL {
                        mantissa = mantissa * 10 + i64::from(byte - b'0');
                        decimals = decimals.map(|d: u32| d.saturating_add(1));
                    } else if decimals.is_none() {
                        beyond = beyond.saturating_add(1);
                    }
                }
                b'.' if decimals.is_none() => decimals = Some(0),
                b'+' | b'-' if digits == 0 && decimals.is_none() && !signed => {
                    (negative, signed) = (byte == b'-', true);
                }
                _ if is_blank(byte) => continue,
                _ => break,
            }
            length = i + 1;
        }
        let mantissa = if negative { -mantissa } else { mantissa };
        (digits > 0).then_some((Self { mantissa, digits, decimals, beyond }, length))
    }

    /// Reads `text` as a number and nothing else.
    pub(super) fn whole(text: &[u8]) -> Option<Self> {
        let (number, length) = Self::read(text)?;
        text[length..].iter().all(|&b| is_blank(b)).then_some(number)
    }

    /// Whether there are only zeros behind a point, if there is one.
    pub(super) fn is_whole(self) -> bool {
        let power = self.decimals.map_or(Some(1), |decimals| 10_i64.checked_pow(decimals));
        power.is_some_and(|power| self.mantissa % power == 0)
    }

    /// A whole number as it is written without a point.
    pub(super) fn without_point(self) -> Self {
        let decimals = self.decimals.unwrap_or(0);
        let power = 10_i64.checked_pow(decimals).unwrap_or(i64::MAX);
        let digits = self.digits.saturating_sub(decimals);
        Self { mantissa: self.mantissa / power, digits, decimals: None, beyond: self.beyond }
    }

    /// The value with a point where it is written.
    #[expect(
        clippy::cast_precision_loss,
        reason = "what a float does not hold of 18 digits is below any rounding"
    )]
    pub(super) fn to_f64(self) -> f64 {
        let power = |exponent: u32| (0..exponent.min(400)).fold(1.0, |power, _| power * 10.0);
        self.mantissa as f64 * power(self.beyond) / power(self.decimals.unwrap_or(0))
    }

    /// The value as a whole number, if it is one.
    pub(super) fn to_integer(self) -> Option<i64> {
        if self.mantissa == 0 || self.beyond > 0 {
            return (self.beyond == 0).then_some(0);
        }
        let power = 10_i64.checked_pow(self.decimals.unwrap_or(0))?;
        (self.mantissa % power == 0).then_some(self.mantissa / power)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blocks(text: &str) -> Vec<(String, u32, End)> {
        Lexer::new(text.as_bytes())
            .map(|block| (String::from_utf8_lossy(block.text).into_owned(), block.line, block.end))
            .collect()
    }

    #[test]
    fn line_ends_of_any_kind_mean_nothing() {
        for text in [
            "\u{feff}G01*\n%MOMM*%\nX1\nY2D01*",
            "G01*\r%MOMM*%\rX1\rY2D01*",
            "G01*\r\n%MOMM*%\r\nX1\r\nY2D01*",
        ] {
            let found = blocks(text);
            let lines: Vec<u32> = found.iter().map(|block| block.1).collect();
            assert_eq!(lines, [1, 2, 3], "{text:?}");
            assert!(found.iter().all(|block| block.2 == End::Star), "{found:?}");
        }
    }

    #[test]
    fn a_comment_may_speak_of_per_cents() {
        let found = blocks("G04 scale 100 % of it*%MOMM*%");
        assert_eq!(found[0].0, "G04 scale 100 % of it", "the whole comment");
        assert_eq!(found[1].0, "MOMM", "and then the command");
    }

    #[test]
    fn numbers_remember_how_they_were_written() {
        let number = |text: &str| Number::read(text.as_bytes());
        let plain = Number { mantissa: -1500, digits: 5, decimals: None, beyond: 0 };
        assert_eq!(number("-01500Y3"), Some((plain, 6)), "leading zeros count as digits");
        let point = Number { mantissa: 15, digits: 2, decimals: Some(1), beyond: 0 };
        assert_eq!(number("+1.5"), Some((point, 4)), "a point");
        assert_eq!(number("1\r\n2X").map(|n| n.0.mantissa), Some(12), "a number over two lines");
        assert_eq!(number("-"), None, "no digit");
        let long = Number { mantissa: 123_456_789_012_345_678, digits: 20, decimals: None, beyond: 2 };
        assert_eq!(number("12345678901234567890"), Some((long, 20)), "more digits than it keeps");
        let value = |text: &str| number(text).expect("a number").0.to_f64();
        assert!((value("0.024000000000000004") - 0.024).abs() < 1e-15, "as programs print floats");
        assert!((value("12345678901234567890") - 12_345_678_901_234_567_890.0).abs() < 1e4, "a large one");
        assert!(value("0.00000000000000000000000000000000000000001").abs() < 1e-40, "a small one");
    }
}
