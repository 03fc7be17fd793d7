//! Any text as a millproject of pcb2gcode, and what it says as the settings of a job.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::job::{MillProject, Settings};

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    let read = MillProject::read("millproject", &text);
    if let Err(error) = read.and_then(|project| Settings::resolve(project.options)) {
        assert!(!error.to_string().is_empty(), "an error has words");
    }
});
