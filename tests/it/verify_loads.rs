//! What breaks tools, or cuts with the wrong one, though the way is right.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use voromill::board::{Board, Outline};
use voromill::geometry::{Nm, Path as Way, Point};
use voromill::verify::{Finding, Program, Role, Settings, Severity, verify};

/// An empty board of 30 mm by 20 mm.
fn plate() -> Board {
    let corner = |x: i64, y: i64| Point::new(Nm::from_mm(x), Nm::from_mm(y));
    let ring = [corner(0, 0), corner(30, 0), corner(30, 20), corner(0, 20), corner(0, 0)];
    let outline = Outline::new(Way::polyline(ring).into_iter().collect());
    Board { outline, ..Board::default() }
}

/// What is found of this name in what `motions` cut with `tool`.
fn found(name: &str, tool: &str, motions: &str) -> Vec<Finding> {
    let program = Program {
        file: "loads.ngc".to_owned(),
        text: format!("G21 G90 G94\nG0 Z5\n{motions}\nG0 Z5\nM5\nM2\n"),
        role: Some(Role::Cutout),
        cutter: Some(tool.parse().expect("a tool")),
        ..Program::default()
    };
    let report = verify(&[program], &plate(), &[], &Settings::default()).expect("it can be judged");
    report.findings.into_iter().filter(|finding| finding.name == name).collect()
}

#[test]
fn a_feed_that_no_tool_bears_is_told() {
    let told = |tool: &str, spindle: &str, feed: &str, depth: &str| {
        let motions = format!("{spindle}\nG0 X0 Y0\nG1 Z-{depth} F10\nG1 X20 F{feed}\nX0\nG0 Z5 F9999");
        found("feed-per-turn", tool, &motions)
    };
    for (tool, spindle, feed, depth, expected) in [
        // Half of 0.8 mm in a turn.
        ("endmill:0.8mm", "M3 S10000", "4000", "0.1", 0),
        ("endmill:0.8mm", "M3 S10000", "4001", "0.1", 1),
        ("endmill:0.8mm", "M3 S120", "200", "0.1", 1),
        // A kerf of 0.1 + 2 · 0.1 · tan 15° = 0.1536 mm.
        ("vbit:0.1mm:30deg", "M3 S10000", "1530", "0.1", 0),
        ("vbit:0.1mm:30deg", "M3 S10000", "1540", "0.1", 1),
        // An eighth of 0.8 mm.
        ("drill:0.8mm", "M3 S10000", "1000", "0.1", 0),
        ("drill:0.8mm", "M3 S10000", "1001", "0.1", 1),
        // What nobody tells turns 60 000 times a minute.
        ("endmill:0.8mm", "M3", "24000", "0.1", 0),
        ("endmill:0.8mm", "M3", "24001", "0.1", 1),
        ("endmill:0.8mm", "M3 S1000", "24000", "0.1", 0),
        ("endmill:0.8mm", "M3 S1000", "24001", "0.1", 1),
        ("endmill:0.8mm", "M3 S999", "4000", "0.1", 1),
        // 4 mm/min are 101.6 as inches, and 400 are 10 160.
        ("endmill:0.8mm", "G20 M3 S10000", "4", "0.004", 0),
        ("endmill:0.8mm", "G20 M3 S10000", "400", "0.004", 1),
    ] {
        let findings = told(tool, spindle, feed, depth);
        assert_eq!(findings.len(), expected, "{tool} {spindle} F{feed}: {findings:?}");
    }
    let both = told("endmill:0.8mm", "M3 S10000", "20000", "0.1");
    assert_eq!(both[0].severity, Severity::Warning, "{both:?}");
    assert!(
        both[0].message.ends_with("20000 mm/min: at 10000 rpm that is 2.000 mm in a turn (2 motions)"),
        "{both:?}"
    );
    assert_eq!(both[0].line, Some(6), "where it is first");
    assert_eq!(found("feed-per-turn", "endmill:0.8mm", "M3 S10000\nG1 X0 Y0 F9000\nX20"), [], "through air");
}

