//! Any bytes as the body of an aperture macro and its parameters, flashed and drawn.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::import::gerber::{Options, read};

fuzz_target!(|bytes: &[u8]| {
    let split = bytes.iter().position(|&b| b == b'|').unwrap_or(bytes.len());
    let (body, parameters) = bytes.split_at(split);
    let mut file = b"%FSLAX46Y46*%\n%MOMM*%\n%AMFUZZ*".to_vec();
    file.extend_from_slice(body);
    file.extend_from_slice(b"%\n%ADD10FUZZ");
    if !parameters.is_empty() {
        file.push(b',');
        file.extend_from_slice(&parameters[1..]);
    }
    file.extend_from_slice(b"*%\nD10*\nX0Y0D03*\nX1000000Y500000D01*\n%LR30*%\nX2000000D03*\nM02*\n");
    if let Err(error) = read("fuzz.gbr", &file, &Options::default()) {
        assert!(!error.render().is_empty(), "an error has words");
    }
});
