//! Programs, good and bad, and what is found in them.

use std::path::{Path, PathBuf};

use voromill::board::{Board, Side};
use voromill::gcode::read::{self, Listing, Motion, Way};
use voromill::geometry::{Nm, Turn};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Part};
use voromill::verify::{Placement, Program, Report, Role, Settings, Severity, verify};

fn fixture(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(path)
}

fn load(files: &[&str]) -> import::Loaded {
    let paths: Vec<PathBuf> = files.iter().map(|file| fixture(file)).collect();
    import::load(&paths, &Selection::default()).expect("a board")
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
    Program { file: file.to_owned(), text, role, cutter, placement: None }
}

const FRONT: Option<Role> = Some(Role::Isolation(Side::Front));

#[test]
fn loops_of_straight_lines_isolate() {
    let board = load(&["verify/pads-F_Cu.gbr"]).board;
    let report = judge(&board, foreign("loops.nc", text("verify/loops.nc"), "endmill:0.2mm", FRONT));
    assert_eq!(names(&report, Severity::Info), [""; 0], "{:?}", report.findings);
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
    // The kerf reaches 0.1 mm beyond its middle, which runs 0.95 mm from the middle of a pad of 1 mm.
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
}

/// A program of ours with all that is known of it, as motions.
struct Milled {
    program: Program,
    listing: Listing,
    tool: String,
}

fn mill(board: &str) -> (Board, Vec<Milled>) {
    let settings = job::Settings::resolve(Options::default()).expect("the defaults");
    let job = job::mill(load(&[board]), &settings).expect("a job");
    let milled = job.programs.iter().filter_map(|written| {
        let side = match written.part {
            Part::Front => Side::Front,
            Part::Back => Side::Back,
            _ => return None,
        };
        let layer = job.layers.iter().find(|layer| layer.side == side)?;
        let (shift, mirror) = (layer.placement.shift, layer.placement.mirror);
        let program = Program {
            file: format!("{side}.ngc"),
            text: written.text.clone(),
            role: Some(Role::Isolation(side)),
            cutter: None,
            placement: Some(Placement { shift, mirror, ..Placement::default() }),
        };
        let listing = read::read(&written.text).expect("our own");
        Some(Milled { program, listing, tool: settings.isolation_tool.kind.to_string() })
    });
    let milled = milled.collect();
    (job.board.clone(), milled)
}

/// Motions as a program, every word written out.
fn written(motions: &[Motion], tool: &str) -> String {
    let mut text = format!("(tool 1: {tool})\nG21 G90\n");
    for motion in motions {
        let word = |letter: char, value: Option<Nm>| value.map_or(String::new(), |v| format!(" {letter}{v}"));
        let (x, y, z) = (word('X', motion.to.x), word('Y', motion.to.y), word('Z', motion.to.z));
        text += if motion.spindle.is_some() { "M3 S10000\n" } else { "M5\n" };
        text += &match motion.way {
            Way::Rapid => format!("G0{x}{y}{z}\n"),
            Way::Feed => format!("G1{x}{y}{z} F100\n"),
            Way::Arc { center, turn } => {
                let from = motion.from.point().expect("a place");
                let word = if turn == Turn::Clockwise { "G2" } else { "G3" };
                format!("{word}{x}{y}{z} I{} J{} F100\n", center.x - from.x, center.y - from.y)
            }
        };
    }
    text + "M5\nM2\n"
}

/// Where paths begin and end: the first motion below the surface, and the lift after.
fn paths(motions: &[Motion]) -> Vec<(usize, usize)> {
    let below = |motion: &Motion| motion.to.z.is_some_and(|z| z < Nm::ZERO);
    let mut found = Vec::new();
    let mut start = None;
    for (index, motion) in motions.iter().enumerate() {
        match (start, below(motion)) {
            (None, true) => start = Some(index),
            (Some(first), false) => {
                found.push((first, index));
                start = None;
            }
            _ => {}
        }
    }
    found
}

/// Numbers that look random and are the same every time (Knuth's MMIX generator).
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).expect("31 bits") % count
    }
}

/// Does one thing wrong; says what, and what may be found then.
fn mutate(motions: &mut Vec<Motion>, dice: &mut Dice) -> (String, &'static [&'static str]) {
    let mut all = paths(motions);
    // Something must come after a path for a lift that is left out to matter.
    all.retain(|(_, last)| last + 1 < motions.len());
    let (first, last) = all[dice.below(all.len())];
    let raise = |motion: &mut Motion, z: Nm| {
        for place in [&mut motion.from, &mut motion.to] {
            place.z = place.z.map(|own| if own < Nm::ZERO { z } else { own });
        }
    };
    match dice.below(6) {
        0 => {
            motions.drain(first..last);
            (format!("path {first}..{last} deleted"), &["short"])
        }
        1 => {
            // The way between lifts without its second half: lifted where it stops.
            let middle = first + (last - first).div_ceil(2);
            motions.drain(middle.max(first + 1)..last);
            (format!("path {first}..{last} cut short at {middle}"), &["short"])
        }
        2 => {
            let by = Nm::from_um(400 + i64::try_from(dice.below(400)).expect("small"));
            for motion in &mut motions[first.saturating_sub(1)..last] {
                motion.to.x = motion.to.x.map(|x| x + by);
                motion.from.x = motion.from.x.map(|x| x + by);
                if let Way::Arc { center, .. } = &mut motion.way {
                    center.x += by;
                }
            }
            (format!("path {first}..{last} shifted by {by}"), &["short", "gouge", "open", "destroyed"])
        }
        3 => {
            motions[first..last].iter_mut().for_each(|motion| raise(motion, Nm::from_um(-20)));
            (format!("path {first}..{last} too shallow"), &["short"])
        }
        4 => {
            motions[first..last].iter_mut().for_each(|motion| raise(motion, Nm::from_mm(-3)));
            (format!("path {first}..{last} too deep"), &["gouge"])
        }
        _ => {
            let z = motions[last - 1].to.z;
            motions[last].to.z = z;
            motions[last].from.z = z;
            if let Some(next) = motions.get_mut(last + 1) {
                next.from.z = z;
                next.to.z = z;
            }
            (format!("lift after {first}..{last} left out"), &["rapid-in-material"])
        }
    }
}

#[test]
fn what_harms_copper_is_found_and_named_and_nothing_in_the_unmutated() {
    let mut dice = Dice(2005);
    let (mut missed, mut tried) = (Vec::new(), 0);
    for (board, rounds) in [("boards/blinker", 120), ("boards/regulator", 80)] {
        let (board, milled) = mill(board);
        for Milled { program, listing, tool } in &milled {
            let clean = Program { text: written(&listing.motions, tool), ..program.clone() };
            let report = judge(&board, clean);
            assert_eq!(names(&report, Severity::Warning), [""; 0], "{}: {:?}", program.file, report.findings);
            for _ in 0..rounds / milled.len() {
                tried += 1;
                let mut motions = listing.motions.clone();
                let (what, expected) = mutate(&mut motions, &mut dice);
                let wrong = Program { text: written(&motions, tool), ..program.clone() };
                let found = names(&judge(&board, wrong), Severity::Warning);
                if !found.iter().any(|name| expected.contains(name)) {
                    missed.push(format!("{} {}: {what}: found {found:?}", board.name, program.file));
                }
            }
        }
    }
    // A cut that goes too deep, or a lift left out, where there is room on both sides harms no copper and is not seen.
    assert!(missed.len() * 15 <= tried, "{} of {tried} missed:\n{}", missed.len(), missed.join("\n"));
}
