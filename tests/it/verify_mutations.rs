//! Programs of ours, spoilt in one place: what is wrong is found and named, and nothing where
//! nothing is wrong.

use std::path::Path;

use rayon::prelude::*;
use voromill::board::{Board, Side};
use voromill::gcode::read::{self, Motion, Way};
use voromill::geometry::{Nm, Point, Turn};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Part};
use voromill::topology::Nets;
use voromill::verify::{Finding, Known, Placement, Program, Role, Settings, Severity, verify};

/// A board with the program that isolates it, as motions.
struct Milled {
    board: Board,
    nets: Nets,
    placement: Placement,
    motions: Vec<Motion>,
    tool: String,
    /// Half the kerf.
    half: f64,
}

fn mill(tool: &str) -> Milled {
    let file = |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/verify").join(name);
    let files = [file("seven-F_Cu.gbr"), file("seven-Edge_Cuts.gbr")];
    let options = Options { tool: vec![tool.parse().expect("a tool")], ..Options::default() };
    let settings = job::Settings::resolve(options).expect("settings");
    let loaded = import::load(&files, &Selection::default()).expect("a board");
    let mut job = job::mill(loaded, &settings).expect("a job");
    let written = job.programs.iter().find(|written| written.part == Part::Front).expect("a front");
    let motions = read::read(&written.text).expect("our own").motions;
    let layer = job.layers.remove(0);
    let placement = Placement { shift: layer.placement.shift, ..Placement::default() };
    let half = settings.kerf().to_f64() / 2.0;
    Milled { board: job.board, nets: layer.nets, placement, motions, tool: tool.to_owned(), half }
}

impl Milled {
    fn judge(&self, motions: &[Motion], tool: &str) -> Vec<Finding> {
        let program = Program {
            file: "front.ngc".to_owned(),
            text: written(motions, tool),
            role: Some(Role::Isolation(Side::Front)),
            cutter: None,
            placement: Some(self.placement),
            ..Program::default()
        };
        let known = [Known { side: Side::Front, nets: &self.nets }];
        let report = verify(&[program], &self.board, &known, &Settings::default());
        report.expect("it can be judged").findings
    }
}

/// Motions as a program, every word written out.
fn written(motions: &[Motion], tool: &str) -> String {
    let mut text = format!("(tool 1: {tool})\nG21 G90\n");
    for motion in motions {
        let word = |letter: char, value: Option<Nm>| value.map_or(String::new(), |v| format!(" {letter}{v}"));
        let (x, y, z) = (word('X', motion.to.x), word('Y', motion.to.y), word('Z', motion.to.z));
        text += if motion.spindle.turns() { "M3 S10000\n" } else { "M5\n" };
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

/// What is done wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fault {
    Deleted,
    CutShort,
    Shifted,
    WrongTool,
    TooShallow,
    TooDeep,
    RapidLowered,
    Bridged,
    Displaced,
}

const FAULTS: [Fault; 9] = [
    Fault::Deleted,
    Fault::CutShort,
    Fault::Shifted,
    Fault::WrongTool,
    Fault::TooShallow,
    Fault::TooDeep,
    Fault::RapidLowered,
    Fault::Bridged,
    Fault::Displaced,
];

impl Fault {
    /// What of it may be found; one of these must be.
    const fn names(self) -> &'static [&'static str] {
        match self {
            Self::Deleted | Self::CutShort | Self::TooShallow | Self::Bridged => &["short"],
            Self::Shifted => &["short", "gouge", "open", "destroyed"],
            Self::WrongTool | Self::Displaced => &["gouge"],
            Self::TooDeep => &["too-deep"],
            Self::RapidLowered => &["rapid-in-material"],
        }
    }
}

/// The width of a bridge at the surface.
const BRIDGE: f64 = 20_000.0;

/// How much wider it is at the bottom of copper of 35 µm, where a V-bit of 30° is narrower by the
/// tangent of 15° on either side.
const FLARE: f64 = 18_756.0;