/// A square and a circle, cut to these depths one after another, in chords or in arcs.
fn passes(depths: &[f64], chords: Option<u32>) -> String {
    let mut text = "M3 S10000\nG0 X2 Y2\nG0 Z0.1\n".to_owned();
    for depth in depths {
        let _ = writeln!(text, "G1 Z-{depth} F60\nX12 F100\nY12\nX2\nY2");
    }
    let _ = writeln!(text, "G0 Z5\nG0 X25 Y10\nG0 Z0.1");
    for depth in depths {
        let _ = writeln!(text, "G1 Z-{depth} F60");
        match chords {
            None => text += "G3 X15 Y10 I-5 J0 F100\nG3 X25 Y10 I5 J0\n",
            Some(count) => {
                for i in 1..=count {
                    let (sin, cos) = libm::sincos(f64::from(i) / f64::from(count) * TAU);
                    let _ = writeln!(text, "X{:.4} Y{:.4} F100", 20.0 + 5.0 * cos, 10.0 + 5.0 * sin);
                }
            }
        }
    }
    text
}

#[test]
fn a_pass_that_is_too_deep_for_its_end_mill_is_told() {
    // Three diameters are 1.5 mm.
    for (depths, expected) in [
        (&[1.5][..], 0),
        (&[1.6], 1),
        (&[1.4, 2.8], 0),
        (&[0.2, 1.8], 1),
        (&[0.2, 1.7], 0),
        (&[0.4, 0.8, 1.2, 1.6, 2.0], 0),
    ] {
        for chords in [None, Some(8), Some(2000)] {
            let findings = found("pass-too-deep", "endmill:0.5mm", &passes(depths, chords));
            assert_eq!(findings.len(), expected, "{depths:?}, {chords:?} chords: {findings:?}");
        }
    }
    let findings = found("pass-too-deep", "endmill:0.5mm", &passes(&[0.2, 1.8], None));
    let said = "a pass 1.600 mm deep with an end mill of 0.500 mm (2 places)";
    assert_eq!(findings[0].message, said, "the square and the circle");
    assert_eq!((findings[0].severity, findings[0].line), (Severity::Warning, Some(12)), "where it is first");
}

#[test]
fn what_was_cut_before_is_not_cut_again() {
    let told = |motions: &str| found("pass-too-deep", "endmill:0.5mm", motions).len();
    let start = "M3 S10000\nG0 X2 Y2\nG0 Z0.1\n";
    // Down along 10 mm at once, and then level.
    assert_eq!(told(&format!("{start}G1 Z0 F60\nX12 Z-1.8\nX2\n")), 1, "the ramp itself");
    let often = "X12 Z-0.6\nX2 Z-1.2\nX12 Z-1.8\nX2\n";
    assert_eq!(told(&format!("{start}G1 Z0 F60\n{often}")), 0, "to and fro");
    // A hole that is bored in turns of 0.4 mm.
    let turns: String =
        (1..=5).map(|turn| format!("G3 X2 Y2 I0.4 Z-{:.1}\n", 0.4 * f64::from(turn))).collect();
    assert_eq!(told(&format!("{start}G1 Z0 F60\n{turns}G3 X2 Y2 I0.4\n")), 0, "in five turns");
    assert_eq!(told(&format!("{start}G1 Z0 F60\nG3 X2 Y2 I0.4 Z-2\n")), 1, "in one");
    // Straight down, which is what drills and end mills bear.
    assert_eq!(told(&format!("{start}G1 Z-2 F60\n")), 0, "a plunge");
    assert_eq!(found("pass-too-deep", "drill:0.5mm", &format!("{start}G1 Z-2 F60\n")), [], "a drill");
}

#[test]
fn a_drill_that_goes_sideways_is_told() {
    let slot = "M3 S10000\nG0 X2 Y2\nG0 Z0.1\nG1 Z-1.7 F60\nG1 X3 F100\nG0 Z5\n";
    let found = |tool: &str, motions: &str| found("drill-sideways", tool, motions);
    let drilled = found("drill:0.8mm", slot);
    assert_eq!(drilled.len(), 1, "{drilled:?}");
    assert_eq!((drilled[0].severity, drilled[0].line), (Severity::Error, Some(7)), "{drilled:?}");
    assert_eq!(found("endmill:0.8mm", slot), [], "what end mills are for");
    assert_eq!(found("drill:0.8mm", &slot.replace("X3", "X2.04")), [], "rounded");
    assert_eq!(found("drill:0.8mm", &slot.replace("Z-1.7", "Z0.1")), [], "above the board");
    assert_eq!(found("drill:0.8mm", &slot.replace("G1 X3", "G2 X2 Y2 I0.4")).len(), 1, "round");
    let aslant = "M3 S10000\nG0 X2 Y2\nG0 Z1\nG1 X3 Z-1.7 F60\n";
    assert_eq!(found("drill:0.8mm", aslant).len(), 1, "aslant");
    assert_eq!(
        found("drill:0.8mm", "M3 S9000\nG0 X2 Y2\nG83 X5 Y5 Z-1.7 R1 Q0.5 F60\nX8\nG80\n"),
        [],
        "cycles"
    );
}

