//! How much neighbouring passes share: a length, or a part of the kerf.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{Nm, ParseLengthError};
use crate::toolpath::Percent;

use super::Length;

/// How much neighbouring passes share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlap {
    /// Such as `20um`, whatever the tool.
    Length(Length),
    /// Such as `50%`: a part of each tool's own kerf, less than all of it.
    OfKerf(Percent),
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

impl Overlap {
    /// What it comes to with a tool that cuts so wide.
    #[must_use]
    pub fn of(self, kerf: Nm) -> Nm {
        match self {
            Self::Length(length) => length.nm(),
            Self::OfKerf(part) => part.of(kerf),
        }
    }
}

impl FromStr for Overlap {
    type Err = ParseOverlapError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if !text.trim().ends_with('%') {
            return Ok(Self::Length(text.parse()?));
        }
        let part = text.parse().ok().filter(|&part| part < Percent::ALL);
        part.map(Self::OfKerf).ok_or_else(|| ParseOverlapError::Part(text.to_owned()))
    }
}

impl fmt::Display for Overlap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Length(length) => length.fmt(f),
            Self::OfKerf(part) => part.fmt(f),
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
