//! Programs that cut the same places hundreds of times: they are judged in bounded time, and what
//! was not looked at is told.

use std::fmt::Write as _;
use std::path::Path;

use voromill::board::Side;
use voromill::import::{self, Selection};
use voromill::verify::{Program, Report, Role, Settings, Severity, verify};

/// Numbers by chance.
struct Chance(u64);

impl Chance {
    /// Between zero and `most`.
    fn next(&mut self, most: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 33).expect("31 bits")) / f64::from(1_u32 << 31) * most
    }
}

/// Judges cuts, each a line of G-code from where the tool goes down.
fn judged(cuts: impl Iterator<Item = ([f64; 2], String)>) -> Report {
    let mut text = "G21 G90 G17 F100\nM3 S1000\nG0 Z2\n".to_owned();
    for ([x, y], cut) in cuts {
        let _ = writeln!(text, "G0 X{x:.4} Y{y:.4}\nG1 Z-0.1\n{cut}\nG0 Z2");
    }
    text.push_str("M5\nM2\n");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/verify/pads-F_Cu.gbr");
    let board = import::load(&[path], &Selection::default()).expect("a board").board;
    let program = Program {
        file: "crowd.nc".to_owned(),
        text,
        role: Some(Role::Isolation(Side::Front)),
        cutter: Some("endmill:0.2mm".parse().expect("a tool")),
        placement: None,
        ..Program::default()
    };
    verify(&[program], &board, &[], &Settings::default()).expect("it can be judged")
}

fn count(report: &Report, name: &str) -> usize {
    report.findings.iter().filter(|finding| finding.name == name).count()
}

#[test]
fn thousands_of_chords_over_a_board_are_judged() {
    let mut chance = Chance(1);
    let report = judged((0..4000).map(|_| {
        let [x, y, to_x, to_y] = [7.0, 4.0, 7.0, 4.0].map(|most| chance.next(most));
        ([x, y], format!("G1 X{to_x:.4} Y{to_y:.4}"))
    }));
    assert_eq!(count(&report, "destroyed"), 2, "both pads are gone: {:?}", report.findings);
    assert_eq!((count(&report, "gouge"), count(&report, "short")), (0, 0), "{:?}", report.findings);
    let told: Vec<_> = report.findings.iter().filter(|finding| finding.name == "not-judged").collect();
    assert!(!told.is_empty(), "what was not looked at is told: {:?}", report.findings);
}

#[test]
fn thousands_of_circles_over_a_board_are_judged() {
    let mut chance = Chance(2);
    let report = judged((0..2000).map(|_| {
        let [x, y, radius] = [7.0, 4.0, 2.0].map(|most| chance.next(most));
        ([x, y], format!("G2 X{x:.4} Y{y:.4} I{:.4} J0", -radius - 0.05))
    }));
    assert_eq!(count(&report, "destroyed"), 2, "both pads are gone: {:?}", report.findings);
}

/// As where all of a large empty board is cleared.
#[test]
fn slivers_are_looked_for_beside_long_ways_that_run_side_by_side() {
    let arcs = (0..40).map(f64::from).map(|i| {
        let radius = 3.0 + 0.15 * i;
        ([7.0 + radius, 4.0], format!("G3 X{:.4} Y4 I{:.4} J0", 7.0 - radius, -radius))
    });
    let lines = (0..40).map(f64::from).map(|i| {
        let y = -60.0 + 0.15 * i;
        ([-30.0, y], format!("G1 X30 Y{:.4}", y + 40.0))
    });
    let along_an_axis = (0..40).map(f64::from).map(|i| {
        let y = 20.0 + 0.15 * i;
        ([-90.0, y], format!("G1 X90 Y{y:.4}"))
    });
    let small = (0..400).map(f64::from).map(|i| ([-80.0 + 0.4 * i, 20.8], "G1 Y20.9".to_owned()));
    let report = judged(arcs.chain(lines).chain(along_an_axis).chain(small));
    assert_eq!(count(&report, "not-judged"), 0, "{:?}", report.findings);
}

#[test]
fn a_program_run_a_hundred_times_is_no_worse_than_once() {
    let loops =
        [([0.85, 0.85], "G1 X3.15\nY3.15\nX0.85\nY0.85"), ([3.85, 0.85], "G1 X6.15\nY3.15\nX3.85\nY0.85")];
    let report = judged((0..200).map(|n| (loops[n % 2].0, loops[n % 2].1.to_owned())));
    let worse = report.findings.iter().filter(|finding| finding.severity >= Severity::Warning);
    let names: Vec<&str> = worse.map(|finding| finding.name).collect();
    assert_eq!(names, ["not-judged"], "slivers were not looked for: {:?}", report.findings);
    assert_eq!(count(&report, "recut"), 1, "but for its time");
}
