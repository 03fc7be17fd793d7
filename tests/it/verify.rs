//! Programs, good and bad, and what is found in them.

use std::path::{Path, PathBuf};

use voromill::board::{Board, Outline, Side};
use voromill::geometry::{Nm, Path as Contour, Point, Segment};
use voromill::import::{self, Selection};
use voromill::verify::{Finding, Program, Report, Role, Settings, Severity, verify};

use crate::layers::Folder;

fn fixture(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(path)
}

fn load(files: &[&str]) -> import::Loaded {
    let paths: Vec<PathBuf> = files.iter().map(|file| fixture(file)).collect();
    import::load(&paths, &Selection::default()).expect("a board")
}

/// The board of these layers.
fn drawn(layers: &[(&str, &str)]) -> Board {
    Folder::with(layers).load(&Selection::default()).expect("a board").board
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
    Program { file: file.to_owned(), text, role, cutter, placement: None, ..Program::default() }
}

const FRONT: Option<Role> = Some(Role::Isolation(Side::Front));

#[test]
fn loops_of_straight_lines_isolate() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let report = judge(&board, foreign("loops.nc", text("verify/loops.nc"), "endmill:0.2mm", FRONT));
    assert_eq!(names(&report, Severity::Info), [""; 0], "{:?}", report.findings);
}

/// Two pads on a board that begins at this x and ends at 8 mm, 4 mm high.
fn pads_from(left: Nm) -> Board {
    let mut board = load(&["verify/pads-F_Cu.gbr"]).board;
    let [right, bottom, top] = [8, 0, 4].map(Nm::from_mm);
    let start = Point::new(left, bottom);
    let corners = [Point::new(right, bottom), Point::new(right, top), Point::new(left, top), start];
    let segments = corners.map(|to| Segment::Line { to }).to_vec();
    board.outline = Outline::new(vec![Contour { start, segments }]);
    board
}

#[test]
fn copper_that_goes_on_beyond_the_edge_is_judged_as_far_as_the_board_goes() {
    // The right half of the left pad lies on the board, which begins at x = 2 mm.
    let board = pads_from(Nm::from_mm(2));
    let cut_into = |motion: &str| {
        let text = format!("G21 G90 G94\nM3 S10000\nG0 Z2\n{motion}\nG0 Z2\nM5\nM2\n");
        let report = judge(&board, foreign("cut.nc", text, "endmill:0.2mm", FRONT));
        names(&report, Severity::Warning).contains(&"gouge")
    };
    // Cuts that cross the whole pad, that end beyond the edge, and that go round.
    for (motion, cuts) in [
        ("G0 X0 Y2\nG1 Z-0.1 F60\nX4 F120", true),
        ("G0 X0 Y2\nG1 Z-0.1 F60\nX1.85 F120", false),
        ("G0 X0 Y2\nG1 Z-0.1 F60\nX2.1 F120", true),
        ("G0 X2.5 Y2\nG1 Z-0.1 F60\nG2 X2.5 Y2 I-1 J0 F120", true),
        ("G0 X1.8 Y2\nG1 Z-0.1 F60\nG2 X1.8 Y2 I-0.5 J0 F120", false),
        ("G0 X1 Y3\nG1 Z-0.1 F60\nG2 X1 Y3 I1 J0 F120", true),
    ] {
        assert_eq!(cut_into(motion), cuts, "{motion}");
    }
}

#[test]
fn copper_that_lies_beyond_the_edge_altogether_may_be_cut() {
    // The left pad ends at x = 3 mm. A cut 0.3 mm from it reaches 0.1 mm into it.
    let cut = "G21 G90 G94\nM3 S10000\nG0 Z2\nG0 X3.3 Y1\nG1 Z-0.1 F60\nG1 Y3 F120\nG0 Z2\nM5\nM2\n";
    let cuts = |edge: i64| {
        let board = pads_from(Nm::from_um(edge));
        let report = judge(&board, foreign("cut.nc", cut.to_owned(), "endmill:0.8mm", FRONT));
        names(&report, Severity::Warning).contains(&"gouge")
    };
    assert_eq!([cuts(3_100), cuts(2_900)], [false, true], "the edge beyond the pad, and in it");
}

