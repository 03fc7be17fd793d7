//! Which odd nodes are joined by a second cut: a matching in which staying alone costs half a
//! retract.
//!
//! Nearest pairs first, then alternating chains: a pair is taken apart, one of the two joins a near
//! node, whose partner is loose in turn, and so on a few steps; whatever makes the sum smaller is
//! kept. A search goes on from a node only where the most that can be gained from there would do,
//! and again only with more gain than before. The exact algorithm (J. Edmonds, *Paths, trees, and
//! flowers*, Canadian Journal of Mathematics 17, 1965) would be several hundred lines for the last
//! percent.

use crate::topology::Groups;

use super::number;

/// Two nodes that may be joined, the smaller first, and what joining them costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Candidate {
    pub(super) nodes: (usize, usize),
    pub(super) cost: f64,
}

/// How many pairs a chain takes apart at most. Chosen: more found nothing on the boards at hand.
const LONGEST: usize = 4;
/// How many ways one search looks at. Measured: it finds what a search finds that looks at ten
/// times as many and leaves none out; around a hub of hundreds of nodes there are far more.
const BUDGET: usize = 10_000;
/// How many ways all searches and markings together may look at, for each node. Chosen: as many as
/// two searches that find nothing.
const EACH: usize = 2 * BUDGET;
/// Gains below this are rounding.
const LEAST: f64 = 1e-9;

/// The indices of the candidates that are joined, each node at most once, with a small sum of their
/// costs and of `alone` for every node left over.
pub(super) fn join(nodes: usize, candidates: &[Candidate], alone: f64) -> Vec<usize> {
    joined(nodes, candidates, alone).0
}

/// [`join`], and how many ways were looked at: at most [`EACH`] for each node and what the last
/// search still took.
fn joined(nodes: usize, candidates: &[Candidate], alone: f64) -> (Vec<usize>, usize) {
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    let key = |index: usize| candidates[index];
    order.sort_by(|&a, &b| key(a).cost.total_cmp(&key(b).cost).then(key(a).nodes.cmp(&key(b).nodes)));
    let ways = order.iter().flat_map(|&candidate| {
        let Candidate { nodes: (a, b), cost } = key(candidate);
        [(a, b), (b, a)].map(|(from, to)| (number(from), Way { to, cost, candidate }))
    });
    let mut matching = Matching {
        candidates,
        near: Groups::new(nodes, ways),
        joined: vec![None; nodes],
        closing: vec![None; nodes],
        alone,
        promise: vec![[f64::NEG_INFINITY; LONGEST]; nodes],
        looks: 0,
    };
    for index in order {
        let Candidate { nodes: (a, b), cost } = key(index);
        let is_alone = |node: usize| matching.joined[node].is_none();
        if cost < 2.0 * alone && is_alone(a) && is_alone(b) {
            matching.join(index);
        }
    }
    for pairs in 0..LONGEST {
        (0..nodes).for_each(|node| matching.promise[node][pairs] = matching.most(node, pairs));
    }
    let mut search = Search::of(nodes);
    let mut changed = Changed::all(nodes);
    while changed.any {
        changed.any = false;
        for node in 0..nodes {
            let is_due = std::mem::take(&mut changed.about[node]) && !matching.near.of(node).is_empty();
            if is_due && matching.looks < EACH * nodes {
                let touched = matching.improve(node, &mut search);
                matching.looks += changed.mark(&touched, &mut matching);
            }
        }
    }
    debug_assert!(matching.promises_are_kept(), "a promise is out of date");
    let mut chosen: Vec<usize> = matching.joined.into_iter().flatten().map(|way| way.candidate).collect();
    chosen.sort_unstable();
    chosen.dedup();
    (chosen, matching.looks)
}

/// A candidate as one of its nodes sees it.
#[derive(Clone, Copy, Debug)]
struct Way {
    to: usize,
    cost: f64,
    candidate: usize,
}

