//! What is written is what was planned: every dialect's text is read back by the reader, which
//! shares no code with the writer, and compared motion by motion.

use proptest::prelude::*;
use voromill::gcode::dialect::{ALL, Arcs};
use voromill::gcode::read::{Listing, Motion, Way};
use voromill::gcode::{Dialect, Header, Input, read, write};
use voromill::geometry::{Arc, Nm, Point, Turn};
use voromill::toolpath::{Feed, Move, Position, Program, Section, Tool};

fn um(x: i64, y: i64, z: i64) -> Position {
    Position { x: Nm::from_um(x), y: Nm::from_um(y), z: Nm::from_um(z) }
}

fn header() -> Header {
    Header {
        generator: "voromill 0.0.0".to_owned(),
        inputs: vec![Input {
            file: "what?! (front) ~ 100% µ.gbr".to_owned(),
            design: "0123456789abcdef".to_owned(),
        }],
        settings: vec![("a-setting".to_owned(), "with a value that is long ".repeat(9))],
        seconds: Some(754.0),
    }
}

/// One section that cuts `moves` from where the first of them begins.
fn program(start: Position, moves: Vec<Move>) -> Program {
    let tool: Tool = "vbit:0.1mm:30deg".parse().expect("a tool");
    let over = Position { z: Nm::from_mm(2), ..start };
    let mut all = vec![Move::Rapid { to: over }, Move::Feed { to: start, feed: tool.plunge }];
    let end = moves.iter().rev().find_map(Move::to).unwrap_or(start);
    all.extend(moves);
    all.push(Move::Rapid { to: Position { z: Nm::from_mm(2), ..end } });
    let section = Section { tool, label: "a cut".to_owned(), moves: all };
    let mut other = section.clone();
    other.tool.number = 2;
    Program {
        title: "a test".to_owned(),
        notes: Vec::new(),
        safe: Nm::from_mm(2),
        sections: vec![section.clone(), section, other],
    }
}

fn place(motion: &Motion) -> Option<(Position, Position)> {
    let at = |p: read::Place| Some(Position { x: p.x?, y: p.y?, z: p.z? });
    Some((at(motion.from)?, at(motion.to)?))
}

/// All planned points that the text must pass, in order.
fn planned(program: &Program) -> Vec<Position> {
    program.sections.iter().flat_map(|section| section.moves.iter().filter_map(Move::to)).collect()
}

fn near(a: Position, b: Position, unit: i64) -> bool {
    [a.x - b.x, a.y - b.y, a.z - b.z].into_iter().all(|off| off.abs() <= Nm::new(unit / 2))
}

/// The points of the plan are met in order, each to the last digit.
fn assert_passes_all(listing: &Listing, program: &Program, dialect: &Dialect) {
    let unit = 10_i64.pow(u32::try_from(6 - dialect.decimals).expect("at most six"));
    let mut at = 0;
    for target in planned(program) {
        let arrived = |motion: &Motion| {
            place(motion).is_some_and(|(from, to)| near(from, target, unit) || near(to, target, unit))
        };
        let from = at.min(listing.motions.len() - 1);
        let found = listing.motions[from..].iter().position(arrived);
        assert!(found.is_some(), "{}: nothing goes to {target:?} after motion {at}", dialect.name);
        at = from + found.unwrap_or(0);
    }
}

/// What every program must keep, whatever is planned.
fn assert_safe(listing: &Listing, safe: Nm, name: &str) {
    let first = listing.motions.first().expect("a motion");
    assert_eq!((first.way, first.to.z, first.to.x), (Way::Rapid, Some(safe), None), "{name} lifts first");
    for motion in &listing.motions {
        let Some((from, to)) = place(motion) else { continue };
        let sideways = from.point() != to.point();
        let low = from.z.min(to.z);
        if motion.way == Way::Rapid {
            assert!(
                !sideways || low >= safe,
                "{name}: a rapid sideways below the safe height in line {}",
                motion.line
            );
        } else {
            assert!(motion.spindle.turns(), "{name}: a feed with the spindle off, line {}", motion.line);
        }
    }
    let last = listing.motions.last().expect("a motion");
    assert_eq!(last.to.z, Some(safe), "{name} ends lifted");
    assert!(!listing.spinning, "{name} ends with the spindle off");
}

