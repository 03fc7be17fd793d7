//! Programs that clear copper, whole and spoilt: what is left is told where, and how much.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "places counted in a small area"
)]

use std::path::{Path, PathBuf};

use voromill::board::{Board, Side};
use voromill::geometry::{Arc, Nm, Point};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Part, Settings};
use voromill::topology::{self, Method};
use voromill::verify::{self, Finding, Program, Role, Severity, verify};

use crate::cli::{stdout, voromill};
use crate::oracle;

/// The program for the back of the blinker, in its files' coordinates.
fn made(options: &str) -> (Board, String) {
    milled("blinker", options)
}

/// A board of the fixtures with nothing left that was to be cleared, and the program for its back.
fn milled(name: &str, wanted: &str) -> (Board, String) {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(name);
    let loaded = import::load(&[path], &Selection::default()).expect("a board");
    let board = loaded.board.clone();
    let options = Options::from_toml("voromill.toml", &format!("origin = \"keep\"\n{wanted}"));
    let settings = Settings::resolve(options.expect("settings")).expect("settings that make sense");
    let job = job::mill(loaded, &settings).expect("a job");
    let report = job.verify(&settings).expect("a verdict");
    let left: Vec<&Finding> = report.findings.iter().filter(|found| found.name == "copper-left").collect();
    assert!(left.is_empty(), "{name}: {wanted}: {left:?}");
    let program = job.programs.into_iter().find(|program| program.part == Part::Back).expect("a back");
    (board, program.text)
}

/// What is wrong with it by this check.
fn found(board: &Board, text: &str, check: &str) -> Vec<Finding> {
    let role = Some(Role::Isolation(Side::Back));
    let program = Program { file: "it".to_owned(), text: text.to_owned(), role, ..Program::default() };
    let report = verify(&[program], board, &[], &verify::Settings::default()).expect("it can be judged");
    report.findings.into_iter().filter(|found| found.name == check).collect()
}

/// The words of a line by their letters.
fn word(line: &str, letter: char) -> Option<f64> {
    let found = line.split(' ').find_map(|word| word.strip_prefix(letter));
    found.and_then(|number| number.parse().ok())
}

/// A stretch at depth: its lines, and the chords of its ways in millimetres.
struct Stretch {
    lines: std::ops::Range<usize>,
    chords: Vec<[(f64, f64); 2]>,
}

/// The stretches between coming down and going up.
fn stretches(text: &str) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = Vec::new();
    let (mut at, mut is_down) = ((0.0, 0.0), false);
    for (number, line) in text.lines().enumerate() {
        if let Some(z) = word(line, 'Z') {
            if z < 0.0 && !is_down {
                all.push(Stretch { lines: number + 1..number + 1, chords: Vec::new() });
            }
            is_down = z < 0.0;
            continue;
        }
        if !line.starts_with('G') || (word(line, 'X').is_none() && word(line, 'Y').is_none()) {
            continue;
        }
        let to = (word(line, 'X').unwrap_or(at.0), word(line, 'Y').unwrap_or(at.1));
        let last = all.last_mut().filter(|_| is_down);
        if let Some(stretch) = last {
            stretch.lines.end = number + 1;
            stretch.chords.extend(chords(line, at, to));
        }
        at = to;
    }
    all
}

/// A way as chords.
fn chords(line: &str, from: (f64, f64), to: (f64, f64)) -> Vec<[(f64, f64); 2]> {
    let point = |(x, y): (f64, f64)| Point::from_f64(x * 1e6, y * 1e6);
    let turn = match line.split(' ').next() {
        Some("G2") => voromill::geometry::Turn::Clockwise,
        Some("G3") => voromill::geometry::Turn::CounterClockwise,
        _ => return vec![[from, to]],
    };
    let center = (from.0 + word(line, 'I').unwrap_or_default(), from.1 + word(line, 'J').unwrap_or_default());
    let arc = Arc { start: point(from), end: point(to), center: point(center), turn };
    let mut at = from;
    let next = |p: Point| {
        let next = (p.x.to_f64() / 1e6, p.y.to_f64() / 1e6);
        [std::mem::replace(&mut at, next), next]
    };
    arc.flatten(Nm::from_um(1)).map(next).collect()
}