#[test]
fn a_whole_turn_that_sinks_a_little_is_a_whole_turn() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let taken = |sink: &str| {
        let text = format!(
            "G21 G90 G94\nM3 S10000\nG0 Z2\nG0 X2.5 Y2\nG1 Z-0.1 F60\nG2 X2.5 Y2 {sink} I-0.5 J0 F120\nG0 Z2\nM5\nM2\n"
        );
        names(&judge(&board, foreign("turn.nc", text, "endmill:0.2mm", FRONT)), Severity::Error)
    };
    assert_eq!(taken(""), ["gouge", "open", "short"], "level");
    for sink in ["Z-0.1001", "Z-0.14", "Z-0.16"] {
        assert_eq!(taken(sink), taken(""), "{sink}");
    }
}

#[test]
fn what_a_v_bit_leaves_at_the_bottom_of_the_copper_joins() {
    // Round the left pad, and short of closing the loop: at the surface the round ends overlap, at
    // the bottom of the copper they do not.
    let around = |gap: &str| {
        format!(
            "(a loop)\nG21 G90 G94\nM3 S10000\nG0 Z2\nG0 X0.85 Y2\nG1 Z-0.1 F60\nG1 X0.85 Y0.85 F120\nX3.15\nY3.15\nX0.85\n\
             Y{gap}\nG0 Z2\nM5\nM2\n"
        )
    };
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let find = |gap: &str| {
        let program = foreign("loop.nc", around(gap), "vbit:0.1mm:30deg", FRONT);
        judge(&board, program).findings.iter().filter(|finding| finding.name == "short").count()
    };
    // Half the kerf is 76.8 µm at the surface, and 67.4 µm below 35 µm of copper.
    assert_eq!((find("2.13"), find("2.145"), find("2.16")), (0, 1, 1), "130 µm, 145 µm, 160 µm");
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
    // The kerf reaches 0.1 mm beyond its middle, which runs 0.95 mm from the middle of a pad of 1
    // mm.
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
    let bulge = also("G00 X2 Y-5\nG01 Z-0.1\nG02 X2 Y-5 I0 J-50\n");
    assert!(
        judged(bulge.clone()).contains(&"outside-stock"),
        "begins and ends beside it: {:?}",
        judged(bulge)
    );
}

#[test]
fn a_cut_where_nobody_knows_is_an_error() {
    let board = load(&["verify/pads-F_Cu.gbr", "verify/pads.drl"]).board;
    for lost in ["G1 Z-2 F60\nG0 Z2\n", "G0 X1\nG1 Z-0.1 F60\nG0 Z2\n"] {
        let text = format!("G21 G90 G94\nM3 S10000\nG0 Z2\n{lost}G0 X3 Y2\nG1 Z-2 F60\nG0 Z2\nM5\nM2\n");
        let report = judge(&board, foreign("lost.nc", text, "drill:0.8mm", None));
        let told = |finding: &Finding| finding.message.contains("a place that the program has not given");
        let found = report.findings.iter().find(|finding| told(finding));
        assert_eq!(found.map(|finding| finding.severity), Some(Severity::Error), "{lost}: {report:?}");
    }
}

/// Into a hole of a thinner drill no rapid leads.
#[test]
fn a_rapid_goes_down_where_it_was_cut_as_wide() {
    let board = load(&["verify/pads-F_Cu.gbr", "verify/pads.drl"]).board;
    let text = |first: &str, second: &str| {
        format!(
            "G21 G90 G94\nM3 S10000\nG0 Z2\n(tool 1: {first})\nG0 X3 Y2\nG1 Z-2 F60\nG0 Z2\nM5\nM0\nM3 S10000\n\
             (tool 2: {second})\nG0 X3 Y2\nG0 Z-1.9\nG1 Z-2 F60\nG0 Z2\nM5\nM2\n"
        )
    };
    let judged = |first: &str, second: &str| {
        let text = text(first, second);
        let program = Program { file: "wide.nc".to_owned(), text, ..Program::default() };
        names(&judge(&board, program), Severity::Error).contains(&"rapid-in-material")
    };
    assert!(!judged("drill:0.8mm", "drill:0.8mm"), "the same");
    assert!(!judged("drill:1mm", "drill:0.8mm"), "a thinner one");
    assert!(judged("drill:0.8mm", "drill:1mm"), "a thicker one");
}

