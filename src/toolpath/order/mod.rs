//! The order of the trails: less travel through the air.
//!
//! Trails between which the tool retracts are the cities of a travelling salesman who enters each
//! at one end and leaves at the other (a closed one anywhere). Nearest-next starts; exchanges of
//! two and three links over neighbour lists (2-opt, Or-opt and 3-opt moves in one) improve it; then
//! small double bridges, seeded, shake it at one trail after the other, kept where the repaired
//! tour is shorter, until at each many in a row were in vain. Of a few trails all orders are tried.
//! Everything is bounded by counts, never by a clock, so the order depends on the trails alone.
//!
//! # Sources
//!
//! G. A. Croes, *A method for solving traveling-salesman problems*, Operations Research 6, 1958
//! (2-opt). S. Lin, *Computer solutions of the traveling salesman problem*, Bell System Technical
//! Journal 44, 1965 (3-opt). I. Or, *Traveling salesman-type combinatorial problems and their
//! relation to the logistics of regional blood banking*, Northwestern University, 1976 (Or-opt).
//! O. Martin, S. W. Otto, E. W. Felten, *Large-step Markov chains for the traveling salesman
//! problem*, Complex Systems 5, 1991 (double bridges).

mod few;
mod ground;
mod neighbours;
mod search;
mod step;
mod tour;

use crate::geometry::Point;

use neighbours::Buckets;
use search::improve;

/// How trails are put in order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Nearest next, then improved.
    #[default]
    Improved,
    /// Nearest next, as in the paper (§III-G).
    Greedy,
}

/// What is cut in one go, from one retract to the next; it may also be cut the other way round.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    /// Where it begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// Where else it may begin and end, if it is closed.
    pub entries: Vec<Point>,
}

impl Stretch {
    /// One that is cut from end to end.
    pub(super) const fn open(from: Point, to: Point) -> Self {
        Self { from, to, entries: Vec::new() }
    }
}

/// A stretch in its leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Leg {
    /// Its index.
    pub stretch: usize,
    /// Whether it is cut from its end.
    pub reversed: bool,
    /// The index of the entry at which it begins; none for its own beginning.
    pub entry: Option<usize>,
}

/// Beside cuts so many times as long, the way between them is worth no long search. Measured: a
/// long one takes as long as all the rest of a wide isolation together, and shortens its way by a
/// fifth, which is 0.2 % of the time on the machine.
const CUT_A_WAY: f64 = 10.0;

/// Every stretch once; the first is sought from `start`. Improving never makes the way longer; it
/// goes on less long where the way is next to nothing beside the `cut` nanometres of the stretches
/// themselves.
pub(super) fn arrange(stretches: &[Stretch], start: Point, order: Order, cut: f64) -> Vec<Leg> {
    let ends: Vec<[Point; 2]> = stretches.iter().map(|stretch| [stretch.from, stretch.to]).collect();
    let mut greedy = nearest_next(&ends, start);
    let mut improved = (order == Order::Improved).then(|| greedy.clone());
    let shortest = improved.as_mut().map(|legs| improve_all(legs, stretches, &ends, start, cut));
    let first = enter_well(&mut greedy, stretches, &mut ends.clone(), start);
    improved.filter(|_| shortest.is_some_and(|shortest| shortest <= first)).unwrap_or(greedy)
}

/// Improves an order, chooses where closed stretches are entered, and improves it once more; the
/// length of the way.
fn improve_all(
    legs: &mut Vec<Leg>,
    stretches: &[Stretch],
    ends: &[[Point; 2]],
    start: Point,
    cut: f64,
) -> f64 {
    let mut ends = ends.to_vec();
    if stretches.iter().any(|stretch| !stretch.entries.is_empty()) {
        improve(legs, &ends, start, Effort::Quick);
    }
    let way = enter_well(legs, stretches, &mut ends, start);
    improve(legs, &ends, start, if way * CUT_A_WAY < cut { Effort::Quick } else { Effort::Full });
    enter_well(legs, stretches, &mut ends, start)
}

/// How long an order is improved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Effort {
    /// Until no move helps.
    Quick,
    /// And shaken after that.
    Full,
}

/// From each end to the nearest end of a stretch not yet cut.
fn nearest_next(ends: &[[Point; 2]], start: Point) -> Vec<Leg> {
    let mut buckets = Buckets::new(ends.as_flattened());
    let (mut at, mut legs) = (start, Vec::with_capacity(ends.len()));
    while let Some(end) = buckets.nearest(at) {
        let (stretch, reversed) = (end / 2, end % 2 == 1);
        buckets.remove(2 * stretch);
        buckets.remove(2 * stretch + 1);
        at = ends[stretch][1 - end % 2];
        legs.push(Leg { stretch, reversed, entry: None });
    }
    legs
}

