//! How the picture of the back lies on that of the front, by the drill dots that both show.
//!
//! The distance of two dots is the same on both pictures, however they were laid on the scanner. So
//! each pair of the back that has few pairs of the front as long as it is laid on these; of all
//! turns and shifts that come of it, the one counts with which most dots meet. Least squares over
//! all that meet make it finer than a pixel. Nothing is drawn by lot: pairs are taken in the order
//! of how rare they are.
//!
//! A back that is mirrored fits mirrored alone, and that is said: which side of a board a picture
//! shows is nothing to guess.
//!
//! S. Umeyama, *Least-squares estimation of transformation parameters between two point patterns*,
//! IEEE Trans. PAMI 13, 1991, in the plane and without a scale.

use std::collections::HashMap;

use crate::board::Hole;

use super::motion::{Motion, Place};

/// How far two dots that meet may be apart, in pixels: the middle of each is within half a pixel of
/// its place. Chosen.
const OFF: f64 = 1.5;

/// The same before the motion is refined: a pair that is a pixel off turns all others. Chosen.
const ROUGHLY: f64 = 3.0;

/// How far dots of pictures that lie on each other may be apart on average, in pixels. Chosen: what
/// the middles of dots are off.
const ALIGNED: f64 = 0.5;

/// How many dots must meet, and what part of those of the picture with fewer. Chosen.
const LEAST: usize = 3;
const SHARE: f64 = 0.6;

/// How many must meet before a picture is called mirrored. Chosen: three meet by chance.
const MIRRORED: usize = 4;

/// The farthest turn of a back seen from the front, in radians: 45 degrees. Chosen: past that, the
/// corners of a board would fit by another turn as well.
const FARTHEST: f64 = std::f64::consts::FRAC_PI_4;

/// The most dots of which pairs are made: those farthest from the middle. Chosen.
const MOST: usize = 250;

/// The most pairs of the back that are laid on the front, and the most ways to do so. Chosen.
const PAIRS: usize = 80;
const WAYS: usize = 20_000;

/// The most different motions that are refined. Chosen.
const REFINED: usize = 24;

/// How the picture of the back lies on that of the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Registration {
    /// As it is.
    Aligned,
    /// It is to be moved so.
    Moved(Fit),
    /// It fits mirrored alone: so many dots meet then.
    Mirrored(usize),
    /// One of the two has so few dots.
    TooFew(usize),
    /// So few dots meet at best.
    Apart(usize),
    /// It fits in several ways, with so many dots each.
    Ambiguous(usize),
}

/// A motion, and how well it fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fit {
    /// The back is to be moved so.
    pub(crate) motion: Motion,
    /// How many dots meet.
    pub(crate) count: usize,
    /// How far they are apart then, on average and at most, in nanometres.
    pub(crate) mean: f64,
    /// The farthest, in nanometres.
    pub(crate) worst: f64,
}

/// How the `back` lies on the `front`, whose pixels have so many nanometres.
pub(crate) fn register(front: &[Hole], back: &[Hole], pixel: f64) -> Registration {
    let places = |holes: &[Hole]| -> Vec<Place> {
        holes.iter().map(|hole| (hole.path.start.x.to_f64(), hole.path.start.y.to_f64())).collect()
    };
    let (front, back) = (Dots::new(places(front), pixel), places(back));
    let fewer = front.places.len().min(back.len());
    if fewer < LEAST {
        return Registration::TooFew(fewer);
    }
    #[expect(clippy::cast_precision_loss, reason = "counts of dots")]
    let is_enough = |count: usize| count >= LEAST && count as f64 >= fewer as f64 * SHARE;
    let still = front.fit(&back, Motion::new(0.0, (0.0, 0.0), (0.0, 0.0)), OFF);
    let still = still.filter(|fit| is_enough(fit.count) && fit.mean <= ALIGNED * pixel);
    let fits = front.fits(&back, |angle| angle.abs() <= FARTHEST);
    let best = fits.first().filter(|fit| is_enough(fit.count));
    let flipped: Vec<Place> = back.iter().map(|&(x, y)| (-x, y)).collect();
    let mirrored = front.fits(&flipped, |_| true).first().map_or(0, |fit| fit.count);
    let upright = best.iter().map(|fit| fit.count).chain(still.map(|fit| fit.count)).max().unwrap_or(0);
    if mirrored >= MIRRORED && is_enough(mirrored) && mirrored > upright + (upright / 20).max(1) {
        return Registration::Mirrored(mirrored);
    }
    match (still, best) {
        (Some(still), Some(best)) if still.count >= best.count => Registration::Aligned,
        (Some(_), None) => Registration::Aligned,
        (_, Some(best)) => {
            let is_whole = best.count == front.places.len() && best.count == back.len();
            if fits.len() > 1 && fits[1].count == best.count && !is_whole {
                Registration::Ambiguous(best.count)
            } else {
                Registration::Moved(*best)
            }
        }
        (None, None) => Registration::Apart(fits.first().map_or(0, |fit| fit.count)),
    }
}