/// What Grbl 1.1 bears.
fn assert_grbl_bears(text: &str) {
    for line in text.lines() {
        assert!(line.len() < 128, "a line of {} bytes: {line}", line.len());
        let code: String =
            line.split('(').next().unwrap_or_default().chars().filter(|c| !c.is_whitespace()).collect();
        assert!(code.len() <= 79, "{} characters of code: {line}", code.len());
        assert!(
            line.bytes().all(|b| (0x20..0x7e).contains(&b) && !b"?!%".contains(&b)),
            "a byte that acts at once: {line}"
        );
        for word in ["G64", "M6", "G81", "G82", "G83"] {
            assert!(!code.contains(word), "{word} in {line}");
        }
    }
}

#[test]
fn a_square_reads_as_it_was_planned_in_every_dialect() {
    let feed = Feed::from_mm_per_min(200);
    let corners = [(10_000, 0), (10_000, 10_000), (0, 10_000), (0, 0)];
    let moves = corners.map(|(x, y)| Move::Feed { to: um(x, y, -70), feed }).to_vec();
    let program = program(um(0, 0, -70), moves);
    for dialect in ALL {
        let text = write(&program, dialect, &header());
        let listing = read(&text).unwrap_or_else(|error| panic!("{}: {error}\n{text}", dialect.name));
        assert_passes_all(&listing, &program, dialect);
        assert_safe(&listing, program.safe, &dialect.name);
    }
}

#[test]
fn grbl_bears_every_line() {
    let program =
        program(um(0, 0, -70), vec![Move::Feed { to: um(5, 5, -70), feed: Feed::from_mm_per_min(200) }]);
    assert_grbl_bears(&write(&program, Dialect::by_name("grbl").unwrap(), &header()));
}

#[test]
fn the_same_program_is_written_in_every_dialect() {
    let feed = Feed::from_mm_per_min(150);
    let moves = vec![
        Move::Feed { to: um(20_000, 0, -70), feed },
        Move::Arc {
            to: um(25_000, 5_000, -70),
            center: um(20_000, 5_000, 0).point(),
            turn: Turn::CounterClockwise,
            feed,
        },
        Move::Arc {
            to: um(25_000, 5_000, -90),
            center: um(24_000, 5_000, 0).point(),
            turn: Turn::Clockwise,
            feed,
        },
        Move::Dwell { milliseconds: 1500 },
    ];
    let program = program(um(0, 0, -70), moves);
    for dialect in ALL {
        insta::with_settings!({
            snapshot_path => concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/gcode"),
            prepend_module_to_snapshot => false
        }, {
            insta::assert_snapshot!(dialect.name.as_ref(), write(&program, dialect, &header()));
        });
    }
}

fn any_position() -> impl Strategy<Value = Position> {
    (-50_000_000..50_000_000_i64, -50_000_000..50_000_000_i64, -2_000_000..-1_i64)
        .prop_map(|(x, y, z)| Position { x: Nm::new(x), y: Nm::new(y), z: Nm::new(z) })
}

/// A line to a place, or an arc of any size down to nothing: radius, first angle, sweep.
fn any_step() -> impl Strategy<Value = (Option<Position>, f64, f64, f64)> {
    let radius = prop_oneof![1.0..1e3, 1e3..1e6, 1e6..5e7_f64];
    let sweep = prop_oneof![-6.3..6.3_f64, -1e-3..1e-3_f64];
    (prop::option::of(any_position()), radius, -3.2..3.2_f64, sweep)
}

