//! A step of the local search: two or three links through the air exchanged, found without touching
//! the tour.
//!
//! Every end has one link, so a step is told by which link it begins with and which near ends it
//! goes on to: 1–2 is unlinked, 2 linked to a near 3, whose link 3–4 is cut in turn, and 4 linked
//! to 1, or to a near 5, whose partner 6 is linked to 1. Which of these give a tour depends on how
//! the ends lie, in the tour's direction or against it:
//!
//! ```text
//!   Pair    1–2 … 4–3              3 lies as 2 does: what is between is turned round
//!   Pairs   … and 6–5              a second one upon the first
//!   Turn    1–2 … 6–5 … 3–4        3 lies the other way, 5 between 2 and 3: both parts are turned round,
//!   Swap    1–2 … 5–6 … 3–4        or change places
//! ```
//!
//! (Lin and Kernighan's search of 1973, three links deep; the array of the tour is reversed only
//! for what is taken.)

use super::ground::Ground;
use super::tour::{End, Tour};

/// How many near ends the third link is sought among. Measured: more cost time and gain nothing.
const BREADTH: usize = 4;

/// What is exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Pair,
    Pairs,
    Turn,
    Swap,
}

/// An exchange of links that makes the tour shorter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    kind: Kind,
    /// In the order of the module's drawing; of a pair the last two say nothing.
    ends: [End; 6],
    /// By how much.
    pub(super) gain: f64,
}

impl Step {
    /// The step that unlinks `first` and gains most, if that is more than `least`.
    pub(super) fn best(ground: &Ground, tour: &Tour, first: End, least: f64) -> Option<Self> {
        let (t1, t2) = (first, tour.partner(first));
        let (link, along) = (ground.distance(t1, t2), tour.is_entry(t2));
        let mut best = Self { kind: Kind::Pair, ends: [t1; 6], gain: least };
        for &(t3, length) in ground.near(t2) {
            if link - length <= least {
                break;
            }
            let t4 = tour.partner(t3);
            if t3 == t1 {
                continue;
            }
            let open = link - length + ground.distance(t3, t4);
            if tour.is_entry(t3) == along {
                let gain = open - ground.distance(t4, t1);
                if gain > best.gain {
                    best = Self { kind: Kind::Pair, ends: [t1, t2, t3, t4, t4, t3], gain };
                }
            }
            best.deepen(ground, tour, [t1, t2, t3, t4], open);
        }
        (best.gain > least).then_some(best)
    }

    /// Becomes a step of three links that begins with these four ends, if one gains more; `open` is
    /// what is gained before the tour is closed again.
    fn deepen(&mut self, ground: &Ground, tour: &Tour, [t1, t2, t3, t4]: [End; 4], open: f64) {
        let near = ground.near(t4);
        for &(t5, length) in &near[..BREADTH.min(near.len())] {
            let rest = open - length;
            if rest <= self.gain {
                break;
            }
            if t5 == t1 || t5 == t2 || t5 == t3 {
                continue;
            }
            let t6 = tour.partner(t5);
            let gain = rest + ground.distance(t5, t6) - ground.distance(t6, t1);
            if gain > self.gain
                && let Some(kind) = Kind::of(tour, [t2, t3, t4, t5])
            {
                *self = Self { kind, ends: [t1, t2, t3, t4, t5, t6], gain };
            }
        }
    }

    /// The ends whose links it changes.
    pub(super) fn ends(&self) -> &[End] {
        &self.ends[..if self.kind == Kind::Pair { 4 } else { 6 }]
    }

    /// Changes the tour.
    pub(super) fn take(&self, tour: &mut Tour) {
        let [t1, t2, t3, t4, t5, t6] = self.ends;
        match self.kind {
            Kind::Pair => tour.exchange(t1, t2, t4, t3),
            Kind::Pairs => {
                tour.exchange(t1, t2, t4, t3);
                tour.exchange(t1, t4, t6, t5);
            }
            Kind::Turn => {
                tour.exchange(t1, t2, t6, t5);
                tour.exchange(t2, t5, t3, t4);
            }
            Kind::Swap => {
                tour.exchange(t1, t2, t3, t4);
                tour.exchange(t1, t3, t6, t5);
                tour.exchange(t3, t5, t2, t4);
            }
        }
    }
}

impl Kind {
    /// What three links make whose ends from the second to the fifth are these; none where no tour
    /// would be left.
    fn of(tour: &Tour, [t2, t3, t4, t5]: [End; 4]) -> Option<Self> {
        let along = tour.is_entry(t2);
        let same = tour.is_entry(t5) == along;
        let pair = tour.is_entry(t3) == along;
        let last = if pair { t4 } else { t3 };
        // What lies from the second end on, away from the first.
        let within = if along { tour.is_between(t2, t5, last) } else { tour.is_between(last, t5, t2) };
        match (pair, within, same) {
            // What the first pair turns round lies the other way after it.
            (true, true, false) | (true, false, true) => Some(Self::Pairs),
            (false, true, true) => Some(Self::Turn),
            (false, true, false) => Some(Self::Swap),
            (true, true, true) | (true, false, false) | (false, false, _) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which ends are partners, the smaller first.
    fn links(tour: &Tour) -> Vec<(End, End)> {
        let entered = tour.entered();
        let pairs = entered.iter().zip(entered.iter().cycle().skip(1));
        let mut links: Vec<_> = pairs.map(|(a, b)| ((a ^ 1).min(*b), (a ^ 1).max(*b))).collect();
        links.sort_unstable();
        links
    }

    #[test]
    fn every_step_leaves_a_tour_with_the_links_that_it_says_and_can_be_taken_back() {
        let entered: Vec<End> = vec![0, 3, 4, 7, 8, 11, 12, 14, 16];
        let ends = 0..18;
        let mut kinds = Vec::new();
        for (t1, t3, t5) in
            ends.clone().flat_map(|a| ends.clone().flat_map(move |b| (0..18).map(move |c| (a, b, c))))
        {
            let mut tour = Tour::new(entered.clone());
            let [t2, t4, t6] = [t1, t3, t5].map(|end| tour.partner(end));
            let mut all = [t1, t2, t3, t4, t5, t6];
            let step = Step { kind: Kind::Pair, ends: all, gain: 0.0 };
            all.sort_unstable();
            if all.windows(2).any(|pair| pair[0] == pair[1]) {
                continue;
            }
            let Some(kind) = Kind::of(&tour, [t2, t3, t4, t5]) else { continue };
            let before = links(&tour);
            Step { kind, ..step }.take(&mut tour);
            let after = links(&tour);
            for (a, b) in [(t2, t3), (t4, t5), (t6, t1)] {
                assert!(after.contains(&(a.min(b), a.max(b))), "{kind:?}: {a} is linked to {b}");
            }
            let kept = before.iter().filter(|link| after.contains(link)).count();
            assert_eq!(kept, entered.len() - 3, "{kind:?}: all other links stay");
            assert!(after.iter().all(|&(a, b)| tour.partner(a) == b), "{kind:?}: partners are known");
            tour.take_back();
            assert_eq!(links(&tour), before, "{kind:?}: as before");
            kinds.push(kind);
        }
        for kind in [Kind::Pairs, Kind::Turn, Kind::Swap] {
            assert!(kinds.contains(&kind), "{kind:?} was tried");
        }
    }
}
