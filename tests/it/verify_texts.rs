//! What stands round the motions of a text: stops, comments, what is behind its end, how it says
//! that the board lies.

use std::path::Path;
use std::sync::LazyLock;

use voromill::board::Board;
use voromill::geometry::{Nm, Vector};
use voromill::import::{self, Selection};
use voromill::job::{self, Job, Options, Part};
use voromill::verify::{Laid, Program, Settings, Severity, is_probe, verify};

use crate::cli::{stderr, stdout, voromill};

fn job(settings: &str, name: &str) -> Job {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator");
    let mut loaded = import::load(&[folder], &Selection::default()).expect("a board");
    if !name.is_empty() {
        name.clone_into(&mut loaded.board.name);
    }
    let options = Options::from_toml("settings", settings).expect("options");
    job::mill(loaded, &job::Settings::resolve(options).expect("settings")).expect("a job")
}

/// All drills in one program, in which the machine pauses for each.
static PAUSED: LazyLock<Job> = LazyLock::new(|| job("tool-change = \"pause\"", ""));

fn text(job: &Job, part: Part) -> &str {
    &job.programs.iter().find(|written| written.part == part).expect("a program").text
}

fn program(text: &str) -> Program {
    Program { file: "text.ngc".to_owned(), text: text.to_owned(), ..Program::default() }
}

/// What is found, as bad as a warning or worse: each name once, and the messages.
fn found(board: &Board, program: Program) -> (Vec<&'static str>, String) {
    let report = verify(&[program], board, &[], &Settings::default()).expect("it can be judged");
    let bad = || report.findings.iter().filter(|finding| finding.severity >= Severity::Warning);
    let mut names: Vec<&str> = bad().map(|finding| finding.name).collect();
    names.sort_unstable();
    names.dedup();
    (names, bad().map(|finding| finding.message.clone()).collect::<Vec<_>>().join("; "))
}

#[test]
fn nobody_waits_at_m1_unless_that_was_switched_on() {
    let whole = text(&PAUSED, Part::Drill);
    let of = |text: &str| found(&PAUSED.board, program(text));
    assert_eq!(of(whole).0, [""; 0], "it stops with M0");
    let optional = whole.replace("\nM0\n", "\nM1\n");
    let (names, said) = of(&optional);
    assert_eq!(names, ["tool-not-changed", "word-not-taken"], "Grbl passes over M1: {said}");
    let (names, said) = of(&optional.replace("dialect grbl", "dialect linuxcnc"));
    assert_eq!(names, ["tool-not-changed"], "{said}");
    assert!(said.contains("M1, which stops only where somebody has switched that on"), "{said}");
}

#[test]
fn what_grbl_does_not_take_is_told() {
    let whole = text(&PAUSED, Part::Drill);
    for (line, what) in [
        ("(drill (long))", "a comment within a comment"),
        ("G0 Z3\nG1 F100\nG2 I1 J0\n", "an arc without X and Y"),
        ("G90 G91 G0 X5\nG90", "codes of which one alone can hold"),
        ("G80 G0 Z5", "G80 beside a motion"),
        ("G0 Z5 H1", "a word for which none of its codes asks"),
        ("G1 Z5 P2 F100", "a word for which none of its codes asks"),
        ("G0 Z5 A0", "a word for which none of its codes asks"),
        ("G4 S3", "a dwell without P"),
        ("T256", "a tool above T255"),
        ("N10000001 G0 Z5", "a line with a number above 10000000"),
    ] {
        let changed = whole.replacen("\nM5\n", &format!("\n{line}\nM5\n"), 1);
        let (names, said) = found(&PAUSED.board, program(&changed));
        assert!(names.contains(&"word-not-taken") && said.contains(what), "{line}: {said}");
    }
    for line in ["G4 P3", "T255 M9", "N10000000 G0 Z5", "G10 L20 P1 Z5", "G17 G21 G90 G94 G0 Z5"] {
        let changed = whole.replacen("\nM5\n", &format!("\nG0 Z5\n{line}\nM5\n"), 1);
        let (names, said) = found(&PAUSED.board, program(&changed));
        assert!(!names.contains(&"word-not-taken"), "{line}: {said}");
    }
    let whole_turn = whole.replacen("\nM5\n", "\nG0 Z3\nG0 X5 Y5\nG1 F100\nG2 X5 I1 J0\nM5\n", 1);
    let (_, said) = found(&PAUSED.board, program(&whole_turn));
    assert!(!said.contains("an arc without X and Y"), "its X says where it ends: {said}");
}

