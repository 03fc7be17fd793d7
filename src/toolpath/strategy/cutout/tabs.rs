//! Where tabs go: on straight stretches, as evenly round as those allow.

use crate::geometry::{Nm, Point};

use super::ring::Ring;

/// What holds the board while it is cut out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tabs<'a> {
    /// Where they are.
    pub places: TabPlaces<'a>,
    /// How wide each stays.
    pub width: Nm,
    /// How far below the surface their tops lie.
    pub top: Nm,
}

/// Where tabs are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TabPlaces<'a> {
    /// So many on each contour round a board, evenly spread; fewer on cut-outs whose piece is
    /// small.
    Count(u32),
    /// So many that they are no farther apart than this along the way.
    Spacing(Nm),
    /// On the contours next to these points of the board.
    At(&'a [Point]),
}

/// How far the way may turn, in radians, within how many openings to both sides of a tab's middle:
/// at best about 20° within the tab and half its width beside it; where a contour has no place for
/// that, more, and then within the tab alone. Chosen.
const STRAIGHT: [(f64, f64); 5] = [(0.35, 1.0), (1.0, 1.0), (0.35, 0.5), (1.0, 0.5), (f64::INFINITY, 0.5)];
/// How many places along a contour are looked at. Chosen: one for each 0.1 mm of a common board.
const PLACES: u32 = 2000;
/// How many beginnings of an even spread are tried. Chosen.
const PHASES: u32 = 24;

/// The distances along a ring at which a tab may have its middle.
pub(super) fn places(ring: &Ring) -> impl Iterator<Item = f64> {
    let step = step(ring);
    (0..PLACES).map(move |place| step * f64::from(place))
}

fn step(ring: &Ring) -> f64 {
    ring.length() / f64::from(PLACES)
}

/// How long the stretch of a ring is that has these places.
pub(super) fn length(ring: &Ring, own: &[f64]) -> f64 {
    step(ring) * f64::from(u32::try_from(own.len()).unwrap_or(PLACES))
}

/// The most tabs a contour has room for: each with as much way between them.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
pub(super) fn room(length: f64, opening: f64) -> u32 {
    (length / (2.0 * opening)) as u32
}

/// The middles of `count` tabs at some of the places `own`, ascending distances along the ring;
/// fewer where no more find room.
pub(super) fn spread(ring: &Ring, own: &[f64], count: u32, opening: f64) -> Vec<f64> {
    let mut best = Vec::new();
    for (most, openings) in STRAIGHT {
        let is_straight = |place: &f64| ring.turn_around(*place, openings * opening) < most;
        let places: Vec<f64> = own.iter().copied().filter(is_straight).collect();
        let found = evenest(ring, own, &places, count, opening);
        if found.len() > best.len() {
            best = found;
        }
        if best.len() == count as usize {
            break;
        }
    }
    best.sort_by(f64::total_cmp);
    best
}

/// Of several even spreads over `own` moved to the nearest of `places`, the one that has most tabs
/// and is moved least.
fn evenest(ring: &Ring, own: &[f64], places: &[f64], count: u32, opening: f64) -> Vec<f64> {
    let length = ring.length();
    let share = self::length(ring, own) / f64::from(count.max(1));
    let mut best: (Vec<f64>, f64) = (Vec::new(), f64::INFINITY);
    for phase in 0..PHASES {
        let mut found: Vec<f64> = Vec::new();
        let mut moved = 0.0;
        for index in 0..count {
            let even = share * (f64::from(index) + (f64::from(phase) + 0.5) / f64::from(PHASES));
            let Some(even) = at(ring, own, even) else { continue };
            let free = |place: f64| found.iter().all(|other| apart(place, *other, length) >= 2.0 * opening);
            if let Some(place) = nearest(places, even, length, share, free) {
                moved += apart(place, even, length) * apart(place, even, length);
                found.push(place);
            }
        }
        if found.len() > best.0.len() || (found.len() == best.0.len() && moved < best.1) {
            best = (found, moved);
        }
    }
    best.0
}

/// Of `places` along a ring of a `length`, in order, the nearest to one, no farther than `reach`,
/// that is free; of equals the first.
fn nearest(places: &[f64], from: f64, length: f64, reach: f64, free: impl Fn(f64) -> bool) -> Option<f64> {
    let next = places.partition_point(|&place| place < from);
    let (before, after) = places.split_at(next);
    let mut ahead = after.iter().chain(before).copied().peekable();
    let mut behind = before.iter().rev().chain(after.iter().rev()).copied().peekable();
    let by_distance =
        |a: &f64, b: &f64| apart(*a, from, length).total_cmp(&apart(*b, from, length)).then(a.total_cmp(b));
    for _ in places {
        let is_ahead = by_distance(ahead.peek()?, behind.peek()?).is_le();
        let place = if is_ahead { ahead.next() } else { behind.next() }?;
        if apart(place, from, length) > reach {
            return None;
        }
        if free(place) {
            return Some(place);
        }
    }
    None
}

/// The distance along the ring of what is so far along its places `own`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
fn at(ring: &Ring, own: &[f64], along: f64) -> Option<f64> {
    let whole = (along / step(ring)).floor();
    own.get(whole as usize).map(|before| before + (along - whole * step(ring)))
}

/// How far two places of a ring are apart, the shorter way round.
pub(super) fn apart(a: f64, b: f64, length: f64) -> f64 {
    let direct = (a - b).abs();
    direct.min(length - direct)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::random;

    #[test]
    fn the_nearest_free_place_is_that_of_all() {
        let mut next = random();
        for _ in 0..500 {
            let mut number = |below: i64| f64::from(u32::try_from(next(below)).expect("small"));
            let (length, reach) = (1000.0, number(600));
            let count = number(8);
            let mut places: Vec<f64> =
                (0..12).map(f64::from).take_while(|&i| i < count).map(|_| number(1000)).collect();
            places.sort_by(f64::total_cmp);
            let (from, taken) = (number(1000), number(1000));
            let free = |place: f64| apart(place, taken, length) > 100.0;
            let off = |place: &f64| apart(*place, from, length);
            let near = places.iter().copied().filter(|place| off(place) <= reach && free(*place));
            let least = near.min_by(|a, b| off(a).total_cmp(&off(b)));
            assert_eq!(nearest(&places, from, length, reach, free), least, "of {places:?} from {from}");
        }
    }
}
