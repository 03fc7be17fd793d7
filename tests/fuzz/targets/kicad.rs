//! Any bytes as a KiCad board.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::import::kicad::read;

fuzz_target!(|bytes: &[u8]| {
    if let Err(error) = read("fuzz.kicad_pcb", bytes) {
        assert!(!error.render().is_empty(), "an error has words");
    }
});
