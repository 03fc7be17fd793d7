//! Programs as others write them, and where they lie.

use std::path::{Path, PathBuf};

use voromill::board::{Board, Side};
use voromill::geometry::{Nm, Point, Vector};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Part};
use voromill::verify::{
    Finding, Orientation, Placement, Program, Role, Settings, Severity, Tiles, register, verify,
};

use crate::corpus;

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/verify").join(name)
}

fn board(files: &[&str]) -> Board {
    let files: Vec<PathBuf> = files.iter().map(|name| fixture(name)).collect();
    import::load(&files, &Selection::default()).expect("a board").board
}

fn program(name: &str, tool: &str, side: Side) -> Program {
    Program {
        file: name.to_owned(),
        text: std::fs::read_to_string(fixture(name)).expect("a program"),
        role: Some(Role::Isolation(side)),
        cutter: Some(tool.parse().expect("a tool")),
        placement: None,
        ..Program::default()
    }
}

fn judge(board: &Board, program: Program) -> Vec<Finding> {
    let report = verify(&[program], board, &[], &Settings::default()).expect("it can be judged");
    report.findings.into_iter().filter(|finding| finding.severity >= Severity::Warning).collect()
}

/// Two pads on the back, which pcb2gcode mirrors.
fn back() -> Board {
    let selection = Selection { back: Some(fixture("pads-F_Cu.gbr")), ..Selection::default() };
    import::load(&[], &selection).expect("a board").board
}

#[test]
fn a_mirrored_program_with_modal_words_and_tool_changes_isolates() {
    let board = back();
    let placed = |shift: Vector| {
        let placement = Placement { shift, mirror: Some(Nm::ZERO), ..Placement::default() };
        Program { placement: Some(placement), ..program("pcb2gcode.nc", "endmill:0.2mm", Side::Back) }
    };
    let right = Vector::new(Nm::from_mm(10), Nm::from_mm(20));
    assert_eq!(judge(&board, placed(right)), [], "laid as it is meant");
    let wrong = judge(&board, placed(right + Vector::new(Nm::from_um(300), Nm::ZERO)));
    assert!(wrong.iter().any(|finding| finding.name == "gouge"), "laid 0.3 mm off: {wrong:?}");
}

#[test]
fn where_a_mirrored_program_lies_is_found() {
    let board = back();
    let mut program = program("pcb2gcode.nc", "endmill:0.2mm", Side::Back);
    let found =
        register(&program, &board, &Orientation::default(), &[], &Settings::default()).expect("it fits");
    program.placement = Some(found);
    assert_eq!(judge(&board, program), [], "laid as was found: {found:?}");
}

/// The layers of a board are all drawn as they are seen from the front.
#[test]
fn a_side_that_becomes_its_own_mirror_image_is_told() {
    let shift = Vector::new(Nm::from_mm(10), Nm::from_mm(20));
    for (board, side, text, spoilt) in [
        (back(), Side::Back, "pcb2gcode.nc", false),
        (back(), Side::Back, "loops.nc", true),
        (board(&["pads-F_Cu.gbr"]), Side::Front, "pcb2gcode.nc", true),
        (board(&["pads-F_Cu.gbr"]), Side::Front, "loops.nc", false),
    ] {
        let placement = match text {
            "loops.nc" => Placement::default(),
            _ => Placement { shift, mirror: Some(Nm::ZERO), ..Placement::default() },
        };
        let program = Program { placement: Some(placement), ..program(text, "endmill:0.2mm", side) };
        let found = judge(&board, program);
        let names: Vec<_> = found.iter().map(|finding| (finding.name, finding.severity)).collect();
        let expected = if spoilt { vec![("mirror-image", Severity::Error)] } else { Vec::new() };
        assert_eq!(names, expected, "{text} for the {side}: {found:?}");
    }
}

#[test]
fn a_board_that_was_turned_and_moved_is_found_within_3_um() {
    for (rotate, tool) in
        [("0deg", "vbit:0.1mm:30deg"), ("90deg", "endmill:0.2mm"), ("180deg", "endmill:0.14mm")]
    {
        let options = Options {
            rotate: Some(rotate.parse().expect("an angle")),
            tool: vec![tool.parse().expect("a tool")],
            ..Options::default()
        };
        let off = off_when_found(&seven(), Side::Front, options, &Settings::default());
        assert!(off <= 3_000.0, "{rotate} {tool}: {off} nm off");
    }
}