fn moves(start: Position, steps: &[(Option<Position>, f64, f64, f64)]) -> Vec<Move> {
    let feed = Feed::from_mm_per_min(200);
    let mut at = start;
    let step = |&(to, radius, first, sweep): &(Option<Position>, f64, f64, f64)| {
        let next = if let Some(to) = to {
            Move::Feed { to, feed }
        } else {
            let (x, y) = at.point().to_f64();
            let center = Point::from_f64(x - radius * libm::cos(first), y - radius * libm::sin(first));
            let (cx, cy) = center.to_f64();
            let (sin, cos) = libm::sincos(first + sweep);
            let end = Point::from_f64(cx + radius * cos, cy + radius * sin);
            let turn = if sweep > 0.0 { Turn::CounterClockwise } else { Turn::Clockwise };
            Move::Arc { to: Position::over(end, at.z), center, turn, feed }
        };
        at = next.to().unwrap_or(at);
        next
    };
    steps.iter().map(step).collect()
}

/// The length of what is cut.
fn cut_length(listing: &Listing) -> f64 {
    let length = |motion: &Motion| match (motion.way, place(motion)) {
        (Way::Arc { center, turn }, Some((from, to))) => {
            Arc { start: from.point(), end: to.point(), center, turn }.length()
        }
        (Way::Feed, Some((from, to))) => from.point().distance(to.point()),
        _ => 0.0,
    };
    listing.motions.iter().map(length).sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn whatever_is_planned_is_read_back(start in any_position(), steps in prop::collection::vec(any_step(), 1..30)) {
        let moves = moves(start, &steps);
        let mut at = start;
        let mut length = 0.0;
        for step in &moves {
            let to = step.to().unwrap();
            length += match *step {
                Move::Arc { center, turn, .. } => Arc { start: at.point(), end: to.point(), center, turn }.length(),
                _ => at.point().distance(to.point()),
            };
            at = to;
        }
        let program = program(start, moves);
        for dialect in ALL {
            let text = write(&program, dialect, &header());
            let listing = read(&text).map_err(|error| TestCaseError::fail(format!("{}: {error}\n{text}", dialect.name)))?;
            assert_passes_all(&listing, &program, dialect);
            assert_safe(&listing, program.safe, &dialect.name);
            // A lost or doubled turn would show here; rounding moves each end by a micrometre at
            // most.
            let (cut, allowed) = (cut_length(&listing) / 3.0, 4_000.0 * f64::from(u32::try_from(steps.len()).expect("a few")));
            prop_assert!((cut - length).abs() <= allowed, "{}: {} nm cut, {} planned\n{}", dialect.name, cut, length, text);
            if dialect.arcs == Arcs::Lines {
                prop_assert!(!text.contains("G2 ") && !text.contains("G3 "), "arcs in {}", dialect.name);
            }
            if dialect.name == "grbl" {
                assert_grbl_bears(&text);
            }
        }
    }

    #[test]
    fn reading_anything_ends_without_a_panic(text in "[ -~\n]{0,400}") {
        drop(read(&text));
    }

    #[test]
    fn reading_words_ends_without_a_panic(words in prop::collection::vec("[GMXYZIJRFSTPQ]-?[0-9]{1,3}(\\.[0-9]{0,4})?[ \n]", 0..60)) {
        drop(read(&words.concat()));
    }
}

#[test]
fn the_reader_knows_inches_increments_radii_and_cycles() {
    let text = "G20 G91.1\nG0 Z0.1\nG0 X1 Y0\nM3 S1000\nG1 Z-0.01 F10\nG91\nX1\nG90 G2 X2 Y-2 R1\nG0 Z.1\nG21 G98 G83 X1 Y1 Z-2 R1 Q0.8 F100\nX5\nG80\nM5\nM30\n";
    let listing = read(text).unwrap();
    let ends: Vec<_> =
        listing.motions.iter().map(|motion| (motion.to.x, motion.to.y, motion.to.z, motion.line)).collect();
    let mm = |value: f64| Some(Nm::from_f64(value * 1e6));
    assert_eq!(ends[3], (mm(50.8), mm(0.0), mm(-0.254), 7), "an inch further");
    let Way::Arc { center, .. } = listing.motions[4].way else { panic!("no arc") };
    assert_eq!(center, Point::new(Nm::new(50_800_000), Nm::new(-25_400_000)), "half a turn by its radius");
    let pecks: Vec<_> = ends.iter().filter(|end| end.3 == 10).map(|end| end.2).collect();
    let expected = [2.54, 1.0, 0.2, 1.0, -0.6, 1.0, -1.4, 1.0, -2.0, 2.54].map(mm);
    assert_eq!(pecks, expected, "pecks of 0.8 mm, back to where it was");
    assert_eq!(listing.end, Some(14), "it ends");
}

