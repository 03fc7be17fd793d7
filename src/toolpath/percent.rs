//! Parts of a whole in hundredths of a percent, exact as they are written.

use std::fmt;
use std::str::FromStr;

use crate::geometry::Nm;

/// A part of a whole, in whole hundredths of a percent, so that `33.33%` is exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Percent(u32);

/// A text that is no percentage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a percentage with at most two decimals, such as `12.5%`")]
pub struct ParsePercentError;

impl Percent {
    /// All of it.
    pub const ALL: Self = Self::new(100);

    /// So many whole percent.
    #[must_use]
    pub const fn new(percent: u32) -> Self {
        Self(percent * 100)
    }

    /// As a part of one.
    #[must_use]
    pub fn part(self) -> f64 {
        f64::from(self.0) / f64::from(Self::ALL.0)
    }

    /// This part of a length, rounded towards zero.
    #[must_use]
    pub fn of(self, length: Nm) -> Nm {
        length * i64::from(self.0) / i64::from(Self::ALL.0)
    }
}

impl FromStr for Percent {
    type Err = ParsePercentError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let part = text.trim().strip_suffix('%').ok_or(ParsePercentError)?.trim();
        let (whole, rest) = part.split_once('.').unwrap_or((part, ""));
        let digits = |text: &str| text.bytes().all(|digit| digit.is_ascii_digit());
        if part.is_empty() || !digits(whole) || !digits(rest) || rest.len() > 2 {
            return Err(ParsePercentError);
        }
        format!("{whole}{rest:0<2}").parse().map(Self).map_err(|_| ParsePercentError)
    }
}

/// As it is written, without needless zeros.
impl fmt::Display for Percent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.0 / 100, self.0 % 100) {
            (whole, 0) => write!(f, "{whole}%"),
            (whole, tenths) if tenths % 10 == 0 => write!(f, "{whole}.{}%", tenths / 10),
            (whole, hundredths) => write!(f, "{whole}.{hundredths:02}%"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentages_read_back_as_they_are_written() {
        for text in ["0%", "50%", "12.5%", "33.33%", "0.05%", "250%"] {
            assert_eq!(text.parse::<Percent>().expect(text).to_string(), text, "{text}");
        }
        assert_eq!(" 12.50 %".parse::<Percent>().expect("a part").to_string(), "12.5%", "no needless zeros");
        for text in ["", "%", "5", "-5%", "1.234%", "half%", "1.2.3%", "99999999999%"] {
            assert_eq!(text.parse::<Percent>(), Err(ParsePercentError), "{text}");
        }
    }

    #[test]
    fn a_part_of_a_length_is_exact() {
        let half: Percent = "12.5%".parse().expect("a percentage");
        assert_eq!((half.of(Nm::new(800)), half.part()), (Nm::new(100), 0.125), "an eighth");
    }
}