#[test]
fn what_other_controllers_take_otherwise_is_told() {
    let whole = text(&PAUSED, Part::Drill);
    let of = |dialect: &str, line: &str| {
        let changed = whole.replacen("\nM5\n", &format!("\nG0 Z3\nG0 X5 Y5\nG1 F100\n{line}\nM5\n"), 1);
        let changed = changed.replace("dialect grbl", &format!("dialect {dialect}"));
        found(&PAUSED.board, program(&changed)).1
    };
    let far = format!("G0 Z5{}F100", " ".repeat(95));
    for (dialect, line, what) in [
        ("grbl", "G0 G28 Z5", "codes of which one alone can hold"),
        ("grbl", "G2 X7 R0.9999", "an arc whose R is less"),
        ("grblhal", "M98 P9 L0\nO9", "M98: grblhal runs no subprogram"),
        ("grblhal", "(a (b))", "a comment within a comment"),
        ("grblhal", "G0 Z5 H1", "a word for which none of its codes asks"),
        ("fluidnc", "G2 I1 J0", "an arc without X and Y"),
        ("fluidnc", "G95\nG94 F100", "G95: fluidnc stops"),
        ("fluidnc", "(a (b) c)", "a comment that goes on"),
        ("fluidnc", "G4 S3", "a dwell without P"),
        ("tinyg", "o9 if [1]\nG0 Z5\no9 endif", "a subprogram, a branch or a loop"),
        ("tinyg", "G38.3 Z2 F10", "G38.3: tinyg stops"),
        ("tinyg", "/G0 Z5", "a line that begins with `/`"),
        ("tinyg", "G2 X5 I1 J0", "a full circle with X and Y"),
        ("tinyg", "G2 X7.002 I1 J0", "by more than 0.1 %"),
        ("g2core", "G3 X5 I1 J0", "a full circle of G3"),
        ("mach3", "G2 X7.0045 I1 J0", "by more than 0.002 mm"),
        ("smoothieware", "g0 Z5", "a lower-case letter"),
        ("smoothieware", "R1 G0 Z5", "does not begin with G M T S N X Y Z or F"),
        ("marlin", "G28 Z5", "G28: marlin goes to its switches"),
        ("marlin", "G53 G0 Z0", "G53: marlin counts it from the bed"),
        ("marlin", "G0 Z[2+3]", "a parameter or an expression"),
        ("marlin", "G10 L2 P2 Z5", "G10 with L"),
        ("marlin", &far, "code behind its 96th character"),
        ("reprapfirmware", "G30", "G30: reprapfirmware takes it for a probe"),
        ("klipper", "G53 G0 Z0", "G53: klipper does not take it"),
        ("klipper", "G38.2 Z2 F10", "G38.2: klipper passes over it"),
        ("klipper", "G91 G2 X2 I1 J0\nG90", "an arc in G91"),
    ] {
        let said = of(dialect, line);
        assert!(said.contains(what), "{dialect}, {line}: {said}");
    }
    for (dialect, line, what) in [
        ("fluidnc", "(a (b))", "a comment"),
        ("grblhal", "G2 X5 I1 J0 P2", "a word for which"),
        ("tinyg", "G2 X7.0009 I1 J0", "0.1 %"),
        ("mach3", "G2 X7.0015 I1 J0", "0.002 mm"),
        ("smoothieware", "O9", "does not begin"),
        (
            "marlin",
            "(a comment that is long, in a line of its own, where nothing is lost with what is behind its 96 characters)",
            "96th",
        ),
    ] {
        let said = of(dialect, line);
        assert!(!said.contains(what), "{line}: {said}");
    }
    let nobody = whole.replace("dialect grbl", "for somebody");
    let nobody = nobody.replacen("\nM5\n", "\nG90 G91 G0 Z5\nG90\nM5\n", 1);
    let (names, said) = found(&PAUSED.board, program(&nobody));
    assert!(names.contains(&"unclear") && said.contains("of its codes one alone can hold"), "{said}");
}

