//! Which random scenes a test draws: `VOROMILL_SEEDS=1000..2000` asks for others than the usual
//! ones, in every test that runs and takes its scenes by seeds.

use std::ops::Range;

/// The seeds that were asked for, or the usual ones.
pub(crate) fn seeds(usual: Range<u64>) -> Range<u64> {
    let Some(asked) = std::env::var_os("VOROMILL_SEEDS") else { return usual };
    let range = asked.to_str().and_then(|text| text.split_once(".."));
    let read = |(from, to): (&str, &str)| Some(from.parse().ok()?..to.parse().ok()?);
    range.and_then(read).expect("VOROMILL_SEEDS reads FROM..TO")
}
