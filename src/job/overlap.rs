//! How much neighbouring passes share: a length, or a part of the kerf.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{Nm, ParseLengthError};

use super::Length;

/// How much neighbouring passes share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlap {
    /// Such as `20um`, whatever the tool.
    Length(Length),
    /// Such as `50%`: a part of each tool's own kerf.
    OfKerf {
        /// In hundredths of a percent, less than all of it.
        hundredths: u32,
    },
}

/// A text that does not say how much passes share.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseOverlapError {
    /// A part of the kerf that is no part of it.
    #[error("`{0}` is not a part of the kerf: expected 0% to 99.99%, such as `50%`")]
    Part(String),
    /// Neither a part nor a length.
    #[error("{0}, or a part of the kerf, such as `50%`")]
    Length(#[from] ParseLengthError),
}

/// All of it, in hundredths of a percent.
const ALL: u32 = 10_000;

impl Overlap {
    /// What it comes to with a tool that cuts so wide.
    #[must_use]
    pub fn of(self, kerf: Nm) -> Nm {
        match self {
            Self::Length(length) => length.nm(),
            Self::OfKerf { hundredths } => kerf * i64::from(hundredths) / i64::from(ALL),
        }
    }
}

impl FromStr for Overlap {
    type Err = ParseOverlapError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let Some(part) = text.trim().strip_suffix('%') else { return Ok(Self::Length(text.parse()?)) };
        let (whole, rest) = part.trim().split_once('.').unwrap_or((part.trim(), ""));
        let digits = |text: &str| text.bytes().all(|digit| digit.is_ascii_digit());
        let hundredths = (digits(whole) && digits(rest) && rest.len() <= 2)
            .then(|| format!("{whole}{rest:0<2}").parse().ok())
            .flatten();
        hundredths
            .filter(|&hundredths: &u32| hundredths < ALL && !part.trim().is_empty())
            .map(|hundredths| Self::OfKerf { hundredths })
            .ok_or_else(|| ParseOverlapError::Part(text.to_owned()))
    }
}

/// As it is written, without needless zeros.
impl fmt::Display for Overlap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Length(length) => length.fmt(f),
            Self::OfKerf { hundredths } => match (hundredths / 100, hundredths % 100) {
                (whole, 0) => write!(f, "{whole}%"),
                (whole, tenths) if tenths % 10 == 0 => write!(f, "{whole}.{}%", tenths / 10),
                (whole, hundredths) => write!(f, "{whole}.{hundredths:02}%"),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_parts_read_back_as_they_are_written() {
        for text in ["20um", "0%", "50%", "12.5%", "33.33%", "0.05%", "99.99%"] {
            let overlap: Overlap = text.parse().expect(text);
            assert_eq!(overlap.to_string().parse(), Ok(overlap), "{text}");
        }
        assert_eq!(" 12.50 %".parse::<Overlap>().expect("a part").to_string(), "12.5%", "no needless zeros");
    }

    #[test]
    fn a_part_is_of_the_kerf_and_a_length_is_not() {
        let of = |text: &str| text.parse::<Overlap>().expect(text).of(Nm::from_um(153));
        assert_eq!(of("50%"), Nm::new(76_500), "half of it");
        assert_eq!(of("20um"), Nm::from_um(20), "as it is");
    }

    #[test]
    fn what_is_neither_is_refused_with_what_was_expected() {
        for text in ["100%", "-5%", "%", "1.234%", "half%", "5", "half"] {
            let error = text.parse::<Overlap>().expect_err(text).to_string();
            assert!(error.contains("50%"), "{text}: {error}");
        }
    }
}
