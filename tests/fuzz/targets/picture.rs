//! Any bytes as a picture of copper.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::import::picture::{Options, read};

fuzz_target!(|bytes: &[u8]| {
    let options = Options { dpi_unless_said: Some(600.0), most_pixels: Some(1 << 16), ..Options::default() };
    if let Err(error) = read("fuzz.png", bytes, &options) {
        assert!(!error.render().is_empty(), "an error has words");
    }
});