#[test]
fn a_tool_that_nobody_has_time_to_change_is_told() {
    let holes = |change: &str| {
        let hole = "G1 Z-1.8 F60\nG0 Z5\n";
        let text = format!(
            "(plate drill)\n(starts with tool 1: drill:0.8mm)\nG21 G90\nT1 M6\nM3 S9000\nG0 X2 Y2 Z5\n{hole}\
             (goes on with tool 2: drill:1mm)\n{change}G0 X5\n{hole}(tool 2: drill:1mm)\nX8\n{hole}M5\nM2\n"
        );
        let program = Program { file: "holes.ngc".to_owned(), text, ..Program::default() };
        let report = verify(&[program], &plate(), &[], &Settings::default()).expect("it can be judged");
        let findings = report.findings.into_iter().filter(|finding| finding.name == "tool-not-changed");
        findings.map(|finding| (finding.severity, finding.line)).collect::<Vec<_>>()
    };
    assert_eq!(holes(""), [(Severity::Error, Some(11))], "once, at the first hole");
    assert_eq!(holes("T2\n"), [(Severity::Error, Some(12))], "T alone chooses it");
    for change in ["M0\n", "T2 M6\n", "M5\nM0\nM3\n", "T2\nM6\n", "M25\n", "M291 S3\n"] {
        assert_eq!(holes(change), [], "{change}");
    }
    assert_eq!(holes("T1 M6\n").len(), 2, "the tool that is in, and another number than the comments have");
    assert_eq!(holes("T3 M6\n").len(), 1, "another number than the comments have");
}

#[test]
fn pins_stand_beside_the_board_and_in_what_is_under_it() {
    let told = |holes: &[(&str, &str, &str)]| {
        let hole = |(x, y, z): &(&str, &str, &str)| format!("G0 X{x} Y{y}\nG1 Z{z} F60\nG0 Z5\n");
        let holes: String = holes.iter().map(hole).collect();
        let text = format!(
            "(plate alignment)\n(mount tool 1: drill:3mm)\nG21 G90\nM3 S9000\nG0 X9 Y-9\nG0 Z5\n{holes}M5\nM2\n"
        );
        let program = Program { file: "pins.ngc".to_owned(), text, ..Program::default() };
        let report = verify(&[program], &plate(), &[], &Settings::default()).expect("it can be judged");
        let findings = report.findings.into_iter().filter(|finding| finding.name == "alignment-hole");
        findings.map(|finding| finding.message).collect::<Vec<_>>()
    };
    let other = ("15", "24", "-6");
    assert_eq!(told(&[("15", "-4", "-6"), other]), [""; 0]);
    assert_eq!(told(&[("15", "-1.6", "-6"), other]), [""; 0], "a tenth beside the board");
    assert_eq!(told(&[("15", "-1.4", "-6"), other]), ["an alignment hole reaches into the board"]);
    assert_eq!(told(&[("15", "9", "-6"), other]), ["an alignment hole reaches into the board"]);
    assert!(told(&[("15", "-4", "-60"), other])[0].ends_with("into the machine"));
    assert_eq!(told(&[]), ["it drills no alignment hole"]);
}

/// Code behind the end is carried out by some controllers; subprograms are where they belong.
#[test]
fn code_behind_the_end_is_told() {
    let behind = |text: &str| {
        let motions = format!("M3 S10000\nG0 X2 Y2\nG1 Z-1 F60\nG0 Z5\nM5\nM2\n{text}");
        let found = found("code-after-end", "endmill:0.5mm", &motions);
        found.iter().map(|finding| finding.line).collect::<Vec<_>>()
    };
    // What `found` has behind it retracts.
    assert_eq!(behind("N9 (a comment)\n%\n"), [Some(12)]);
    assert_eq!(behind("G0 X5\n"), [Some(9)]);
    assert_eq!(behind("M30\nM5\n\nO100\nG1 X2\nM99\n"), [Some(16)], "behind a subprogram");
    assert_eq!(behind("o100 sub\nG1 X2\no100 endsub\n"), [Some(13)], "behind a subprogram");
}

