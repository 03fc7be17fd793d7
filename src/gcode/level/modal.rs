//! The modal state that levelling has to know: units, distance mode, motion, plane.

use super::words::Word;
use crate::geometry::Turn;

/// What the words so far say of those that follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Modal {
    /// Nanometres in a unit.
    pub(super) unit: i64,
    /// G91.
    pub(super) incremental: bool,
    /// G90.1.
    pub(super) absolute_centers: bool,
    /// A drilling cycle.
    pub(super) cycle: bool,
}

/// As the reader begins.
impl Default for Modal {
    fn default() -> Self {
        Self { unit: 1_000_000, incremental: false, absolute_centers: false, cycle: false }
    }
}

impl Modal {
    /// Takes a line into account.
    pub(super) fn update(&mut self, words: &[Word<'_>]) {
        for word in words.iter().filter(|word| word.letter == 'G') {
            match word.number.times(10) {
                Some(200) => self.unit = 25_400_000,
                Some(210) => self.unit = 1_000_000,
                Some(900) => self.incremental = false,
                Some(910) => self.incremental = true,
                Some(901) => self.absolute_centers = true,
                Some(911) => self.absolute_centers = false,
                Some(0 | 10 | 20 | 30 | 330 | 331 | 800) => self.cycle = false,
                Some(730 | 740 | 810..=890) => self.cycle = true,
                _ => {}
            }
        }
    }

    /// Decimals that tell a tenth of a micrometre, a quarter in inches: no less than the usual, so
    /// that the ends of short arcs are as far from their centre as controllers ask.
    pub(super) const fn decimals(self) -> usize {
        if self.unit == 1_000_000 { 4 } else { 5 }
    }

    /// One unit of the last decimal, in nanometres.
    pub(super) const fn digit(self) -> i64 {
        if self.unit == 1_000_000 { 100 } else { 254 }
    }
}

/// The word of an arc.
pub(super) const fn arc_word(turn: Turn) -> &'static str {
    match turn {
        Turn::Clockwise => "G2",
        Turn::CounterClockwise => "G3",
    }
}
