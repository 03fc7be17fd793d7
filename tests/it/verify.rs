//! Programs, good and bad, and what is found in them.

use std::path::{Path, PathBuf};

use voromill::board::{Board, Side};
use voromill::geometry::Nm;
use voromill::import::{self, Selection};
use voromill::verify::{Program, Report, Role, Settings, Severity, verify};

fn fixture(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(path)
}

fn load(files: &[&str]) -> import::Loaded {
    let paths: Vec<PathBuf> = files.iter().map(|file| fixture(file)).collect();
    import::load(&paths, &Selection::default()).expect("a board")
}

fn text(file: &str) -> String {
    std::fs::read_to_string(fixture(file)).expect("a program")
}

fn judge(board: &Board, program: Program) -> Report {
    verify(&[program], board, &[], &Settings::default()).expect("it can be judged")
}

/// What is found, worst first, each name once.
fn names(report: &Report, least: Severity) -> Vec<&'static str> {
    let mut names: Vec<_> = report
        .findings
        .iter()
        .filter(|finding| finding.severity >= least)
        .map(|finding| finding.name)
        .collect();
    names.dedup();
    names
}

fn foreign(file: &str, text: String, tool: &str, role: Option<Role>) -> Program {
    let cutter = Some(tool.parse().expect("a tool"));
    Program { file: file.to_owned(), text, role, cutter, placement: None }
}

const FRONT: Option<Role> = Some(Role::Isolation(Side::Front));

#[test]
fn loops_of_straight_lines_isolate() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let report = judge(&board, foreign("loops.nc", text("verify/loops.nc"), "endmill:0.2mm", FRONT));
    assert_eq!(names(&report, Severity::Info), [""; 0], "{:?}", report.findings);
}

#[test]
fn relative_inches_are_followed_and_a_line_that_parts_nothing_is_found_out() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let report = judge(&board, foreign("relative.nc", text("verify/relative.nc"), "vbit:0.1mm:30deg", FRONT));
    // The rim of the sheet round the copper and the cut is clad: a line alone does not part it.
    assert_eq!(names(&report, Severity::Info), ["short"], "{:?}", report.findings);
    let short = &report.findings[0];
    assert_eq!(short.nets, ["LEFT", "RIGHT"], "both nets");
    assert!(short.message.contains("bridge"), "{}", short.message);
}

#[test]
fn half_a_circle_leaves_a_bridge() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let half = text("verify/arcs.nc");
    let report = judge(&board, foreign("arcs.nc", half.clone(), "endmill:0.2mm", FRONT));
    assert_eq!(names(&report, Severity::Info), ["short"], "{:?}", report.findings);
    assert_eq!(report.findings[0].program.as_deref(), Some("arcs.nc"), "the program");
    let whole = half.replace("R1.15 F120\n", "R1.15 F120\nG03 X3.15 Y2 R1.15\n");
    let report = judge(&board, foreign("arcs.nc", whole, "endmill:0.2mm", FRONT));
    assert_eq!(names(&report, Severity::Info), [""; 0], "{:?}", report.findings);
}

#[test]
fn a_cut_through_a_pad_is_a_gouge_with_its_depth() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    // The kerf reaches 0.1 mm beyond its middle, which runs 0.95 mm from the middle of a pad of 1 mm.
    let near = text("verify/loops.nc").replace("X3.1500", "X2.9500");
    let report = judge(&board, foreign("loops.nc", near, "endmill:0.2mm", FRONT));
    assert_eq!(names(&report, Severity::Info), ["gouge"], "{:?}", report.findings);
    let depth = report.findings[0].size.expect("a depth");
    assert!((depth - Nm::from_um(150)).abs() <= Nm::from_um(5), "0.15 mm, not {depth}");
    assert!(report.findings[0].line.is_some_and(|line| (9..=13).contains(&line)), "{:?}", report.findings[0]);
}

#[test]
fn canned_cycles_drill() {
    let board = load(&["verify/pads-F_Cu.gbr", "verify/pads.drl"]).board;
    let both = text("verify/cycle.nc");
    let judged = |text: String, tool: &str| {
        names(&judge(&board, foreign("cycle.nc", text, tool, None)), Severity::Info)
    };
    assert_eq!(judged(both.clone(), "drill:0.8mm"), [""; 0], "both holes");
    assert_eq!(judged(both.replace("X5\n", ""), "drill:0.8mm"), ["hole-missing"], "one alone");
    assert_eq!(judged(both.replace("X5\n", "X5\nX7\n"), "drill:0.8mm"), ["hole-extra"], "one too many");
    assert_eq!(judged(both, "drill:1mm"), ["hole-size"], "too wide");
}

#[test]
fn motions_that_break_tools_are_found() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let good = text("verify/loops.nc");
    let judged = |text: String| {
        names(&judge(&board, foreign("loops.nc", text, "endmill:0.2mm", FRONT)), Severity::Error)
    };
    assert_eq!(judged(good.replace("M03 S10000\n", "")), ["plunge-spindle-off"], "no M3");
    assert_eq!(judged(good.replace("G01 F120.00\n", "")), ["feed-missing"], "no F");
    let sunk = good.replace("G00 Z2.0000\nG00 X3.8500", "G00 X3.8500");
    assert!(judged(sunk.clone()).contains(&"rapid-in-material"), "{:?}", judged(sunk));
    let away = good.replace("X6.1500 Y0.8500", "X6.1500 Y-20");
    assert!(judged(away.clone()).contains(&"outside-stock"), "{:?}", judged(away));
}
