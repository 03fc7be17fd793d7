//! How far a machine may round corners off: the tolerance of G64, where a dialect has one.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;

use crate::geometry::{Nm, ParseLengthError};

/// How far a machine may round corners off to keep its speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub enum Blend {
    /// As far as it is set to: programs say nothing of it.
    Machine,
    /// `G64 P0.005`: no farther than this, which is above zero.
    Within(Nm),
}

/// A text that does not say how far.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseBlendError {
    /// A length that rounds nothing off.
    #[error("`{0}` is not a blend tolerance: expected a length above zero, or `machine`")]
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
        let most: Nm = text.parse()?;
        if most <= Nm::ZERO {
            return Err(ParseBlendError::Nothing(text.to_owned()));
        }
        Ok(Self::Within(most))
    }
}

impl TryFrom<String> for Blend {
    type Error = ParseBlendError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}

/// As it is written: `machine`, or millimetres without needless zeros.
impl fmt::Display for Blend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Machine => f.write_str("machine"),
            Self::Within(most) => {
                write!(f, "{}mm", most.to_string().trim_end_matches('0').trim_end_matches('.'))
            }
        }
    }
}
