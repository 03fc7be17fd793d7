//! The whole pipeline through the library: what settings change, and what is said of it.

use std::path::{Path, PathBuf};

use voromill::gcode::{dialect, read};
use voromill::import::{self, Selection};
use voromill::job::{self, Job, Options, Part, Settings};

/// The job on a board of `fixtures/boards`, with settings as a settings file gives them.
fn job(files: &str, settings: &str) -> (Job, Settings) {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(files);
    let loaded = import::load(&[path], &Selection::default()).expect("a board");
    let options = Options::from_toml("voromill.toml", settings).expect("settings");
    let settings = Settings::resolve(options).expect("settings that make sense");
    (job::mill(loaded, &settings).expect("a job"), settings)
}

fn warned(job: &Job, code: &str) -> bool {
    job.warnings.iter().any(|warning| warning.code == code)
}

fn cut_mm(job: &Job, part: Part) -> f64 {
    let program = job.programs.iter().find(|program| program.part == part).expect("such a program");
    program.statistics.cut_length.to_mm()
}

#[test]
fn every_dialect_writes_a_program_that_reads_back() {
    for dialect in dialect::ALL {
        let (job, _) = job("blinker", &format!("dialect = \"{}\"", dialect.name));
        for program in &job.programs {
            let back = read(&program.text);
            assert!(back.is_ok(), "{} {:?}: {:?}", dialect.name, program.part, back.err());
        }
    }
}

#[test]
fn a_cache_key_changes_with_files_and_settings_and_with_nothing_else() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards");
    let temporary = tempfile::tempdir().expect("a folder");
    let copy = temporary.path().to_path_buf();
    for entry in std::fs::read_dir(folder.join("blinker")).expect("readable") {
        let path = entry.expect("an entry").path();
        std::fs::copy(&path, copy.join(path.file_name().expect("a name"))).expect("writable");
    }
    let key = |path: &Path, settings: &str| {
        let loaded = import::load(&[path.to_path_buf()], &Selection::default()).expect("a board");
        let options = Options::from_toml("voromill.toml", settings).expect("settings");
        job::cache_key(&loaded, &Settings::resolve(options).expect("settings"), &[])
    };
    let first = key(&copy, "");
    assert_eq!(first.len(), 64, "SHA-256 in hexadecimal");
    assert_eq!(first, key(&folder.join("blinker"), ""), "in another folder");
    assert_eq!(first, key(&copy, "tabs = 4"), "with a default said aloud");
    assert_ne!(first, key(&copy, "tabs = 3"), "with another setting");
    let copper = copy.join("blinker-B_Cu.gbr");
    let text = std::fs::read_to_string(&copper).expect("readable");
    std::fs::write(&copper, text + "G04 a comment*\n").expect("writable");
    assert_ne!(first, key(&copy, ""), "with another file, even one that means the same");
}

#[test]
fn without_an_outline_the_frame_is_cut_unless_told_otherwise() {
    let layer = "blinker/blinker-B_Cu.gbr";
    let (framed, _) = job(layer, "");
    assert!(framed.layers[0].lap.is_some(), "a lap round the copper");
    assert!(warned(&framed, "outline-missing"), "and why: {:?}", framed.warnings);
    let (open, _) = job(layer, "frame = false");
    assert!(open.layers[0].lap.is_none() && warned(&open, "frame-not-cut"), "said, as nets stay joined");
    assert!(cut_mm(&open, Part::Back) < cut_mm(&framed, Part::Back), "and less is cut");
}

#[test]
fn outlines_go_round_every_net_and_take_longer() {
    let (voronoi, _) = job("blinker", "");
    let (outline, _) = job("blinker", "strategy = \"outline\"");
    assert!(outline.layers[0].lap.is_none(), "no net reaches the edge");
    assert!(cut_mm(&outline, Part::Back) > cut_mm(&voronoi, Part::Back), "the paper's saving");
}

#[test]
fn the_back_is_turned_over_and_registers_with_the_drills() {
    let (job, _) = job("regulator", "");
    let back = job.layers.iter().find(|layer| layer.placement.mirror.is_some()).expect("a back");
    let axis = back.placement.mirror.expect("mirrored");
    let hole = job.board.holes[0].path.start;
    let (front, turned) = (job.placement.point(hole), back.placement.point(hole));
    assert_eq!((front.x + turned.x, front.y), (axis * 2, turned.y), "the same hole, seen from behind");
    let program = job.programs.iter().find(|program| program.part == Part::Back).expect("a back");
    assert!(program.text.contains("turned over"), "the header says so");
}

#[test]
fn the_report_names_everything_that_was_read_and_written() {
    let (job, settings) = job("regulator", "");
    let report = job.describe(&settings);
    assert_eq!(report.programs.len(), job.programs.len(), "every program");
    assert_eq!(report.layers.len(), 2, "both sides");
    assert!(report.sources.iter().all(|source| source.sha256.len() == 64), "files by their content");
    assert!(report.electrical_nets.is_some(), "sides joined through holes");
    let key = |name: &str| report.settings.contains_key(name);
    assert!(key("tool") && key("depth") && key("pixel"), "the settings: {:?}", report.settings);
    let text = report.summary(false);
    assert!(text.lines().count() < 40 && text.contains("total"), "short:\n{text}");
}

#[test]
fn holes_that_no_drill_fits_are_bored_or_named() {
    let (left, _) = job("regulator", "drills = \"0.8mm\"\ndrill-tolerance = \"0.05mm\"");
    assert!(warned(&left, "no-drill-for-hole"), "named: {:?}", left.warnings);
    let settings = "drills = \"0.8mm\"\ndrill-tolerance = \"0.05mm\"\ndrill-bore = true\ncutout-tool = \"endmill:0.6mm\"";
    let (bored, _) = job("regulator", settings);
    assert!(!warned(&bored, "no-drill-for-hole"), "bored: {:?}", bored.warnings);
}
