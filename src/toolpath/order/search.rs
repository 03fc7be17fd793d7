//! Local search: Or-opt moves and chains of 2-opt moves until none helps, then double bridges.

use std::cmp::Ordering;
use std::collections::VecDeque;

use crate::geometry::Point;

use super::neighbours::Buckets;
use super::tour::{End, Tour};
use super::{Effort, Leg};

/// How many near ends each end looks at. Chosen: the usual eight; ten changed nothing, five cost a percent.
const NEAR: usize = 8;
/// How many 2-opt moves a chain may have.
const LONGEST_CHAIN: usize = 6;
/// How many first moves of a chain are tried.
const BREADTH: usize = 5;
/// How many stretches an Or-opt move carries at most.
const CARRIED: usize = 3;
/// How many stretches a move that does not help by itself may turn round: beyond it the trial costs more than it finds.
const LONGEST_TRIAL: u32 = 300;
/// Gains below a picometre are rounding.
const LEAST: f64 = 1e-3;
/// How far the three cuts of a double bridge may lie apart.
const BRIDGE: u64 = 30;
/// The least double bridges, so that a handful of stretches is ordered as well as can be.
const LEAST_SHAKES: usize = 60;
/// Double bridges for each stretch. Measured: eight shorten the way by another half percent, and cost a fifth of the
/// time of a whole job on a small board.
const SHAKES_EACH: usize = 3;
/// The most double bridges, for ten thousand stretches within two seconds.
const MOST_SHAKES: usize = 24_000;

/// Improves an order of stretches with these `ends`, begun from `start`.
pub(super) fn improve(legs: &mut Vec<Leg>, ends: &[[Point; 2]], start: Point, effort: Effort) {
    if legs.len() < 2 {
        return;
    }
    let home = u32::try_from(2 * ends.len()).expect("ends are numbered in 32 bits");
    let mut entered: Vec<End> = vec![home];
    entered.extend(legs.iter().map(|leg| end(leg.stretch) + End::from(leg.reversed)));
    let mut search = Search::new(ends, start, Tour::new(entered));
    search.settle();
    if effort == Effort::Full {
        search.shake((LEAST_SHAKES + SHAKES_EACH * legs.len()).min(MOST_SHAKES));
    }
    *legs = search.legs(home);
}

fn end(stretch: usize) -> End {
    u32::try_from(2 * stretch).expect("ends are numbered in 32 bits")
}

/// A tour that also passes home: an extra stretch that is left at the start and entered for nothing, which makes
/// the open way a closed tour.
struct Search {
    points: Vec<(f64, f64)>,
    home: End,
    near: Vec<End>,
    width: usize,
    /// Of few stretches, home sees more ends than the others do, who leave out their own.
    near_home: Vec<End>,
    tour: Tour,
    queue: VecDeque<End>,
    queued: Vec<bool>,
    length: f64,
    random: u64,
}

/// A 2-opt move: the near end, its partner, and what is gained before the tour is closed again.
#[derive(Clone, Copy)]
struct Link {
    near: End,
    other: End,
    gain: f64,
}

impl Search {
    fn new(ends: &[[Point; 2]], start: Point, tour: Tour) -> Self {
        let flat = ends.as_flattened();
        let buckets = Buckets::new(flat);
        let width = NEAR.min(flat.len().saturating_sub(2));
        let mut near = Vec::with_capacity(flat.len() * width);
        for (index, &point) in (0_u32..).zip(flat) {
            near.extend(
                buckets.nearest_few(point, width, |other| other / 2 != index / 2).iter().map(|n| n.1),
            );
        }
        let near_home = buckets.nearest_few(start, NEAR, |_| true).iter().map(|n| n.1).collect();
        let mut points: Vec<(f64, f64)> = flat.iter().map(|p| p.to_f64()).collect();
        points.extend([start.to_f64(); 2]);
        let home = end(ends.len());
        let queue: VecDeque<End> = tour.entered().iter().flat_map(|&entry| [entry, entry ^ 1]).collect();
        let queued = vec![true; points.len()];
        let random = 0x9E37_79B9_7F4A_7C15;
        Self { points, home, near, width, near_home, tour, queue, queued, length: 0.0, random }
    }

    fn distance(&self, a: End, b: End) -> f64 {
        if a == self.home || b == self.home {
            return 0.0;
        }
        let (p, q) = (self.points[a as usize], self.points[b as usize]);
        let (x, y) = (p.0 - q.0, p.1 - q.1);
        (x * x + y * y).sqrt()
    }

    /// The near ends of `end`: home has them where it is left, none where it is entered.
    fn near(&self, end: End) -> &[End] {
        match end.cmp(&self.home) {
            Ordering::Less => &self.near[end as usize * self.width..(end as usize + 1) * self.width],
            Ordering::Equal => &[],
            Ordering::Greater => &self.near_home,
        }
    }

    fn link(&self, end: End) -> f64 {
        self.distance(end, self.tour.partner(end))
    }

    fn exchange(&mut self, a: End, b: End, c: End, d: End) {
        self.tour.exchange(a, b, c, d);
        for end in [a, b, c, d] {
            self.look_again(end);
        }
    }

    fn look_again(&mut self, end: End) {
        if !std::mem::replace(&mut self.queued[end as usize], true) {
            self.queue.push_back(end);
        }
    }

    /// Until no move at any queued end helps.
    fn settle(&mut self) {
        while let Some(end) = self.queue.pop_front() {
            self.queued[end as usize] = false;
            while self.chain(end) || self.carry(end) {}
        }
    }

