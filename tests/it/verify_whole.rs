//! Cutouts and holes, spoilt in one place: what is wrong is found under its name, and nothing where
//! nothing is wrong.

use std::path::Path;
use std::sync::LazyLock;

use voromill::board::{Board, Hole, Outline, Plating, Side};
use voromill::geometry::{Nm, Path as Way, Point, Segment, Turn, Vector};
use voromill::import::{self, Loaded, Selection};
use voromill::job::{self, Job, Options, Part};
use voromill::verify::{
    Finding, Orientation, Placement, Program, Role, Settings, Severity, register, verify,
};

static BLINKER: LazyLock<Job> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let loaded = import::load(&[folder], &Selection::default()).expect("a board");
    // All drills in one program.
    let options = Options::from_toml("settings", "dialect = \"linuxcnc\"").expect("options");
    job::mill(loaded, &job::Settings::resolve(options).expect("settings")).expect("a job")
});

fn text(part: Part) -> &'static str {
    &BLINKER.programs.iter().find(|written| written.part == part).expect("a program").text
}

fn judge(board: &Board, role: Option<Role>, text: &str) -> Vec<Finding> {
    let program =
        Program { file: "spoilt.ngc".to_owned(), text: text.to_owned(), role, ..Program::default() };
    let settings = Settings { tabs: Some(4), tab_width: Some(Nm::from_mm(2)), ..Settings::default() };
    verify(&[program], board, &[], &settings).expect("it can be judged").findings
}

/// What is found, as bad as `severity` or worse, each name once.
fn names(findings: &[Finding], severity: Severity) -> Vec<&'static str> {
    let mut names: Vec<_> =
        findings.iter().filter(|finding| finding.severity >= severity).map(|finding| finding.name).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// Every x of the motions, changed.
