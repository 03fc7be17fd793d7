//! Local search: moves of two and three links over neighbour lists until none helps, then small
//! double bridges, one stretch after the other for as long as they help there.

use std::collections::VecDeque;

use crate::geometry::Point;

use super::few::{FEW, shortest};
use super::ground::{Ground, end};
use super::step::Step;
use super::tour::{End, Tour};
use super::{Effort, Leg};

/// Gains below a picometre are rounding.
const LEAST: f64 = 1e-3;
/// How far two of the three cuts of a double bridge may lie apart. Measured: 30 leave a tenth of a
/// percent, 10 half a percent.
const BRIDGE: u64 = 50;
/// Double bridges for each stretch at most. Measured: three times as many shorten the way through
/// a thousand by a quarter of a percent.
const SHAKES_EACH: usize = 60;
/// How many ends are looked at in the end, beyond which nothing is shaken: ten thousand stretches
/// are in order within two seconds.
const MOST_LOOKS: u64 = 3_000_000;
/// After how many double bridges in vain a stretch is left alone until something near it changes,
/// and how many more all have together. Measured: 40 shorten the way by a quarter of a percent and
/// take twice as long; 12 leave half a percent.
const IDLE_EACH: usize = 16;
const IDLE: usize = 100;

/// Improves an order of stretches with these `ends`, begun from `start`.
pub(super) fn improve(legs: &mut Vec<Leg>, ends: &[[Point; 2]], start: Point, effort: Effort) {
    if legs.len() <= FEW {
        *legs = shortest(ends, start);
        return;
    }
    let home = u32::try_from(2 * ends.len()).expect("ends are numbered in 32 bits");
    let mut entered: Vec<End> = vec![home];
    entered.extend(legs.iter().map(|leg| end(leg.stretch) + End::from(leg.reversed)));
    let mut search = Search::new(ends, start, Tour::new(entered));
    search.settle();
    if effort == Effort::Full {
        search.shake(SHAKES_EACH * legs.len(), IDLE_EACH + IDLE / legs.len());
    }
    *legs = search.legs(home);
}

/// A tour that also passes home: an extra stretch that is left at the start and entered for
/// nothing, which makes the open way a closed tour.
pub(super) struct Search {
    ground: Ground,
    tour: Tour,
    queue: VecDeque<End>,
    queued: Vec<bool>,
    length: f64,
    looks: u64,
    random: u64,
}

impl Search {
    fn new(ends: &[[Point; 2]], start: Point, tour: Tour) -> Self {
        let ground = Ground::new(ends, start);
        let queue: VecDeque<End> = tour.entered().iter().flat_map(|&entry| [entry, entry ^ 1]).collect();
        let queued = vec![true; 2 * ends.len() + 2];
        let random = 0x9E37_79B9_7F4A_7C15;
        Self { ground, tour, queue, queued, length: 0.0, looks: 0, random }
    }

    fn link(&self, end: End) -> f64 {
        self.ground.distance(end, self.tour.partner(end))
    }

    fn look_again(&mut self, end: End) {
        if !std::mem::replace(&mut self.queued[end as usize], true) {
            self.queue.push_back(end);
        }
    }

    /// Until no step at any queued end helps.
    fn settle(&mut self) {
        while let Some(end) = self.queue.pop_front() {
            self.queued[end as usize] = false;
            self.looks += 1;
            while let Some(step) = Step::best(&self.ground, &self.tour, end, LEAST) {
                step.take(&mut self.tour);
                self.length -= step.gain;
                step.ends().iter().for_each(|&end| self.look_again(end));
            }
        }
    }

    /// Double bridges from one stretch after the other, each kept only if the tour, settled again,
    /// is not longer; until at every stretch `idle` in a row gained nothing or enough has been
    /// looked at. What is shaken lies near what was before it, in memory too, and costs nothing
    /// more where it is good already, so time grows with the stretches.
    fn shake(&mut self, times: usize, idle: usize) {
        let count = u64::from(self.tour.count());
        if count < 4 {
            return;
        }
        let reach = BRIDGE.min((count - 1) / 2);
        let mut waiting: VecDeque<End> = self.tour.entered().iter().map(|entry| entry / 2).collect();
        // Of each stretch that waits; none of one that is left alone.
        let mut vain = vec![Some(0); waiting.len()];
        for _ in 0..times {
            let Some(stretch) = waiting.pop_front() else { return };
            self.tour.mark();
            self.length = 0.0;
            let first = u64::from(self.tour.place(2 * stretch));
            let cuts = [first, first + 1 + self.draw(reach), first + 1 + reach + self.draw(reach)];
            let outs = cuts.map(|cut| {
                let place = usize::try_from(cut % count).expect("a place in the tour");
                self.tour.entered()[place] ^ 1
            });
            self.bridge(outs);
            self.settle();
            if self.length < -LEAST {
                for end in self.tour.changed() {
                    if vain[(end / 2) as usize].replace(0).is_none() {
                        waiting.push_back(end / 2);
                    }
                }
            }
            if self.length > LEAST {
                self.tour.take_back();
            }
            let own = &mut vain[stretch as usize];
            *own = own.map(|vain| vain + 1).filter(|&vain| vain < idle);
            if own.is_some() {
                waiting.push_back(stretch);
            }
            if self.looks > MOST_LOOKS {
                return;
            }
        }
    }

    /// Swaps the two runs of stretches between three ways out: a–b … c–d … e–f becomes a–d … e–b …
    /// c–f.
    fn bridge(&mut self, [a, c, e]: [End; 3]) {
        let [b, d, f] = [a, c, e].map(|out| self.tour.partner(out));
        let before = self.link(a) + self.link(c) + self.link(e);
        self.tour.exchange(a, b, e, f);
        self.tour.exchange(a, e, d, c);
        self.tour.exchange(e, c, b, f);
        [a, b, c, d, e, f].into_iter().for_each(|end| self.look_again(end));
        self.length +=
            self.ground.distance(a, d) + self.ground.distance(e, b) + self.ground.distance(c, f) - before;
    }

    /// A number below `below`, from a fixed sequence (xorshift64).
    fn draw(&mut self, below: u64) -> u64 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        self.random % below.max(1)
    }

    /// The tour from home on, the way in which home is left at the start.
    fn legs(&self, home: End) -> Vec<Leg> {
        let entered = self.tour.entered();
        let place = entered.iter().position(|&end| end / 2 == home / 2).expect("home is in the tour");
        let (before, after) = (&entered[..place], &entered[place + 1..]);
        let leg = |end: End| Leg { stretch: (end / 2) as usize, reversed: end % 2 == 1, entry: None };
        if entered[place] == home {
            after.iter().chain(before).map(|&end| leg(end)).collect()
        } else {
            before.iter().rev().chain(after.iter().rev()).map(|&end| leg(end ^ 1)).collect()
        }
    }
}