#[test]
fn a_first_rapid_into_the_board_is_told() {
    let told = |motions: &str| {
        let text = format!("(plate cutout)\nG21 G90\n{motions}G0 Z5\nM5\nM2\n");
        let tool = Some("endmill:1mm".parse().expect("a tool"));
        let program = Program { file: "first.ngc".to_owned(), text, cutter: tool, ..Program::default() };
        let report = verify(&[program], &plate(), &[], &Settings::default()).expect("it can be judged");
        let rapids = report.findings.into_iter().filter(|finding| finding.name == "rapid-in-material");
        rapids.map(|finding| (finding.severity, finding.line)).collect::<Vec<_>>()
    };
    let cut = "G1 Z-0.5 F60\nX5\n";
    assert_eq!(told(&format!("G0 X2 Y2\nG0 Z5\nM3 S9000\n{cut}")), [], "at a height that nobody knows yet");
    assert_eq!(
        told(&format!("G0 Z-5\nM3 S9000\nG0 X2 Y2\n{cut}")),
        [(Severity::Error, Some(3))],
        "and sideways"
    );
    assert_eq!(told(&format!("G0 X2 Y2 Z-0.1\nM3 S9000\n{cut}")), [(Severity::Error, Some(3))]);
    assert_eq!(told(&format!("G0 Z0.01\nM3 S9000\nG0 X2 Y2\n{cut}")), [(Severity::Warning, Some(5))]);
}

#[test]
fn codes_that_a_controller_does_not_take_are_told() {
    let told = |dialect: Option<&str>, codes: &str| {
        let text = format!("(plate cutout)\nG21\nG90\nM3 S9000\nG0 X0 Y0 Z5\n{codes}\nM5\nM2\n");
        let program = Program {
            file: "codes.ngc".to_owned(),
            text,
            cutter: Some("endmill:1mm".parse().expect("a tool")),
            dialect: dialect.map(str::to_owned),
            ..Program::default()
        };
        let report = verify(&[program], &plate(), &[], &Settings::default()).expect("it can be judged");
        let findings = report.findings.into_iter().filter(|finding| finding.name == "word-not-taken");
        findings.map(|finding| finding.message).collect::<Vec<_>>()
    };
    for (dialect, codes, expected) in [
        ("grbl", "G81 X5 Y5 Z-1.8 R1 F60\nG80", "G81: grbl stops there with an error"),
        ("grbl", "M6 T1", "M6: grbl stops there with an error"),
        ("grbl", "G64 P0.01\nG64 P0.02", "G64: grbl stops there with an error (2 times)"),
        ("grbl", "G4 P1\nG17 G40 G49 G61 G80 G91.1 G94\nG38.2 Z-1 F9\nM0\nM8\nM9", ""),
        ("fluidnc", "G83 X5 Y5 Z-1.8 R1 Q0.5 F60\nG80", "G83: fluidnc stops there with an error"),
        ("fluidnc", "T1 M6", "M6: fluidnc passes over it, and does not wait"),
        ("grblhal", "G83 X5 Y5 Z-1.8 R1 Q0.5 F60\nG80\nT1 M6", ""),
        ("linuxcnc", "G83 X5 Y5 Z-1.8 R1 Q0.5 F60\nG80\nG64 P0.01\nT1 M6", ""),
        ("tinyg", "M0", "M0: tinyg passes over it, and does not wait"),
        ("smoothieware", "G91.1", "G91.1: smoothieware takes it for G91, and all that follows for steps"),
        ("klipper", "G81 X5 Y5 Z-1.8 R1 F60\nG80", "G81: klipper passes over it, and drills no hole"),
        ("reprapfirmware", "M0", "M0: reprapfirmware ends the job there"),
        ("marlin", "G1 X5 F60\nM30", "M30: marlin deletes a file there"),
        ("smoothieware", "G81 X5 Y5 Z-1.8 R1 F60\nG82 X6 Z-1.8 R1\nG83 X7 Z-1.8 R1 Q0.5\nG80", ""),
        (
            "smoothieware",
            "G85 X5 Y5 Z-1.8 R1 F60\nG80",
            "G85: smoothieware passes over it, and drills no hole",
        ),
        (
            "reprapfirmware",
            "G81 X5 Y5 Z-1.8 R1 F60\nG80",
            "G81: reprapfirmware runs a macro of that name, and drills no hole where there is none",
        ),
        ("klipper", "G20", "G20: klipper stops there with an error"),
    ] {
        let findings = told(Some(dialect), codes);
        let expected: Vec<&str> =
            Some(expected).into_iter().filter(|expected| !expected.is_empty()).collect();
        assert_eq!(findings, expected, "{dialect}: {codes}");
        assert_eq!(
            told(None, &format!("(dialect {dialect})\n{codes}")),
            expected,
            "as the program says: {codes}"
        );
    }
    assert_eq!(told(None, "G81 X5 Y5 Z-1.8 R1 F60\nG80\nM6"), [""; 0], "nobody knows for which");
}