struct Matching<'a> {
    candidates: &'a [Candidate],
    /// The candidates of each node, cheapest first.
    near: Groups<Way>,
    /// The way by which a node is joined.
    joined: Vec<Option<Way>>,
    /// The way by which a chain that comes to a node would come back, while one is sought.
    closing: Vec<Option<Way>>,
    alone: f64,
    /// By how much a chain can gain at most from a node that is loose, after one more pair at most,
    /// after two, and so on; more than it can where it would come by a node twice.
    promise: Vec<[f64; LONGEST]>,
    /// How many ways were looked at.
    looks: usize,
}

impl Matching<'_> {
    /// Joins the two nodes of a candidate.
    fn join(&mut self, candidate: usize) {
        let Candidate { nodes: (a, b), cost } = self.candidates[candidate];
        self.joined[a] = Some(Way { to: b, cost, candidate });
        self.joined[b] = Some(Way { to: a, cost, candidate });
    }

    /// What a loose node promises if so many pairs may follow the next one.
    fn most(&self, node: usize, pairs: usize) -> f64 {
        let mate = self.joined[node].map(|way| way.to);
        let ways = self.near.of(node).iter().filter(|way| Some(way.to) != mate);
        let gains = ways.map(|way| match self.joined[way.to] {
            None => 2.0 * self.alone - way.cost,
            Some(Way { to: partner, cost: freed, .. }) => {
                let further = pairs.checked_sub(1).map_or(0.0, |pairs| self.promise[partner][pairs]);
                freed - way.cost + further.max(0.0)
            }
        });
        gains.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether all that is promised is what it would be if it were worked out now.
    fn promises_are_kept(&self) -> bool {
        let all = self.promise.iter().enumerate();
        let mut each = all.flat_map(|(node, promise)| promise.iter().enumerate().map(move |of| (node, of)));
        each.all(|(node, (pairs, promise))| promise.total_cmp(&self.most(node, pairs)).is_eq())
    }

    /// Frees `node` and its partner and looks for a chain that gains; the nodes that are joined
    /// otherwise than before.
    fn improve(&mut self, node: usize, search: &mut Search) -> Vec<usize> {
        let (loose, first, gain, rest) = match self.joined[node] {
            // Alone: it is the loose end itself, and nothing waits for the chain to come back.
            None => (node, None, self.alone, 0.0),
            Some(way) => (way.to, Some(node), way.cost, self.alone),
        };
        let back = first.map_or(&[][..], |first| self.near.of(first));
        let home = back.iter().map(|way| way.cost).fold(rest + self.alone, f64::min);
        search.begin(rest, home);
        search.busy.push(node);
        search.busy.push(loose);
        back.iter().for_each(|&way| self.closing[way.to] = Some(way));
        let found = self.extend(loose, gain, search);
        back.iter().for_each(|way| self.closing[way.to] = None);
        self.looks += BUDGET - search.budget;
        if found { self.apply(first, search.chain.all()) } else { Vec::new() }
    }

    /// Joins `loose` to a near node and either closes there or goes on from that node's partner.
    fn extend(&self, loose: usize, gain: f64, search: &mut Search) -> bool {
        let pairs = search.chain.len + 1;
        for &Way { to: next, cost, candidate } in self.near.of(loose) {
            let left = gain - cost;
            // A chain may yet end at a node that was alone.
            if left + self.alone <= LEAST || search.budget == 0 {
                return false;
            }
            search.budget -= 1;
            let Some(Way { to: partner, cost: freed, .. }) = self.joined[next] else {
                if left + self.alone - search.rest > LEAST && !search.busy.all().contains(&next) {
                    search.chain.push(candidate);
                    return true;
                }
                continue;
            };
            let left = left + freed;
            let close = self.closing[partner].filter(|close| close.cost < left - LEAST);
            let ends = left - search.rest - self.alone > LEAST;
            // What has come here with more, and after no more pairs, has gone on from here.
            let goes_on = pairs < LONGEST
                && left + self.promise[partner][LONGEST - 1 - pairs] > search.home + LEAST
                && search.reached[partner].is_less(search.number, pairs, left);
            if !(close.is_some() || ends || goes_on) || search.busy.all().contains(&next) {
                continue;
            }
            search.chain.push(candidate);
            if let Some(close) = close {
                search.chain.push(close.candidate);
            }
            if close.is_some() || ends {
                return true;
            }
            search.reached[partner].note(search.number, pairs, left);
            search.busy.push(next);
            search.busy.push(partner);
            if self.extend(partner, left, search) {
                return true;
            }
            search.busy.len -= 2;
            search.chain.len -= 1;
        }
        false
    }

    /// Takes apart whatever the chain's nodes were in, and joins them along it; all that were
    /// touched.
    fn apply(&mut self, first: Option<usize>, chain: &[usize]) -> Vec<usize> {
        let ends = chain.iter().flat_map(|&candidate| {
            let (a, b) = self.candidates[candidate].nodes;
            [a, b]
        });
        let mut freed: Vec<usize> = ends.chain(first).collect();
        let partners: Vec<usize> =
            freed.iter().filter_map(|&node| self.joined[node].map(|way| way.to)).collect();
        freed.extend(partners);
        for &node in &freed {
            self.joined[node] = None;
        }
        chain.iter().for_each(|&candidate| self.join(candidate));
        freed
    }
}

