//! Damaged texts beside the layers of a board: job files, settings, millprojects, maps of heights
//! and programs, with bytes changed, cut out and said twice; and damaged boards from their bytes to
//! the verdict on their programs.
//!
//! `tests/fuzz` has the same as targets of a fuzzer, which looks for what these do not reach.
//! `PROPTEST_CASES=20000` looks longer.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use proptest::sample::Index;
use voromill::gcode::level::{Frame, HeightMap, Levelling, level};
use voromill::geometry::Nm;
use voromill::import::{Selection, load};
use voromill::job::{self, MillProject, Options, Settings};

use crate::layers::{DRILL, Folder, SQUARE};

/// One change to a text.
#[derive(Clone, Debug)]
enum Edit {
    Replace(Index, u8),
    Remove(Index, Index),
    Repeat(Index, Index),
}

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let byte = prop_oneof![
        any::<u8>(),
        prop::sample::select(b"0123456789+-.,:;=\"'[]{}()#%*\n\r\t \0GXYZIJFSTMD".to_vec())
    ];
    let edit = prop_oneof![
        (any::<Index>(), byte).prop_map(|(at, byte)| Edit::Replace(at, byte)),
        (any::<Index>(), any::<Index>()).prop_map(|(from, to)| Edit::Remove(from, to)),
        (any::<Index>(), any::<Index>()).prop_map(|(from, to)| Edit::Repeat(from, to)),
    ];
    prop::collection::vec(edit, 0..6)
}

/// The seed with all changes made to it.
fn damaged(seed: &[u8], edits: &[Edit]) -> Vec<u8> {
    /// What is cut out or said twice: at most a few lines.
    const LONGEST: usize = 80;
    let mut bytes = seed.to_vec();
    for edit in edits.iter().filter(|_| !seed.is_empty()) {
        if bytes.is_empty() {
            return bytes;
        }
        let part = |from: &Index, to: &Index| {
            let start = from.index(bytes.len());
            start..(start + 1 + to.index(LONGEST)).min(bytes.len())
        };
        match edit {
            Edit::Replace(at, byte) => {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            Edit::Remove(from, to) => drop(bytes.drain(part(from, to))),
            Edit::Repeat(from, to) => {
                let part = part(from, to);
                let copy = bytes[part.clone()].to_vec();
                bytes.splice(part.end..part.end, copy);
            }
        }
    }
    bytes
}

/// The files of a folder of fixtures that end so, as seeds.
fn seeds(folder: &str, endings: &[&str]) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(folder);
    let entries = fs::read_dir(folder).expect("readable").map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> = entries.filter(|path| path.is_file()).collect();
    paths
        .retain(|path| endings.is_empty() || endings.iter().any(|end| path.to_string_lossy().ends_with(end)));
    paths.sort();
    assert!(!paths.is_empty(), "there are seeds");
    paths.iter().map(|path| fs::read(path).expect("readable")).collect()
}

const JOB: &str = r#"{"Header": {"CreationDate": "2026-01-01"}, "GeneralSpecs": {"ProjectId": {"Name": "amp"}},
 "FilesAttributes": [{"Path": "a.gbr", "FileFunction": "Copper,L1,Top", "FilePolarity": "Positive"},
 {"Path": "b.gbr", "FileFunction": "Profile,NP"}, {"Path": "c.drl", "FileFunction": "Plated,1,2,PTH"}]}"#;

const PROGRAM: &str = "G21\nG90\nG0 Z5\nG0 X1 Y1\nG1 Z-0.1 F100\nG1 X4 Y4\nG2 X5 Y3 I0 J-1\nG0 Z5\nM2\n";

