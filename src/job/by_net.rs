//! Nets by name: which strategy isolates which.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::Error;

use crate::board::diagnostic::planning;
use crate::board::{Copper, Warning};
use crate::topology::{NetId, Nets};

use super::choice::Strategy;
use super::{Layer, Pattern, Settings};

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
    "`{0}` gives nets no strategy: expected a pattern and voronoi, outline or auto, such as GND*=outline"
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

/// What a net is called: its names, its number, and what all its copper is for if that is one
/// thing.
pub(super) fn names(copper: &Copper, nets: &Nets, id: NetId) -> Vec<String> {
    let net = &nets.nets()[id.index()];
    let function = |&feature: &u32| copper.attributes_of(&copper.features[feature as usize]).function.clone();
    let mut functions: Vec<Option<String>> = net.features.iter().map(function).collect();
    functions.dedup();
    let mut names = net.names.clone();
    names.push(nets.label(id));
    if let [Some(function)] = functions.as_slice() {
        names.push(function.clone());
    }
    names
}

/// The strategy of each net, by number: the first pattern that matches a net decides, and else the
/// strategy of all.
pub(super) fn strategies(copper: &Copper, nets: &Nets, settings: &Settings) -> Vec<Strategy> {
    let strategy = |id: NetId| {
        let chosen = &settings.strategy_for;
        if chosen.is_empty() {
            return settings.strategy;
        }
        let names = names(copper, nets, id);
        let own = chosen.iter().find(|own| own.nets.matches_any(&names));
        own.map_or(settings.strategy, |own| own.strategy)
    };
    (0..).map(NetId).take(nets.nets().len()).map(strategy).collect()
}

/// The nets that have a loop of their own.
pub(super) fn looped(strategies: &[Strategy]) -> Vec<NetId> {
    let nets = (0..).map(NetId).zip(strategies);
    nets.filter(|(_, strategy)| **strategy == Strategy::Outline).map(|(id, _)| id).collect()
}

/// A `pattern-without-net` for each pattern that means no net of any layer.
pub(super) fn idle<'a>(
    layers: impl Iterator<Item = (&'a Copper, &'a Layer)> + Clone,
    settings: &Settings,
) -> Vec<Warning> {
    let means_one = |pattern: &Pattern| {
        layers.clone().any(|(copper, layer)| {
            let mut ids = (0..).map(NetId).take(layer.nets.nets().len());
            ids.any(|id| pattern.matches_any(&names(copper, &layer.nets, id)))
        })
    };
    let idle = settings.strategy_for.iter().filter(|own| !means_one(&own.nets));
    idle.map(|own| without_net(&own.nets, "it decides on no strategy")).collect()
}

/// The warning for a pattern that means none, and what follows from it.
pub(super) fn without_net(pattern: &Pattern, so: &str) -> Warning {
    planning::PATTERN_WITHOUT_NET.warning(format!("no net is called `{pattern}`, so {so}"))
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
