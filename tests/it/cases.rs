//! How often properties are tried.

use proptest::prelude::ProptestConfig;
use proptest::test_runner::RngSeed;

/// The same cases every time; others, as many as it says, where `PROPTEST_CASES` is set.
pub(crate) fn same(cases: u32, seed: u64) -> ProptestConfig {
    let config = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    if std::env::var_os("PROPTEST_CASES").is_some() {
        return config;
    }
    ProptestConfig { cases, rng_seed: RngSeed::Fixed(seed), ..config }
}