/// What a search for a chain has joined so far, and how many ways it may yet look at; one search
/// after the other.
struct Search {
    /// Which search it is, from 1.
    number: usize,
    /// How it has gone on from each node.
    reached: Vec<Reached>,
    chain: Few,
    /// The nodes that the chain uses.
    busy: Few,
    /// What it costs if the chain does not come back to the node that waits for it.
    rest: f64,
    /// The least that a chain must have gained to end, one way or the other.
    home: f64,
    budget: usize,
}

impl Search {
    fn of(nodes: usize) -> Self {
        let reached = vec![Reached::default(); nodes];
        let (chain, busy) = (Few::default(), Few::default());
        Self { number: 0, reached, chain, busy, rest: 0.0, home: 0.0, budget: 0 }
    }

    /// Begins another.
    fn begin(&mut self, rest: f64, home: f64) {
        self.number += 1;
        (self.chain.len, self.busy.len) = (0, 0);
        (self.rest, self.home, self.budget) = (rest, home, BUDGET);
    }
}

/// With how much gain a search has gone on from a loose node, after so many pairs or fewer.
#[derive(Clone, Copy, Default)]
struct Reached {
    search: usize,
    gain: [f64; LONGEST],
}

impl Reached {
    /// Whether it has gone on in this `search` with less than `gain` after so many `pairs`, if at
    /// all.
    fn is_less(&self, search: usize, pairs: usize, gain: f64) -> bool {
        self.search != search || self.gain[pairs] < gain
    }

    /// It goes on with more than before.
    fn note(&mut self, search: usize, pairs: usize, gain: f64) {
        if self.search != search {
            *self = Self { search, gain: [f64::NEG_INFINITY; LONGEST] };
        }
        self.gain[pairs..].iter_mut().for_each(|most| *most = most.max(gain));
    }
}

/// A list no longer than what a chain needs.
#[derive(Default)]
struct Few {
    items: [usize; 2 * (LONGEST + 1)],
    len: usize,
}

impl Few {
    fn push(&mut self, item: usize) {
        self.items[self.len] = item;
        self.len += 1;
    }

    fn all(&self) -> &[usize] {
        &self.items[..self.len]
    }
}

/// The nodes about which something has changed since a chain was last sought from them.
struct Changed {
    about: Vec<bool>,
    any: bool,
    /// When each node was last loose, as a number of the mark.
    seen: Vec<usize>,
    marks: usize,
}

impl Changed {
    fn all(nodes: usize) -> Self {
        Self { about: vec![true; nodes], any: nodes > 0, seen: vec![0; nodes], marks: 0 }
    }