#[test]
fn a_tool_that_comes_straight_up_cuts_nothing() {
    let board = load(&["verify/pads-F_Cu.gbr", "verify/pads.drl"]).board;
    let judged = |up: &str| {
        let text = text("verify/cycle.nc").replace("M05", &format!("{up}\nM05"));
        names(&judge(&board, foreign("up.nc", text, "drill:0.8mm", None)), Severity::Info)
    };
    let down = "G0 X5 Y2\nG1 Z-1.8 F60\n";
    assert!(!judged(&format!("{down}G1 Z2 F2000")).contains(&"feed-per-turn"), "up");
    assert!(judged(&format!("{down}G1 X5.01 Z2 F20000")).contains(&"feed-per-turn"), "not straight");
}

/// The loops with another way cut after them.
fn also(way: &str) -> String {
    text("verify/loops.nc").replace("M05\n", &format!("{way}G00 Z2.0000\nM05\n"))
}

#[test]
fn a_gouge_through_the_middle_of_a_pad_has_its_true_depth() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    // Into the middle of a pad of 1 mm and back: 1 mm and half the kerf, far beyond what a kerf
    // reaches.
    let deep = also("G00 X2 Y0.85\nG01 Z-0.1000\nG01 X2 Y2\n");
    let report = judge(&board, foreign("loops.nc", deep, "endmill:0.2mm", FRONT));
    let gouge = report.findings.iter().find(|finding| finding.name == "gouge").expect("a gouge");
    let depth = gouge.size.expect("a depth");
    assert!((depth - Nm::from_um(1100)).abs() <= Nm::from_um(5), "1.1 mm, not {depth}");
    assert_eq!(names(&report, Severity::Error), ["gouge"], "half a cut leaves the pad whole");
}

#[test]
fn a_part_thinner_than_a_pixel_is_cut_off_all_the_same() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let judged = |x: &str| {
        let across = also(&format!("G00 X{x} Y0.85\nG01 Z-0.1000\nG01 X{x} Y3.15\n"));
        let loops = across.replace("X3.1500", "X3.0750").replace("X3.8500", "X3.9250");
        names(&judge(&board, foreign("loops.nc", loops, "endmill:0.2mm", FRONT)), Severity::Error)
    };
    // The second loop ends 25 µm within the pad's edge at x = 3, and the cut beside it leaves 35
    // µm, then all but nothing.
    assert!(judged("2.84").contains(&"open"), "35 µm: {:?}", judged("2.84"));
    assert!(!judged("2.87").contains(&"open"), "5 µm are a crumb: {:?}", judged("2.87"));
}

#[test]
fn a_thin_strip_at_the_edge_is_a_sliver() {
    let board = load(&["verify/seven-F_Cu.gbr", "verify/seven-Edge_Cuts.gbr"]).board;
    let judged = |y: &str| {
        let program =
            format!("G21 G90 G94 F100\nM3 S10000\nG0 Z2\nG0 X3 Y{y}\nG1 Z-0.1\nG1 X5\nG0 Z2\nM5\nM2\n");
        let report = judge(&board, foreign("strip.nc", program, "endmill:0.2mm", FRONT));
        report.findings.iter().find(|finding| finding.name == "sliver").and_then(|finding| finding.size)
    };
    assert_eq!(judged("0.13"), Some(Nm::from_um(30)), "30 µm between the kerf and the edge");
    assert_eq!(judged("0.2"), None, "0.1 mm is no sliver");
    assert_eq!(judged("0.05"), None, "nothing is left");
}

