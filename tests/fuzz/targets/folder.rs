//! A folder of any files with any names: which layer is which.
//!
//! The bytes are cut at form feeds; of each piece the first line is a file's name and the rest its
//! content.
#![no_main]

use std::path::PathBuf;

use libfuzzer_sys::fuzz_target;
use voromill::import::{Selection, load};

fuzz_target!(|bytes: &[u8]| {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for piece in bytes.split(|&b| b == 0x0c).take(16) {
        let (name, content) = piece.split_at(piece.iter().position(|&b| b == b'\n').unwrap_or(piece.len()));
        let name: String = String::from_utf8_lossy(name).chars().filter(|c| !"/\0".contains(*c)).take(60).collect();
        if !matches!(name.as_str(), "" | "." | "..") {
            // A name that the file system refuses is none.
            let _ = std::fs::write(folder.path().join(name), content.get(1..).unwrap_or_default());
        }
    }
    let paths: [PathBuf; 1] = [folder.path().to_owned()];
    if let Err(error) = load(&paths, &Selection::default()) {
        assert!(!error.render().is_empty(), "an error has words");
    }
});
