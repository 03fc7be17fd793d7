//! The colours of Algorithm 2: random ones, those seen, and the odds of a confusion.

use bitvec::prelude::{BitVec, Lsb0};

use crate::raster::blend::mix;
use crate::topology::splitmix::{STEP, splitmix};

/// A colour of 8 bits a component: red, green, blue.
pub type Colour = [u8; 3];

/// The splitmix64 generator (Steele, Lea, Flood 2014): 64 good bits from a counter, so a seed is
/// one number.
#[derive(Clone, Debug)]
pub(super) struct Random(u64);

impl Random {
    pub(super) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        let number = splitmix(self.0);
        self.0 = self.0.wrapping_add(STEP);
        number
    }

    /// Any colour other than black whose half is not among those `seen`, and enters its half there.
    ///
    /// The paper asks for unique colours; of 2²⁴ only 2²¹ differ once halved, so it is the halves
    /// that must. Past a million traces they would run out, and repeat.
    pub(super) fn colour(&mut self, seen: &mut Colours) -> Colour {
        for _ in 0..64 {
            let [red, green, blue, ..] = self.next().to_le_bytes();
            let colour = [red, green, blue];
            if colour != [0; 3] && seen.insert(mix([colour])) {
                return colour;
            }
        }
        [255; 3]
    }
}

/// A set of colours, one bit for each of the 2²⁴: two megabytes, and an answer in one look.
#[derive(Clone, Debug)]
pub(super) struct Colours(BitVec<u32, Lsb0>);

impl Colours {
    /// The set of black alone, where nothing is drawn.
    pub(super) fn black() -> Self {
        let mut colours = Self(BitVec::repeat(false, 1 << 24));
        colours.insert([0; 3]);
        colours
    }

    pub(super) fn contains(&self, colour: Colour) -> bool {
        self.0[index(colour)]
    }

    /// Adds `colour`; whether it is new.
    pub(super) fn insert(&mut self, colour: Colour) -> bool {
        !self.0.replace(index(colour), true)
    }
}

fn index([red, green, blue]: Colour) -> usize {
    usize::from(red) << 16 | usize::from(green) << 8 | usize::from(blue)
}

/// How likely the algorithm is to miss an overlap because two mixes look alike, as the paper
/// estimates it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Odds {
    /// P_bc: that some mix has the colour of a single trace.
    pub base: f64,
    /// P_mc: that two mixes have one colour.
    pub mixed: f64,
}

impl Odds {
    /// For `traces` traces that overlap in `overlaps` regions.
    ///
    /// ```text
    /// P_bc ≤ overlaps × traces × 2⁻²²
    /// P_mc ≈ 1 − (1 − overlaps / 2²⁵)^(overlaps − 1)
    /// ```
    #[must_use]
    pub fn new(traces: u32, overlaps: u32) -> Self {
        let base = f64::from(overlaps) * f64::from(traces) / f64::from(1 << 22);
        let apart = 1.0 - f64::from(overlaps) / f64::from(1 << 25);
        let mixed = 1.0 - power(apart.max(0.0), overlaps.saturating_sub(1));
        Self { base: base.min(1.0), mixed }
    }
}

/// `base` to the power of `exponent`, by multiplications alone.
fn power(base: f64, exponent: u32) -> f64 {
    let (mut result, mut square) = (1.0, base);
    for bit in 0..u32::BITS {
        if exponent >> bit & 1 == 1 {
            result *= square;
        }
        square *= square;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_odds_of_the_paper_s_example_come_out() {
        let odds = Odds::new(100, 10);
        assert!((1.0 / odds.base - 4194.3).abs() < 0.1, "about 1 in 4000: {}", odds.base);
        assert!((1.0 / odds.mixed - 372_827.0).abs() < 1.0, "about 1 in 372 000: {}", odds.mixed);
    }

    #[test]
    fn random_colours_differ_when_halved() {
        let (mut random, mut seen) = (Random::new(7), Colours::black());
        let halves: std::collections::BTreeSet<_> =
            (0..10_000).map(|_| mix([random.colour(&mut seen)])).collect();
        assert_eq!(halves.len(), 10_000, "all different");
        assert!(halves.iter().all(|&half| seen.contains(half)), "and all entered");
    }
}