/// Places in the area 40 µm apart, each with the stretches that clear it: half a kerf of 0.1 mm.
fn cleared(stretches: &[Stretch], area: [f64; 4]) -> Vec<Vec<usize>> {
    let half = 0.1;
    let [left, bottom, width, height] = area;
    let (columns, rows) = ((width / PITCH) as usize, (height / PITCH) as usize);
    let mut by: Vec<Vec<usize>> = vec![Vec::new(); columns * rows];
    for (number, stretch) in stretches.iter().enumerate() {
        for &[a, b] in &stretch.chords {
            let range = |low: f64, high: f64, start: f64, count: usize| {
                let first = ((low - half - start) / PITCH).ceil().max(0.0) as usize;
                first..(((high + half - start) / PITCH).floor() + 1.0).clamp(0.0, count as f64) as usize
            };
            for row in range(a.1.min(b.1), a.1.max(b.1), bottom, rows) {
                for column in range(a.0.min(b.0), a.0.max(b.0), left, columns) {
                    let p = [left + column as f64 * PITCH, bottom + row as f64 * PITCH];
                    let known = &mut by[row * columns + column];
                    if known.last() != Some(&number)
                        && oracle::polyline::to_chord(p, a.into(), b.into()) <= half
                    {
                        known.push(number);
                    }
                }
            }
        }
    }
    by
}

const PITCH: f64 = 0.04;

/// An area of the blinker, lower left corner, width and height in millimetres: about its middle, so
/// that it lies where it lies when the board is mirrored.
const AREA: [f64; 4] = [14.32, 8.0, 12.0, 12.0];

fn in_area() -> String {
    let [x, y, width, height] = AREA;
    format!("clear-area = \"{x}mm,{y}mm,{width}mm,{height}mm\"\ntool = \"endmill:0.2mm\"\n")
}

#[test]
fn a_stretch_that_is_left_out_is_found_where_nothing_else_clears_its_place() {
    let (board, text) = made(&in_area());
    let all = stretches(&text);
    let places = cleared(&all, AREA);
    let lines: Vec<&str> = text.lines().collect();
    let (mut harmful, mut harmless) = (0, 0);
    // Each takes a while: those that clear most by themselves, and some others.
    let alone = |number: usize| places.iter().filter(|by| by.as_slice() == [number]).count();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by_key(|&number| std::cmp::Reverse(alone(number)));
    let looked_at = order.iter().enumerate().filter(|(rank, _)| *rank < 6 || rank % 16 == 0);
    for (number, stretch) in looked_at.map(|(_, &number)| (number, &all[number])) {
        let alone = alone(number);
        let mm2 = alone as f64 * PITCH * PITCH;
        let without = |line: &usize| !stretch.lines.contains(line);
        let spoilt: Vec<&str> = (0..lines.len()).filter(without).map(|line| lines[line]).collect();
        let found = found(&board, &(spoilt.join("\n") + "\n"), "copper-left");
        if mm2 > 0.3 {
            harmful += 1;
            assert!(!found.is_empty(), "{:?}: {mm2} mm²", stretch.lines);
        } else if alone == 0 {
            harmless += 1;
            assert_eq!(found, [], "{:?}: others clear it", stretch.lines);
        }
    }
    assert!(harmful >= 3, "{harmful} of {} harm, {harmless} do not", all.len());
}

