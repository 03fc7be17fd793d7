//! Any bytes as a DXF drawing, filled.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::geometry::Nm;
use voromill::import::drawing::{Options, Unit};
use voromill::import::dxf::read;

fuzz_target!(|bytes: &[u8]| {
    let options = Options { unit: Some(Unit::MILLIMETRE), ..Options::default() };
    match read("fuzz.dxf", bytes, &options) {
        Ok(drawing) => drop(drawing.artwork.polygons(Nm::from_um(1))),
        Err(error) => assert!(!error.render().is_empty(), "an error has words"),
    }
});