/// Begins each closed stretch where the way to it and on from it is shortest; the length of the
/// whole way.
fn enter_well(legs: &mut [Leg], stretches: &[Stretch], ends: &mut [[Point; 2]], start: Point) -> f64 {
    let (mut before, mut length) = (start, 0.0);
    for index in 0..legs.len() {
        let leg = legs[index];
        let after = legs.get(index + 1).map(|next| ends[next.stretch][usize::from(next.reversed)]);
        let detour = |p: Point| before.distance(p) + after.map_or(0.0, |after| p.distance(after));
        let entries = stretches[leg.stretch].entries.iter().enumerate();
        if let Some((entry, &point)) = entries.min_by(|a, b| detour(*a.1).total_cmp(&detour(*b.1))) {
            legs[index].entry = Some(entry);
            ends[leg.stretch] = [point, point];
        }
        let [first, last] = ends[leg.stretch];
        let (first, last) = if leg.reversed { (last, first) } else { (first, last) };
        length += before.distance(first);
        before = last;
    }
    length
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::Nm;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::new(x), Nm::new(y))
    }

    fn travel(stretches: &[Stretch], legs: &[Leg]) -> f64 {
        let (mut here, mut sum) = (Point::default(), 0.0);
        for leg in legs {
            let Stretch { from, to, entries } = &stretches[leg.stretch];
            let entry = leg.entry.map(|entry| entries[entry]);
            let (first, last) = if leg.reversed { (*to, *from) } else { (*from, *to) };
            sum += here.distance(entry.unwrap_or(first));
            here = entry.unwrap_or(last);
        }
        sum
    }

    fn any_stretch() -> impl Strategy<Value = Stretch> {
        let place = || (0..1000_i64, 0..1000_i64).prop_map(|(x, y)| at(x * 10_000, y * 10_000));
        (place(), place(), any::<bool>()).prop_map(|(from, to, closed)| {
            if closed { Stretch { from, to: from, entries: vec![from, to] } } else { Stretch::open(from, to) }
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn every_stretch_is_cut_once_and_improving_never_makes_it_longer(
            stretches in prop::collection::vec(any_stretch(), 0..60),
        ) {
            let greedy = arrange(&stretches, Point::default(), Order::Greedy, 0.0);
            let improved = arrange(&stretches, Point::default(), Order::Improved, 0.0);
            for legs in [&greedy, &improved] {
                let mut seen: Vec<usize> = legs.iter().map(|leg| leg.stretch).collect();
                seen.sort_unstable();
                prop_assert_eq!(seen, (0..stretches.len()).collect::<Vec<_>>());
            }
            let (before, after) = (travel(&stretches, &greedy), travel(&stretches, &improved));
            prop_assert!(after <= before + 1.0, "greedy {before}, improved {after}");
        }

        #[test]
        fn small_orders_are_as_good_as_the_best(
            stretches in prop::collection::vec(any_stretch(), 1..5),
        ) {
            let open: Vec<_> = stretches.iter().map(|s| Stretch::open(s.from, s.to)).collect();
            let found = travel(&open, &arrange(&open, Point::default(), Order::Improved, 0.0));
            let best = shortest(&open, &mut vec![false; open.len()], Point::default());
            prop_assert!(found <= best + 1.0, "found {found}, possible {best}");
        }
    }

    #[test]
    fn the_end_to_begin_with_need_not_be_among_the_nearest() {
        let far = Stretch::open(at(7_020_000, 2_230_000), at(3_810_000, 5_560_000));
        let near = Stretch::open(at(3_690_000, 5_640_000), at(2_600_000, 7_960_000));
        let stretches = [near, far];
        let legs = arrange(&stretches, Point::default(), Order::Improved, 0.0);
        assert_eq!(legs.iter().map(|leg| leg.stretch).collect::<Vec<_>>(), [1, 0], "it saves a millimetre");
    }

    /// The way through `count` points strewn over a square, as a multiple of √(count · area).
    fn strewn(count: u32) -> f64 {
        const SIDE: u64 = 100_000_000;
        let mut state = 88_172_645_463_325_252_u64;
        let mut draw = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            i64::try_from(state % SIDE).expect("below the side")
        };
        let holes: Vec<Stretch> = (0..count)
            .map(|_| {
                let hole = at(draw(), draw());
                Stretch::open(hole, hole)
            })
            .collect();
        let way = travel(&holes, &arrange(&holes, Point::default(), Order::Improved, 0.0));
        way / (f64::from(count).sqrt() * 1e8)
    }

    /// Johnson and McGeoch (The Traveling Salesman Problem: A Case Study, 1997, §2) give the
    /// optimum as 0.7313 for 1000 points and 0.7168 for 10 000.
    #[test]
    fn a_thousand_holes_are_within_five_percent_of_the_best_order() {
        let ratio = strewn(1000);
        assert!(ratio <= 0.7313 * 1.05, "{ratio}");
    }

    #[test]
    #[cfg_attr(debug_assertions, ignore = "takes seconds in a debug build")]
    fn ten_thousand_holes_are_within_five_percent_of_the_best_order() {
        let ratio = strewn(10_000);
        assert!(ratio <= 0.7168 * 1.05, "{ratio}");
    }

    /// By trying all orders.
    fn shortest(stretches: &[Stretch], done: &mut Vec<bool>, here: Point) -> f64 {
        let mut best = f64::INFINITY;
        for i in 0..stretches.len() {
            if !done[i] {
                done[i] = true;
                let Stretch { from, to, .. } = stretches[i];
                best = best.min(here.distance(from) + shortest(stretches, done, to));
                best = best.min(here.distance(to) + shortest(stretches, done, from));
                done[i] = false;
            }
        }
        if best.is_finite() { best } else { 0.0 }
    }
}
