//! A distance to which all copper is cleared round some nets: `HV*=6mm`.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{Nm, ParseLengthError};
use crate::topology::Pattern;

use super::quantity::Length;

/// How far round the nets that a pattern means all other copper is cleared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DistanceFor {
    /// Which nets.
    pub nets: Pattern,
    /// How far; above zero.
    pub distance: Length,
}

/// Text that gives no distance to nets.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseDistanceForError {
    /// Without a pattern, or with a length that is none to clear.
    #[error("`{0}` is not a distance for nets: expected a pattern and a length above zero, such as HV*=6mm")]
    Form(String),
    /// What should be a length is none.
    #[error(transparent)]
    Length(#[from] ParseLengthError),
}

impl FromStr for DistanceFor {
    type Err = ParseDistanceForError;

    /// A name may have equals signs: the last one counts.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let refused = || ParseDistanceForError::Form(text.to_owned());
        let (nets, distance) =
            text.rsplit_once('=').filter(|(nets, _)| !nets.is_empty()).ok_or_else(refused)?;
        let distance: Length = distance.trim().parse()?;
        if distance.nm() <= Nm::ZERO {
            return Err(refused());
        }
        Ok(Self { nets: nets.parse().map_err(|_| refused())?, distance })
    }
}

impl fmt::Display for DistanceFor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.nets, self.distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        for text in ["HV*=6mm", "a=b=0.5mm"] {
            assert_eq!(text.parse::<DistanceFor>().expect(text).to_string(), text, "as it was");
        }
        for text in ["HV", "=6mm", "HV=", "HV=0mm", "HV=-1mm", "HV=far"] {
            assert!(text.parse::<DistanceFor>().is_err(), "{text}");
        }
    }
}
