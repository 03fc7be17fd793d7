//! Programs as others write them, and where they lie.

use std::path::{Path, PathBuf};

use voromill::board::{Board, Side};
use voromill::geometry::{Nm, Point, Vector};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Part};
use voromill::verify::{
    Change, Finding, Orientation, Placement, Program, Role, Settings, Severity, Tiles, diff, register, verify,
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
        asked: None,
    }
}

fn judge(board: &Board, program: Program) -> Vec<Finding> {
    let report = verify(&[program], board, &[], &Settings::default()).expect("it can be judged");
    report.findings.into_iter().filter(|finding| finding.severity >= Severity::Warning).collect()
}

#[test]
fn a_mirrored_program_with_modal_words_and_tool_changes_isolates() {
    let board = board(&["pads-F_Cu.gbr"]);
    let placed = |shift: Vector| {
        let placement = Placement { shift, mirror: Some(Nm::ZERO), ..Placement::default() };
        Program { placement: Some(placement), ..program("pcb2gcode.nc", "endmill:0.2mm", Side::Front) }
    };
    let right = Vector::new(Nm::from_mm(10), Nm::from_mm(20));
    assert_eq!(judge(&board, placed(right)), [], "laid as it is meant");
    let wrong = judge(&board, placed(right + Vector::new(Nm::from_um(300), Nm::ZERO)));
    assert!(wrong.iter().any(|finding| finding.name == "gouge"), "laid 0.3 mm off: {wrong:?}");
}

#[test]
fn where_a_mirrored_program_lies_is_found() {
    let board = board(&["pads-F_Cu.gbr"]);
    let mut program = program("pcb2gcode.nc", "endmill:0.2mm", Side::Front);
    let found = register(&program, &board, &Orientation::default(), &Settings::default()).expect("it fits");
    program.placement = Some(found);
    assert_eq!(judge(&board, program), [], "laid as was found: {found:?}");
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
        let off = off_when_found(options, &Settings::default());
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
        let off = off_when_found(options, &Settings { tiles, ..Settings::default() });
        assert!(off <= 3_000.0, "{rotate}: {off} nm off");
    }
}

/// How far from where it lies a board of ours is found, by its front program alone, in nanometres.
fn off_when_found(options: Options, judging: &Settings) -> f64 {
    let settings = job::Settings::resolve(options).expect("settings");
    let files = [fixture("seven-F_Cu.gbr"), fixture("seven-Edge_Cuts.gbr")];
    let loaded = import::load(&files, &Selection::default()).expect("a board");
    let job = job::mill(loaded, &settings).expect("a job");
    let written = job.programs.iter().find(|written| written.part == Part::Front).expect("a front");
    let program = Program {
        file: "front.ngc".to_owned(),
        text: written.text.clone(),
        role: Some(Role::Isolation(Side::Front)),
        ..Program::default()
    };
    let found = register(&program, &job.board, &Orientation::default(), judging).expect("it fits");
    let truth =
        Placement { degrees: job.placement.rotation.degrees(), shift: job.placement.shift, mirror: None };
    let machine = [Point::new(Nm::ZERO, Nm::ZERO), Point::new(Nm::from_mm(8), Nm::from_mm(6))];
    machine.into_iter().map(|place| found.undo(place).distance(truth.undo(place))).fold(0.0, f64::max)
}

#[test]
fn programs_that_cut_the_same_do_not_differ() {
    let loops = program("loops.nc", "endmill:0.2mm", Side::Front);
    let text =
        loops.text.replace("X3.1500 Y0.8500", "X2 Y0.85\nG01 X3.1510 Y0.8500").replace("G90", "G90 G94");
    let other = Program { text, ..loops.clone() };
    let same = diff(&loops, &other, Nm::from_um(5), &Settings::default()).expect("compared");
    assert!(same.is_same(), "a micrometre and another line: {:?}", same.regions);
}