#[test]
fn what_the_text_does_not_tell_is_refused_with_the_reason() {
    let cases = [
        ("G68 X1 Y1 R5", "rotated"),
        ("X1", "before the first of G0"),
        ("G0 X#<a>", "nothing in the program"),
        ("G0 X1 X2", "twice"),
        ("G0 X", "expected a number"),
        ("G28\nG91 G0 X1", "does not give"),
        ("G0 X0 Y0\nG2 X1 Y1 I1 J5 F1", "from its centre"),
        ("G18 G5 X1 Y1", "G17"),
        ("G0 X0 Y0\nG90.1\nG2 X2 I1 F1", "with G90.1 an arc needs J"),
        ("G0 X3.9e-05", "exponent"),
        ("G4 S1 Z-1", "a dwell without P"),
        ("S999999999\nG95 G1 X1 F50000", "a kilometre a minute"),
    ];
    for (text, reason) in cases {
        let error = read(text).expect_err(text).to_string();
        assert!(error.contains(reason), "`{text}` gives `{error}`, without `{reason}`");
    }
}

#[test]
fn circles_in_coarse_decimals_are_those_that_grbl_bears() {
    let dialect = |arcs: &str| {
        let text = format!("name = 'coarse'\nbase = 'grbl'\ndecimals = 2\narcs = '{arcs}'");
        Dialect::from_toml(&text).expect("a dialect")
    };
    let (center, radius) = (Point::new(Nm::new(3_317_300), Nm::new(4_112_700)), Nm::new(613_400));
    for step in 0..60 {
        let (sin, cos) = libm::sincos(f64::from(step) / 60.0 * std::f64::consts::TAU);
        let (x, y) = (radius.to_f64() * cos, radius.to_f64() * sin);
        let start = Point::new(center.x + Nm::from_f64(x), center.y + Nm::from_f64(y));
        let start = Position::over(start, Nm::from_um(-100));
        let circle = Move::Arc { to: start, center, turn: Turn::Clockwise, feed: Feed::from_mm_per_min(200) };
        let text = write(&program(start, vec![circle]), &dialect("center"), &header());
        assert!(text.contains("\nG2 "), "it is written as arcs:\n{text}");
        for motion in &read(&text).expect("it reads").motions {
            let (Way::Arc { center, .. }, Some((from, to))) = (motion.way, place(motion)) else { continue };
            let off = center.distance(from.point()) - center.distance(to.point());
            assert!(off.abs() < 1_000.0, "the ends are {off} nm apart from the centre:\n{text}");
        }
        let text = write(&program(start, vec![circle]), &dialect("radius"), &header());
        assert!(read(&text).is_ok(), "{text}");
    }
}

#[test]
fn lines_of_the_users_own_have_the_numbers_that_they_have() {
    let text = "name = 'numbered'\nbase = 'linuxcnc'\nline-numbers = 'by-tens'";
    let mut dialect = Dialect::from_toml(text).expect("a dialect");
    dialect.own.before = ["%", "N5 M64 P0"].map(str::to_owned).to_vec();
    let text = write(&program(um(0, 0, -100), Vec::new()), &dialect, &header());
    assert!(text.contains("(own G-code begins)\n%\nN5 M64 P0\n(own G-code ends)\nN10 "), "{text}");
}

