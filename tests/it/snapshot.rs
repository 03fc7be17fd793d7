//! What becomes of the fixture boards, word for word: programs under `snapshots/gcode`, reports
//! under `snapshots/report`. `INSTA_UPDATE=always cargo test --test it snapshot` writes them anew;
//! a reviewer reads the difference.

use std::path::Path;

use voromill::import::{self, Selection};
use voromill::job::{self, Job, Options, Part, Settings};

/// Mills `fixtures/boards/<board>` in memory.
fn mill(board: &str, options: Options) -> (Job, Settings) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(board);
    let loaded = import::load(&[folder], &Selection::default()).expect("a fixture can be read");
    let settings = Settings::resolve(options).expect("sound settings");
    (job::mill(loaded, &settings).expect("a fixture can be milled"), settings)
}

/// Compares `text` with `snapshots/<stage>/<name>.snap`.
fn matches_snapshot(stage: &str, name: &str, text: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots").join(stage);
    insta::with_settings!(
        { snapshot_path => path, prepend_module_to_snapshot => false, omit_expression => true },
        { insta::assert_snapshot!(name, text) }
    );
}

/// Every program of a board, and its report.
fn matches_snapshots(board: &str, case: &str, options: Options) {
    let (job, settings) = mill(board, options);
    for program in &job.programs {
        matches_snapshot("gcode", &format!("{case}-{}", program.tag), &program.text);
    }
    matches_snapshot("report", case, &job.describe(&settings).to_json());
}

#[test]
fn the_blinker_is_milled_as_before() {
    matches_snapshots("blinker", "blinker", Options::default());
}

#[test]
fn the_regulator_is_milled_as_before() {
    matches_snapshots("regulator", "regulator", Options::default());
}

#[test]
fn the_qfn_breakout_is_milled_as_before() {
    matches_snapshots("qfn-breakout", "qfn-breakout", Options::default());
}

#[test]
fn outlines_for_linuxcnc_with_an_end_mill_are_as_before() {
    let file =
        "strategy = \"outline\"\ndialect = \"linuxcnc\"\ntool = \"endmill:0.3mm\"\norigin = \"keep\"\n";
    let options = Options::from_toml("voromill.toml", file).expect("sound options");
    matches_snapshots("blinker", "blinker-outline", options);
}

#[test]
fn loops_among_boundaries_midway_are_as_before() {
    let options =
        Options::from_toml("voromill.toml", "strategy-for = \"GND=outline\"\n").expect("sound options");
    let (job, _) = mill("blinker", options);
    let back = job.programs.iter().find(|program| program.part == Part::Back).expect("a side with copper");
    matches_snapshot("gcode", "blinker-mixed-back", &back.text);
}
