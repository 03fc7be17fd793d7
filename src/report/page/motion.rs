//! A program as the page plays it: the motions that its text, read back, makes over the board.

use serde::Serialize;

use crate::board::Side;
use crate::gcode::ReadError;
use crate::gcode::read::{self, Listing, Motion, Way};
use crate::geometry::{Nm, Point};
use crate::verify::{Cutter, Placement};

use super::boundary::letter;
use crate::report::ink::{Ink, place, um};

/// A program's text with what is known of it.
#[derive(Clone, Debug)]
pub struct Machined<'a> {
    /// Its file's name.
    pub file: String,
    /// Its text.
    pub text: &'a str,
    /// For each line of the text its number in the file, where that has others between.
    pub lines: Option<Vec<u32>>,
    /// The tool, where the text names none.
    pub cutter: Option<Cutter>,
    /// The side it isolates; none for drilling and cutting out.
    pub side: Option<Side>,
    /// What it is for: `front`, `drill`.
    pub part: &'static str,
    /// How the board lies.
    pub placement: Placement,
    /// How long it takes, in seconds.
    pub seconds: f64,
    /// The speed of a rapid, in millimetres per minute.
    pub rapid: f64,
    /// The tools with the way that each cuts and its time.
    pub tools: Vec<ToolUse>,
}

/// What a tool does in a program.
#[derive(Clone, Debug, Serialize)]
pub struct ToolUse {
    /// Its number.
    pub number: u32,
    /// What it is.
    pub name: String,
    /// The way it cuts, in millimetres.
    pub cut_mm: f64,
    /// How long it moves.
    pub seconds: f64,
}

/// A program to be drawn and played.
#[derive(Clone, Debug, Serialize)]
pub struct ProgramDrawing {
    /// Its file's name.
    pub file: String,
    /// What it is for.
    pub part: &'static str,
    /// The side it isolates.
    pub side: Option<Side>,
    /// How long it takes, in seconds.
    pub seconds: f64,
    /// The speed of a rapid, in millimetres per minute.
    pub rapid: f64,
    /// Its tools.
    pub tools: Vec<ToolUse>,
    /// The cutters in the order in which they come: width at the tip, and how much wider for each
    /// unit of depth.
    pub cutters: Vec<(i64, f64)>,
    /// Its motions.
    ///
    /// `s x y z` is where it begins; `r dx dy` a rapid, `f dx dy` a feed, `a dx dy i j` an arc
    /// against the clock and `c` with it, the centre from the start. What holds from the next
    /// motion on: `z height`, `v feed` in mm/min, `t cutter`. `n lines` is how many lines of text
    /// lie between the next motion and the one before, where that is not one.
    pub motions: String,
}

/// Reads a program back and lays it over the board.
///
/// # Errors
///
/// [`ReadError`] where the text cannot be followed.
pub(super) fn drawing(program: &Machined<'_>) -> Result<ProgramDrawing, ReadError> {
    let listing = read::read(&read::without_own_code(program.text))?;
    let mut cutters = cutters(program.text);
    if cutters.is_empty() {
        cutters.extend(program.cutter.map(|cutter| (1, cutter)));
    }
    Ok(ProgramDrawing {
        file: program.file.clone(),
        part: program.part,
        side: program.side,
        seconds: program.seconds,
        rapid: program.rapid,
        tools: program.tools.clone(),
        motions: motions(&listing, program, &cutters),
        cutters: cutters.iter().map(|(_, cutter)| (um(cutter.tip), widening(cutter))).collect(),
    })
}

/// How much wider a cutter is for each unit of depth, in thousandths.
fn widening(cutter: &Cutter) -> f64 {
    let metre = Nm::from_mm(100);
    let wider = (cutter.width_at(metre) - cutter.tip).to_f64() / metre.to_f64();
    (wider * 1000.0).round() / 1000.0
}

/// The cutters that the comments of a program name, each with the line from which it is in the
/// spindle.
fn cutters(text: &str) -> Vec<(u32, Cutter)> {
    let named = |line: &str| {
        let (_, tool) = line.split_once("tool ")?;
        tool.split([' ', ')']).rfind(|word| !word.is_empty())?.parse().ok()
    };
    let mut cutters: Vec<(u32, Cutter)> =
        (1..).zip(read::lines(text)).filter_map(|(number, line)| Some((number, named(line)?))).collect();
    // The header names the tool too.
    cutters.dedup_by_key(|(_, cutter)| *cutter);
    cutters
}

fn motions(listing: &Listing, program: &Machined<'_>, cutters: &[(u32, Cutter)]) -> String {
    let (placement, lines) = (&program.placement, program.lines.as_deref());
    let mut pen = Pen { ink: Ink::default(), placement, lines, now: None };
    for motion in &listing.motions {
        let cutter = cutters.partition_point(|(line, _)| *line <= motion.line).saturating_sub(1);
        pen.motion(motion, cutter);
    }
    pen.ink.into_text()
}

/// What holds after a motion.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Now {
    z: i64,
    feed: i64,
    cutter: usize,
    line: u32,
}

struct Pen<'a> {
    ink: Ink,
    placement: &'a Placement,
    lines: Option<&'a [u32]>,
    now: Option<Now>,
}

impl Pen<'_> {
    fn motion(&mut self, motion: &Motion, cutter: usize) {
        let (Some(to), Some(z)) = (motion.to.point(), motion.to.z) else { return };
        let (to, z) = (self.over(to), um(z));
        let in_file = |lines: &[u32]| lines.get(motion.line as usize - 1).copied();
        let line = self.lines.and_then(in_file).unwrap_or(motion.line);
        let Some(mut now) = self.now else {
            self.ink.put('t', &[index(cutter)]);
            self.ink.put('n', &[i64::from(line)]);
            self.ink.step('s', to, &[z]);
            self.now = Some(Now { z, feed: 0, cutter, line });
            return;
        };
        let feed = motion.feed.map_or(0, |feed| feed / 1_000_000);
        if now.z != z {
            self.ink.put('z', &[z]);
        }
        if now.feed != feed && motion.way != Way::Rapid {
            now.feed = feed;
            self.ink.put('v', &[feed]);
        }
        if now.cutter != cutter {
            self.ink.put('t', &[index(cutter)]);
        }
        if line != now.line + 1 {
            self.ink.put('n', &[i64::from(line) - i64::from(now.line)]);
        }
        self.now = Some(Now { z, cutter, line, ..now });
        match motion.way {
            Way::Rapid => self.ink.step('r', to, &[]),
            Way::Feed => self.ink.step('f', to, &[]),
            Way::Arc { center, turn } => {
                let turn = if self.placement.mirror.is_some() { turn.reversed() } else { turn };
                let [i, j] = self.ink.to(self.over(center));
                self.ink.step(letter(turn), to, &[i, j]);
            }
        }
    }

    /// A point of the machine on the board.
    fn over(&self, p: Point) -> [i64; 2] {
        place(self.placement.undo(p))
    }
}

fn index(cutter: usize) -> i64 {
    i64::try_from(cutter).unwrap_or(0)
}