    /// A 2-opt move that unlinks `fixed`, or a chain of such moves, kept as far as it is best.
    fn chain(&mut self, fixed: End) -> bool {
        let before = self.tour.changes();
        for choice in 0..BREADTH {
            let (mut open, mut best, mut kept) = (0.0, LEAST, before);
            let mut touched = [fixed; 3 * LONGEST_CHAIN];
            for step in 0..LONGEST_CHAIN {
                let loose = self.tour.partner(fixed);
                open += self.distance(fixed, loose);
                let Some(link) = self.step(fixed, loose, open, if step == 0 { choice } else { 0 }) else {
                    break;
                };
                open = link.gain - self.distance(fixed, link.other);
                // A move that only prepares for the next must not cost much by itself.
                if open <= best && self.tour.span(loose, link.near) > LONGEST_TRIAL {
                    break;
                }
                self.tour.exchange(fixed, loose, link.other, link.near);
                touched[3 * step..][..3].copy_from_slice(&[loose, link.other, link.near]);
                if open > best {
                    (best, kept) = (open, self.tour.changes());
                }
            }
            self.tour.take_back(kept);
            if kept > before {
                self.length -= best;
                touched.into_iter().for_each(|end| self.look_again(end));
                return true;
            }
        }
        false
    }

    /// The 2-opt move that links `loose` to a near end and gains most, after leaving out the best `skip`.
    fn step(&self, fixed: End, loose: End, open: f64, skip: usize) -> Option<Link> {
        let mut found = [Link { near: loose, other: fixed, gain: f64::NEG_INFINITY }; BREADTH];
        let entry = self.tour.is_entry(loose);
        for &near in self.near(loose) {
            let gain = open - self.distance(loose, near);
            if gain <= LEAST {
                break;
            }
            let other = self.tour.partner(near);
            if self.tour.is_entry(near) == entry && other != loose && other != fixed {
                let link = Link { near, other, gain: gain + self.distance(near, other) };
                let place = found.partition_point(|better| better.gain >= link.gain);
                if place < BREADTH {
                    found[place..].rotate_right(1);
                    found[place] = link;
                }
            }
        }
        Some(found[skip]).filter(|link| link.gain > f64::NEG_INFINITY)
    }

    /// An Or-opt move: up to three stretches from `first` on, away from its partner, go elsewhere beside a near end.
    fn carry(&mut self, first: End) -> bool {
        let before = self.tour.partner(first);
        let mut last = first ^ 1;
        for _ in 0..CARRIED {
            let after = self.tour.partner(last);
            if after == before || after ^ 1 == before || first == self.home || last == self.home {
                return false;
            }
            let gain =
                self.distance(before, first) + self.distance(last, after) - self.distance(before, after);
            for (held, far) in [(first, last), (last, first)] {
                if self.carry_to([before, first, last, after], held, far, gain) {
                    return true;
                }
            }
            last = after ^ 1;
        }
        false
    }

    /// Carries the stretches between two ends so that `held` is linked to a near end and `far` to that one's partner.
    fn carry_to(&mut self, [before, first, last, after]: [End; 4], held: End, far: End, gain: f64) -> bool {
        for index in 0..self.near(held).len() {
            let near = self.near(held)[index];
            let so_far = gain - self.distance(held, near);
            if so_far <= LEAST {
                return false;
            }
            let other = self.tour.partner(near);
            let better = so_far + self.distance(near, other) - self.distance(far, other);
            if better <= LEAST
                || near == before
                || near == after
                || self.between(first, last, near)
                || self.between(first, last, other)
            {
                continue;
            }
            self.length -= better;
            // The one of the two that follows the stretches when walking on from `after`.
            let (c, d) = if self.tour.is_entry(near) == self.tour.is_entry(first) {
                (other, near)
            } else {
                (near, other)
            };
            self.exchange(before, first, c, d);
            self.exchange(before, c, after, last);
            // Now before–after … c–last … first–d.
            if (held == first) == (near == c) {
                self.exchange(c, last, first, d);
            }
            return true;
        }
        false
    }

    /// Whether `end` belongs to the at most three stretches from `first` to `last`.
    fn between(&self, first: End, last: End, end: End) -> bool {
        let mut at = first;
        for _ in 0..CARRIED {
            if at / 2 == end / 2 {
                return true;
            }
            if at ^ 1 == last {
                return false;
            }
            at = self.tour.partner(at ^ 1);
        }
        false
    }

    /// Double bridges at random places, each kept only if the tour, settled again, is not longer.
    fn shake(&mut self, times: usize) {
        let count = u64::from(self.tour.count());
        if count < 4 {
            return;
        }
        for _ in 0..times {
            self.tour.mark();
            self.length = 0.0;
            let first = self.draw(count);
            let reach = BRIDGE.min((count - 1) / 2);
            let cuts = [first, first + 1 + self.draw(reach), first + 1 + reach + self.draw(reach)];
            let outs = cuts.map(|cut| {
                let place = usize::try_from(cut % count).expect("a place in the tour");
                self.tour.entered()[place] ^ 1
            });
            self.bridge(outs);
            self.settle();
            if self.length > LEAST {
                self.tour.take_back(0);
            }
        }
    }

    /// Swaps the two runs of stretches between three ways out: a–b … c–d … e–f becomes a–d … e–b … c–f.
    fn bridge(&mut self, [a, c, e]: [End; 3]) {
        let [b, d, f] = [a, c, e].map(|out| self.tour.partner(out));
        let before = self.link(a) + self.link(c) + self.link(e);
        self.exchange(a, b, e, f);
        self.exchange(a, e, d, c);
        self.exchange(e, c, b, f);
        self.length += self.distance(a, d) + self.distance(e, b) + self.distance(c, f) - before;
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
