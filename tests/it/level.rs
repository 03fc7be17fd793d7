//! Programs levelled to a surface: the same depth below it everywhere, and everything else as it
//! was.

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use voromill::gcode::dialect::ALL;
use voromill::gcode::level::{Frame, HeightMap, LevelError, Levelled, Levelling, MapError, level};
use voromill::gcode::read::{Motion, Way};
use voromill::gcode::{Dialect, read};
use voromill::geometry::{Arc, Nm, Point};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};

use crate::cli::{stderr, stdout, voromill};

/// A grid of touches every `step` millimetres from (−5, −5), as high as `height` says of
/// millimetres.
fn map(size: u32, step: f64, height: impl Fn(f64, f64) -> f64) -> HeightMap {
    let place = |index: u32| f64::from(index) * step - 5.0;
    let points: Vec<[f64; 3]> = (0..size * size)
        .map(|index| {
            let (x, y) = (place(index % size), place(index / size));
            [x * 1e6, y * 1e6, height(x, y) * 1e6]
        })
        .collect();
    HeightMap::through(&points).expect("a map")
}

fn bump(x: f64, y: f64) -> f64 {
    0.08 * libm::sin(x / 9.0) * libm::cos(y / 7.0) + 0.002 * x
}

fn levelled(text: &str, map: &HeightMap) -> Levelled {
    level(text, map, &Levelling::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The points of a motion with their heights, in nanometres.
fn along(motion: &Motion) -> Vec<(f64, f64, f64)> {
    let (Some(from), Some(to)) = (motion.from.point(), motion.to.point()) else { return Vec::new() };
    let (Some(low), Some(high)) = (motion.from.z, motion.to.z) else { return Vec::new() };
    (0..=32)
        .map(|part| {
            let t = f64::from(part) / 32.0;
            let (x, y) = match motion.way {
                Way::Arc { center, turn } => Arc { start: from, end: to, center, turn }.at(t),
                Way::Rapid | Way::Feed => {
                    let ((a, b), (c, d)) = (from.to_f64(), to.to_f64());
                    (a + (c - a) * t, b + (d - b) * t)
                }
            };
            (x, y, low.to_f64() + (high - low).to_f64() * t)
        })
        .collect()
}

/// The ends of all motions.
fn ends(text: &str) -> Vec<(Option<Point>, Option<Nm>)> {
    let listing = read(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    listing.motions.iter().map(|motion| (motion.to.point(), motion.to.z)).collect()
}

/// All programs of a fixture board, with names, in a dialect.
fn programs(dialect: &str) -> Vec<(String, String)> {
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator");
    let loaded = import::load(&[board], &Selection::default()).expect("a board");
    let options = Options::from_toml("f", &format!("dialect = \"{dialect}\"")).expect("options");
    let settings = Settings::resolve(options).expect("settings");
    let job = job::mill(loaded, &settings).expect("a job");
    job.programs.into_iter().map(|written| (written.part.name().to_owned(), written.text)).collect()
}

#[test]
fn every_cut_of_every_program_keeps_its_depth_below_a_surface_that_is_not_flat() {
    let map = map(15, 5.0, bump);
    // What is left to rounding: the last digit of z, and of the ends of arcs.
    let tolerance = Nm::from_um(5).to_f64() + 150.0;
    let differing = ["grbl", "linuxcnc", "marlin", "reprapfirmware", "smoothieware", "tinyg"];
    for dialect in ALL.iter().filter(|dialect| differing.contains(&dialect.name.as_ref())) {
        for (part, text) in programs(&dialect.name) {
            let done = levelled(&text, &map);
            let (before, after) = (read(&text).unwrap(), read(&done.text).unwrap());
            let depths: Vec<Nm> = before.motions.iter().filter_map(|motion| motion.to.z).collect();
            let mut cuts = 0;
            for motion in after.motions.iter().filter(|motion| motion.way != Way::Rapid) {
                if motion.from.point() == motion.to.point() {
                    continue;
                }
                cuts += 1;
                for (x, y, z) in along(motion) {
                    let depth = z - map.over(Point::from_f64(x, y)).to_f64();
                    let off = depths
                        .iter()
                        .map(|planned| (planned.to_f64() - depth).abs())
                        .fold(f64::MAX, f64::min);
                    // Ramps and helices go from depth to depth.
                    let between = part == "cutout" || part == "drill";
                    assert!(
                        between || off <= tolerance,
                        "{part} in {}: line {} is off by {off}",
                        dialect.name,
                        motion.line
                    );
                }
            }
            assert!(cuts > 0 || part == "drill", "{part} cuts");
            assert!(
                done.text.lines().count() == text.lines().count() + done.added,
                "{part}: lines are added, none lost"
            );
        }
    }
}

#[test]
fn comments_tools_speeds_and_travel_stay_to_the_letter() {
    let map = map(15, 5.0, bump);
    for dialect in ["grbl", "linuxcnc", "marlin"] {
        for (part, text) in programs(dialect) {
            let done = levelled(&text, &map);
            let kept = |text: &str| -> Vec<String> {
                let coordinates =
                    |line: &&str| !line.starts_with(['G', 'X', 'Y', 'Z']) || line.contains("Z2");
                text.lines().filter(coordinates).map(str::to_owned).collect()
            };
            assert_eq!(kept(&text), kept(&done.text), "{part} in {dialect}");
            let feeds = |text: &str| {
                let mut feeds: Vec<_> =
                    read(text).unwrap().motions.iter().map(|motion| motion.feed).collect();
                feeds.dedup();
                feeds
            };
            assert_eq!(feeds(&text), feeds(&done.text), "{part} in {dialect}: feeds");
        }
    }
}

#[test]
fn a_tilted_plane_gives_exact_heights_without_splitting_what_is_straight() {
    let plane = map(3, 20.0, |x, y| 0.1 + x * 0.004 - y * 0.002);
    let text = "G21 G90\nG0 Z2\nG0 X0 Y0\nG1 Z-0.1 F100\nG1 X30 Y10 F200\nX12.5\nG0 Z2\nM2\n";
    let expected = "G21 G90\nG0 Z2\nG0 X0 Y0\nG1 Z0 F100\nG1 X30 Y10 Z0.1 F200\nX12.5 Z0.03\nG0 Z2\nM2\n";
    let done = levelled(text, &plane);
    assert_eq!(done.text, expected, "z is that of the plane, a tenth below");
    assert_eq!((done.levelled, done.added), (4, 0), "four motions are low");
}

#[test]
fn arcs_follow_as_helices_and_a_circle_comes_back() {
    let plane = map(3, 20.0, |x, _| x * 0.01);
    let text = "G21 G90 G17\nG0 Z2\nG0 X20 Y10\nG1 Z-0.1 F100\nG2 X20 Y10 I-5 J0 (round)\nG0 Z2\nM2\n";
    let done = levelled(text, &plane);
    assert!(done.added > 3, "a circle on a slope is split: {}", done.text);
    let listing = read(&done.text).unwrap();
    let arcs: Vec<&Motion> =
        listing.motions.iter().filter(|motion| matches!(motion.way, Way::Arc { .. })).collect();
    assert_eq!(arcs.len(), done.added + 1, "all of them arcs");
    assert_eq!(arcs.last().and_then(|arc| arc.to.point()), arcs[0].from.point(), "closed");
    assert_eq!(arcs.last().and_then(|arc| arc.to.z), Some(Nm::from_um(100)), "0.2 up, 0.1 down");
    for arc in arcs {
        for (x, y, z) in along(arc) {
            let off = z + 1e5 - plane.over(Point::from_f64(x, y)).to_f64();
            assert!(off.abs() <= 5_150.0, "line {} is off by {off}", arc.line);
        }
    }
    assert!(done.text.contains("(round)"), "the comment stays");
}

/// The turns of an arc that goes round several times (P) lie on the surface like any other arc; on
/// a level surface they stay one line.
#[test]
fn an_arc_that_goes_round_several_times_follows_the_surface_on_each_turn() {
    let plane = map(3, 20.0, |x, _| x * 0.01);
    for (arc, turns, end) in [
        ("G3 X10 Y10 I5 J5 Z-0.4 P2", 2.0, (10, 10, -400)),
        ("G2 X20 Y20 I5 J5 Z-0.4 P3 (half a turn more)", 2.5, (20, 20, -400)),
        ("G91\nG3 X0 Y0 I5 J5 Z-0.3 P2\nG90", 2.0, (10, 10, -400)),
    ] {
        let text = format!("G21 G90 G17\nG0 Z2\nG0 X10 Y10\nG1 Z-0.1 F100\n{arc}\nG0 Z2\nM2\n");
        let done = levelled(&text, &plane);
        assert!(!done.text.contains(['P', 'R']), "each piece goes round once: {}", done.text);
        let listing = read(&done.text).unwrap();
        let arcs: Vec<&Motion> =
            listing.motions.iter().filter(|motion| matches!(motion.way, Way::Arc { .. })).collect();
        let sweep: f64 = arcs.iter().map(|arc| length(arc)).sum();
        let radius = 50_f64.sqrt() * 1e6;
        let round = sweep / (std::f64::consts::TAU * radius);
        assert!((round - turns).abs() < 1e-3, "it goes round {round} times: {}", done.text);
        let (x, y, z) = end;
        let last = arcs.last().expect("arcs").to;
        let place = Point::new(Nm::from_mm(x), Nm::from_mm(y));
        assert_eq!(last.point(), Some(place), "where it ended before: {}", done.text);
        assert_eq!(last.z, Some(Nm::from_um(z) + plane.over(place)), "as deep: {}", done.text);
        let mut way = 0.0;
        for arc in arcs {
            for (part, (x, y, z)) in along(arc).into_iter().enumerate() {
                let share = (way + length(arc) * f64::from(u32::try_from(part).unwrap()) / 32.0) / sweep;
                let off = z + 1e5 + 3e5 * share - plane.over(Point::from_f64(x, y)).to_f64();
                assert!(off.abs() <= 5_250.0, "line {} is off by {off}: {}", arc.line, done.text);
            }
            way += length(arc);
        }
        let flat = map(3, 20.0, |_, _| 0.05);
        let done = levelled(&text, &flat).text;
        let higher = text.replace("Z-0.1 ", "Z-0.05 ").replace("Z-0.4", "Z-0.35");
        assert_eq!(done, higher, "one line on a level surface");
        assert_eq!(levelled(&text, &map(3, 20.0, |_, _| 0.0)).text, text, "the same text");
    }
    let tap = "G21 G90\nM3 S100\nG0 Z2\nG0 X10 Y10\nG33.1 Z-1 K1\nG0 Z2\nM2\n";
    let error = level(tap, &plane, &Levelling::default()).expect_err("there and back in a line");
    assert!(matches!(error, LevelError::Indirect { line: 5, .. }), "{error}");
}

/// How long an arc is in the plane, in nanometres.
fn length(motion: &Motion) -> f64 {
    let (Way::Arc { center, turn }, Some(start), Some(end)) =
        (motion.way, motion.from.point(), motion.to.point())
    else {
        return 0.0;
    };
    Arc { start, end, center, turn }.length()
}

#[test]
fn cycles_increments_inches_and_modal_lines_are_levelled_as_they_are_written() {
    let flat = map(3, 30.0, |_, _| 0.254);
    let cases = [
        (
            "G20 G90\nG0 Z.1\nX1 Y1\nG1 Z-.005 F4\nX2\nG0 Z.1\nM2",
            "G20 G90\nG0 Z.1\nX1 Y1\nG1 Z0.005 F4\nX2\nG0 Z.1\nM2",
        ),
        (
            "G90\nG0 Z2\nX0 Y0\nG91\nG1 Z-2.1 F100\nX5\nG0 Z2.1\nX5\nG90\nM2",
            "G90\nG0 Z2\nX0 Y0\nG91\nG1 Z-1.846 F100\nX5\nG0 Z1.846\nX5\nG90\nM2",
        ),
        (
            "G90 G98\nG0 Z5\nG0 X0 Y0\nG81 X1 Y1 Z-2 R1 F100\nX2\nG80\nM2",
            "G90 G98\nG0 Z5\nG0 X0 Y0\nG81 X1 Y1 Z-1.746 R1.254 F100\nX2\nG80\nM2",
        ),
        (
            "G90 G98\nG0 Z5\nG0 X0 Y0\nG73 X1 Y1 Z-2 R1 Q0.7 F100\nX2\nG89 X3 R2 P0.1\nG86 X4 Z-1\nG80\nM2",
            "G90 G98\nG0 Z5\nG0 X0 Y0\nG73 X1 Y1 Z-1.746 R1.254 Q0.7 F100\nX2\nG89 X3 R2.254 P0.1\nG86 X4 Z-0.746\nG80\nM2",
        ),
        (
            "N10 G90\nN20 G0 Z2\nN30 G0X1Y1\nN40 G1Z-1F100(down)\nN50 M2",
            "N10 G90\nN20 G0 Z2\nN30 G0X1Y1\nN40 G1Z-0.746F100(down)\nN50 M2",
        ),
        (
            "G90\nG0 Z5\nX0 Y0\nM70\nG91 G20\nG0 Z-.1\nM72\nG0 Z0.5\nG1 Z-0.1 F100\nX10\nG0 Z5\nM2",
            "G90\nG0 Z5\nX0 Y0\nM70\nG91 G20\nG0 Z-0.09\nM72\nG0 Z0.754\nG1 Z0.154 F100\nX10\nG0 Z5\nM2",
        ),
        (
            "(end mill (long) X1)\nM118 G0 Z-9 (so)\nM117 Z-9\nM84 X Y\nG90\nG0 Z2\nX0 Y0\n/2 G1 F9 z - 1(down (slow) Z3)\nM2",
            "(end mill (long) X1)\nM118 G0 Z-9 (so)\nM117 Z-9\nM84 X Y\nG90\nG0 Z2\nX0 Y0\n/2 G1 F9 Z-0.746(down (slow) Z3)\nM2",
        ),
        (
            "%\n$X\nG90\nG0 Z2\nX0 Y0\nG1 Z-1 F9 (down\n%\nZ[",
            "%\n$X\nG90\nG0 Z2\nX0 Y0\nG1 Z-0.746 F9 (down\n%\nZ[",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(levelled(text, &flat).text, expected, "a surface a quarter of a millimetre high");
    }
}

#[test]
fn a_pause_in_a_line_that_is_split_comes_after_all_of_it() {
    let ridge = map(3, 20.0, |x, _| if (10.0..20.0).contains(&x) { 0.2 } else { 0.0 });
    let text = "G90\nG0 Z2\nX0 Y0\nG1 Z-0.1 F100\n/G1 X30 F200 M0 (over the ridge)\nM2\n";
    let done = levelled(text, &ridge);
    let flat =
        |text: &str| text.lines().filter(|line| line.contains('/')).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(flat(&done.text)[0].matches("M0").count(), 0, "not before the ridge: {}", done.text);
    assert!(flat(&done.text).last().is_some_and(|line| line.ends_with("M0")), "{}", done.text);
}

#[test]
fn the_note_stands_before_the_first_word() {
    let levelling = Levelling { note: "levelled".to_owned(), ..Levelling::default() };
    let flat = map(2, 30.0, |_, _| 0.0);
    for (text, expected) in [
        ("(a)\n%\nG21\nG0 Z1\n", "(a)\n%\n(levelled)\nG21\nG0 Z1\n"),
        ("; a\r\nG21\r\nG0 Z1", "; a\r\n; levelled\r\nG21\r\nG0 Z1"),
    ] {
        assert_eq!(level(text, &flat, &levelling).unwrap().text, expected, "after the title");
    }
}

#[test]
fn every_format_gives_the_same_map() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/level");
    let text = |name: &str| fs::read_to_string(folder.join(name)).expect("a fixture");
    let (first, _) = HeightMap::read(&text("board.probe"), &Frame::default()).expect("bCNC's");
    assert_eq!(first.size(), (3, 2), "three columns, two rows");
    for (name, kind) in [
        ("board.hmap", "OpenCNCPilot"),
        ("candle.map", "Candle"),
        ("linuxcnc.txt", "LinuxCNC"),
        ("ugs.xyz", "x, y and z"),
        ("grbl.log", "Grbl"),
    ] {
        let (map, format) = HeightMap::read(&text(name), &Frame::default()).expect(name);
        assert!(format.name.contains(kind), "{name} is {}", format.name);
        for (x, y) in [(0, 0), (20, 10), (7, 3), (13, 9), (-4, 20)] {
            let p = Point::new(Nm::from_mm(x), Nm::from_mm(y));
            assert!((map.over(p) - first.over(p)).abs() <= Nm::new(1), "{name} at {x}, {y}");
        }
    }
    let zero = Some([-100_000, -80_000, -31_500].map(Nm::from_um));
    let (map, format) =
        HeightMap::read(&text("tinyg.log"), &Frame { zero, ..Frame::default() }).expect("a log");
    assert_eq!((&map, format.name.contains("TinyG")), (&first, true), "from the machine's zero");
    // As g2core reports it: the axis that moved, then what it is asked for.
    let asked: String = text("tinyg.log")
        .lines()
        .map(|line| match line.contains("\"e\":1") {
            true => format!("{{\"prb\":{{\"e\":1, \"z\":-9.000}}}}\n{line}\n"),
            false => format!("{line}\n"),
        })
        .collect();
    let (map, _) = HeightMap::read(&asked, &Frame { zero, ..Frame::default() }).expect("a log");
    assert_eq!(map, first, "the answer holds for the report before it");
    let zero = [-100, -80, -31].map(Nm::from_mm);
    let frame = Frame { zero: Some(zero), ..Frame::default() };
    let (moved, _) = HeightMap::read(&text("grbl.log"), &frame).expect("a log");
    assert_eq!(moved.over(Point::default()), Nm::from_um(-500), "what is said holds over what is reported");
    assert_eq!(moved.zeroed_at(Point::default()).over(Point::default()), Nm::ZERO, "zero set there");
}

#[test]
fn maps_that_are_none_say_why() {
    let cases = [
        ("G0 X1\n", "not a height map"),
        ("", "not a height map"),
        ("0 0 0\n1 0 0\n0 1 zero\n", "line 3"),
        ("0 10 2\n0 10 2\n-1 1 50\n0 0 0\n10 0 0\n", "declares 4 points, but has 2"),
        ("[PRB:1.000,2.000,3.000:1]\n", "zero"),
        // A probe that touched nothing is no touch.
        ("WCO:0,0,0\n[PRB:1.000,2.000,3.000:0]\n", "0 columns and 0 rows"),
        (
            "WCO:0,0,0\n[PRB:1.000,2.000,3.000:2]\n",
            "line 2: `[PRB:1.000,2.000,3.000:2]`: expected [PRB:x,y,z:1]",
        ),
        (
            "{\"prb\":{\"e\":1,\"x\":1,\"y\":2}}\n",
            "line 1: `{\"prb\":{\"e\":1,\"x\":1,\"y\":2}}`: expected {\"prb\"",
        ),
        (
            "{\"prb\":{\"e\":1,\"x\":1,\"y\":2,\"z\":3}}\n",
            "line 1: the controller reports probed points in machine coordinates",
        ),
        // g2core's reports: z alone, or of the second touch alone.
        (
            "{\"prb\":{\"e\":1, \"z\":-10}}\n",
            "line 1: `{\"prb\":{\"e\":1, \"z\":-10}}`: expected x and y, too: g2core",
        ),
        (
            "{\"prb\":{\"e\":0, \"z\":1}}\n{\"prb\":{\"e\":1, \"z\":2}}\n{\"prb\":{\"e\":1, \"z\":3}}\n",
            "line 2: `{\"prb\":{\"e\":1, \"z\":2}}`: expected x and y, too: g2core",
        ),
        // Numbers with commas, more columns than there are axes, two heights of one place.
        ("0 0 0\n0,5 1,25 -0,03\n", "line 2: `0,5 1,25 -0,03`: expected decimal points in numbers"),
        ("0,5;1,25;-0,03\n", "line 1: `0,5;1,25;-0,03`: expected decimal points in numbers"),
        (
            "0 10 2\n0 10 2\n-1 1 50\n0,0 0,0 0,1\n",
            "line 4: `0,0 0,0 0,1`: expected decimal points in numbers",
        ),
        ("0 0 0\n1 0 0 7\n", "line 2: `1 0 0 7`: expected x, y and z, or the nine columns"),
        ("0,5,1,25,0,03\n", "line 1: `0,5,1,25,0,03`: expected x, y and z, or the nine columns"),
        ("0 10 2\n0 10 2\n-1 1 50\n0 0 0 0\n", "line 4: `0 0 0 0`: expected x, y and z"),
        ("0;0;1;1\n2;2;-1;1\n0;1;1\n0;0\n0;0;0\n", "line 5: `0;0;0`: expected as many heights as columns"),
        ("0;0;1;1\n2;2;-1;1\n0;1;1\n0;0\n", "declares 4 points, but has 2"),
        ("0;0;1;1\n2;2;-1;1\n0;1;1\n0;nan\n0;0\n", "line 4: `0;nan`"),
        (
            "-9 -5 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n",
            "line 1: the touch at x = -9.000 mm, y = -5.000 mm lies beside the 2 by 2 grid of all others",
        ),
        (
            "0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n0 5 0\n",
            "line 7: the touch at x = 0.000 mm, y = 5.000 mm lies beside the 3 by 2 grid of all others",
        ),
        // Two of them, or a grid that has a hole beside: nobody can tell.
        ("-9 -5 0\n-8 -5 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n", "6 points of the 4 by 3 grid were not probed"),
        ("0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n", "1 points of the 3 by 2 grid were not probed"),
        (
            "0 0 0\n1 0 0\n0 1 0\n1 1 0\n1 0 0.2\n",
            "line 5: the surface is at 0.200 mm at x = 1.000 mm, y = 0.000 mm, and line 2 has it at 0.000 mm",
        ),
        ("<heightmap MinX=\"0\">", "never closed"),
        (
            "<heightmap MinX=\"0\" MinY=\"0\" MaxX=\"1\" MaxY=\"1\" SizeX=\"2\" SizeY=\"2\"><point X=\"0\" Y=\"0\">0</point></heightmap>",
            "declares 4 points, but has 1",
        ),
        ("<heightmap MinX=\"0\" MinY=\"0\" MaxX=\"1\" MaxY=\"1\" SizeX=\"2\"></heightmap>", "SizeY"),
        ("0 0 0\n1 0 9\n0 1 0\n1 1 0\n", "rises by 9.000 mm"),
    ];
    for (text, reason) in cases {
        let error = HeightMap::read(text, &Frame::default()).expect_err(text).to_string();
        assert!(error.contains(reason), "`{text}` gives `{error}`, without `{reason}`");
    }
}

#[test]
fn programs_that_cannot_be_levelled_say_why_and_where() {
    let map = map(3, 10.0, |_, _| 0.1);
    let error = |text: &str| level(text, &map, &Levelling::default()).expect_err(text);
    let outside = error("G90\nG0 Z2\nX0 Y0\nG1 Z-1 F1\nX30\n");
    assert!(matches!(outside, LevelError::Outside { line: 5, .. }), "{outside}");
    assert!(outside.to_string().contains("x = 30.000 mm"), "{outside}");
    assert!(
        matches!(error("G90\nG0 Z2\nG1 Z-1 F1\nX3 Y2\n"), LevelError::Nowhere { line: 3, .. }),
        "before x and y"
    );
    assert!(
        matches!(error("G90\nG0 Z0.05\nX0 Y0\nX1\nG1 Z-1 F1\n"), LevelError::High { .. }),
        "travel too low"
    );
    assert!(matches!(error("G68 X0\n"), LevelError::Read(_)), "what the reader refuses");
    assert!(matches!(error("G21\n(copper)\nG04 P1\n"), LevelError::NoMotion), "a Gerber file");
    assert!(
        matches!(error("G92 X0\n"), LevelError::Indirect { line: 1, .. }),
        "what can only be followed whole"
    );
    // The pieces of a motion would each take as long as all of it.
    let timed = error("G90\nG0 Z2\nX0 Y0\nG1 Z-1 F1\nG93\nG1 X5 F2\n");
    assert!(matches!(timed, LevelError::Indirect { line: 6, .. }), "{timed}");
    assert!(timed.to_string().contains("the time of a motion (G93)"), "{timed}");
    let summed = error("G90\nG0 Z2*74\nX0 Y0\nG1 Z-1 F1*71\n");
    assert!(matches!(summed, LevelError::Indirect { line: 4, .. }), "{summed}");
    assert!(summed.to_string().contains("a checksum"), "{summed}");
    let inside = level("G90\nG0 Z2\nX0 Y0\nG1 Z-1 F1\nX16.9\n", &map, &Levelling::default());
    assert!(inside.is_ok(), "within the margin: {inside:?}");
    assert!(matches!(HeightMap::through(&[]), Err(MapError::Few { columns: 0, rows: 0 })), "nothing touched");
}

/// One line of a random program.
fn lines() -> impl Strategy<Value = Vec<String>> {
    let at = 0..300_i32;
    let line = prop_oneof![
        (at.clone(), at.clone()).prop_map(|(x, y)| format!(
            "G1 X{}.{} Y{}.{} F200",
            x / 10,
            x % 10,
            y / 10,
            y % 10
        )),
        (at.clone(), at.clone()).prop_map(|(x, y)| format!(
            "G0 Z2\nG0 X{}.{} Y{}\nG1 Z-0.15 F50",
            x / 10,
            x % 10,
            y / 10
        )),
        (1..20_i32).prop_map(|r| format!("G3 I-{}.{} J0 (circle)", r / 10, r % 10)),
        (at.clone(), at).prop_map(|(x, y)| format!("G90 G1 X{}.5 Y{}.25", x / 10, y / 10)),
        (0..9_i32).prop_map(|x| format!("G91\nG1 X0.{x} Y-0.{x}\nG90")),
        (0..9_i32).prop_map(|x| format!("G20\nG1 X0.{x}1 Y.{x}\nG21")),
        Just("M5\nM3 S1000\n; a comment".to_owned()),
        (1..5_i32).prop_map(|x| format!(
            "G0 Z3\nG98 G82 X{x} Y2 Z-1.5 R2.5 P0.1\nX{x}.5\nG80\nG0 Z2\nG0 X5 Y5\nG1 Z-0.1"
        )),
    ];
    prop::collection::vec(line, 1..25)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn a_flat_surface_moves_what_is_low_and_nothing_else(lines in lines(), height in -3..4_i64) {
        let text = format!("G21 G90 G17 G91.1\nG0 Z2\nG0 X5 Y5\nM3 S1000\nG1 Z-0.1 F100\n{}\nG0 Z2\nM5\nM2\n", lines.join("\n"));
        let um = height * 50;
        let height = Nm::from_um(um);
        let flat = map(5, 15.0, |_, _| height.to_mm());
        let done = levelled(&text, &flat);
        prop_assert_eq!(done.added, 0, "nothing is split");
        if height == Nm::ZERO {
            prop_assert_eq!(&done.text, &text, "the same text");
        }
        // Inches are written to a quarter of a micrometre.
        for ((p, z), (place, levelled)) in ends(&text).into_iter().zip(ends(&done.text)) {
            let planned = z.map(|z| if z < done.safe { z + height } else { z });
            prop_assert_eq!(p, place, "x and y stay: {}", done.text);
            let off = planned.zip(levelled).map_or(Nm::ZERO, |(planned, levelled)| (planned - levelled).abs());
            prop_assert!(planned.is_some() == levelled.is_some() && off <= Nm::new(127), "{planned:?}, not {levelled:?}: {}", done.text);
        }
    }

    #[test]
    fn reading_any_map_ends_without_a_panic(text in "[ -~\n]{0,200}", numbers in prop::collection::vec("-?[0-9]{1,3}(\\.[0-9]{0,4})?[ \n,]", 0..60)) {
        drop(HeightMap::read(&text, &Frame::default()));
        drop(HeightMap::read(&numbers.concat(), &Frame::default()));
        drop(HeightMap::read(&format!("<heightmap {text}</heightmap>"), &Frame::default()));
    }
}

#[test]
fn dialects_that_probe_write_a_program_that_touches_every_point_once() {
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator");
    let loaded = import::load(&[board], &Selection::default()).expect("a board");
    let probing = job::Probing {
        side: voromill::board::Side::Front,
        grid: "4x3".parse().expect("a grid"),
        inset: "1mm".parse().expect("a length"),
        depth: "0.5mm".parse().expect("a length"),
        clearance: "1mm".parse().expect("a length"),
        feed: "50mm/min".parse().expect("a feed"),
    };
    for dialect in ALL {
        let options = Options::from_toml("f", &format!("dialect = \"{}\"", dialect.name)).expect("options");
        let settings = Settings::resolve(options).expect("settings");
        let written = job::probe(&loaded, &settings, &probing);
        if !matches!(
            dialect.name.as_ref(),
            "grbl" | "grblhal" | "fluidnc" | "linuxcnc" | "smoothieware" | "tinyg" | "g2core"
        ) {
            let error = written.expect_err("it does not probe").to_string();
            assert!(
                error.contains("grbl or grblhal or fluidnc or linuxcnc or smoothieware or tinyg or g2core"),
                "{error}"
            );
            continue;
        }
        let text = written.expect("a program");
        // Half a millimetre below zero; where the way down counts from where the tool is, which is
        // a millimetre above, further.
        let down = if dialect.name == "smoothieware" { "G38.2 Z-1.5 F50" } else { "G38.2 Z-0.5 F50" };
        assert_eq!(text.matches(down).count(), 12, "four by three: {text}");
        let is_absolute = matches!(dialect.name.as_ref(), "tinyg" | "g2core");
        assert_eq!(text.contains("G28.3 Z0 or G92 Z0"), is_absolute, "how zero is set: {text}");
        assert_eq!(
            text.contains("(PROBEOPEN regulator-front-probe.txt)"),
            dialect.name == "linuxcnc",
            "{text}"
        );
        assert_eq!(
            text.contains("each line with prb"),
            matches!(dialect.name.as_ref(), "tinyg" | "g2core"),
            "what to keep: {text}"
        );
        assert!(!text.contains("M3"), "the spindle stays off");
        accepted_by_linuxcnc(&text, dialect);
    }
}

#[test]
fn g_code_of_the_users_own_stays_as_it_is() {
    // What nobody can follow without the machine, and a cut of its own below the safe height.
    let own = "(own G-code begins)\nG28\nG10 L20 P0 Z0\nG1 X50 Y50 Z-0.1 F50\n(own G-code ends)\n";
    let program = |own: &str| {
        format!("{own}G21 G90\nG0 Z2\n{own}G0 Z2\nG0 X1 Y1\nG1 Z-0.1 F100\nG1 X4\nG0 Z2\n{own}M2\n")
    };
    let map = map(4, 5.0, bump);
    let (plain, with) = (levelled(&program(""), &map), levelled(&program(own), &map));
    assert_eq!(with.text.matches(own).count(), 3, "as it was:\n{}", with.text);
    assert_eq!(with.text.replace(own, ""), plain.text, "and all else as without it");
    assert!(plain.text != program(""), "which is levelled");
}

/// LinuxCNC's own interpreter takes the program, where `LCNC_ROOT` says where LinuxCNC is.
fn accepted_by_linuxcnc(text: &str, dialect: &Dialect) {
    // Skipped where there is no LinuxCNC.
    let Ok(root) = std::env::var("LCNC_ROOT") else { return };
    if dialect.name != "linuxcnc" {
        return;
    }
    let folder = tempfile::TempDir::new().expect("a folder");
    let tools: String = (1..30).map(|tool| format!("T{tool} P{tool} Z0.0 D1.0 ;\n")).collect();
    fs::write(folder.path().join("program.ngc"), text).expect("writable");
    fs::write(folder.path().join("tool.tbl"), tools).expect("writable");
    let done = std::process::Command::new(format!("{root}/usr/bin/rs274"))
        .args(["-g", "-n", "2", "-t", "tool.tbl", "-v", "rs.var", "program.ngc", "out.txt"])
        .env("LD_LIBRARY_PATH", format!("{root}/usr/lib:{root}/usr/lib/x86_64-linux-gnu"))
        .env("PYTHONPATH", format!("{root}/usr/lib/python3/dist-packages"))
        .current_dir(folder.path())
        .output()
        .expect("the interpreter runs");
    assert!(done.status.success(), "{}\n{text}", String::from_utf8_lossy(&done.stderr));
}

#[test]
fn linuxcnc_takes_levelled_programs() {
    let linuxcnc = Dialect::by_name("linuxcnc").expect("built in");
    let map = map(15, 5.0, bump);
    for (_, text) in programs("linuxcnc") {
        accepted_by_linuxcnc(&levelled(&text, &map).text, linuxcnc);
    }
}

#[test]
fn the_command_levels_a_program_and_says_what_it_did() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    let map = fixtures.join("level/grbl.log");
    fs::write(
        folder.path().join("front.nc"),
        "(front)\nG90\nG0 Z2\nX0 Y0\nG1 Z-0.1 F100\nX20 Y10\nG0 Z2\nM2\n",
    )
    .expect("writable");
    let done = voromill(folder.path(), &["level", "front.nc", "--map", &map.to_string_lossy()]);
    assert!(done.status.success(), "{}", stderr(&done));
    let text = fs::read_to_string(folder.path().join("front-levelled.nc")).expect("beside the program");
    assert!(text.contains("(front)\n(levelled by voromill") && text.contains("to grbl.log sha256"), "{text}");
    assert!(text.contains("X20 Y10 Z0.05\n"), "up to 0.15 mm: {text}");
    assert!(stdout(&done).contains("front-levelled.nc: 3 motions below 2.000 mm"), "{}", stdout(&done));
    let twice = voromill(folder.path(), &["level", "front-levelled.nc", "--map", &map.to_string_lossy()]);
    assert_eq!(twice.status.code(), Some(2), "it follows the surface already");
    let said = stderr(&twice);
    assert!(said.contains("line 2: the program is levelled already") && said.contains("hint: "), "{said}");
    let far = voromill(
        folder.path(),
        &["level", "front.nc", "--map", &map.to_string_lossy(), "--map-zero", "0mm,0mm,0mm"],
    );
    assert_eq!(far.status.code(), Some(2), "elsewhere");
    for (option, value) in [("--zero-at", "500mm,0mm"), ("--margin", "-1mm"), ("--tolerance", "0mm")] {
        let asked = format!("{option}={value}");
        let refused =
            voromill(folder.path(), &["level", "front.nc", "--map", &map.to_string_lossy(), &asked]);
        assert_eq!(refused.status.code(), Some(2), "{asked}");
        assert!(stderr(&refused).contains(option), "{}", stderr(&refused));
    }
    assert!(stderr(&far).contains("front.nc: ") && stderr(&far).contains("hint: "), "{}", stderr(&far));
}

#[test]
fn touches_of_one_place_that_agree_are_one_touch() {
    let text = "0 0 0\n1 0 0\n0 1 0\n1 1 0.03\n1 1 0.01\n";
    let (map, _) = HeightMap::read(text, &Frame::default()).expect("a map");
    let corner = Point::new(Nm::from_mm(1), Nm::from_mm(1));
    assert_eq!(map.over(corner), Nm::from_um(10), "the slow touch after the quick one holds");
}

#[test]
fn a_touch_two_millimetres_low_is_refused_by_its_place_unless_it_is_accepted() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/level/one-low.xyz");
    fs::write(folder.path().join("front.nc"), "G90\nG0 Z2\nX5 Y5\nG1 Z-0.1 F100\nX20 Y10\nG0 Z2\nM2\n")
        .expect("writable");
    let level = |more: &[&str]| {
        voromill(folder.path(), &[&["level", "front.nc", "--map", &map.to_string_lossy()], more].concat())
    };
    let refused = level(&[]);
    assert_eq!(refused.status.code(), Some(2), "no cutter goes there");
    let said = stderr(&refused);
    assert!(
        said.contains(
            "one-low.xyz: 1 probed point lies off the plane of the neighbours: x = 10.000 mm, y = 10.000 mm"
        ) && said.contains("at -1.985 mm is 2.0")
            && said.contains("--accept-outliers"),
        "{said}"
    );
    assert!(!folder.path().join("front-levelled.nc").exists(), "nothing is written");
    let accepted = level(&["--accept-outliers"]);
    assert!(accepted.status.success(), "{}", stderr(&accepted));
    assert!(stdout(&accepted).contains("1 probed point lies off"), "it is said still: {}", stdout(&accepted));
}

#[test]
fn the_walkthrough_levels_its_front() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let crate_root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let named = |path: &str| crate_root.join(path).to_string_lossy().into_owned();
    let (board, config) = (named("fixtures/boards/regulator"), named("docs/walkthrough/voromill.toml"));
    let run = |arguments: &[&str]| {
        let done = voromill(folder.path(), arguments);
        assert!(done.status.success(), "{arguments:?}: {}", stderr(&done));
        stdout(&done)
    };
    run(&["mill", &board, "--config", &config, "-o", "out", "--no-html", "--no-verify"]);
    let said = run(&["probe", &board, "--config", &config, "-o", "out/regulator-probe.ngc"]);
    assert!(said.contains("35 points to probe"), "{said}");
    let map = named("docs/walkthrough/regulator.probe");
    let tools = ["endmill-0.4mm", "vbit-0.1mm-20deg"].map(|tool| format!("out/regulator-front-{tool}"));
    for tool in &tools {
        let said = run(&["level", &format!("{tool}.ngc"), "--map", &map]);
        assert!(said.contains("bCNC's probe file, 7 by 5 probed points"), "{said}");
    }
    let [wide, fine] = tools.map(|tool| format!("{tool}-levelled.ngc"));
    run(&["verify", &wide, &fine, "--board", &board]);
}

