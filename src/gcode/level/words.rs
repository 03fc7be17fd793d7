//! A line → words: a letter and an exact number each.

use crate::gcode::read::{ReadError, Spelled, spelled};

/// A decimal number, exactly: `mantissa` / 10^`decimals`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Number {
    pub(super) mantissa: i64,
    pub(super) decimals: u32,
}

/// How many digits a number may have. Chosen: more than any machine tells apart, and no overflow.
const DIGITS: usize = 15;

impl Number {
    /// What is written so; none beyond [`DIGITS`], or where it is no number.
    fn read(text: &str) -> Option<Self> {
        let (whole, part) = text.split_once('.').unwrap_or((text, ""));
        let digits = format!("{whole}{part}");
        let count = digits.trim_start_matches(['+', '-']).len();
        let decimals = u32::try_from(part.len()).ok()?;
        (count <= DIGITS).then_some(())?;
        Some(Self { mantissa: digits.parse().ok()?, decimals })
    }

    /// The number of `unit`s it stands for, in whole ones, halves away from zero; none beyond an
    /// `i64`.
    pub(super) fn times(self, unit: i64) -> Option<i64> {
        let scale = 10_i128.pow(self.decimals);
        let scaled = i128::from(self.mantissa) * i128::from(unit);
        let half = scale / 2 * scaled.signum();
        i64::try_from((scaled + half) / scale).ok()
    }
}

/// A letter, its number, and where both stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub(super) letter: char,
    pub(super) number: Number,
    pub(super) from: usize,
    pub(super) text: &'a str,
}

/// The words of a line, as the reader takes them.
pub(super) fn words(line: u32, source: &str) -> Result<Vec<Word<'_>>, ReadError> {
    let word = |Spelled { letter, number, place }: Spelled| {
        let (from, text) = (place.start, &source[place]);
        let wrong = || ReadError {
            line,
            column: u32::try_from(from + 1).unwrap_or(u32::MAX),
            text: text.to_owned(),
            expected: format!("expected a number of at most {DIGITS} digits after the letter"),
        };
        Ok(Word { letter, number: Number::read(&number).ok_or_else(wrong)?, from, text })
    };
    spelled(line, source)?.into_iter().map(word).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_to_the_last_digit() {
        let read = |text| Number::read(text).map(|number| (number.mantissa, number.decimals));
        assert_eq!(read("-0.25"), Some((-25, 2)), "a sign and a point");
        assert_eq!(read("+.5"), Some((5, 1)), "without a nought");
        assert_eq!(read("7."), Some((7, 0)), "without decimals");
        assert_eq!(read("123456789012345"), Some((123_456_789_012_345, 0)), "as many digits as there may be");
        for text in ["1234567890.123456", ".", "[1+1]", "1.2.3"] {
            assert_eq!(read(text), None, "{text}");
        }
    }
}
