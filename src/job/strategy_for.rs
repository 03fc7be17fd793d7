//! A strategy for some nets: `GND*=outline`.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::Error;

use super::choice::Strategy;
use crate::topology::Pattern;

/// A strategy for the nets that a pattern means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StrategyFor {
    /// Which nets.
    pub nets: Pattern,
    /// How they are isolated.
    pub strategy: Strategy,
}

/// Text that gives no strategy to nets.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not a strategy for nets: expected a pattern and voronoi, outline or auto, such as GND*=outline"
)]
pub struct ParseStrategyForError(String);

impl FromStr for StrategyFor {
    type Err = ParseStrategyForError;

    /// A name may have equals signs: the last one counts.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let error = || ParseStrategyForError(text.to_owned());
        let (nets, strategy) =
            text.rsplit_once('=').filter(|(nets, _)| !nets.is_empty()).ok_or_else(error)?;
        let strategy = Strategy::deserialize(strategy.into_deserializer()).map_err(|_: Error| error())?;
        Ok(Self { nets: nets.parse().map_err(|_| error())?, strategy })
    }
}

impl fmt::Display for StrategyFor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let strategy = match self.strategy {
            Strategy::Voronoi => "voronoi",
            Strategy::Outline => "outline",
            Strategy::Auto => "auto",
        };
        write!(f, "{}={strategy}", self.nets)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        for text in ["GND*=outline", "a=b=voronoi", "N?=auto"] {
            assert_eq!(text.parse::<StrategyFor>().expect(text).to_string(), text, "as it was");
        }
        let own: StrategyFor = "a=b=voronoi".parse().expect("a strategy");
        assert!(own.nets.matches("a=b"), "the last equals sign counts");
        for text in ["GND", "GND=", "=outline", "GND=Outline", "GND=round"] {
            assert!(text.parse::<StrategyFor>().is_err(), "{text}");
        }
    }
}
