//! Any bytes as a drill file, with copper to judge its number format by.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::geometry::{Nm, Point, Rect};
use voromill::import::excellon::{Context, read};

fuzz_target!(|bytes: &[u8]| {
    let at = |x, y| Point::new(Nm::from_mm(x), Nm::from_mm(y));
    let context = Context::new([at(10, 20), at(30, 5)], Some(Rect::new(at(0, 0), at(50, 40))));
    for context in [Context::default(), context] {
        if let Err(error) = read("fuzz.drl", bytes, &context) {
            assert!(!error.render().is_empty(), "an error has words");
        }
    }
});
