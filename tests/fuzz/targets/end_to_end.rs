//! Any bytes as a layer, an outline and a drill file, cut at form feeds; milled, and the programs
//! judged.
//!
//! Whatever is milled must be followed by the judge: a program of ours that `verify` cannot read is
//! a finding.
#![no_main]

use std::path::PathBuf;

use libfuzzer_sys::fuzz_target;
use voromill::geometry::Nm;
use voromill::import::{Selection, load};
use voromill::job::{self, Options, Settings};

/// More would be milled for minutes.
const WIDEST: Nm = Nm::from_mm(30);
const MOST: usize = 60;

fuzz_target!(|bytes: &[u8]| {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let names = ["a-F_Cu.gbr", "a-Edge_Cuts.gbr", "a.drl"];
    for (name, content) in names.iter().zip(bytes.split(|&b| b == 0x0c)) {
        std::fs::write(folder.path().join(name), content).expect("written");
    }
    let paths: [PathBuf; 1] = [folder.path().to_owned()];
    let Ok(loaded) = load(&paths, &Selection::default()) else { return };
    let Some(bounds) = loaded.board.bounds() else { return };
    let features: usize = loaded.board.front.iter().map(|copper| copper.features.len()).sum();
    if bounds.width().max(bounds.height()) > WIDEST || features + loaded.board.holes.len() > MOST {
        return;
    }
    let settings = Settings::resolve(Options::default()).expect("the defaults");
    match job::mill(loaded, &settings) {
        Err(error) => assert!(!error.to_string().is_empty(), "an error has words"),
        Ok(job) => drop(job.verify(&settings).expect("our own programs can be judged")),
    }
});