#[test]
fn what_is_not_cut_any_more_is_found_with_place_and_area() {
    let loops = program("loops.nc", "endmill:0.2mm", Side::Front);
    // The right side of the second loop goes, and is lifted over.
    let text = loops.text.replace("G01 X6.1500 Y3.1500", "G00 Z2.0000\nG00 X6.1500 Y3.1500\nG01 Z-0.1000");
    let other = Program { text, ..loops.clone() };
    let found = diff(&loops, &other, Nm::from_um(5), &Settings::default()).expect("compared");
    assert_eq!(found.total(Change::Cut).0, 0, "nothing more is cut");
    assert_eq!(found.regions.len(), 1, "{:?}", found.regions);
    // 2.3 mm by 0.2 mm without the round ends of the sides that meet it.
    let expected = 2.3 * 0.2 - std::f64::consts::PI * 0.01;
    let region = found.regions[0];
    assert!((region.area - expected).abs() < 0.01, "{} mm² for {expected}", region.area);
    assert!(region.middle().distance(Point::new(Nm::from_um(6150), Nm::from_mm(2))) < 50_000.0, "{region:?}");
    let back = diff(&other, &loops, Nm::from_um(5), &Settings::default()).expect("compared");
    assert_eq!(back.total(Change::Left).0, 0, "the other way round it is cut");
    let nothing = Program { text: String::new(), ..loops.clone() };
    let all = diff(&nothing, &loops, Nm::from_um(5), &Settings::default()).expect("compared");
    assert_eq!(all.total(Change::Cut).0, 2, "two loops where there was nothing");
}

#[test]
fn a_loop_that_moved_is_cut_in_one_place_and_left_in_another() {
    let loops = program("loops.nc", "endmill:0.2mm", Side::Front);
    // A side of a loop moved by half the kerf: the strip left and the strip cut lie on either side
    // of what both cut.
    let text = loops.text.replace("X3.1500", "X3.2500");
    let moved = diff(&loops, &Program { text, ..loops.clone() }, Nm::from_um(5), &Settings::default());
    let moved = moved.expect("compared");
    // By more than the kerf: the two strips touch nothing but what both cut at their ends.
    let text = loops.text.replace("X3.1500", "X3.3500");
    let beside = diff(&loops, &Program { text, ..loops.clone() }, Nm::from_um(5), &Settings::default());
    let beside = beside.expect("compared");
    for (found, wide) in [(moved, 0.1), (beside, 0.2)] {
        let [(cut, cut_area), (left, left_area)] = [found.total(Change::Cut), found.total(Change::Left)];
        assert_eq!((cut, left), (1, 1), "{:?}", found.regions);
        assert!((cut_area - 2.5 * wide).abs() < 0.1, "{cut_area} mm² more");
        assert!((left_area - 2.3 * wide).abs() < 0.1, "{left_area} mm² less");
    }
}

/// A corner of two cuts, 10 mm each, on both sides of which strips are cut that are narrower than a
/// pixel of 25 µm, and than are tolerated or not.
#[test]
fn strips_narrower_than_a_pixel_are_one_difference() {
    let program = |kerf: f64| {
        let lines = "G0 X0.003 Y0.004\nG1 Z-0.1\nG1 X10.003\nG1 Y10.004\nG0 Z2\n";
        let head =
            format!("(front isolation)\n(tool endmill:{kerf:.4}mm)\nG21 G90 G17 F100\nM3 S1000\nG0 Z2\n");
        Program { file: "x.ngc".to_owned(), text: format!("{head}{lines}M5\nM2\n"), ..Program::default() }
    };
    let wide = 0.005;
    for strip in [0.0002, 0.001, 0.006, 0.012] {
        let (narrow, broad) = (program(0.2), program(0.2 + 2.0 * (wide + strip)));
        let more = diff(&narrow, &broad, Nm::from_um(5), &Settings::default()).expect("compared");
        let less = diff(&broad, &narrow, Nm::from_um(5), &Settings::default()).expect("compared");
        // Along the outside, with two round ends and a corner, and along the inside.
        let off = 0.1 + wide + strip / 2.0;
        let expected = strip * (20.0 + 2.5 * std::f64::consts::PI * off + 20.0 - 2.0 * off);
        for (found, change) in [(more, Change::Cut), (less, Change::Left)] {
            assert_eq!(found.regions.len(), 1, "a strip of {strip} mm hangs together: {:?}", found.regions);
            let (places, area) = found.total(change);
            assert!(
                places == 1 && (area / expected - 1.0).abs() < 0.005,
                "{area} mm² for {expected}, {strip} mm wide"
            );
        }
        let same = program(0.2 + 2.0 * (wide - strip / 4.0));
        let same = diff(&narrow, &same, Nm::from_um(5), &Settings::default()).expect("compared");
        assert!(same.is_same(), "a quarter of {strip} mm less than is tolerated: {:?}", same.regions);
    }
}