#[test]
fn where_the_first_of_several_tiles_lies_is_found() {
    let spacing: Nm = "3mm".parse().expect("a length");
    for rotate in ["0deg", "90deg"] {
        let options = Options {
            rotate: Some(rotate.parse().expect("an angle")),
            tool: vec!["endmill:0.2mm".parse().expect("a tool")],
            tile: Some("3x2".parse().expect("tiles")),
            tile_spacing: Some(job::Length(spacing)),
            ..Options::default()
        };
        let tiles = Some(Tiles { columns: 3, rows: 2, spacing });
        let off = off_when_found(&seven(), Side::Front, options, &Settings { tiles, ..Settings::default() });
        assert!(off <= 3_000.0, "{rotate}: {off} nm off");
    }
}

/// Where gaps are wide, no cut is near copper wherever the program lies.
#[test]
fn cuts_midway_between_nets_far_apart_are_found_within_3_um() {
    let Some(root) = corpus::boards() else { return };
    let board = [root.join("visolate_numpres")];
    let off = off_when_found(&board, Side::Back, Options::default(), &Settings::default());
    assert!(off <= 3_000.0, "{off} nm off");
}

/// How far from where it lies a board is found, by its program of one side alone without what it
/// says of itself, in nanometres.
fn off_when_found(files: &[PathBuf], side: Side, options: Options, judging: &Settings) -> f64 {
    let settings = job::Settings::resolve(options).expect("settings");
    let loaded = import::load(files, &Selection::default()).expect("a board");
    let job = job::mill(loaded, &settings).expect("a job");
    let part = if side == Side::Front { Part::Front } else { Part::Back };
    let written = job.programs.iter().find(|written| written.part == part).expect("its program");
    let is_code = |line: &&str| !line.starts_with('(');
    let code: Vec<&str> = written.text.lines().filter(is_code).collect();
    let program = Program {
        file: "program.ngc".to_owned(),
        text: code.join("\n"),
        role: Some(Role::Isolation(side)),
        cutter: Some(settings.isolation[0].tool.kind.to_string().parse().expect("a tool")),
        ..Program::default()
    };
    let mirror = (side == Side::Back).then_some(Nm::ZERO);
    let known = Orientation { degrees: Some(job.placement.rotation.degrees()), mirror };
    let found = register(&program, &job.board, &known, &[], judging).expect("it fits");
    let mirror = (side == Side::Back).then_some(job.axis);
    let truth = Placement { degrees: job.placement.rotation.degrees(), shift: job.placement.shift, mirror };
    let machine = [Point::new(Nm::ZERO, Nm::ZERO), Point::new(Nm::from_mm(8), Nm::from_mm(6))];
    machine.into_iter().map(|place| found.undo(place).distance(truth.undo(place))).fold(0.0, f64::max)
}

fn seven() -> [PathBuf; 2] {
    [fixture("seven-F_Cu.gbr"), fixture("seven-Edge_Cuts.gbr")]
}

/// Other people's cutouts, beside boards they were not made for.
#[test]
fn a_cutout_of_another_board_does_not_fit_wherever_it_is_laid() {
    let Some(root) = corpus::artwork() else { return };
    for (program, board, tool, thickness) in [
        (
            "gcode/flatcam_8991_test_copper/CUTOUT-2mm.nc",
            "gcode/flatcam_8991_test_copper/gerbers",
            "2mm",
            1600,
        ),
        ("gcode/flatcam_2014_blinds/cutout.ngc", "kicad/v4_blinds_mainboard/gerbers", "3.175mm", 1500),
    ] {
        let Ok(text) = std::fs::read_to_string(root.join(program)) else {
            println!("no {program} at VOROMILL_ARTWORK: nothing is judged");
            continue;
        };
        let board = import::load(&[root.join(board)], &Selection::default()).expect("a board").board;
        let cutter = Some(format!("endmill:{tool}").parse().expect("a tool"));
        let role = Some(Role::Cutout);
        let mut read =
            Program { file: program.to_owned(), text, role, cutter, placement: None, ..Program::default() };
        let settings = Settings { board: Nm::from_um(thickness), ..Settings::default() };
        let fitted =
            register(&read, &board, &Orientation::default(), &[], &settings).expect("it is laid somewhere");
        for placement in [None, Some(fitted)] {
            read.placement = placement;
            let found = verify(&[read.clone()], &board, &[], &settings).expect("it can be judged").findings;
            let wrong = found.iter().filter(|finding| finding.severity == Severity::Error);
            let names: Vec<&str> = wrong.map(|finding| finding.name).collect();
            assert!(
                names.contains(&"board-gouged") || names.contains(&"board-left"),
                "{program} laid {placement:?}: {found:?}"
            );
        }
    }
}