#[test]
fn a_spoilt_stretch_leaves_copper_of_about_the_right_area() {
    let (board, text) = made(&in_area());
    let all = stretches(&text);
    let places = cleared(&all, AREA);
    let area =
        |number: usize| places.iter().filter(|by| by.as_slice() == [number]).count() as f64 * PITCH * PITCH;
    let longest = (0..all.len()).max_by(|&a, &b| area(a).total_cmp(&area(b))).expect("a stretch");
    let lines: Vec<&str> = text.lines().collect();
    let spoil = |change: &dyn Fn(usize, &str) -> Option<String>| -> String {
        let changed = lines.iter().enumerate().filter_map(|(number, line)| {
            if all[longest].lines.contains(&number) { change(number, line) } else { Some((*line).to_owned()) }
        });
        changed.map(|line| line + "\n").collect()
    };
    let sum = |text: &str| -> f64 {
        found(&board, text, "copper-left").iter().filter_map(|found| found.area).sum()
    };
    assert!(sum(&text) < 1e-9, "as it is nothing is left");
    let gone = sum(&spoil(&|_, _| None));
    // What is no longer swept lies partly beside copper, where the tool does not reach.
    assert!(gone > area(longest) * 0.5 && gone < area(longest) * 1.2, "{gone} of {}", area(longest));
    let shift = |line: &str, letter: char, by: f64| {
        let word = |word: &str| match word.strip_prefix(letter).and_then(|value| value.parse::<f64>().ok()) {
            Some(value) => format!("{letter}{:.4}", value + by),
            None => word.to_owned(),
        };
        line.split(' ').map(word).collect::<Vec<_>>().join(" ")
    };
    // From where it comes down.
    let moved = |letter: char, by: f64| -> String {
        let lines = lines.iter().enumerate().map(|(number, line)| {
            let is_it =
                (all[longest].lines.start.saturating_sub(4)..all[longest].lines.end).contains(&number);
            if is_it { shift(line, letter, by) } else { (*line).to_owned() }
        });
        lines.map(|line| line + "\n").collect()
    };
    let middle = all[longest].lines.start + all[longest].lines.len() / 2;
    let spoilt = [
        ("shifted right", moved('X', 0.15)),
        ("shifted down", moved('Y', -0.15)),
        ("cut short", spoil(&|number, line| (number < middle).then(|| line.to_owned()))),
        ("a finer tool", text.replace("endmill:0.2mm", "endmill:0.15mm")),
        ("not deep enough", text.replace("Z-0.1", "Z-0.03")),
        ("a hundredth smaller", text.lines().map(|line| smaller(line) + "\n").collect()),
    ];
    for (how, spoilt) in spoilt {
        assert_ne!(spoilt, text, "{how}: it is changed");
        let left = sum(&spoilt);
        let is_without_cuts = how == "not deep enough";
        assert!(left > 0.02 || is_without_cuts, "{how}: {left} mm² are left");
    }
}

