//! Nets by name: which strategy isolates which.

use crate::board::diagnostic::planning;
use crate::board::{Copper, Warning};
use crate::topology::{NetId, Nets, Pattern, called};

use super::choice::Strategy;
use super::strategy_for::StrategyFor;

/// The strategy of each net, by number: the first pattern that matches a net decides, and else the
/// strategy of all.
pub(super) fn strategies(
    copper: &Copper,
    nets: &Nets,
    chosen: &[StrategyFor],
    usual: Strategy,
) -> Vec<Strategy> {
    let strategy = |id: NetId| {
        if chosen.is_empty() {
            return usual;
        }
        let names = called(copper, nets, id);
        let own = chosen.iter().find(|own| own.nets.matches_any(&names));
        own.map_or(usual, |own| own.strategy)
    };
    (0..).map(NetId).take(nets.nets().len()).map(strategy).collect()
}

/// The nets that have a loop of their own.
pub(super) fn looped(strategies: &[Strategy]) -> Vec<NetId> {
    let nets = (0..).map(NetId).zip(strategies);
    nets.filter(|(_, strategy)| **strategy == Strategy::Outline).map(|(id, _)| id).collect()
}

/// The warning for a pattern that means none, and what follows from it.
pub(super) fn without_net(pattern: &Pattern, so: &str) -> Warning {
    planning::PATTERN_WITHOUT_NET.warning(format!("no net is called `{pattern}`, so {so}"))
}