/// Strokes by chance, every third the other way round in the second program, some in one alone.
#[test]
fn differences_cover_what_exact_distances_say() {
    let coarse = Settings { pixel: Some(Nm::from_mm(1)), ..Settings::default() };
    let mut seed = 5_u64;
    let mut chance = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(seed >> 40).expect("24 bits")) / f64::from(1_u32 << 24)
    };
    let strokes: Vec<[f64; 4]> = (0..40).map(|_| [(); 4].map(|()| 12.0 * chance())).collect();
    // The last of each crosses many tiles and everything else.
    let before: Vec<[f64; 4]> = strokes[..32].iter().copied().chain([[0.0, 0.0, 12.0, 11.0]]).collect();
    let after: Vec<[f64; 4]> = strokes[8..].iter().copied().chain([[0.0, 11.5, 12.0, 0.5]]).collect();
    let text = |strokes: &[[f64; 4]], turned: usize| {
        let line = |(number, &[x, y, to_x, to_y]): (usize, &[f64; 4])| {
            let ends = [(x, y), (to_x, to_y)];
            let [from, to] = if number % 3 == turned { [ends[1], ends[0]] } else { ends };
            format!("G0 X{:.6} Y{:.6}\nG1 Z-0.1\nG1 X{:.6} Y{:.6}\nG0 Z2\n", from.0, from.1, to.0, to.1)
        };
        let lines: String = strokes.iter().enumerate().map(line).collect();
        format!("(front isolation)\n(tool endmill:0.2mm)\nG21 G90 G17 F100\nM3 S1000\nG0 Z2\n{lines}M5\nM2\n")
    };
    let program = |text: String| Program { file: "x.ngc".to_owned(), text, ..Program::default() };
    let (old, new) = (program(text(&before, 3)), program(text(&after, 1)));
    let found = diff(&old, &new, Nm::from_um(5), &Settings::default()).expect("compared");
    let away = |strokes: &[[f64; 4]], x: f64, y: f64| {
        let to = |&[ax, ay, bx, by]: &[f64; 4]| {
            let (ux, uy, wx, wy) = (bx - ax, by - ay, x - ax, y - ay);
            let t = ((wx * ux + wy * uy) / (ux * ux + uy * uy)).clamp(0.0, 1.0);
            ((wx - t * ux).powi(2) + (wy - t * uy).powi(2)).sqrt()
        };
        strokes.iter().map(to).fold(f64::INFINITY, f64::min)
    };
    let places = (0..480).flat_map(|i| (0..480).map(move |j| (f64::from(i) / 40.0, f64::from(j) / 40.0)));
    let (mut cut, mut left) = (0.0, 0.0);
    for (x, y) in places {
        let (old, new) = (away(&before, x, y), away(&after, x, y));
        cut += if new <= 0.1 && old > 0.105 { 6.25e-4 } else { 0.0 };
        left += if old <= 0.1 && new > 0.105 { 6.25e-4 } else { 0.0 };
    }
    let few = diff(&old, &new, Nm::from_um(5), &coarse).expect("compared");
    for (change, expected) in [(Change::Cut, cut), (Change::Left, left)] {
        let area = few.total(change).1;
        assert!((area / expected - 1.0).abs() < 0.02, "pixels of 1 mm: {area} for {expected}");
        let area = found.total(change).1;
        // Ends of strokes lie half a kerf beyond the square that is sampled.
        assert!(expected > 5.0 && (area - expected).abs() < 0.15 + expected * 0.01, "{area} for {expected}");
    }
    let turned = diff(&old, &program(text(&before, 2)), Nm::ZERO, &Settings::default()).expect("compared");
    assert!(turned.is_same(), "the way that a line is cut is no difference");
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
        let mut read = Program { file: program.to_owned(), text, role, cutter, placement: None, asked: None };
        let settings = Settings { board: Nm::from_um(thickness), ..Settings::default() };
        let fitted =
            register(&read, &board, &Orientation::default(), &settings).expect("it is laid somewhere");
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
