//! Nets that are left out of isolation: text, logos, whatever nothing is soldered to.

use crate::board::diagnostic::planning;
use crate::board::{Board, Copper, Side, Warning};
use crate::topology::{self, Nets, Pattern, called};

use super::Topology;
use super::by_net::without_net;
use super::plain::method;

/// Takes the nets that a pattern means out of the copper of `board`: cuts go through them as if
/// they were not there.
///
/// Warned about: `nets-ignored` on each side that has some, `pattern-without-net` for what means
/// none.
pub fn ignore(board: &mut Board, patterns: &[Pattern], topology: Topology) -> Vec<Warning> {
    let mut meant = vec![false; patterns.len()];
    let mut warnings = Vec::new();
    for copper in [&mut board.front, &mut board.back].into_iter().flatten() {
        warnings.extend(thin(copper, patterns, topology, &mut meant));
    }
    for (pattern, _) in patterns.iter().zip(meant).filter(|(_, meant)| !meant) {
        warnings.push(without_net(pattern, "it leaves none out"));
    }
    warnings
}

/// One side; `meant` learns which patterns mean a net.
fn thin(
    copper: &mut Copper,
    patterns: &[Pattern],
    topology: Topology,
    meant: &mut [bool],
) -> Option<Warning> {
    let nets = topology::recover(copper, method(topology));
    let mut left_out = Vec::new();
    for id in (0..).map(topology::NetId).take(nets.nets().len()) {
        let names = called(copper, &nets, id);
        for (pattern, meant) in patterns.iter().zip(meant.iter_mut()) {
            if pattern.matches_any(&names) {
                *meant = true;
                left_out.push(id);
            }
        }
    }
    left_out.dedup();
    if left_out.is_empty() {
        return None;
    }
    let mut index = 0;
    copper.features.retain(|_| {
        index += 1;
        left_out.binary_search(&nets.of(index - 1)).is_err()
    });
    Some(warning(&left_out, &nets, copper.side))
}

fn warning(left_out: &[topology::NetId], nets: &Nets, side: Side) -> Warning {
    /// Nets that a message lists. Chosen: fits a line.
    const SHOWN: usize = 5;
    let mut labels: Vec<String> = left_out.iter().take(SHOWN).map(|&id| nets.label(id)).collect();
    if left_out.len() > SHOWN {
        labels.push(format!("{} more", left_out.len() - SHOWN));
    }
    let message = format!("not isolated, as requested: {}", labels.join(", "));
    planning::NETS_IGNORED.warning(message).on(side)
}