fn levelling() -> Levelling {
    Levelling { tolerance: Nm::from_um(5), margin: Nm::from_mm(2), safe: None, note: String::new() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn a_damaged_job_file_never_panics(edits in edits()) {
        let folder = Folder::with(&[("a.gbr", SQUARE), ("b.gbr", SQUARE), ("c.drl", DRILL)]);
        fs::write(folder.path("x.gbrjob"), damaged(JOB.as_bytes(), &edits)).expect("written");
        if let Err(error) = folder.load(&Selection::default()) {
            prop_assert!(!error.is_empty(), "an error without words");
        }
    }

    #[test]
    fn damaged_settings_never_panic(edits in edits()) {
        let bytes = damaged(job::DEFAULTS.as_bytes(), &edits);
        let read = Options::from_toml("voromill.toml", &String::from_utf8_lossy(&bytes));
        if let Err(error) = read.and_then(Settings::resolve) {
            prop_assert!(!error.to_string().is_empty(), "an error without words");
        }
    }

    #[test]
    fn a_damaged_millproject_never_panics(seed in any::<Index>(), edits in edits()) {
        let seeds = seeds("millproject", &[]);
        let text = damaged(&seeds[seed.index(seeds.len())], &edits);
        let read = MillProject::read("millproject", &String::from_utf8_lossy(&text));
        if let Err(error) = read.and_then(|project| Settings::resolve(project.options)) {
            prop_assert!(!error.to_string().is_empty(), "an error without words");
        }
    }

    #[test]
    fn a_damaged_map_of_heights_never_panics(seed in any::<Index>(), edits in edits()) {
        let seeds = seeds("level", &[]);
        let text = damaged(&seeds[seed.index(seeds.len())], &edits);
        let frame = Frame { unit: Nm::from_mm(1), zero: Some([Nm::ZERO; 3]) };
        match HeightMap::read(&String::from_utf8_lossy(&text), &frame) {
            Err(error) => prop_assert!(!error.to_string().is_empty(), "an error without words"),
            Ok((map, _)) => if let Err(error) = level(PROGRAM, &map, &levelling()) {
                prop_assert!(!error.to_string().is_empty(), "an error without words");
            },
        }
    }

    #[test]
    fn a_damaged_program_never_panics(seed in any::<Index>(), edits in edits()) {
        let mut seeds = seeds("verify", &[".nc", ".ngc"]);
        seeds.push(PROGRAM.as_bytes().to_vec());
        let text = damaged(&seeds[seed.index(seeds.len())], &edits);
        let text = String::from_utf8_lossy(&text);
        if let Err(error) = voromill::gcode::read(&text) {
            prop_assert!(!error.to_string().is_empty(), "an error without words");
        }
        let surface = [[0.0, 0.0, 0.0], [5e6, 0.0, 1e4], [0.0, 5e6, 2e4], [5e6, 5e6, 0.0]];
        let map = HeightMap::through(&surface).expect("a surface");
        if let Err(error) = level(&text, &map, &levelling()) {
            prop_assert!(!error.to_string().is_empty(), "an error without words");
        }
    }
}

const COPPER: &str = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.4*%\n%ADD11R,1.5X1.0*%\nD10*\nX1000000Y1000000D02*\nX4000000Y1000000D01*\nG75*\nG03*\nX6000000Y3000000I0J2000000D01*\nG01*\nD11*\nX2000000Y4000000D03*\nX5000000Y5500000D03*\nM02*\n";
const EDGE: &str = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.1*%\nD10*\nX0Y0D02*\nX8000000Y0D01*\nX8000000Y7000000D01*\nX0Y7000000D01*\nX0Y0D01*\nM02*\n";
const HOLES: &str = "M48\nMETRIC\nT1C0.6\n%\nT1\nX2.0Y4.0\nX5.0Y5.5\nM30\n";

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn what_is_made_of_a_damaged_board_can_be_judged(which in 0_usize..3, edits in edits()) {
        /// More would be milled for seconds.
        const WIDEST: Nm = Nm::from_mm(30);
        const MOST: usize = 60;
        let mut files = [("a-F_Cu.gbr", COPPER.into()), ("a-Edge_Cuts.gbr", EDGE.into()), ("a.drl", Vec::from(HOLES))];
        files[which].1 = damaged(&files[which].1, &edits);
        let folder = Folder::with(&[]);
        for (name, bytes) in &files {
            fs::write(folder.path(name), bytes).expect("written");
        }
        let Ok(loaded) = load(&[folder.path("")], &Selection::default()) else { return Ok(()) };
        let features: usize = loaded.board.front.iter().map(|copper| copper.features.len()).sum();
        let wide = loaded.board.bounds().is_none_or(|bounds| bounds.width().max(bounds.height()) > WIDEST);
        if wide || features + loaded.board.holes.len() > MOST {
            return Ok(());
        }
        let settings = Settings::resolve(Options::default()).expect("the defaults");
        match job::mill(loaded, &settings) {
            Err(error) => prop_assert!(!error.to_string().is_empty(), "an error without words"),
            Ok(job) => {
                let judged = job.verify(&settings);
                prop_assert!(judged.is_ok(), "our own programs are followed: {:?}", judged.err());
            }
        }
    }
}