/// What is found of this name in a program for this controller, with its line.
fn told(name: &str, dialect: Option<&str>, lines: &str) -> Vec<(Severity, Option<u32>, String)> {
    let program = Program {
        file: "state.ngc".to_owned(),
        text: lines.to_owned(),
        role: Some(Role::Cutout),
        cutter: Some("endmill:1mm".parse().expect("a tool")),
        dialect: dialect.map(str::to_owned),
        ..Program::default()
    };
    let report = verify(&[program], &plate(), &[], &Settings::default()).expect("it can be judged");
    let findings = report.findings.into_iter().filter(|finding| finding.name == name);
    findings.map(|finding| (finding.severity, finding.line, finding.message)).collect()
}

#[test]
fn a_dwell_in_the_unit_of_another_controller_is_told() {
    for (dialect, dwell, expected) in [
        (Some("grbl"), "G4 P3", ""),
        (Some("grbl"), "G4 P3000", "grbl waits 3000 s, as P counts seconds"),
        (Some("linuxcnc"), "G4 P1500.0\nG4 P1500", "linuxcnc waits 1500 s, as P counts seconds (2 times)"),
        (Some("marlin"), "G4 P3", "marlin waits 3 ms, as P counts milliseconds"),
        (Some("klipper"), "G4 P3000", ""),
        (Some("marlin"), "G4 S3", ""),
        (Some("reprapfirmware"), "G4 P0", ""),
        // A setting says what P counts.
        (Some("mach3"), "G4 P3000", ""),
        (Some("smoothieware"), "G4 P3", ""),
        (None, "G4 P3000", ""),
    ] {
        let text = format!("G21 G90\nG0 Z5\nM3 S9000\n{dwell}\nG0 X0 Y0\nM5\nM2\n");
        let found = told("dwell-length", dialect, &text);
        let expected = Some(expected).filter(|expected| !expected.is_empty());
        let expected = expected.map(|expected| (Severity::Warning, Some(4), expected.to_owned()));
        assert_eq!(found, Vec::from_iter(expected), "{dialect:?} {dwell}");
    }
}

#[test]
fn a_spindle_that_turns_while_a_person_reaches_for_the_tool_is_told() {
    let waits = "it waits while the spindle turns";
    let ends = "it ends, without M5, M2 or M30: the spindle goes on turning";
    for (lines, expected) in [
        ("M5\nM0\nM3\nG0 X5\nM5\nM2", None),
        ("M0\nG0 X5\nM5\nM2", Some((5, waits.to_owned()))),
        ("M0\nG0 X5\nM0\nM5\nM2", Some((5, format!("{waits} (2 times)")))),
        ("M5 M0\nM3\nG0 X5\nM2", None),
        ("G0 X5\nM30", None),
        ("G0 X5\nM5", None),
        ("G0 X5", Some((5, ends.to_owned()))),
        // It stops the spindle, or a macro may.
        ("T2 M6\nM3\nG0 X5\nM2", None),
        ("M456\nG0 X5\nM2", None),
    ] {
        let found = told("spindle-left-on", None, &format!("G21 G90\nG0 Z5\nM3 S9000\nG0 X0 Y0\n{lines}\n"));
        let expected = expected.map(|(line, message)| (Severity::Warning, Some(line), message));
        assert_eq!(found, Vec::from_iter(expected), "{lines}");
    }
}