/// What a line does beside a code that is no motion.
#[test]
fn codes_that_stand_beside_a_motion_leave_it_its_words() {
    let head = "G21 G90\nG0 X0 Y0 Z2\nG1 F100\n";
    let cases = [
        ("G92.1 G1 Z-5", Way::Feed, 0, Some(-5)),
        ("G92.2 G0 X5", Way::Rapid, 5, Some(2)),
        ("G28.1 G1 X5", Way::Feed, 5, Some(2)),
        ("G0 G92 X-1\nX5", Way::Rapid, 6, Some(2)),
        ("G0 G28 Z2\nG90\nX5", Way::Rapid, 5, None),
        ("G4 P1 X15", Way::Feed, 15, Some(2)),
        ("G4 X15", Way::Rapid, 0, Some(2)),
    ];
    for (text, way, x, z) in cases {
        let listing = read(&format!("{head}{text}\n")).expect(text);
        let last = listing.motions.last().expect("a motion");
        let is = (last.way, last.to.x, last.to.z);
        assert_eq!(is, (way, Some(Nm::from_mm(x)), z.map(Nm::from_mm)), "{text}");
    }
}

#[test]
fn loops_that_are_left_from_within_others_run_as_often_as_they_say() {
    let inner = "o12 repeat [5]\nLEAVE\no12 endrepeat\n";
    let cases = [
        ("o10 repeat [3]\nX1\nINNERo10 endrepeat\n", "o10 continue", 3),
        ("o10 repeat [3]\nX1\nINNERo10 endrepeat\n", "o10 break", 1),
        ("o10 repeat [3]\nX1\no11 repeat [2]\nINNERo11 endrepeat\no10 endrepeat\n", "o11 break", 3),
        ("o10 repeat [3]\nX1\no11 while [1]\nINNERo11 endwhile\no10 endrepeat\n", "o11 break", 3),
        (
            "o10 repeat [3]\n#1=0\no11 do\n#1=[#1+1]\nX1\nINNERo11 while [#1 lt 2]\no10 endrepeat\n",
            "o11 continue",
            6,
        ),
    ];
    for (outer, leave, times) in cases {
        let text = outer.replace("INNER", inner).replace("LEAVE", leave);
        let listing = read(&format!("G21 G90\nG0 X0 Y0 Z2\nG91\n{text}")).expect(&text);
        let last = listing.motions.last().expect("a motion");
        assert_eq!(last.to.x, Some(Nm::from_mm(times)), "{text}");
    }
}

#[test]
fn feeds_probes_and_dwells_are_what_the_text_says() {
    let of = |text: &str| read(&format!("G21 G90\n{text}\n")).expect(text);
    let last = |text: &str| *of(text).motions.last().expect("a motion");
    let inverse = "G0 X0 Y0 Z0\nG1 F100\nG93\nX5 F2";
    assert_eq!(last(inverse).feed, Some(10_000_000), "5 mm in half a minute");
    assert_eq!(last(&format!("{inverse}\nG94\nX6")).feed, None, "an old feed counts nothing any more");
    assert_eq!(last("G0 X0 Y0 Z0\nG93 G1 X0 F2").feed, Some(1), "nothing in half a minute");
    let probed = last("G91\nG38.2 Z-20 F50\nG90\nG92 Z1.5\nG0 Z5");
    assert_eq!(probed.to.z, Some(Nm::from_mm(5)), "from a height that nobody knows");
    let dwells = of("G0 X0 Y0 Z2\nG82 X1 Z-1 R1 P500 F100\nX2").dwells;
    assert_eq!(dwells.len(), 1, "P of a cycle, once: {dwells:?}");
    assert_eq!(dwells[0].thousandths, 500_000);
    let notes = of("G10 L1 P1 Z-5").notes;
    assert!(notes.iter().any(|note| note.warns && note.message.contains("G10 L1")), "{notes:?}");
    assert_eq!(of("O1001\nG0 X0").indirect, None, "the number of a program");
}