fn each_x(text: &str, change: impl Fn(f64) -> f64) -> String {
    let word = |word: &str| match word.strip_prefix('X').and_then(|x| x.parse::<f64>().ok()) {
        Some(x) => format!("X{:.4}", change(x)),
        None => word.to_owned(),
    };
    let line = |line: &str| {
        if line.starts_with('(') {
            line.to_owned()
        } else {
            line.split(' ').map(word).collect::<Vec<_>>().join(" ")
        }
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Depths beyond `from` become `to`.
fn depth(text: &str, from: f64, to: &str) -> String {
    let word = |word: &str| match word.strip_prefix("Z-").and_then(|z| z.parse::<f64>().ok()) {
        Some(z) if z > from => format!("Z-{to}"),
        _ => word.to_owned(),
    };
    text.lines()
        .map(|line| {
            if line.starts_with('(') {
                line.to_owned()
            } else {
                line.split(' ').map(word).collect::<Vec<_>>().join(" ")
            }
        })
        .collect::<Vec<_>>()
        .join("\n")
}

#[test]
fn a_spoilt_cutout_is_found_out() {
    let whole = text(Part::Cutout);
    let find = |text: &str| judge(&BLINKER.board, Some(Role::Cutout), text);
    assert_eq!(find(whole), [], "nothing is wrong with it");
    let lines: Vec<&str> = whole.lines().collect();
    let two_thirds = [&lines[..lines.len() * 2 / 3], &["M5", "M2"]].concat().join("\n");
    let wide = whole.replace("endmill:1mm", "endmill:2mm");
    let thin = whole.replace("endmill:1mm", "endmill:0.6mm");
    for (what, text, expected) in [
        ("moved by 0.5 mm", each_x(whole, |x| x + 0.5), &["board-gouged", "board-left"][..]),
        ("for a thinner cutter than is in the spindle", wide, &["board-gouged"]),
        ("for a thicker one", thin, &["board-left"]),
        ("1.4 mm deep", depth(whole, 1.4, "1.4"), &["not-through"]),
        ("1.59 mm deep", depth(whole, 1.59, "1.59"), &["not-through"]),
        ("the last third left out", two_thirds, &["not-through"]),
        (
            "nothing cut",
            lines
                .iter()
                .filter(|line| !["G1", "G2", "G3"].contains(&line.split(' ').next().unwrap_or_default()))
                .copied()
                .collect::<Vec<_>>()
                .join("\n"),
            &["board-left"],
        ),
        ("all tabs cut through", whole.replace("Z-1\n", "Z-1.7\n"), &["tab-missing"]),
    ] {
        let findings = find(&text);
        for name in expected {
            assert!(names(&findings, Severity::Error).contains(name), "{what}: {findings:?}");
        }
    }
    let one_tab = find(&whole.replacen("Z-1\n", "Z-1.7\n", 1));
    assert!(names(&one_tab, Severity::Warning).contains(&"tab-missing"), "a tab of four: {one_tab:?}");
    let weak = find(&whole.replace("Z-1\n", "Z-1.45\n"));
    assert_eq!(names(&weak, Severity::Warning), ["tab-thin"], "tabs of 0.15 mm: {weak:?}");
}

/// A program without comments that cuts from one place of the board to another.
fn cut(from: Point, to: Point) -> Program {
    let [x, y, other_x, other_y] = [from.x, from.y, to.x, to.y].map(|coordinate| format!("{coordinate:.3}"));
    let text = format!(
        "G21 G90 G94\nM3 S10000\nG0 Z2\nG0 X{x} Y{y}\nG1 Z-1.8 F60\nG1 X{other_x} Y{other_y}\nG0 Z2\nM5\nM2\n"
    );
    let cutter = Some("endmill:1mm".parse().expect("a tool"));
    Program { file: "cut.nc".to_owned(), text, role: Some(Role::Cutout), cutter, ..Program::default() }
}

#[test]
fn what_is_cut_beside_a_slot_is_not_cut_in_it() {
    let mut board = BLINKER.board.clone();
    let around = board.bounds().expect("a board").inflate(Nm::from_mm(-4));
    let [start, _, to, corner] = around.corners();
    let path = Way { start, segments: vec![Segment::Line { to }] };
    board.holes.push(Hole { path, diameter: Nm::from_um(1_100), ..board.holes[0].clone() });
    let gouged = |program: Program| {
        let found = verify(&[program], &board, &[], &Settings::default()).expect("it can be judged").findings;
        names(&found, Severity::Error).contains(&"board-gouged")
    };
    assert!(!gouged(cut(start, to)), "the slot itself");
    let way = Vector::new(Nm::from_mm(2), Nm::ZERO);
    assert!(gouged(cut(corner, corner + way)), "in a corner of the rectangle round it");
}

#[test]
fn what_is_cut_out_of_a_board_without_an_outline_is_not_judged() {
    let board = Board { outline: None, ..BLINKER.board.clone() };
    let program = cut(Point::default(), Point::new(Nm::from_mm(5), Nm::ZERO));
    let error = verify(&[program], &board, &[], &Settings::default()).expect_err("no outline");
    assert_eq!(error.to_string(), "cut.nc: the board has no outline: what cuts it out cannot be judged");
}

/// Into what the board lies on, and into the table: slipped decimal points, drills that were not
/// set to zero.
#[test]
fn what_goes_far_below_the_board_is_told() {
    for (part, role) in [(Part::Drill, Role::Drilling), (Part::Cutout, Role::Cutout)] {
        // Drills go 2.76 mm deep with a point of 0.96 mm.
        for (to, warned, failed) in [("3.5", false, false), ("5", true, false), ("17", true, true)] {
            let found = judge(&BLINKER.board, Some(role), &depth(text(part), 1.6, to));
            let told = |severity| names(&found, severity).contains(&"too-deep");
            let expected = (warned, failed);
            assert_eq!(
                (told(Severity::Warning), told(Severity::Error)),
                expected,
                "{role}, {to} mm: {found:?}"
            );
        }
    }
}

/// Zero is set once for all programs.
#[test]
fn a_program_whose_zero_is_elsewhere_is_told() {
    let judge = |texts: &[&str]| {
        let program = |(text, i): (&&str, u32)| Program {
            file: format!("{i}.ngc"),
            text: (*text).to_owned(),
            ..Program::default()
        };
        let programs: Vec<Program> = texts.iter().zip(1..).map(program).collect();
        let found =
            verify(&programs, &BLINKER.board, &[], &Settings::default()).expect("it can be judged").findings;
        let told = found.into_iter().filter(|finding| finding.name == "zero-differs");
        told.map(|finding| (finding.program.unwrap_or_default(), finding.message)).collect::<Vec<_>>()
    };
    let again = |line: &str| {
        let options =
            Options::from_toml("settings", &format!("dialect = \"linuxcnc\"\n{line}")).expect("options");
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
        let loaded = import::load(&[folder], &Selection::default()).expect("a board");
        let job = job::mill(loaded, &job::Settings::resolve(options).expect("settings")).expect("a job");
        let of = |part: Part| job.programs.iter().find(|written| written.part == part).expect("a program");
        [Part::Back, Part::Drill, Part::Cutout].map(|part| of(part).text.clone())
    };
    let [back, drill, cutout] = [Part::Back, Part::Drill, Part::Cutout].map(text);
    assert_eq!(judge(&[back, drill, cutout]), [], "as they were made");
    // The board is 40.64 by 30.48 mm.
    let [_, _, centred] = again("origin = \"center\"");
    let said = |program: &str, message: &str| vec![(program.to_owned(), message.to_owned())];
    let expected = said("3.ngc", "zero lies 20.320, 15.240 mm away from that of 1.ngc");
    assert_eq!(judge(&[back, drill, &centred]), expected, "one of three");
    let expected = said("1.ngc", "zero lies -20.320, -15.240 mm away from that of 2.ngc");
    let [_, other, _] = again("origin = \"center\"");
    assert_eq!(judge(&[back, &other, &centred]), expected, "what most say counts");
    let [_, turned, _] = again("rotate = \"90deg\"");
    assert!(judge(&[back, &turned, cutout])[0].1.starts_with("the board is turned by 90.000°"), "turned");
    let [flipped, _, _] = again("mirror-axis = \"25mm\"");
    assert_eq!(judge(&[&flipped, drill, cutout]), [], "there is but one that is flipped");
    let expected = said("2.ngc", "the board is flipped about a line 4.680 mm to the right of that of 1.ngc");
    assert_eq!(judge(&[back, &flipped]), expected, "there are two");
}

/// Programs of other CAM say nothing: their places are found.
#[test]
fn a_program_whose_zero_was_found_elsewhere_is_told() {
    let bare = |text: &str| {
        let code = text.lines().filter(|line| !line.starts_with('('));
        code.map(|line| line.to_owned() + "\n").collect::<String>()
    };
    let settings = Settings::default();
    let [back, drill, cutout] = [Part::Back, Part::Drill, Part::Cutout].map(text).map(bare);
    let judge = |drill: &str, cutout: &str| {
        let found = |(file, text, role, tool): (&str, &str, Role, &str)| {
            let cutter = Some(tool.parse().expect("a tool"));
            let mut program = Program {
                file: file.to_owned(),
                text: text.to_owned(),
                role: Some(role),
                cutter,
                ..Program::default()
            };
            let at =
                register(&program, &BLINKER.board, &Orientation::default(), &[], &settings).expect("it fits");
            program.placement = Some(at);
            program
        };
        let programs = [
            ("back.nc", &*back, Role::Isolation(Side::Back), "vbit:0.1mm:30deg"),
            ("drill.nc", drill, Role::Drilling, "drill:0.8mm"),
            ("cutout.nc", cutout, Role::Cutout, "endmill:1mm"),
        ]
        .map(found);
        let report = verify(&programs, &BLINKER.board, &[], &settings).expect("it can be judged");
        let told = report.findings.into_iter().filter(|finding| finding.name == "zero-differs");
        told.map(|finding| finding.program.unwrap_or_default()).collect::<Vec<_>>()
    };
    assert_eq!(judge(&drill, &cutout), [""; 0], "as they were made");
    assert_eq!(judge(&each_x(&drill, |x| x + 2.5), &cutout).len(), 1, "one of two that are not mirrored");
    assert_eq!(judge(&drill, &each_x(&cutout, |x| x - 1.0)).len(), 1, "one of two that are not mirrored");
}

/// One hole fits on each of the board: where comments say nothing, it lies as other programs do.
#[test]
fn a_program_that_fits_in_several_places_lies_where_it_is_likely_to() {
    let (board, known, settings) = (&BLINKER.board, Orientation::default(), Settings::default());
    let corner = board.bounds().expect("a size").min();
    let offset = Vector::new(Nm::from_mm(5), Nm::from_mm(3));
    let as_milled = Placement { shift: Point::default() - corner + offset, ..Placement::default() };
    let hole = as_milled.apply(board.holes[board.holes.len() / 2].path.start);
    let drilled = |comment: &str| {
        let (x, y) = (hole.x.to_mm(), hole.y.to_mm());
        format!("{comment}G21 G90\nM3 S1000\nG0 Z2\nG0 X{x:.4} Y{y:.4}\nG1 Z-2 F60\nG0 Z2\nM2\n")
    };
    let lies = |text: String, likely: &[Placement]| {
        let (role, cutter) = (Some(Role::Drilling), Some("drill:1mm".parse().expect("a tool")));
        let program = Program { file: "hole.nc".to_owned(), text, role, cutter, ..Program::default() };
        register(&program, board, &known, likely, &settings).expect("it fits").shift
    };
    assert_ne!(lies(drilled(""), &[]), as_milled.shift, "on any hole");
    assert_eq!(lies(drilled(""), &[as_milled]), as_milled.shift, "as another program");
    assert_eq!(lies(drilled("(origin lower-left)\n(offset 5mm,3mm)\n"), &[]), as_milled.shift, "as it says");
    let off = Placement { shift: as_milled.shift + Vector::new(Nm::from_um(300), Nm::ZERO), ..as_milled };
    assert_ne!(lies(drilled(""), &[off]), off.shift, "where it does not fit it is not likely");
}

#[test]
fn a_tab_of_an_inner_cut_out_that_is_cut_through_is_told() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator");
    let loaded = import::load(&[folder], &Selection::default()).expect("a board");
    let options = Options::from_toml("settings", "dialect = \"linuxcnc\"").expect("options");
    let job = job::mill(loaded, &job::Settings::resolve(options).expect("settings")).expect("a job");
    let whole = &job.programs.iter().find(|written| written.part == Part::Cutout).expect("a program").text;
    let find = |text: &str| judge(&job.board, Some(Role::Cutout), text);
    assert_eq!(find(whole), [], "nothing is wrong with it");
    // The inner cut-out comes first: two tabs in two passes, the last of which goes through.
    let climbs: Vec<usize> = whole.match_indices("Z-1\n").map(|(at, _)| at).collect();
    assert_eq!(climbs.len(), 12, "two tabs in the cut-out, four outside, in two passes each");
    for climb in [2, 3] {
        let mut spoilt = whole.clone();
        spoilt.replace_range(climbs[climb]..climbs[climb] + 3, "Z-1.7");
        let found = find(&spoilt);
        assert_eq!(
            names(&found, Severity::Warning),
            ["tab-missing"],
            "tab {climb} of the cut-out: {found:?}"
        );
        assert!(found[0].at.is_some_and(|at| at.y > Nm::from_mm(-70)), "in the cut-out: {:?}", found[0].at);
    }
}

/// On three of its four sides such a cut-out has straight places for tabs.
#[test]
fn a_cut_out_that_is_held_where_it_is_straight_lacks_no_tab() {
    let at = |x: i64, y: i64| Point::new(Nm::from_mm(x), Nm::from_mm(y));
    let line = |to| Segment::Line { to };
    let segments = vec![
        line(at(8, 4)),
        line(at(20, 4)),
        line(at(20, 12)),
        Segment::Arc { to: at(16, 16), center: at(20, 16), turn: Turn::Clockwise },
        Segment::Arc { to: at(8, 16), center: at(12, 12), turn: Turn::CounterClockwise },
    ];
    let mut plate = board(hole((3_000, 3_000), None, 1000));
    let edge = plate.outline.iter().flat_map(Outline::contours).cloned();
    plate.outline = Outline::new(edge.chain([Way { start: at(8, 16), segments }]).collect());
    let loaded = Loaded { board: plate.clone(), sources: vec![], warnings: vec![], ignored: vec![] };
    let options = Options::from_toml("settings", "dialect = \"linuxcnc\"").expect("options");
    let job = job::mill(loaded, &job::Settings::resolve(options).expect("settings")).expect("a job");
    let cutout = job.programs.iter().find(|written| written.part == Part::Cutout).expect("a program");
    let findings = judge(&plate, Some(Role::Cutout), &cutout.text);
    assert_eq!(findings, [], "the three tabs it has room for are all there");
}

#[test]
fn a_cutout_a_little_off_is_no_error() {
    let whole = text(Part::Cutout);
    let find = |text: &str| judge(&BLINKER.board, Some(Role::Cutout), text);
    for (what, text) in [
        ("moved by 10 µm", each_x(whole, |x| x + 0.01)),
        ("deeper", depth(whole, 1.69, "2")),
        ("less deep, but through", depth(whole, 1.69, "1.61")),
    ] {
        assert_eq!(find(&text), [], "{what}");
    }
    let moved = find(&each_x(whole, |x| x + 0.05));
    assert_eq!(names(&moved, Severity::Error), [""; 0], "50 µm: {moved:?}");
    assert_eq!(names(&moved, Severity::Warning), ["board-gouged", "board-left"], "50 µm: {moved:?}");
    let size = moved.iter().filter_map(|finding| finding.size).max().expect("how much");
    assert!((size - Nm::from_um(50)).abs() < Nm::from_um(10), "as far as it was moved: {size}");
}

#[test]
fn spoilt_holes_are_found_out() {
    let whole = text(Part::Drill);
    let find = |text: &str| judge(&BLINKER.board, Some(Role::Drilling), text);
    assert_eq!(find(whole), [], "nothing is wrong with it");
    let lines: Vec<&str> = whole.lines().collect();
    let first = lines.iter().position(|line| line.starts_with("G0 X")).expect("a hole");
    let without = |lines: &[&str]| lines.join("\n");
    let left_out: Vec<&str> = [&lines[..first], &lines[first + 4..]].concat();
    let moved = lines[first].split(' ').map(|word| match word.strip_prefix('X') {
        Some(x) => format!("X{:.4}", x.parse::<f64>().expect("a number") + 0.3),
        None => word.to_owned(),
    });
    let moved = moved.collect::<Vec<_>>().join(" ");
    let mut one_moved = lines.clone();
    one_moved[first] = &moved;
    let extra = [&lines[..first], &["G0 X5 Y5", "G1 Z-2.2 F60", "G0 Z2"], &lines[first..]].concat();
    for (what, text, expected) in [
        ("0.5 mm deep", depth(whole, 0.5, "0.5"), "hole-depth"),
        ("only the points go through", depth(whole, 1.61, "1.61"), "hole-depth"),
        ("another drill", whole.replace("drill:0.8mm", "drill:1.1mm"), "hole-size"),
        ("moved by 0.2 mm", each_x(whole, |x| x + 0.2), "hole-place"),
        ("a hole left out", without(&left_out), "hole-missing"),
        ("a hole moved", without(&one_moved), "hole-place"),
        ("a hole too many", without(&extra), "hole-extra"),
        ("half as large", each_x(whole, |x| x / 2.0), "hole-missing"),
    ] {
        let findings = find(&text);
        assert!(names(&findings, Severity::Error).contains(&expected), "{what}: {findings:?}");
    }
    assert_eq!(find(&each_x(whole, |x| x + 0.01)), [], "10 µm are nothing");
    let slight = find(&each_x(whole, |x| x + 0.04));
    assert_eq!(names(&slight, Severity::Warning), ["hole-place"], "40 µm are told: {slight:?}");
    assert_eq!(names(&slight, Severity::Error), [""; 0], "and no error: {slight:?}");
}

fn hole(from: (i64, i64), to: Option<(i64, i64)>, diameter: i64) -> Hole {
    let at = |(x, y): (i64, i64)| Point::new(Nm::from_um(x), Nm::from_um(y));
    let segments = to.into_iter().map(|to| Segment::Line { to: at(to) }).collect();
    let path = Way { start: at(from), segments };
    Hole { path, diameter: Nm::from_um(diameter), plating: Plating::NonPlated, tool: 1, line: 1 }
}

/// 30 mm by 20 mm with one hole.
fn board(hole: Hole) -> Board {
    let corner = |x: i64, y: i64| Point::new(Nm::from_mm(x), Nm::from_mm(y));
    let ring = [corner(0, 0), corner(30, 0), corner(30, 20), corner(0, 20), corner(0, 0)];
    let outline = Outline::new(Way::polyline(ring).into_iter().collect());
    Board {
        name: "plate".to_owned(),
        front: None,
        back: None,
        outline,
        holes: vec![hole],
        ..Board::default()
    }
}

#[test]
fn milled_holes_and_slots_have_their_size() {
    let bored = board(hole((10_000, 10_000), None, 3000));
    let slot = board(hole((10_000, 10_000), Some((13_000, 10_000)), 1000));
    let circle = |x: &str, i: &str| {
        format!(
            "(tool 1: endmill:1mm)\nG21 G90\nM3 S9000\nG0 X{x} Y10 Z2\nG1 Z-1.8 F60\nG3 X{x} Y10 I-{i} J0 F90\nG0 Z2\n"
        )
    };
    let way = |to: &str, z: &str| {
        format!("(tool 1: endmill:1mm)\nG21 G90\nM3 S9000\nG0 X10 Y10 Z2\nG1 Z-{z} F60\nX{to} F90\nG0 Z2\n")
    };
    // Down along the slot, and back on the floor.
    let ramp = |back: &str| {
        format!(
            "(tool 1: endmill:1mm)\nG21 G90\nM3 S9000\nG0 X10 Y10 Z2\nG1 Z0 F60\nX13 Z-1.8 F90\n{back}G0 Z2\n"
        )
    };
    let half = circle("11", "1").replace("G3 X11 Y10", "G3 X9 Y10");
    for (board, text, expected) in [
        (&bored, circle("11", "1"), &[][..]),
        (&bored, circle("10.9", "0.9"), &["hole-size"]),
        (&bored, circle("11.1", "1.1"), &["hole-size"]),
        (&bored, circle("11.1", "1"), &["hole-place"]),
        (&bored, half, &["hole-place", "hole-size"]),
        (&bored, circle("11", "1").replace("Z-1.8", "Z-1.2"), &["hole-depth"]),
        (&slot, way("13", "1.8"), &[]),
        (&slot, way("12.8", "1.8"), &["hole-size"]),
        (&slot, way("13.2", "1.8"), &["hole-size"]),
        (&slot, way("13", "1.3"), &["hole-depth"]),
        (&slot, ramp("X10\n"), &[]),
        (&slot, ramp(""), &["hole-depth"]),
    ] {
        let findings = judge(board, Some(Role::Drilling), &text);
        assert_eq!(names(&findings, Severity::Error), expected, "{text}: {findings:?}");
    }
}

/// EAGLE and others draw mounting holes as contours of the edge, and drill them.
#[test]
fn a_cut_out_that_is_drilled_is_not_milled_again() {
    let at = |(x, y): (i64, i64)| Point::new(Nm::from_um(x), Nm::from_um(y));
    let circle = |(x, y): (i64, i64), radius: i64| {
        let start = at((x + radius, y));
        let round = Segment::Arc { to: start, center: at((x, y)), turn: Turn::CounterClockwise };
        Way { start, segments: vec![round] }
    };
    let slot = {
        let half = |to, center| Segment::Arc { to: at(to), center: at(center), turn: Turn::CounterClockwise };
        let (across, left) = (Segment::Line { to: at((10_000, 14_400)) }, (5_000, 15_600));
        let back = Segment::Line { to: at(left) };
        let (right, left) =
            (half((10_000, 15_600), (10_000, 15_000)), half((5_000, 14_400), (5_000, 15_000)));
        Way { start: at((5_000, 14_400)), segments: vec![across, right, back, left] }
    };
    let mut plate = board(hole((5_000, 5_010), None, 3000));
    plate.holes.extend([
        hole((10_000, 5_000), None, 800),
        hole((5_000, 15_000), Some((10_000, 15_000)), 1200),
        hole((16_000, 10_000), None, 1000),
        hole((24_000, 5_000), None, 2800),
    ]);
    let drilled = [circle((5_000, 5_000), 1_505), circle((10_000, 5_000), 400), slot];
    // A hole in the middle of one, and a hole that is narrower.
    let milled = [circle((16_000, 10_000), 2_000), circle((24_000, 5_000), 1_500)];
    let edge = plate.outline.iter().flat_map(Outline::contours).cloned();
    plate.outline = Outline::new(edge.chain(drilled).chain(milled).collect());
    let made = |plate: &Board, options: &str| {
        let options =
            Options::from_toml("settings", &format!("dialect = \"linuxcnc\"\n{options}")).expect("options");
        let loaded = Loaded { board: plate.clone(), sources: vec![], warnings: vec![], ignored: vec![] };
        job::mill(loaded, &job::Settings::resolve(options).expect("settings")).expect("a job")
    };
    let program = |job: &Job, part: Part| {
        job.programs.iter().find(|written| written.part == part).expect("a program").text.clone()
    };
    let is_narrow =
        |job: &Job| job.warnings.iter().any(|warning| warning.code() == "cut-out-narrower-than-tool");
    let job = made(&plate, "");
    let [drill, cutout] = [Part::Drill, Part::Cutout].map(|part| program(&job, part));
    assert!(
        cutout.contains("cut out along 3 contours"),
        "the plate, and what the drill does not make: {cutout}"
    );
    assert!(!is_narrow(&job), "the drill makes what is too narrow");
    let judged = |drill: &str| {
        let [drill, cutout] = [(drill, Role::Drilling), (&cutout, Role::Cutout)].map(|(text, role)| {
            Program { file: role.to_string(), text: text.to_owned(), role: Some(role), ..Program::default() }
        });
        let settings = Settings { tabs: Some(4), tab_width: Some(Nm::from_mm(2)), ..Settings::default() };
        verify(&[drill, cutout], &plate, &[], &settings).expect("it can be judged").findings
    };
    assert_eq!(judged(&drill), [], "nothing is wrong with them");
    let lines: Vec<&str> = drill.lines().collect();
    let first = lines.iter().position(|line| line.starts_with("G0 X")).expect("a hole");
    let left_out = judged(&[&lines[..first], &lines[first + 4..]].concat().join("\n"));
    assert_eq!(names(&left_out, Severity::Warning), ["board-left", "hole-missing"], "{left_out:?}");
    // Holes that are only marked are no cut-outs.
    let job = made(&plate, "one-drill = true");
    assert!(program(&job, Part::Cutout).contains("cut out along 4 contours"), "the first, too");
    assert!(is_narrow(&job), "the second does not fit");
    // A board within a board: the slot between them is routed, and both edges are milled.
    let mut ring = board(Hole { path: circle((15_000, 10_000), 2_300), ..hole((0, 0), None, 1400) });
    let edge = ring.outline.iter().flat_map(Outline::contours).cloned();
    let parted = [3_000, 1_600].map(|radius| circle((15_000, 10_000), radius));
    ring.outline = Outline::new(edge.chain(parted).collect());
    let cutout = program(&made(&ring, ""), Part::Cutout);
    assert!(cutout.contains("cut out along 3 contours"), "{cutout}");
}

#[test]
fn a_hole_that_is_drilled_too_thin_beside_a_slot_is_in_its_place() {
    let mut board = board(hole((10_000, 10_000), None, 1500));
    board.holes.push(hole((8_600, 8_600), Some((5_000, 8_600)), 1600));
    // Rounding takes it away from the slot, so where most is left of it the slot takes some.
    let text = "(tool 1: drill:0.5mm)\nG21 G90\nM3 S9000\nG0 X10.0001 Y10.0001 Z2\nG1 Z-2 F60\nG0 Z2\nM5\n\
                T2 M6\n(tool 2: endmill:1.6mm)\nM3 S9000\nG0 X8.6 Y8.6 Z2\nG1 Z-1.8 F60\nX5 F90\nG0 Z2\n";
    let findings = judge(&board, Some(Role::Drilling), text);
    assert_eq!(names(&findings, Severity::Error), ["hole-size"], "{findings:?}");
}

#[test]
fn the_point_of_a_drill_is_what_its_tool_says() {
    let board = board(hole((10_000, 10_000), None, 3000));
    // Points of 0.901 mm (118°) and 0.699 mm (130°).
    for (tool, z, expected) in [
        ("drill:3mm", "2.52", &[][..]),
        ("drill:3mm", "2.35", &["hole-depth"]),
        ("drill:3mm:130deg", "2.35", &[]),
        ("endmill:3mm", "1.61", &[]),
    ] {
        let text = format!("(tool 1: {tool})\nG21 G90\nM3 S9000\nG0 X10 Y10 Z2\nG1 Z-{z} F60\nG0 Z2\n");
        let findings = judge(&board, Some(Role::Drilling), &text);
        assert_eq!(names(&findings, Severity::Error), expected, "{tool} {z}: {findings:?}");
    }
}

#[test]
fn holes_for_pins_lie_beside_the_board_and_go_deep_enough() {
    let board = board(hole((10_000, 10_000), None, 1000));
    let program = |y: &str, z: &str| {
        format!(
            "(plate alignment)\n(tool 1: drill:3mm)\nG21 G90\nM3 S9000\nG0 X15 Y-5 Z2\nG1 Z-5 F60\nG0 Z2\n\
             G0 X15 Y{y}\nG1 Z-{z}\nG0 Z2\nM2\n"
        )
    };
    for (y, z, errors, warnings) in [
        ("25", "5", &[][..], &[][..]),
        ("25", "1.8", &["alignment-hole"], &["alignment-hole"]),
        ("25", "3", &[], &["alignment-hole"]),
        ("15", "5", &["alignment-hole"], &["alignment-hole"]),
    ] {
        let findings = judge(&board, None, &program(y, z));
        assert_eq!(names(&findings, Severity::Error), errors, "{y} {z}: {findings:?}");
        assert_eq!(names(&findings, Severity::Warning), warnings, "{y} {z}: {findings:?}");
    }
    let only = program("25", "5").replace("G0 X15 Y25\nG1 Z-5\n", "");
    assert_eq!(names(&judge(&board, None, &only), Severity::Error), ["alignment-hole"], "one alone");
}

/// On pins in these holes the stock is turned over about a line that the back must have, too.
#[test]
fn holes_for_pins_lie_on_pins_when_the_board_is_flipped() {
    let board = board(hole((10_000, 10_000), None, 1000));
    let judge_text = |pins: String, axis: &str| {
        let back = format!(
            "(plate drill)\n(tool 1: drill:1mm)\n(mirrored left to right about the vertical line x = {axis} mm)\n\
             G21 G90\nM3 S9000\nG0 X20 Y10 Z2\nG1 Z-2 F60\nG0 Z2\n"
        );
        let program = |text: String| Program { file: "pins.ngc".to_owned(), text, ..Program::default() };
        let settings = Settings::default();
        let found =
            verify(&[pins, back].map(program), &board, &[], &settings).expect("it can be judged").findings;
        let told = found.into_iter().filter(|finding| finding.name == "alignment-hole");
        told.map(|finding| finding.message).collect::<Vec<_>>()
    };
    let judge = |pins: [(f64, f64); 2], axis: &str| {
        let [a, b] = pins.map(|(x, y)| format!("G0 X{x} Y{y}\nG1 Z-5 F60\nG0 Z2\n"));
        judge_text(format!("(plate alignment)\n(tool 1: drill:3mm)\nG21 G90\nM3 S9000\nG0 Z2\n{a}{b}"), axis)
    };
    let said_of = |off: f64| {
        format!("flipped about x = 15.000 mm, an alignment hole lies {off:.3} mm beside the next pin")
    };
    assert_eq!(judge([(15.0, -5.0), (15.0, 25.0)], "15"), [""; 0], "on the line");
    assert_eq!(judge([(-5.0, 10.0), (35.0, 10.0)], "15"), [""; 0], "to either side of it");
    assert_eq!(judge([(-5.04, 10.0), (35.0, 10.0)], "15"), [""; 0], "0.04 mm off");
    // Bored with an end mill that is far finer, in rounds of two halves.
    let bored = |x: f64, y: i32| {
        let round = |r: f64| format!("G1 X{0} F90\nG3 X{1} Y{y} I-{r}\nG3 X{0} Y{y} I{r}\n", x + r, x - r);
        format!("G0 X{x} Y{y}\nG1 Z-5 F60\n{}{}{}G0 Z2\n", round(0.9), round(1.7), round(2.5))
    };
    let bore = |x: f64| {
        let start = "(plate alignment)\n(tool 1: endmill:1mm)\nG21 G90\nM3 S9000\nG0 Z2\n";
        judge_text(format!("{start}{}{}", bored(x, -5), bored(x, 25)), "15")
    };
    assert_eq!(bore(15.0), [""; 0], "bored on the line");
    assert_eq!(bore(15.2), [said_of(0.4), said_of(0.4)], "bored beside it");
    let said = "flipped about x = 14.900 mm, an alignment hole lies 0.200 mm beside the next pin";
    assert_eq!(judge([(15.0, -5.0), (15.0, 25.0)], "14.9"), [said; 2], "beside the line");
    let apart = judge([(-5.0, -5.0), (35.0, 10.0)], "15");
    assert_eq!(apart, [said_of(15.0), said_of(15.0)], "not opposite to each other");
}

/// A cutout of the plate by a cutter of 1 mm: tabs of 2 mm on the bottom and the top edge, each
/// from this x.
fn held_at(bottom: &[i64], top: &[i64]) -> String {
    let mut text =
        "(tool 1: endmill:1mm)\nG21 G90\nM3 S9000\nG0 Z2\nG0 X-0.5 Y-0.5\nG1 Z-1.8 F60\n".to_owned();
    let mut leave_out = |from: i64, to: i64| {
        text += &format!("X{from} F90\nG0 Z2\nX{to}\nG1 Z-1.8 F60\n");
    };
    bottom.iter().for_each(|&x| leave_out(x, x + 3));
    let mut rest = "X30.5 F90\nY20.5\n".to_owned();
    for x in top.iter().rev() {
        rest += &format!("X{} F90\nG0 Z2\nX{x}\nG1 Z-1.8 F60\n", x + 3);
    }
    text + &rest + "X-0.5 F90\nY-0.5\nG0 Z2\nM5\nM2\n"
}

#[test]
fn a_board_that_is_held_at_one_side_is_told() {
    let plate = board(hole((10_000, 10_000), None, 3000));
    let judged = |bottom: &[i64], top: &[i64], tabs: Option<u32>| {
        let settings = Settings { tabs, ..Settings::default() };
        let text = held_at(bottom, top);
        let program =
            Program { file: "plate.ngc".to_owned(), text, role: Some(Role::Cutout), ..Program::default() };
        verify(&[program], &plate, &[], &settings).expect("it can be judged").findings
    };
    for (bottom, top, tabs) in
        [(&[13][..], &[13][..], None), (&[5, 22], &[13], None), (&[5, 12, 22], &[5, 12, 22], Some(6))]
    {
        assert_eq!(judged(bottom, top, tabs), [], "on both sides: {bottom:?}, {top:?}");
    }
    for (bottom, tabs) in
        [(&[8, 18][..], None), (&[3, 8, 13, 18, 23], None), (&[8, 18], Some(2)), (&[13], None)]
    {
        let findings = judged(bottom, &[], tabs);
        assert_eq!(names(&findings, Severity::Warning), ["tab-spread"], "{bottom:?}: {findings:?}");
        let at = findings[0].at.expect("a place");
        assert_eq!(at.y, Nm::from_mm(20), "{bottom:?}: in the middle of the way without a tab: {at:?}");
        let size = findings[0].size.expect("how long");
        assert!(size > Nm::from_mm(70) && size < Nm::from_mm(100), "{bottom:?}: {size} have no tab");
    }
    assert_eq!(judged(&[13], &[], Some(1)), [], "one was asked for");
}