/// Bytes of a file that is no UTF-8 are what the controller gets; in UTF-8 an umlaut has a byte
/// that Grbl takes for its safety door.
#[test]
fn characters_are_the_bytes_that_they_are_in_their_file() {
    let text = format!("(Fr\u{e4}ser \u{c4})\n{}", text(&PAUSED, Part::Drill));
    let of = |is_bytes: bool| found(&PAUSED.board, Program { is_bytes, ..program(&text) }).0;
    assert_eq!(of(true), [""; 0], "E4 and C4");
    assert_eq!(of(false), ["word-not-taken"], "C3 84");
}

#[test]
fn code_behind_the_end_of_a_tape_is_told() {
    let whole = text(&PAUSED, Part::Drill).replace("dialect grbl", "dialect linuxcnc");
    let of = |behind: &str| found(&PAUSED.board, program(&format!("%\n{whole}%\n{behind}"))).0;
    assert_eq!(of("\n(the end)\n%\n"), [""; 0], "nothing");
    assert_eq!(of("%\nG0 X1\n%\n"), ["code-after-end"], "another tape");
    assert_eq!(of("o100 sub\nG0 X1\no100 endsub\n"), [""; 0], "a subprogram");
    assert_eq!(of("o100 sub\nG0 X1\no100 endsub\nG0 X2\n"), ["code-after-end"], "and more behind it");
    assert_eq!(of("O0002\nG0 X1\nM30\n"), ["code-after-end"], "a program with a number");
}

#[test]
fn a_program_that_cuts_is_no_probe_whatever_its_comments_say() {
    let probe = "(board probe)\nG21 G90 G94\nG0 Z2\nG0 X1 Y1\nG38.2 Z-1 F60\nG0 Z2\nM2\n";
    assert!(is_probe(probe), "it goes down to the surface");
    assert!(!is_probe(&format!("(zero z with the probe)\n{}", text(&PAUSED, Part::Drill))), "it drills");
}

/// A name, a tool and a file whose comments go on in a second line.
#[test]
fn comments_that_are_too_long_for_a_line_are_read_whole() {
    let long = "valve-amplifier-preamp-stage-board-with-regulated-heater-supply-revision-seven";
    let settings = format!(
        "tool-change = \"pause\"\ntool = \"{long}\"\n[tools.{long}]\nkind = \"vbit\"\ntip = \"0.1mm\"\nangle = \"30deg\"\n"
    );
    let made = job(&settings, long);
    for part in [Part::Front, Part::Drill, Part::Cutout] {
        let text = text(&made, part);
        let wide = text.lines().all(|line| line.len() < 80);
        assert!(wide && text.contains("(+"), "{part:?} has comments in two lines");
        let (names, said) = found(&made.board, program(text));
        assert_eq!(names, [""; 0], "{part:?}: {said}");
    }
}

#[test]
fn what_is_given_of_how_the_board_lies_replaces_that_alone() {
    let made = job("offset = \"3mm,4mm\"\nrotate = \"90deg\"", "");
    let front = program(text(&made, Part::Front));
    let lies = |given: &Laid| given.of(&front, &made.board);
    let told = lies(&Laid::default());
    assert_eq!(lies(&Laid { degrees: Some(90.0), ..Laid::default() }), told, "as it says");
    assert_eq!(lies(&Laid { mirror: Some(Nm::from_mm(5)), ..Laid::default() }), told, "it is not mirrored");
    let shift = Some(Vector::new(Nm::from_mm(1), Nm::ZERO));
    let moved = lies(&Laid { shift, ..Laid::default() });
    assert_eq!((Some(moved.shift), moved.degrees), (shift, 90.0), "moved, and still turned");
}

/// As a person gives it.
#[test]
fn the_axis_is_asked_of_the_back_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = |arguments: &[&str]| voromill(folder.path(), arguments);
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker").display().to_string();
    let made = here(&["mill", &board, "-o", "out", "--mirror-axis", "40mm"]);
    assert!(made.status.success(), "{}", stderr(&made));
    let judged = here(&["verify", "out", "--board", &board, "--mirror-axis", "40mm"]);
    assert!(judged.status.success(), "{}{}", stdout(&judged), stderr(&judged));
}
