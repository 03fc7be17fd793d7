//! Any bytes as a zip archive of a board.
#![no_main]

use std::io::Write;
use std::path::PathBuf;

use libfuzzer_sys::fuzz_target;
use voromill::import::{Selection, load};

fuzz_target!(|bytes: &[u8]| {
    let mut file = tempfile::Builder::new().suffix(".zip").tempfile().expect("a temporary file");
    file.write_all(b"PK\x03\x04").and_then(|()| file.write_all(bytes)).expect("written");
    let paths: [PathBuf; 1] = [file.path().to_owned()];
    if let Err(error) = load(&paths, &Selection::default()) {
        assert!(!error.render().is_empty(), "an error has words");
    }
});
