//! Any text as `voromill.toml`, and what it says as the settings of a job.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::job::{Options, Settings};

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    match Options::from_toml("voromill.toml", &text).and_then(Settings::resolve) {
        Ok(settings) => assert!(!settings.options().listed().is_empty(), "settings can be listed"),
        Err(error) => assert!(!error.to_string().is_empty(), "an error has words"),
    }
});