#[test]
fn a_spindle_without_a_speed_stands_where_speeds_begin_at_zero() {
    let lines = "G21 G90\nG0 Z5\nM3\nG0 X0 Y0\nG1 Z-0.1 F50\nX5 F100\nS8000\nX9\nG0 Z5\nM5\nM2\n";
    let found = |dialect: Option<&str>| told("plunge-spindle-off", dialect, lines);
    for dialect in ["grbl", "grblhal", "fluidnc", "linuxcnc"] {
        let message =
            format!("the spindle is on without a speed (S): {dialect} begins with S0, and it stands");
        assert_eq!(found(Some(dialect)), [(Severity::Warning, Some(5), message)]);
    }
    assert_eq!(found(Some("marlin")), [], "M3 alone is full speed");
    assert_eq!(found(None), [], "by a knob");
}

#[test]
fn what_a_program_takes_for_granted_of_where_the_machine_stands_is_told() {
    let rest = "G1 Z-0.1 F50\nX5 F100\nG0 Z5\nM5\nM2\n";
    let found = |lines: &str| {
        let found = told("unclear", None, &format!("G21 G90\nM3 S9000\n{lines}\n{rest}"));
        found.into_iter().filter(|(severity, ..)| *severity == Severity::Warning).collect::<Vec<_>>()
    };
    assert_eq!(found("G0 Z5\nG0 X0 Y0"), []);
    assert_eq!(found("G28 Z0\nG0 X0 Y0\nG0 Z5"), [], "up at home");
    let sideways = "it moves sideways before it says how high: the tool has to be above the board by then";
    assert_eq!(found("G0 X0 Y0\nG0 Z5"), [(Severity::Warning, Some(3), sideways.to_owned())]);
    let zero = "G92 sets zero by where the tool happens to be: a zero that was set before does not count";
    let times = |count: u32| format!("{zero} ({count} times)");
    assert_eq!(found("G92 X5 Y5\nG0 Z5\nG0 X0 Y0"), [(Severity::Warning, Some(3), times(2))]);
    let stays = "zero is moved (G92, G52) and not moved back (G92.1) at the end: programs that come after lie beside this";
    assert_eq!(found("G0 Z5\nG0 X0 Y0\nG92 X5 Y5\nG0 X0 Y0\nG92.1"), [], "and back");
    assert_eq!(
        found("G0 Z5\nG0 X0 Y0\nG92 X5 Y5\nG0 X0 Y0"),
        [(Severity::Warning, Some(11), stays.to_owned())]
    );
    let by_hand =
        "G10 L20 sets zero by where the tool happens to be: a zero that was set before does not count";
    let moves = "G10 L20 moves zero, for the programs that come after, too";
    for (lines, line, said) in [
        ("G10 L20 P1 Z0\nG0 Z5\nG0 X0 Y0", 3, by_hand),
        ("G0 Z5\nG0 X0 Y0\nG10 L20 P1 X5", 5, moves),
        (
            "G10 L2 P1 Z0\nG0 Z5\nG0 X0 Y0",
            3,
            "G10 L2 moves zero, wherever it was set, for the programs that come after, too",
        ),
        ("G92.3\nG0 Z5\nG0 X0 Y0", 3, "G92.3 moves zero as some program before has left it"),
        (
            "G43.1 Z-5\nG0 Z5\nG0 X0 Y0",
            3,
            "G43.1 shifts all heights by -5.000 mm: here they are taken as they stand",
        ),
        (
            "T3 M6 M3\nG43 H4\nG0 Z5\nG0 X0 Y0",
            4,
            "G43 H4 takes the length of another tool than the one that is in",
        ),
        ("G64 P1\nG0 Z5\nG0 X0 Y0", 3, "G64 P1 lets the machine round corners by that much"),
        (
            "G0 Z5\nG0 X0 Y0\nM84 X Y\nG0 X5",
            5,
            "M18 and M84 let go of the motors: where the tool is afterwards is not known",
        ),
        ("M220 S1000\nG0 Z5\nG0 X0 Y0", 3, "M220 S1000: feeds are 1000 % of what they say"),
        (
            "$32=1\nG0 Z5\nG0 X0 Y0",
            3,
            "a setting of the controller is changed, for all programs that come after",
        ),
        (
            "G0 Z5\nG0 X0 Y0\nG38.2 Z-5 F50",
            5,
            "it probes while the spindle turns: the tool drills into the plate, or into the board",
        ),
    ] {
        assert_eq!(found(lines), [(Severity::Warning, Some(line), said.to_owned())], "{lines}");
    }
    for lines in [
        "G0 Z5\nG0 X0 Y0\nM5\nG38.2 Z-5 F50\nG10 L20 P1 Z0\nG0 Z5\nM3",
        "T3 M6 M3\nG43 H3\nG64 P0.01\nG0 Z5\nG0 X0 Y0",
        "G53 G0 Z-5\nG0 X0 Y0\nG0 Z5",
        "$X\nM220 S100\nG43.1 Z0\nG0 Z5\nG0 X0 Y0",
        "M17\nG0 Z5\nG0 X0 Y0\nM84 S60\nG0 X5\nG0 Z5",
    ] {
        assert_eq!(found(lines), [], "{lines}");
    }
}