/// Does one thing wrong; where that has one, the place.
fn spoil(milled: &Milled, fault: Fault, dice: &mut Dice) -> (Vec<Motion>, Option<Point>) {
    let mut motions = milled.motions.clone();
    let all = paths(&motions);
    let (first, last) = all[dice.below(all.len())];
    let raise = |motion: &mut Motion, z: Nm| {
        for place in [&mut motion.from, &mut motion.to] {
            place.z = place.z.map(|own| if own < Nm::ZERO { z } else { own });
        }
    };
    match fault {
        Fault::Deleted => drop(motions.drain(first..last)),
        // Lifted where it is half done.
        Fault::CutShort => drop(motions.drain(first + (last - first).div_ceil(2).max(1)..last)),
        Fault::Shifted => {
            let by = Nm::from_um(400 + i64::try_from(dice.below(400)).expect("small"));
            motions[first.saturating_sub(1)..last].iter_mut().for_each(|motion| displace(motion, by));
        }
        Fault::WrongTool => {}
        Fault::Displaced => {
            // All of it, by more than a track is wide.
            let by = Nm::from_um(450 + i64::try_from(dice.below(1000)).expect("small"));
            motions.iter_mut().for_each(|motion| displace(motion, by));
        }
        Fault::TooShallow => {
            motions[first..last].iter_mut().for_each(|motion| raise(motion, Nm::from_um(-20)))
        }
        Fault::TooDeep => motions[first..last].iter_mut().for_each(|motion| raise(motion, Nm::from_mm(-1))),
        Fault::RapidLowered => {
            let (first, _) = all[1 + dice.below(all.len() - 1)];
            // Before the plunge: the rapid to where it is.
            let z = motions[first].to.z;
            motions[first - 1].from.z = z;
            motions[first - 1].to.z = z;
        }
        Fault::Bridged => return bridge(milled, dice),
    }
    (motions, None)
}

/// Moves a motion to the right.
fn displace(motion: &mut Motion, by: Nm) {
    motion.to.x = motion.to.x.map(|x| x + by);
    motion.from.x = motion.from.x.map(|x| x + by);
    if let Way::Arc { center, .. } = &mut motion.way {
        center.x += by;
    }
}

/// Lifts the tool within a straight cut, so that the kerf has a gap.
fn bridge(milled: &Milled, dice: &mut Dice) -> (Vec<Motion>, Option<Point>) {
    let gap = milled.half * 2.0 + BRIDGE;
    let ends = |motion: &Motion| {
        let level = motion.way == Way::Feed && motion.from.z == motion.to.z && motion.to.z < Some(Nm::ZERO);
        Some((motion.from.point()?, motion.to.point()?)).filter(|_| level)
    };
    // What is cut twice, or at whose middle another cut passes, is not open by a gap.
    let apart = |index: usize, middle: Point| {
        let others = milled.motions.iter().enumerate().filter(|(other, _)| *other != index);
        let below = others.filter(|(_, motion)| motion.to.z.is_some_and(|z| z < Nm::ZERO));
        let near = |motion: &Motion| {
            let (Some(a), Some(b)) = (motion.from.point(), motion.to.point()) else { return false };
            from_segment(middle, a, b) < gap * 1.5
        };
        !below.into_iter().any(|(_, motion)| near(motion))
    };
    let middle = |(a, b): (Point, Point)| a.midpoint(b);
    let candidates: Vec<usize> = (0..milled.motions.len())
        .filter(|&index| {
            let ends = ends(&milled.motions[index]);
            ends.is_some_and(|ends| ends.0.distance(ends.1) > gap * 2.0 && apart(index, middle(ends)))
        })
        .collect();
    let index = candidates[dice.below(candidates.len())];
    let mut motions = milled.motions.clone();
    let whole = motions[index];
    let (a, b) = ends(&whole).expect("a candidate");
    let at = |way: f64| {
        let part = way / a.distance(b);
        let (x, y) = a.to_f64();
        Point::from_f64(x + (b.x - a.x).to_f64() * part, y + (b.y - a.y).to_f64() * part)
    };
    let half = a.distance(b) / 2.0;
    let place = |p: Point, z: Option<Nm>| read::Place { x: Some(p.x), y: Some(p.y), z };
    let (stop, go) = (at(half - gap / 2.0), at(half + gap / 2.0));
    let (up, down) = (Some(Nm::from_mm(2)), whole.to.z);
    let motion = |way: Way, from: read::Place, to: read::Place| Motion { way, from, to, ..whole };
    let instead = [
        motion(Way::Feed, whole.from, place(stop, down)),
        motion(Way::Rapid, place(stop, down), place(stop, up)),
        motion(Way::Rapid, place(stop, up), place(go, up)),
        motion(Way::Feed, place(go, up), place(go, down)),
        motion(Way::Feed, place(go, down), whole.to),
    ];
    motions.splice(index..=index, instead);
    (motions, Some(milled.placement.undo(a.midpoint(b))))
}

