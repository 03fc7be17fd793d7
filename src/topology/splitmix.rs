//! Pseudo-random numbers that are the same everywhere.

/// The step of a counter whose numbers are mixed: 2⁶⁴ over the golden ratio.
pub(crate) const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// A hash of a number: the step of splitmix64 (S. Vigna, after G. Steele et al., 2014).
pub(crate) const fn splitmix(number: u64) -> u64 {
    let mut z = number.wrapping_add(STEP);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Draws whole numbers from zero to below what is asked for, for tests.
#[cfg(test)]
pub(crate) fn random() -> impl FnMut(i64) -> i64 {
    let mut state = 0;
    move |below| {
        state += 1;
        i64::try_from(splitmix(state) >> 33).expect("31 bits") % below
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_reference() {
        // The first two of `splitmix64.c` from a state of 0.
        assert_eq!([splitmix(0), splitmix(STEP)], [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4], "Vigna's");
    }
}