#[test]
fn a_tool_that_is_left_in_the_board_is_told() {
    let start = "G21 G90\nM3 S9000\nG0 Z5\nG0 X0 Y0\nG1 Z-0.1 F50\n";
    let found = |rest: &str| told("tool-left-down", None, &format!("{start}{rest}"));
    let said = |line: u32, does: &str| {
        [(Severity::Warning, Some(line), format!("it {does} with the tool 0.100 mm below the surface"))]
    };
    assert_eq!(found("X5\nG0 Z5\nM5\nM0\nM2\n"), []);
    assert_eq!(found("X5\nM5\nM2\n"), said(6, "ends"));
    assert_eq!(found("X5\nM5\nM0\nG0 Z5\nM2\n"), said(8, "waits"));
    assert_eq!(found("X5\nM5\nT2 M6\nG0 Z5\nM2\n"), said(8, "waits"));
    // Nobody here knows what it does.
    assert_eq!(found("X5\nM456\nG0 Z5\nM5\nM2\n"), []);
}

/// Canned cycles do so, and whatever writes them out.
#[test]
fn a_rapid_into_a_hole_that_was_cut_before_is_none_through_material() {
    let found = |motions: &str| {
        let found = found("rapid-in-material", "endmill:1mm", &format!("M3 S9000\nG0 X5 Y5\n{motions}"));
        found.into_iter().map(|finding| finding.message).collect::<Vec<_>>()
    };
    let through = |depth: &str| [format!("a rapid goes down to {depth} mm below the surface")];
    assert_eq!(found("G1 Z-1 F50\nG0 Z0.2\nG0 Z-0.9\nG1 Z-1.8"), [""; 0]);
    assert_eq!(found("G1 Z-1 F50\nG0 Z0.2\nG0 Z-1.1\nG1 Z-1.8"), through("1.100"), "deeper than it was cut");
    assert_eq!(found("G1 Z-1 F50\nG0 Z0.2\nG0 X6\nG0 Z-0.9\nG1 Z-1.8"), through("0.900"), "beside it");
    assert_eq!(found("G0 Z-0.9\nG1 Z-1.8 F50"), through("0.900"), "before it was cut");
    assert_eq!(
        found("G1 Z-1 F50\nG28"),
        ["a rapid goes sideways 1.000 mm below the surface"],
        "all axes go at once"
    );
    assert_eq!(found("G1 Z-1 F50\nG28 Z0"), [""; 0], "straight up");
}

#[test]
fn lines_that_a_controller_takes_otherwise_are_told() {
    let lines = |dialect: &str, codes: &str| {
        let text = format!("G21\nG90\nM3 S9000\nG0 X0 Y0 Z5\n{codes}\nM5\nM2\n");
        let of_lines = |message: &String| message.contains("line") || message.contains("takes it at once");
        let found = told("word-not-taken", Some(dialect), &text).into_iter();
        found.map(|(_, line, message)| (line, message)).filter(|(_, m)| of_lines(m)).collect::<Vec<_>>()
    };
    let bare = |dialect: &str| {
        (Some(5), format!("coordinates in a line without a code: {dialect} passes over them (2 times)"))
    };
    let several =
        |dialect: &str| (Some(5), format!("several codes in a line: {dialect} runs the first alone"));
    for dialect in ["marlin", "klipper"] {
        assert_eq!(lines(dialect, "X5\nY5"), [bare(dialect)]);
        assert_eq!(lines(dialect, "G91 G0 X5\nG90"), [several(dialect)]);
    }
    let at_once = |what: &str, does: &str| {
        [(Some(5), format!("`{what}`: grbl takes it at once, in comments, too, and {does}"))]
    };
    assert_eq!(lines("grbl", "X5\nG91 G0 Y5\nG90"), []);
    assert_eq!(lines("grbl", "(second pass!)"), at_once("!", "holds the feed"));
    assert_eq!(lines("grbl", "(~ 5 mm)"), at_once("~", "goes on where it waits"));
    assert_eq!(lines("grbl", "(Ä)"), at_once("Ä", "changes feed or spindle, or opens the safety door"));
    assert_eq!(lines("grbl", "(90°, 5 µm, café?)"), [], "bytes that it throws away");
    assert_eq!(lines("linuxcnc", "(second pass!)\nX5"), []);
    // grblHAL reads what is printed in parentheses as text, FluidNC decodes UTF-8.
    assert_eq!(lines("grblhal", "(~ 5 mm, second pass!)"), []);
    assert_eq!(lines("grblhal", "; ~ 5 mm\n(Ä)").len(), 2, "elsewhere, and letters with accents");
    assert_eq!(lines("fluidnc", "(Größe — Ä)"), []);
    assert_eq!(lines("fluidnc", "(cut!\u{a0})").len(), 2, "what holds the feed, and a blank that acts");
    let queue = "`%`: tinyg takes it at once, in comments, too, and drops the lines that it has not run yet";
    assert_eq!(lines("tinyg", "(50%)"), [(Some(5), queue.to_owned())]);
    assert_eq!(lines("g2core", "(50%, Ä!)"), []);
}