/// Fritzing draws an edge of millimetres in steps of a mil: where a long cut crosses it, the steps
/// on either side of the kerf are near to the cut, and nothing is thin.
#[test]
fn a_cut_that_crosses_an_edge_of_small_steps_leaves_no_sliver() {
    const STEP: i64 = 25_400;
    let (wide, high) = (200 * STEP, 400 * STEP);
    let line = |from: (i64, i64), to: (i64, i64), steps: i64| {
        (1..=steps)
            .map(|i| (from.0 + (to.0 - from.0) * i / steps, from.1 + (to.1 - from.1) * i / steps))
            .map(|(x, y)| format!("X{x}Y{y}D01*\n"))
            .collect::<String>()
    };
    let sides = [((0, 0), (wide, 0), 200), ((wide, 0), (wide, high), 1), ((wide, high), (0, high), 1)];
    let edge: String = sides.map(|(from, to, steps)| line(from, to, steps)).concat();
    let head = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.2*%\nD10*\nX0Y0D02*\n";
    let edge = format!("{head}{edge}X0Y0D01*\nM02*\n");
    let copper = format!("{head}X1000000Y5000000D03*\nX4000000Y5000000D03*\nM02*\n");
    let board = drawn(&[("b-F_Cu.gbr", &copper), ("b-Edge_Cuts.gbr", &edge)]);
    let judged = |way: &str| {
        let program = format!("G21 G90 G94 F100\nM3 S10000\nG0 Z2\n{way}\nG0 Z2\nM5\nM2\n");
        let report = judge(&board, foreign("cut.nc", program, "endmill:0.15mm", FRONT));
        report.findings.iter().find(|finding| finding.name == "sliver").and_then(|finding| finding.size)
    };
    assert_eq!(judged("G0 X2.53 Y4\nG1 Z-0.1\nG1 Y-0.1"), None, "across the edge");
    let beside = judged("G0 X0.3 Y0.1\nG1 Z-0.1\nG1 X4.5");
    assert_eq!(beside, Some(Nm::from_um(25)), "along it there is a strip between the kerf and the edge");
}

#[test]
fn a_ridge_between_two_grooves_of_a_v_bit_is_a_sliver() {
    // The grooves overlap at the surface, where half the kerf is 76.8 µm: below 35 µm of copper it
    // is 67.4 µm, and a ridge is left between them.
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let judged = |y: &str| {
        let program = format!(
            "G21 G90 G94 F100\nM3 S10000\nG0 Z2\nG0 X2 Y4\nG1 Z-0.1\nG1 X5\nG0 Z2\nG0 X2 Y{y}\nG1 Z-0.1\nG1 X5\nG0 Z2\nM5\nM2\n"
        );
        let report = judge(&board, foreign("ridge.nc", program, "vbit:0.1mm:30deg", FRONT));
        report.findings.iter().find(|finding| finding.name == "sliver").and_then(|finding| finding.size)
    };
    let width = |y: &str| judged(y).map(|size| (size.get() + 500) / 1000);
    assert_eq!(width("4.15"), Some(15), "15 µm at the bottom, nothing at the surface");
    assert_eq!(width("4.13"), None, "they meet at the bottom");
    assert_eq!(width("4.2"), None, "65 µm at the bottom is no sliver, though it is 46 µm at the surface");
}

#[test]
fn what_is_cut_away_of_a_trace_and_what_is_left_are_as_wide_as_it_was_together() {
    // A trace of 0.3 mm, shaved by a V-bit whose kerf is 19 µm wider at the surface than at the
    // bottom of the copper.
    let board = load(&["verify/seven-F_Cu.gbr"]).board;
    let program = "G21 G90 G94 F100\nM3 S10000\nG0 Z2\nG0 X1.4 Y2\nG1 Z-0.1\nG1 Y4\nG0 Z2\nM5\nM2\n";
    let program = foreign("shaved.nc", program.to_owned(), "vbit:0.1mm:30deg", FRONT);
    let settings = Settings { keep: 0.95, ..Settings::default() };
    let report = verify(&[program], &board, &[], &settings).expect("it can be judged");
    let find = |name: &str| {
        let found = report.findings.iter().find(|finding| finding.name == name);
        found.and_then(|finding| finding.size).expect("it is told")
    };
    let (gone, left) = (find("gouge"), find("minimum-width"));
    assert!((26_000..28_000).contains(&gone.get()), "half the kerf at the surface, less 50 µm: {gone}");
    let together = (gone + left).get();
    assert!((299_000..=301_000).contains(&together), "{gone} and {left} of 0.3 mm");
}

