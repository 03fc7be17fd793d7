//! What is looked for: a file each, listed in [`ALL`].

mod destroyed;
mod feed_missing;
mod gouge;
mod hole_extra;
mod hole_missing;
mod hole_size;
mod minimum_width;
mod open;
mod outside_stock;
mod overtravel;
mod plunge_spindle_off;
mod rapid_in_material;
mod recut;
mod revision;
mod short;
mod sliver;
mod tab_missing;
mod too_deep;
mod unclear;

use crate::board::{Board, Hole, Shape};
use crate::gcode::read::Motion;
use crate::geometry::{Nm, Point};

use super::machining::{Machining, Plunge};
use super::report::Finding;
use super::sheet::Sheet;
use super::{Input, Program, Settings, Severity};

/// A thing that is looked for.
pub struct Check {
    /// Its stable name, which its findings carry.
    pub name: &'static str,
    /// What it finds, in a line.
    pub about: &'static str,
    run: Run,
}

/// What a check is shown.
enum Run {
    /// The motions of any program.
    Motion(fn(&Machining, &Board, &Settings) -> Vec<Finding>),
    /// A side, milled.
    Isolation(fn(&Sheet<'_>, &Settings) -> Vec<Finding>),
    /// All drilling programs together.
    Drilling(fn(&[&Machining], &Board, &Settings) -> Vec<Finding>),
    /// All programs that cut out together.
    Cutout(fn(&[&Machining], &Board, &Settings) -> Vec<Finding>),
    /// A program's text, and the board's files.
    Inputs(fn(&Program, &[Input]) -> Vec<Finding>),
}

/// Every check.
pub const ALL: &[Check] = &[
    short::CHECK,
    open::CHECK,
    destroyed::CHECK,
    gouge::CHECK,
    minimum_width::CHECK,
    sliver::CHECK,
    recut::CHECK,
    too_deep::CHECK,
    rapid_in_material::CHECK,
    plunge_spindle_off::CHECK,
    feed_missing::CHECK,
    outside_stock::CHECK,
    overtravel::CHECK,
    hole_missing::CHECK,
    hole_extra::CHECK,
    hole_size::CHECK,
    tab_missing::CHECK,
    revision::CHECK,
    unclear::CHECK,
];

/// The checks of any program.
pub(super) fn motion(program: &Machining, board: &Board, settings: &Settings) -> Vec<Finding> {
    let run = |check: &Check| match check.run {
        Run::Motion(run) => run(program, board, settings),
        Run::Isolation(_) | Run::Drilling(_) | Run::Cutout(_) | Run::Inputs(_) => Vec::new(),
    };
    ALL.iter().flat_map(run).collect()
}

/// The checks of a milled side.
pub(super) fn isolation(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let run = |check: &Check| match check.run {
        Run::Isolation(run) => run(sheet, settings),
        Run::Motion(_) | Run::Drilling(_) | Run::Cutout(_) | Run::Inputs(_) => Vec::new(),
    };
    ALL.iter().flat_map(run).map(|finding| Finding { side: Some(sheet.side), ..finding }).collect()
}

/// The checks of what is drilled.
pub(super) fn drilling(programs: &[&Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    let run = |check: &Check| match check.run {
        Run::Drilling(run) => run(programs, board, settings),
        Run::Motion(_) | Run::Isolation(_) | Run::Cutout(_) | Run::Inputs(_) => Vec::new(),
    };
    ALL.iter().flat_map(run).collect()
}

/// The checks of what is cut out.
pub(super) fn cutout(programs: &[&Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    let run = |check: &Check| match check.run {
        Run::Cutout(run) => run(programs, board, settings),
        Run::Motion(_) | Run::Isolation(_) | Run::Drilling(_) | Run::Inputs(_) => Vec::new(),
    };
    ALL.iter().flat_map(run).collect()
}

/// The checks of what a program was made from.
pub(super) fn inputs(program: &Program, inputs: &[Input]) -> Vec<Finding> {
    let run = |check: &Check| match check.run {
        Run::Inputs(run) => run(program, inputs),
        Run::Motion(_) | Run::Isolation(_) | Run::Drilling(_) | Run::Cutout(_) => Vec::new(),
    };
    ALL.iter().flat_map(run).collect()
}

/// What is wrong with a motion.
struct Wrong {
    severity: Severity,
    message: String,
    /// How much, in words of the check; none where it is wrong or not.
    size: Option<Nm>,
}

/// The findings of a check of single motions: one for each stretch of lines that are wrong one after another, as large as the largest.
fn each_stretch(
    program: &Machining,
    name: &'static str,
    wrong: impl Fn(&Motion) -> Option<Wrong>,
) -> Vec<Finding> {
    let mut findings: Vec<Finding> = Vec::new();
    let mut last: Option<(usize, Severity)> = None;
    for (index, motion) in program.motions.iter().enumerate() {
        let Some(Wrong { severity, message, size }) = wrong(motion) else { continue };
        let follows = last.is_some_and(|(before, same)| before + 1 == index && same == severity);
        last = Some((index, severity));
        if let Some(begun) = findings.last_mut().filter(|_| follows) {
            if size > begun.size {
                (begun.size, begun.message) = (size, message);
            }
            continue;
        }
        findings.push(Finding {
            at: motion.to.point().or_else(|| motion.from.point()).map(|p| program.placement.undo(p)),
            program: Some(program.file.clone()),
            line: Some(motion.line),
            size,
            ..Finding::new(name, severity, message)
        });
    }
    findings
}

/// So many pixels in mm².
#[expect(clippy::cast_precision_loss, reason = "a display figure")]
fn area(pixels: usize, pitch: Nm) -> f64 {
    pixels as f64 * pitch.to_mm() * pitch.to_mm()
}

/// The middles of `count` equal parts of a way, each with the part's length in nanometres; nothing where it only goes down.
pub(super) fn along(way: &Shape, count: u32) -> Vec<(Point, f64)> {
    let spread = |length: f64, at: &dyn Fn(f64) -> (f64, f64)| {
        let parts = (0..count).map(|i| at((f64::from(i) + 0.5) / f64::from(count)));
        parts.map(|(x, y)| (Point::from_f64(x, y), length / f64::from(count))).collect()
    };
    match way {
        Shape::Stroke { from, to, .. } => {
            let ((x, y), way) = (from.to_f64(), *to - *from);
            spread(way.length(), &|f| (x + way.x.to_f64() * f, y + way.y.to_f64() * f))
        }
        Shape::Arc { arc, .. } => spread(arc.radius() * arc.sweep().abs(), &|f| arc.at(f)),
        Shape::Disc { .. } | Shape::Polygon(_) => Vec::new(),
    }
}

/// How far a point is from where a hole's cutter goes, in nanometres.
fn from_hole(hole: &Hole, p: Point) -> f64 {
    let points = hole.path.flatten(Nm::from_um(5));
    let to_point = p.distance(points[0]);
    points.windows(2).map(|pair| from_segment(p, pair[0], pair[1])).fold(to_point, f64::min)
}

/// The distance from a point to a segment, in nanometres.
fn from_segment(p: Point, a: Point, b: Point) -> f64 {
    let ((px, py), (ax, ay), (bx, by)) = (p.to_f64(), a.to_f64(), b.to_f64());
    let (ux, uy) = (bx - ax, by - ay);
    let squared = ux * ux + uy * uy;
    let along =
        if squared > 0.0 { (((px - ax) * ux + (py - ay) * uy) / squared).clamp(0.0, 1.0) } else { 0.0 };
    let (dx, dy) = (px - ax - ux * along, py - ay - uy * along);
    (dx * dx + dy * dy).sqrt()
}

/// All plunges of all programs with the program that each belongs to.
fn plunges<'a>(programs: &[&'a Machining]) -> impl Iterator<Item = (&'a Machining, Plunge)> {
    programs.iter().copied().flat_map(|program| program.plunges.iter().map(move |&plunge| (program, plunge)))
}