fn from_segment(p: Point, a: Point, b: Point) -> f64 {
    let ((px, py), (ax, ay), (bx, by)) = (p.to_f64(), a.to_f64(), b.to_f64());
    let (ux, uy) = (bx - ax, by - ay);
    let squared = (ux * ux + uy * uy).max(1.0);
    let along = (((px - ax) * ux + (py - ay) * uy) / squared).clamp(0.0, 1.0);
    let (dx, dy) = (px - ax - ux * along, py - ay - uy * along);
    (dx * dx + dy * dy).sqrt()
}

/// What is wrong with the judgement of a spoilt program; nothing where the fault was found and
/// named.
fn missed(milled: &Milled, round: usize) -> Option<String> {
    let fault = FAULTS[round % FAULTS.len()];
    let mut dice = Dice(2005 + u64::try_from(round).expect("small"));
    dice.below(2);
    let (motions, place) = spoil(milled, fault, &mut dice);
    let wider = format!("endmill:{}mm", 0.5 + 0.1 * f64::from(u8::try_from(dice.below(5)).expect("small")));
    let tool = if fault == Fault::WrongTool { &wider } else { &milled.tool };
    let findings = milled.judge(&motions, tool);
    let serious = findings.iter().filter(|finding| finding.severity >= Severity::Warning);
    let mut named = serious.filter(|finding| fault.names().contains(&finding.name));
    let found = match place {
        None => named.next().is_some(),
        // A bridge has its place and its width, which is that at the bottom of the copper.
        Some(place) => named.any(|finding| {
            let bridge = if milled.tool.starts_with("vbit") { BRIDGE + FLARE } else { BRIDGE };
            let width = finding.size.map_or(0.0, Nm::to_f64);
            let off = finding.at.map_or(f64::INFINITY, |at| at.distance(place));
            (width - bridge).abs() < 2_000.0 && off < 50_000.0
        }),
    };
    let names: Vec<_> = findings.iter().map(|f| (f.name, f.message.as_str())).collect();
    (!found).then(|| format!("{} {round} {fault:?} at {place:?}: found {names:?}", milled.tool))
}

#[test]
fn every_fault_is_found_and_named_and_nothing_in_what_is_right() {
    let mut tried = 0;
    for tool in ["vbit:0.1mm:30deg", "endmill:0.2mm"] {
        let milled = mill(tool);
        let clean = milled.judge(&milled.motions, tool);
        assert_eq!(clean, [], "nothing is wrong with the program for {tool}");
        let rounds = 0..117_usize;
        tried += rounds.len();
        let missed: Vec<String> = rounds.into_par_iter().filter_map(|round| missed(&milled, round)).collect();
        assert!(missed.is_empty(), "{} missed:\n{}", missed.len(), missed.join("\n"));
    }
    assert!(tried >= 200, "only {tried} were tried");
}