#[test]
fn an_arc_goes_farther_than_its_ends() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    // From 0.85 to 3.15 and back in half a circle of a radius of 1.15: 2.3 mm in y as well.
    let half = text("verify/arcs.nc");
    let judged = |y: i64| {
        let travel = Some([Nm::from_mm(100), Nm::from_um(y), Nm::from_mm(100)]);
        let settings = Settings { travel, ..Settings::default() };
        let program = foreign("arcs.nc", half.clone(), "endmill:0.2mm", FRONT);
        let report = verify(&[program], &board, &[], &settings).expect("it can be judged");
        report.findings.iter().any(|finding| finding.name == "overtravel")
    };
    assert!(judged(1100), "not even half of it");
    assert!(!judged(2400), "all of it");
}

#[test]
fn a_pad_that_is_milled_away_is_destroyed() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let rows = (0..13).map(|row| {
        let (y, [from, to]) = (900 + row * 183, if row % 2 == 0 { ["0.9", "3.1"] } else { ["3.1", "0.9"] });
        format!("X{from} Y{}.{:03}\nX{to}\n", y / 1000, y % 1000)
    });
    let away = also(&format!("G00 X0.9 Y0.9\nG01 Z-0.1000\n{}", rows.collect::<String>()));
    let report = judge(&board, foreign("loops.nc", away, "endmill:0.2mm", FRONT));
    let destroyed = report.findings.iter().find(|finding| finding.name == "destroyed").expect("one is gone");
    assert_eq!(destroyed.nets, ["LEFT"], "the left one alone: {:?}", report.findings);
}

/// Two pads and a trace of 0.3 mm between them, along y = 0 from x = 0 to 20.
fn dumbbell() -> Board {
    let copper = "%FSLAX34Y34*%\n%MOMM*%\n%ADD10C,2*%\n%ADD11C,0.3*%\nD10*\nX0Y0D03*\nX200000Y0D03*\nD11*\n\
                  X0Y0D02*\nX200000Y0D01*\nM02*\n";
    drawn(&[("a-F_Cu.gbr", copper)])
}

/// A loop round it in short lines, 0.22 mm from the middle of the trace, and on one side `near` it
/// from x = 1.4 to 1.6, where the pad is left and the trace is thinner than large pixels show.
fn round(near: f64) -> String {
    let mut text = "G21 G90 G94 F100\nM3 S10000\nG0 Z2\nG0 X1.3 Y0.22\nG1 Z-0.1\n".to_owned();
    for step in 7..=93 {
        let y = if step == 7 || step == 8 { near } else { 0.22 };
        text += &format!("G1 X{:.4} Y{y:.4}\n", f64::from(step) * 0.2);
    }
    text += "G1 X18.7\nG1 Y1.3\nG1 X21.3\nG1 Y-1.3\nG1 X18.7\nG1 Y-0.22\n";
    for step in (7..=93).rev() {
        text += &format!("G1 X{:.4}\n", f64::from(step) * 0.2);
    }
    text + "G1 X1.3\nG1 Y-1.3\nG1 X-1.3\nG1 Y1.3\nG1 X1.3\nG1 Y0.22\nG0 Z2\nM5\nM2\n"
}

#[test]
fn a_trace_that_is_thinned_is_parted_where_cuts_beside_it_meet() {
    let board = dumbbell();
    let judged = |text: String| {
        let report = judge(&board, foreign("round.nc", text, "endmill:0.4mm", FRONT));
        names(&report, Severity::Error).contains(&"open")
    };
    assert!(!judged(round(0.22)), "40 µm are left all along");
    assert!(judged(round(0.17)), "nothing is, for 0.2 mm, and no cut goes through the middle");
}

