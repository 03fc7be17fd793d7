//! Any bytes as a Gerber file.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::import::gerber::{Options, read};

fuzz_target!(|bytes: &[u8]| {
    if let Err(error) = read("fuzz.gbr", bytes, &Options::default()) {
        assert!(!error.render().is_empty(), "an error has words");
    }
});
