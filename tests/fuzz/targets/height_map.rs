//! Any text as a map of heights, and a program bent to it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::gcode::level::{Frame, HeightMap, Levelling, level};
use voromill::geometry::Nm;

const PROGRAM: &str = "G21\nG90\nG0 Z5\nG0 X1 Y1\nG1 Z-0.1 F100\nG1 X4 Y4\nG2 X5 Y3 I0 J-1\nG0 Z5\nM2\n";

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    let frame = Frame { unit: Nm::from_mm(1), zero: Some([Nm::ZERO; 3]) };
    match HeightMap::read(&text, &frame) {
        Err(error) => assert!(!error.to_string().is_empty(), "an error has words"),
        Ok((map, _)) => {
            let (tolerance, margin) = (Nm::from_um(5), Nm::from_mm(2));
            let levelling = Levelling { tolerance, margin, safe: None, note: String::new() };
            if let Err(error) = level(PROGRAM, &map, &levelling) {
                assert!(!error.to_string().is_empty(), "an error has words");
            }
        }
    }
});