#[test]
fn a_pad_of_which_a_crumb_is_left_is_destroyed() {
    let copper = "%FSLAX34Y34*%\n%MOMM*%\n%ADD10C,0.8*%\nD10*\nX0Y0D03*\nX40000Y0D03*\nM02*\n";
    let board = drawn(&[("a-F_Cu.gbr", copper)]);
    // Discs of 1 mm whose middles lie outside the pad leave what is in none of them.
    let judged = |off: f64| {
        let mut text = "G21 G90 G94 F100\nM3 S10000\n".to_owned();
        for step in 0..12 {
            let turn = f64::from(step) * std::f64::consts::TAU / 12.0;
            text +=
                &format!("G0 Z2\nG0 X{:.4} Y{:.4}\nG1 Z-0.1\n", off * libm::cos(turn), off * libm::sin(turn));
        }
        let report = judge(&board, foreign("away.nc", text + "G0 Z2\nM5\nM2\n", "endmill:1mm", FRONT));
        names(&report, Severity::Error).contains(&"destroyed")
    };
    assert!(judged(0.54), "0.005 mm² are a crumb");
    assert!(!judged(0.58), "0.02 mm² are something");
}

#[test]
fn a_trace_left_with_less_than_half_its_width_is_told() {
    let board = load(&["verify/seven-F_Cu.gbr", "verify/seven-Edge_Cuts.gbr"]).board;
    // A trace of 0.3 mm, its edge at x = 1.35; half the kerf is 0.2 mm.
    let judged = |x: &str| {
        let program =
            format!("G21 G90 G94 F100\nM3 S10000\nG0 Z2\nG0 X{x} Y2.2\nG1 Z-0.1\nG1 Y4\nG0 Z2\nM5\nM2\n");
        let report = judge(&board, foreign("trace.nc", program, "endmill:0.4mm", FRONT));
        report
            .findings
            .iter()
            .find(|finding| finding.name == "minimum-width")
            .and_then(|finding| finding.size)
    };
    let left = judged("1.37").expect("0.12 mm are less than half");
    assert!((left - Nm::from_um(120)).abs() <= Nm::from_um(8), "0.12 mm, not {left}");
    assert_eq!(judged("1.45"), None, "0.2 mm of 0.3 mm");
}

#[test]
fn what_is_cut_twice_is_told() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let once = text("verify/loops.nc");
    let begin = once.find("G00 X0.8500").expect("the loops");
    let end = once.find("M05").expect("their end");
    let twice = once.replace("M05", &format!("{}M05", &once[begin..end]));
    let report = judge(&board, foreign("loops.nc", twice, "endmill:0.2mm", FRONT));
    assert_eq!(names(&report, Severity::Info), ["recut"], "{:?}", report.findings);
}

#[test]
fn a_board_that_nothing_holds_is_told() {
    let board = load(&["verify/seven-F_Cu.gbr", "verify/seven-Edge_Cuts.gbr"]).board;
    let judged = |top: &str| {
        let around = format!(
            "G21 G90 G94 F100\nM3 S10000\nG0 Z2\nG0 X-0.5 Y-0.5\nG1 Z-1.8\nG1 X10\nY8\n{top}X-0.5\nY-0.5\nG0 Z2\nM5\nM2\n"
        );
        names(
            &judge(&board, foreign("around.nc", around, "endmill:1mm", Some(Role::Cutout))),
            Severity::Warning,
        )
    };
    assert_eq!(judged(""), ["tab-missing"], "all round");
    assert_eq!(judged("X6\nG0 Z2\nX3\nG1 Z-1.8\n"), [""; 0], "held by a tab");
}

/// A straight cut between the pads of 2 mm, whose gap is 1 mm, and what is said of copper that it
/// takes.
fn gouges(way: &str, tool: &str, settings: &Settings) -> Vec<Finding> {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let text = format!("G21 G90 G94 F100\nM3 S10000\nG0 Z2\n{way}G0 Z2\nM5\nM2\n");
    let report = verify(&[foreign("gap.nc", text, tool, FRONT)], &board, &[], settings);
    let findings = report.expect("it can be judged").findings;
    findings.into_iter().filter(|finding| finding.name == "gouge").collect()
}