#[test]
fn the_command_that_probes_lays_the_board_as_milling_does() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator");
    let board = board.to_string_lossy();
    let probe = |more: &[&str]| {
        let done =
            voromill(folder.path(), &[&["probe", &board, "-o", "-", "--probe-grid", "20mm"], more].concat());
        assert!(done.status.success(), "{}", stderr(&done));
        stdout(&done)
    };
    let touches = |text: &str| text.matches("G38.2").count();
    // 60 mm by 40 mm.
    assert_eq!(touches(&probe(&[])), 4 * 3, "every 20 mm");
    assert_eq!(touches(&probe(&["--rotate", "90deg"])), 3 * 4, "turned");
    assert!(probe(&["--rotate", "90deg"]).contains("X40"), "40 mm wide");
    assert!(touches(&probe(&["--tile", "2x1"])) > 4 * 3, "two boards");
    assert!(probe(&["--side", "back", "--mirror-axis", "0mm"]).contains("X-60"), "mirrored about 0");
    for (option, value, key) in [
        ("--probe-depth", "0mm", "probe-depth"),
        ("--probe-clearance", "9mm", "probe-clearance"),
        ("--probe-inset", "30mm", "probe-inset"),
        ("--probe-grid", "1um", "probe-grid"),
        ("--dialect", "marlin", "dialect"),
    ] {
        let done = voromill(folder.path(), &["probe", &board, "-o", "p.ngc", option, value]);
        assert_eq!(done.status.code(), Some(2), "{option} {value}");
        assert!(stderr(&done).starts_with(&format!("error: {key}: ")), "{}", stderr(&done));
    }
}