/// The same line, its coordinates smaller by a hundredth.
fn smaller(line: &str) -> String {
    let word = |word: &str| {
        let number = word.get(1..).and_then(|number| number.parse::<f64>().ok());
        match (word.chars().next(), number) {
            (Some(letter @ ('X' | 'Y' | 'I' | 'J')), Some(number)) => format!("{letter}{:.4}", number * 0.99),
            _ => word.to_owned(),
        }
    };
    line.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// With tools of all kinds nothing is left, of all, of areas, of regions and within a distance.
#[test]
fn what_is_cleared_is_clear() {
    for tool in ["\"endmill:0.2mm\"", "\"vbit:0.1mm:60deg\"", "[\"endmill:0.8mm\", \"vbit:0.1mm:30deg\"]"] {
        let kept = "\nkeep-area = \"18mm,12mm,3mm,3mm\"";
        for options in ["clear = true", "clear-nets = \"VCC\"", "distance-for = \"VCC=2mm\"", &in_area()] {
            let options = options.split("\ntool").next().expect("some");
            made(&format!("tool = {tool}\n{options}"));
            made(&format!("tool = {tool}\n{options}{kept}"));
        }
    }
}

/// Nor in space that one net encloses, where the outline strategy has no loops, beside copper that
/// only the finer of two V-bits comes nearer to, where a boundary stays uncut, or along the edge.
#[test]
fn what_is_cleared_is_clear_whatever_else_is_cut() {
    for (tool, options) in [
        ("\"endmill:0.4mm\"", "strategy = \"outline\"\ndistance-for = \"*=1.5mm\""),
        ("\"endmill:0.4mm\"", "strategy = \"outline\"\nwidth = \"0.9mm\"\ndistance-for = \"*=1.5mm\""),
        ("[\"vbit:0.1mm:90deg\", \"vbit:0.1mm:60deg\"]", "distance-for = \"GND=2mm\""),
        ("\"vbit:0.1mm:90deg\"", "passes = 5\nnarrow = \"skip\"\ndistance-for = \"GND=0.75mm\""),
        ("\"endmill:0.6mm\"", "clear = true"),
        ("\"endmill:0.8mm\"", "clear-nets = \"*\""),
    ] {
        for board in ["blinker", "regulator"] {
            milled(board, &format!("tool = {tool}\n{options}"));
        }
    }
}

#[test]
fn passes_that_share_much_of_the_kerf_leave_no_strip_beside_copper() {
    // Some gaps of the board are wider than the kerf, and too narrow for two passes side by side.
    for overlap in ["0%", "30%", "45%", "60%"] {
        made(&format!("tool = \"endmill:0.2mm\"\noverlap = \"{overlap}\"\nclear = true"));
    }
}

#[test]
fn copper_within_a_distance_for_high_voltages_is_an_error() {
    let (board, text) = made("distance-for = \"VCC=1.5mm\"\ntool = \"endmill:0.2mm\"");
    assert_eq!(found(&board, &text, "copper-left"), [], "nothing is left");
    let further = text.replace("(distance-for VCC=1.5mm)", "(distance-for VCC=3mm)");
    assert_ne!(further, text, "its header says how far");
    let left = found(&board, &further, "copper-left");
    assert!(!left.is_empty() && left.iter().all(|found| found.severity == Severity::Error), "{left:?}");
    let copper = board.back.as_ref().expect("a back");
    let nets = topology::recover(copper, Method::Contact);
    for found in &left {
        let (x, y) = found.at.expect("a place").to_f64();
        let all = oracle::distance::distances(copper, &nets, x, y);
        let names = nets.nets().iter().map(|net| net.names.iter().any(|name| name == "VCC"));
        let own = all.iter().zip(names).filter(|(_, is_own)| *is_own).map(|(distance, _)| *distance);
        let nearest = own.fold(f64::INFINITY, f64::min);
        assert!((1.5e6..3e6).contains(&nearest), "{nearest} nm from VCC");
    }
}

#[test]
fn nets_that_the_design_has_too_near_are_told() {
    let (board, text) = made("distance-for = \"OUT=1mm\"\ntool = \"endmill:0.2mm\"");
    let near = found(&board, &text, "net-too-near");
    let gap = near.iter().find(|found| found.nets.contains(&"VCC".to_owned())).expect("it is beside VCC");
    let width = gap.size.expect("a width").to_f64();
    assert!((width - 363_200.0).abs() < 100.0, "the smallest gap, as inspect says: {width}");
    let (board, text) = made("distance-for = \"OUT=0.3mm\"\ntool = \"endmill:0.2mm\"");
    assert_eq!(found(&board, &text, "net-too-near"), [], "0.3 mm are kept");
}

#[test]
fn a_program_that_does_not_say_what_was_asked_for_is_told_by_options() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let board = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/boards/blinker");
    let (_, text) = made("");
    let program = folder.path().join("back.ngc");
    std::fs::write(&program, text).expect("written");
    let verify = |more: &[&str]| {
        let program = program.to_str().expect("a name");
        let all = [&["verify", program, "--board", board, "--side", "back"], more].concat();
        stdout(&voromill(folder.path(), &all))
    };
    assert!(!verify(&[]).contains("copper-left"), "nothing was asked for");
    for more in [&["--clear"][..], &["--clear-area", "14.32mm,8mm,12mm,12mm"], &["--clear-nets", "VCC"]] {
        assert!(verify(more).contains("copper-left"), "{more:?}");
    }
    let kept = ["--clear-area", "14.32mm,8mm,12mm,12mm", "--keep-area", "9mm,3mm,22mm,22mm"];
    assert!(!verify(&kept).contains("copper-left"), "all of it is kept");
    let far = verify(&["--distance-for", "VCC=2mm", "--deny", "error"]);
    assert!(far.contains("error") && far.contains("net-too-near"), "{far}");
}