/// The dots of the front, found by where they are.
struct Dots {
    places: Vec<Place>,
    pixel: f64,
    /// Squares as wide as [`ROUGHLY`] with the numbers of what lies in them.
    squares: HashMap<(i64, i64), Vec<usize>>,
}

/// Two dots: how far apart, and their numbers.
type Pair = (f64, usize, usize);

impl Dots {
    fn new(places: Vec<Place>, pixel: f64) -> Self {
        let mut squares: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
        for (number, &place) in places.iter().enumerate() {
            squares.entry(square(place, pixel)).or_default().push(number);
        }
        Self { places, pixel, squares }
    }

    /// The dot nearest to a place, within so many pixels, [`ROUGHLY`] at most.
    fn nearest(&self, place: Place, within: f64) -> Option<(f64, Place)> {
        let (column, row) = square(place, self.pixel);
        let near = (column - 1..=column + 1).flat_map(|x| (row - 1..=row + 1).map(move |y| (x, y)));
        let numbers = near.filter_map(|square| self.squares.get(&square)).flatten();
        let dots = numbers.map(|&number| (distance(self.places[number], place), self.places[number]));
        let least = dots.min_by(|a, b| a.0.total_cmp(&b.0));
        least.filter(|dot| dot.0 <= within * self.pixel)
    }

    /// How `back`, moved so, fits; none where no dots meet.
    fn fit(&self, back: &[Place], motion: Motion, within: f64) -> Option<Fit> {
        let met = back.iter().filter_map(|&dot| self.nearest(motion.place(dot), within));
        let (count, sum, worst) = met.fold((0, 0.0, 0.0), |(count, sum, worst), (off, _)| {
            (count + 1, sum + off, f64::max(worst, off))
        });
        #[expect(clippy::cast_precision_loss, reason = "counts of dots")]
        let mean = sum / count as f64;
        (count > 0).then_some(Fit { motion, count, mean, worst })
    }

    /// All different ways in which dots of the back meet dots of the front, by a turn that is
    /// `allowed`: most first, and the one that turns and shifts least of those alike.
    fn fits(&self, back: &[Place], allowed: impl Fn(f64) -> bool) -> Vec<Fit> {
        let mut rough: Vec<Fit> = self
            .ways(back, allowed)
            .into_iter()
            .filter_map(|motion| self.fit(back, motion, ROUGHLY))
            .filter(|fit| fit.count >= LEAST)
            .collect();
        rough.sort_by(|a, b| b.count.cmp(&a.count).then(a.mean.total_cmp(&b.mean)));
        let mut fits: Vec<Fit> = Vec::new();
        for fit in rough {
            if fits.len() == REFINED {
                break;
            }
            let is_new = |known: &Fit| self.difference(back, &known.motion, &fit.motion) > 2.0 * ROUGHLY;
            if !fits.iter().all(is_new) {
                continue;
            }
            let mut motion = fit.motion;
            for within in [ROUGHLY, OFF, OFF, OFF] {
                motion = self.refined(back, motion, within);
            }
            let Some(fit) = self.fit(back, motion, OFF) else { continue };
            let is_new = |known: &Fit| self.difference(back, &known.motion, &fit.motion) > ROUGHLY;
            if fits.iter().all(is_new) {
                fits.push(fit);
            }
        }
        let moved = |fit: &Fit| {
            let still = Motion::new(0.0, (0.0, 0.0), (0.0, 0.0));
            self.difference(back, &fit.motion, &still)
        };
        fits.sort_by(|a, b| b.count.cmp(&a.count).then(moved(a).total_cmp(&moved(b))));
        fits
    }

