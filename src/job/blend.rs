//! How far a machine may round corners off.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{Nm, ParseLengthError};

use super::Length;

/// How far a machine may round corners off to keep its speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blend {
    /// As far as it is set to: programs say nothing of it.
    Machine,
    /// No farther than this, which is above zero.
    Within(Length),
}

/// A text that does not say how far.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseBlendError {
    /// A length that rounds nothing off.
    #[error("`{0}` rounds nothing off: expected a length above zero, or `machine`")]
    Nothing(String),
    /// No length.
    #[error("{0}, or `machine`")]
    Length(#[from] ParseLengthError),
}

impl FromStr for Blend {
    type Err = ParseBlendError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text.trim() == "machine" {
            return Ok(Self::Machine);
        }
        let length: Length = text.parse()?;
        if length.nm() <= Nm::ZERO {
            return Err(ParseBlendError::Nothing(text.to_owned()));
        }
        Ok(Self::Within(length))
    }
}

/// As it is written.
impl fmt::Display for Blend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Machine => f.write_str("machine"),
            Self::Within(length) => length.fmt(f),
        }
    }
}