/// A layer of two rectangles, one of them with a hole.
const LAYER: &str = "%FSLAX46Y46*%\n%MOMM*%\nG01*\n%LPD*%\nG36*\nX14000000Y8000000D02*\nX20000000D01*\n\
    Y14000000D01*\nX14000000D01*\nY8000000D01*\nG37*\n%LPC*%\nG36*\nX16000000Y10000000D02*\nX18000000D01*\n\
    Y12000000D01*\nX16000000D01*\nY10000000D01*\nG37*\n%LPD*%\nG36*\nX25000000Y8000000D02*\nX28000000D01*\n\
    Y14000000D01*\nX25000000D01*\nY8000000D01*\nG37*\nM02*\n";

#[test]
fn a_layer_or_a_drawing_says_what_is_cleared_and_kept() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let board = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/boards/blinker");
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40mm\" height=\"30mm\" viewBox=\"0 0 40 30\">\
               <rect x=\"14\" y=\"10\" width=\"8\" height=\"8\"/></svg>";
    let empty = "%FSLAX46Y46*%\n%MOMM*%\nG01*\nM02*\n";
    for (file, text) in [("mask.gbr", LAYER), ("mask.svg", svg), ("empty.gbr", empty)] {
        std::fs::write(folder.path().join(file), text).expect("written");
    }
    let mill = |out: &str, more: &[&str]| {
        let all = [&["mill", board, "-o", out, "--tool", "endmill:0.4mm", "--no-html"], more].concat();
        voromill(folder.path(), &all)
    };
    let cut = |out: &str| {
        let text = std::fs::read_to_string(folder.path().join(out).join("blinker-back.ngc"));
        let text = text.expect("a program");
        let cuts: Vec<&str> = text.lines().filter(|line| !line.starts_with('(')).collect();
        cuts.join("\n")
    };
    // What the layer covers, as rectangles: the same cuts.
    let rectangles = ["--clear-area", "14mm,8mm,6mm,6mm", "--clear-area", "25mm,8mm,3mm,6mm"];
    let hole = ["--keep-area", "16mm,10mm,2mm,2mm"];
    assert!(mill("plain", &[&rectangles[..], &hole].concat()).status.success(), "rectangles");
    let kept = mill("kept", &["--clear-area", "mask.gbr", "--keep-area", "16mm,10mm,2mm,2mm"]);
    assert!(kept.status.success() && !stdout(&kept).contains("copper-left"), "{}", stdout(&kept));
    let layer = mill("layer", &["--clear-area", "mask.gbr"]);
    assert!(layer.status.success() && !stdout(&layer).contains("copper-left"), "{}", stdout(&layer));
    let whole = [&rectangles[..], &[]].concat();
    assert!(mill("whole", &whole).status.success(), "without a hole");
    assert_ne!(cut("layer"), cut("whole"), "its hole is not cleared");
    let drawn = mill("drawn", &["--clear-area", "mask.svg", "--keep-area", "mask.gbr"]);
    assert!(drawn.status.success() && !stdout(&drawn).contains("copper-left"), "{}", stdout(&drawn));
    // Whoever verifies the program must give the layer.
    let verify = |more: &[&str]| {
        let all = [&["verify", "layer/blinker-back.ngc", "--board", board, "-v"], more].concat();
        stdout(&voromill(folder.path(), &all))
    };
    assert!(verify(&[]).contains("`mask.gbr` says where"), "{}", verify(&[]));
    assert!(!verify(&["--clear-area", "mask.gbr"]).contains("copper-left"), "it is clear");
    assert!(verify(&["--clear-area", "14mm,8mm,6mm,6mm"]).contains("copper-left"), "not in its hole");
    for (file, said) in [("empty.gbr", "empty.gbr"), ("none.gbr", "none.gbr"), ("1mm,2mm", "1mm,2mm")] {
        let done = mill("no", &["--clear-area", file]);
        let told = String::from_utf8_lossy(&done.stderr).into_owned();
        assert!(!done.status.success() && told.contains(said), "{file}: {told}");
    }
}
