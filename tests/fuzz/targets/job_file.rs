//! Any bytes as the Gerber job file of a board.
#![no_main]

use std::path::PathBuf;

use libfuzzer_sys::fuzz_target;
use voromill::import::{Selection, load};

const COPPER: &str = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.2*%\nD10*\nX0Y0D02*\nX5000000Y0D01*\nM02*\n";

fuzz_target!(|bytes: &[u8]| {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, content) in [("a.gbr", COPPER.as_bytes()), ("b-F_Cu.gbr", COPPER.as_bytes()), ("x.gbrjob", bytes)] {
        std::fs::write(folder.path().join(name), content).expect("written");
    }
    let paths: [PathBuf; 1] = [folder.path().to_owned()];
    if let Err(error) = load(&paths, &Selection::default()) {
        assert!(!error.render().is_empty(), "an error has words");
    }
});