    /// Motions that lay a pair of the back on a pair of the front.
    fn ways(&self, back: &[Place], allowed: impl Fn(f64) -> bool) -> Vec<Motion> {
        let front_pairs = pairs(&self.places);
        let alike = |length: f64| {
            let slack = 2.0 * self.pixel;
            let from = front_pairs.partition_point(|pair| pair.0 < length - slack);
            let to = front_pairs.partition_point(|pair| pair.0 <= length + slack);
            &front_pairs[from..to]
        };
        let back_pairs = pairs(back);
        let longest = back_pairs.last().map_or(0.0, |pair| pair.0);
        let mut rare: Vec<(usize, Pair)> = back_pairs
            .into_iter()
            .filter(|pair| pair.0 >= longest / 3.0)
            .map(|pair| (alike(pair.0).len(), pair))
            .filter(|(count, _)| *count > 0)
            .collect();
        rare.sort_by(|(a, p), (b, q)| a.cmp(b).then(q.0.total_cmp(&p.0)));
        let mut ways = Vec::new();
        for (_, (length, a, b)) in rare.into_iter().take(PAIRS) {
            let (p, q) = (back[a], back[b]);
            let before = libm::atan2(q.1 - p.1, q.0 - p.0);
            for &(_, c, d) in alike(length) {
                for (c, d) in [(c, d), (d, c)] {
                    let (u, v) = (self.places[c], self.places[d]);
                    let angle =
                        libm::remainder(libm::atan2(v.1 - u.1, v.0 - u.0) - before, std::f64::consts::TAU);
                    if allowed(angle) {
                        ways.push(Motion::new(angle, middle(p, q), middle(u, v)));
                    }
                }
            }
            if ways.len() > WAYS {
                break;
            }
        }
        ways
    }

    /// The motion by least squares of what meets after `motion`.
    fn refined(&self, back: &[Place], motion: Motion, within: f64) -> Motion {
        let met: Vec<(Place, Place)> =
            back.iter().filter_map(|&dot| Some((dot, self.nearest(motion.place(dot), within)?.1))).collect();
        let mean = |places: &mut dyn Iterator<Item = Place>| {
            let (count, x, y) = places.fold((0.0, 0.0, 0.0), |(n, x, y), p| (n + 1.0, x + p.0, y + p.1));
            (x / f64::max(count, 1.0), y / f64::max(count, 1.0))
        };
        if met.len() < 2 {
            return motion;
        }
        let from = mean(&mut met.iter().map(|pair| pair.0));
        let to = mean(&mut met.iter().map(|pair| pair.1));
        let (mut along, mut across) = (0.0, 0.0);
        for &(p, q) in &met {
            let (px, py, qx, qy) = (p.0 - from.0, p.1 - from.1, q.0 - to.0, q.1 - to.1);
            (along, across) = (along + px * qx + py * qy, across + px * qy - py * qx);
        }
        Motion::new(libm::atan2(across, along), from, to)
    }

    /// How far apart two motions lay a dot at most, in pixels.
    fn difference(&self, back: &[Place], a: &Motion, b: &Motion) -> f64 {
        let off = back.iter().map(|&dot| distance(a.place(dot), b.place(dot)));
        off.fold(0.0, f64::max) / self.pixel
    }
}

/// All pairs of the dots farthest from the middle, the shortest first.
fn pairs(places: &[Place]) -> Vec<Pair> {
    let sum = places.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.0, sum.1 + p.1));
    #[expect(clippy::cast_precision_loss, reason = "counts of dots")]
    let count = places.len() as f64;
    let center = (sum.0 / count, sum.1 / count);
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| {
        distance(places[b], center).total_cmp(&distance(places[a], center)).then(a.cmp(&b))
    });
    order.truncate(MOST);
    let mut pairs: Vec<Pair> = Vec::new();
    for (at, &a) in order.iter().enumerate() {
        pairs.extend(order[at + 1..].iter().map(|&b| (distance(places[a], places[b]), a, b)));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    pairs
}

#[expect(clippy::cast_possible_truncation, reason = "`as` saturates, and no board is so large")]
fn square(place: Place, pixel: f64) -> (i64, i64) {
    let side = ROUGHLY * pixel;
    ((place.0 / side).floor() as i64, (place.1 / side).floor() as i64)
}

fn distance(a: Place, b: Place) -> f64 {
    libm::hypot(a.0 - b.0, a.1 - b.1)
}

fn middle(a: Place, b: Place) -> Place {
    (f64::midpoint(a.0, b.0), f64::midpoint(a.1, b.1))
}