    /// Marks all nodes from which a chain can come by one of those `touched`, and makes good what
    /// is promised there; gives how many ways it looked at.
    ///
    /// A chain comes by a node from a loose one near it, and that is the partner of the node before
    /// it, or of the one from which the chain is sought.
    fn mark(&mut self, touched: &[usize], matching: &mut Matching<'_>) -> usize {
        let mut looks = 0;
        self.marks += 1;
        self.any |= !touched.is_empty();
        touched.iter().for_each(|&node| self.about[node] = true);
        let (mut by, mut all) = (touched.to_vec(), touched.to_vec());
        touched.iter().for_each(|&node| self.seen[node] = self.marks);
        for pairs in 0..LONGEST {
            let mut loose: Vec<usize> =
                by.iter().flat_map(|&node| matching.near.of(node).iter().map(|way| way.to)).collect();
            looks += loose.len();
            loose.retain(|&node| std::mem::replace(&mut self.seen[node], self.marks) != self.marks);
            by = loose.iter().map(|&node| matching.joined[node].map_or(node, |way| way.to)).collect();
            by.iter().for_each(|&node| self.about[node] = true);
            all.extend(loose);
            for &node in &all {
                looks += matching.near.of(node).len();
                matching.promise[node][pairs] = matching.most(node, pairs);
            }
        }
        looks
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn cost(candidates: &[Candidate], chosen: &[usize], nodes: usize, alone: f64) -> f64 {
        let left = u32::try_from(nodes - 2 * chosen.len()).expect("a few");
        chosen.iter().map(|&index| candidates[index].cost).sum::<f64>() + alone * f64::from(left)
    }

    /// By trying everything.
    fn best(candidates: &[Candidate], used: u32, nodes: usize, alone: f64) -> f64 {
        let mut least = alone * f64::from(u32::try_from(nodes).expect("a few") - used.count_ones());
        for (index, Candidate { nodes: (a, b), cost }) in candidates.iter().enumerate() {
            if used & (1 << a | 1 << b) == 0 {
                least =
                    least.min(cost + best(&candidates[index + 1..], used | 1 << a | 1 << b, nodes, alone));
            }
        }
        least
    }

    proptest! {
        #[test]
        fn a_matching_uses_no_node_twice_and_is_about_the_best(
            costs in prop::collection::vec((0..8_usize, 0..8_usize, 0.1..3.0_f64), 0..14),
        ) {
            let mut candidates: Vec<Candidate> = costs
                .into_iter()
                .filter(|(a, b, _)| a != b)
                .map(|(a, b, cost)| Candidate { nodes: (a.min(b), a.max(b)), cost })
                .collect();
            candidates.sort_by_key(|candidate| candidate.nodes);
            candidates.dedup_by_key(|candidate| candidate.nodes);
            let chosen = join(8, &candidates, 1.0);
            let mut seen: Vec<usize> = chosen.iter().flat_map(|&i| [candidates[i].nodes.0, candidates[i].nodes.1]).collect();
            seen.sort_unstable();
            let count = seen.len();
            seen.dedup();
            prop_assert_eq!(seen.len(), count, "a node is joined twice");
            let (found, least) = (cost(&candidates, &chosen, 8, 1.0), best(&candidates, 0, 8, 1.0));
            prop_assert!(found <= least * 1.1 + 1e-9, "found {found}, possible {least}");
        }
    }

    /// Nodes of which each may be joined to a dozen others, any of them, for about what both cost
    /// alone: what hubs are to a search.
    fn tangle(nodes: usize) -> Vec<Candidate> {
        let mut seed = 11_u64;
        let mut chance = |below: usize| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            usize::try_from(seed >> 33).expect("31 bits") % below
        };
        let mut candidates: Vec<Candidate> = (0..nodes * 6)
            .map(|_| (chance(nodes), chance(nodes), chance(1000)))
            .filter(|(a, b, _)| a != b)
            .map(|(a, b, cost)| Candidate {
                nodes: (a.min(b), a.max(b)),
                cost: 1.0 + f64::from(u32::try_from(cost).expect("small")) / 1000.0,
            })
            .collect();
        candidates.sort_by_key(|candidate| candidate.nodes);
        candidates.dedup_by_key(|candidate| candidate.nodes);
        candidates
    }

    #[test]
    fn the_work_of_a_tangle_grows_as_it_does() {
        for nodes in [100, 1600] {
            let (chosen, looks) = joined(nodes, &tangle(nodes), 1.0);
            assert!(chosen.len() * 5 > nodes * 2, "{} of {nodes} nodes are joined", 2 * chosen.len());
            // What one search and one marking may still take, once the budget is spent.
            let last = BUDGET * 20 + 12 * nodes;
            assert!(looks <= EACH * nodes + last, "{looks} looks for {nodes} nodes");
        }
    }
}