#[test]
fn that_a_gap_is_narrow_explains_a_gouge_and_does_not_excuse_it() {
    let middle = "G0 X3.5 Y1\nG1 Z-0.1\nY3\n";
    let judged = |tool: &str| gouges(middle, tool, &Settings::default());
    let [deep] = judged("endmill:1.4mm").try_into().expect("one finding of both pads");
    assert_eq!(deep.severity, Severity::Error, "0.2 mm of each: {}", deep.message);
    assert_eq!(deep.nets, ["LEFT", "RIGHT"], "one place is one finding");
    assert!(deep.message.contains("narrower than the kerf"), "it says why: {}", deep.message);
    let [shallow] = judged("endmill:1.06mm").try_into().expect("one finding of both pads");
    assert_eq!(shallow.severity, Severity::Warning, "30 µm of 2 mm: {}", shallow.message);
    assert_eq!(shallow.size, Some(Nm::from_um(30)), "{}", shallow.message);
}

#[test]
fn a_cut_off_its_place_that_costs_little_is_a_warning() {
    let beside = |x: &str| {
        let way = format!("G0 X{x} Y1\nG1 Z-0.1\nY3\n");
        gouges(&way, "endmill:0.2mm", &Settings::default()).pop().map(|finding| finding.severity)
    };
    assert_eq!(beside("3.07"), Some(Severity::Warning), "30 µm of 2 mm");
    assert_eq!(beside("2.95"), Some(Severity::Error), "0.15 mm, with its middle in the pad");
    assert_eq!(beside("3.11"), None, "none");
}

#[test]
fn shallow_places_of_one_cause_are_one_finding_that_holds_all_places() {
    let away: String = (0..4).map(|step| format!("G1 X10 Y{step}\n")).collect();
    let way = format!(
        "G0 X3.5 Y1.9\nG1 Z-0.1\nY2\nG0 Z2\nG0 X10 Y9\nG1 Z-0.1\n{away}G0 Z2\n\
         G0 X0.5 Y2\nG1 Z-0.1\nY2.1\nG0 Z2\nG0 X10 Y-1\nG1 Z-0.1\n{away}G0 Z2\n\
         G0 X6.5 Y2\nG1 Z-0.1\nY2.1\n"
    );
    let found = gouges(&way, "endmill:1.06mm", &Settings::default());
    let told: Vec<_> = found.iter().map(|f| (f.severity, f.nets.len(), f.places.len())).collect();
    // In the gap, of both pads; and beside each pad, where nothing forces it.
    assert_eq!(told, [(Severity::Warning, 2, 1), (Severity::Warning, 2, 1)], "{found:?}");
    assert!(found[0].message.contains("narrower"), "{}", found[0].message);
    assert!(found[1].message.contains("in 2 places"), "{}", found[1].message);
}

#[test]
fn what_is_less_than_a_micrometre_is_counted_and_not_listed() {
    let strict = Settings { gouge: Nm::ZERO, ..Settings::default() };
    let found = gouges("G0 X3.5 Y1\nG1 Z-0.1\nY3\n", "endmill:1.0015mm", &strict);
    let [faint] = found.try_into().expect("one finding");
    assert_eq!((faint.severity, faint.size), (Severity::Info, None), "{}", faint.message);
    assert!(faint.message.contains("2 times"), "it is counted: {}", faint.message);
}

#[test]
fn a_net_whose_end_is_cut_off_has_no_width_of_nothing() {
    let board = load(&["verify/seven-F_Cu.gbr", "verify/seven-Edge_Cuts.gbr"]).board;
    // Over the free end of a trace of 0.3 mm that lies at y = 6: all of its width goes, from one
    // side.
    let end = "G21 G90 G94 F100\nM3 S10000\nG0 Z2\nG0 X8.4 Y6.2\nG1 Z-0.1\nG1 X8.9\nG0 Z2\nM5\nM2\n";
    let report = judge(&board, foreign("end.nc", end.to_owned(), "endmill:1mm", FRONT));
    let narrow: Vec<_> = report.findings.iter().filter(|finding| finding.name == "minimum-width").collect();
    assert!(narrow.iter().all(|finding| finding.size > Some(Nm::ZERO)), "{narrow:?}");
    let gouge = report.findings.iter().find(|finding| finding.name == "gouge").expect("it is told");
    assert_eq!(gouge.severity, Severity::Error, "{}", gouge.message);
}