#[test]
fn a_line_that_a_controller_takes_otherwise_than_it_reads_is_told() {
    let told = |dialect: &str, codes: &str| {
        let text = format!("G21\nG90\nM3 S9000\nG0 X0 Y0 Z5\n{codes}\nM5\nM2\n");
        let found = told("word-not-taken", Some(dialect), &text).into_iter();
        found
            .map(|(severity, line, message)| {
                assert_eq!((severity, line), (Severity::Error, Some(5)), "{dialect}: {message}");
                message
            })
            .collect::<Vec<_>>()
    };
    let arc = "G2 X5 Y5 R5 F60";
    let cases: &[(&[&str], &str, &str)] = &[
        (&["tinyg", "smoothieware"], "G0 (up) Z20", "code behind a comment in its line: {} passes over it"),
        (&["tinyg", "smoothieware"], "(on) M3 S9000", "code behind a comment in its line: {} passes over it"),
        (&["smoothieware"], arc, "an arc with R: {} does not read R, and cuts another arc or none"),
        (&["klipper"], arc, "an arc with R: {} stops there with an error"),
        (
            &["marlin", "klipper"],
            "G0 Z20 ( retract )",
            "a comment in parentheses in a line with code: {} takes its letters for words of the code",
        ),
        (
            &["marlin"],
            "N10 G0 Z20",
            "a line with a number and no checksum: {} does not take the line, and asks for another",
        ),
        (&["grbl"], "#1=2", "a line with a parameter or an expression: {} stops there with an error"),
        (
            &["grbl"],
            "O100 sub\nG4 P0\nO100 endsub",
            "a line with an O-word: {} stops there with an error (2 times)",
        ),
        (&["grbl"], "%", "a line with `%`: {} stops there with an error"),
        (
            &["grbl"],
            "N1000001 G17 G21 G40 G49 G94 G90 G54 G0 X0000000.000000000 Y0000.000000000 Z0005.00000000000",
            "a line of more than 79 characters: {} stops there with an error",
        ),
    ];
    for (dialects, codes, expected) in cases {
        for dialect in *dialects {
            assert_eq!(told(dialect, codes), [expected.replace("{}", dialect)], "{dialect}: {codes}");
        }
        for dialect in ["linuxcnc", "grblhal", "fluidnc", "mach3"] {
            assert_eq!(told(dialect, codes), [""; 0], "{dialect} takes {codes}");
        }
    }
    let numbers = "a line whose number is not one more than the last: smoothieware does not take the line, and asks for another";
    assert_eq!(told("smoothieware", "N4 G0 Z20\nN5 G0 Z19\nG0 Z18"), [""; 0], "numbers that follow");
    let text = "G21\nG90\nM3 S9000\nN10 G0 X0 Y0 Z5\nN20 G0 Z20\nM5\nM2\n";
    let found = self::told("word-not-taken", Some("smoothieware"), text);
    assert_eq!(found, [(Severity::Error, Some(5), numbers.to_owned())], "numbers by tens");
    assert_eq!(told("g2core", &format!("G0 (up) Z20\n{arc}")), [""; 0], "it reads both");
}
