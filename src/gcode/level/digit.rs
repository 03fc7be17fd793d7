//! The last decimal of what levelling writes.

/// Decimals that tell a tenth of a micrometre, a quarter in inches, by the nanometres in a unit: no
/// less than the usual, so that the ends of short arcs are as far from their centre as controllers
/// ask.
pub(super) const fn decimals(unit: i64) -> usize {
    if unit == 1_000_000 { 4 } else { 5 }
}

/// One unit of the last decimal, in nanometres.
pub(super) const fn digit(unit: i64) -> i64 {
    if unit == 1_000_000 { 100 } else { 254 }
}
