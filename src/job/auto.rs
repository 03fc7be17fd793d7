//! `--strategy auto`: for each net a loop or a region, whichever costs the machine less.
//!
//! No rule decides, but the machine: several plans are made, each is timed as its program would be
//! written, and the fastest is taken. The first two are regions for all nets and loops round all
//! nets, so the result never takes longer than either. The others mix them:
//!
//! ```text
//!  1  a region for every net                    4  loops round nets whose loop is short beside the
//!  2  a loop round every net                       edge of their region: by half, by a third, ..
//!  3  a loop round all but the net whose        ╭───╮  ●  a pad alone in the open is such a net: the
//!     loop is longest: what is left is its own  │ ● │     boundaries that go far out to part it from
//!                                               ╰───╯     its neighbours are no longer needed
//! ```
//!
//! A plan that leaves nets joined (a gap that is skipped, a frame that is not cut) is taken only
//! where each does.

use crate::topology::{Extent, NetId};
use crate::voronoi::{Boundaries, Owner};

use super::choice::Strategy;
use super::plan::{Chosen, Plan, Tried};
use super::{Error, Settings};

/// Loops are tried that are at most so long beside the edge of the net's region. Measured on the
/// corpus by `examples/strategies`: finer steps and other bounds gain less than one part in a
/// hundred.
const SHARES: [f64; 3] = [0.3, 0.45, 0.6];

/// The fastest of the plans that `plan` makes of nets with a loop; `strategies` says which nets are
/// free to have one or not.
pub(super) fn fastest(
    strategies: &[Strategy],
    extents: &[Extent],
    settings: &Settings,
    plan: impl Fn(Vec<NetId>) -> Result<Plan, Error>,
) -> Result<(Plan, Chosen), Error> {
    let nets = || (0_u32..).map(NetId).zip(strategies);
    let fixed: Vec<NetId> =
        nets().filter(|(_, strategy)| **strategy == Strategy::Outline).map(|(net, _)| net).collect();
    let free: Vec<NetId> =
        nets().filter(|(_, strategy)| **strategy == Strategy::Auto).map(|(net, _)| net).collect();
    let with_loops = |is_looped: &dyn Fn(NetId) -> bool| {
        let mut looped: Vec<NetId> = free.iter().copied().filter(|&net| is_looped(net)).collect();
        looped.extend(&fixed);
        looped.sort_unstable();
        looped
    };
    let radius = settings.kerf() / 2;
    let loop_length = |net: NetId| extents[net.index()].loop_length(radius);
    let longest = free.iter().copied().max_by(|&a, &b| loop_length(a).total_cmp(&loop_length(b)));

    let first = plan(fixed.clone())?;
    let edges = region_edges(&first.boundaries, strategies.len());
    let mut sets = vec![fixed.clone(), with_loops(&|_| true), with_loops(&|net| Some(net) != longest)];
    for share in SHARES {
        sets.push(with_loops(&|net| loop_length(net) <= share * edges[net.index()]));
    }
    let mut chosen = Chosen { tried: vec![first.tried(fixed.len(), settings)], taken: 0 };
    let mut best = first;
    for (index, looped) in sets.iter().enumerate().skip(1) {
        if sets[..index].contains(looped) {
            continue;
        }
        let next = plan(looped.clone())?;
        let tried = next.tried(looped.len(), settings);
        if tried.is_better(&chosen.tried[chosen.taken]) {
            chosen.taken = chosen.tried.len();
            best = next;
        }
        chosen.tried.push(tried);
    }
    Ok((best, chosen))
}

impl Tried {
    fn is_better(&self, than: &Self) -> bool {
        self.joined.cmp(&than.joined).then(self.seconds.total_cmp(&than.seconds)).is_lt()
    }
}

/// How long the edge of each net's region is, in nanometres.
fn region_edges(boundaries: &Boundaries, nets: usize) -> Vec<f64> {
    let mut edges = vec![0.0; nets];
    for boundary in &boundaries.edges {
        for owner in [boundary.left, boundary.right] {
            if let Owner::Net(net) = owner {
                edges[net.index()] += boundary.path.length();
            }
        }
    }
    edges
}
