//! What is looked for: a file each, listed in [`ALL`].

mod alignment_hole;
mod board_gouged;
mod board_left;
mod code_after_end;
mod copper_left;
mod destroyed;
mod drill_sideways;
mod dwell_length;
mod feed_missing;
mod feed_per_turn;
mod gouge;
mod hole_depth;
mod hole_extra;
mod hole_in_copper;
mod hole_missing;
mod hole_place;
mod hole_size;
mod minimum_width;
mod mirror_image;
mod net_too_near;
mod not_judged;
mod not_through;
mod open;
mod outside_stock;
mod overtravel;
mod pass_too_deep;
mod plunge_spindle_off;
mod program_missing;
mod rapid_in_material;
mod recut;
mod revision;
mod ring_missing;
mod short;
mod sliver;
mod spindle_left_on;
mod tab_extra;
mod tab_missing;
mod tab_spread;
mod tab_thin;
mod too_deep;
mod tool_left_down;
mod tool_not_changed;
mod unclear;
mod word_not_taken;
mod zero_differs;

pub(super) use feed_per_turn::{KIND as FEED_PER_TURN, too_fast};
pub use gouge::KIND as GOUGE;
pub(super) use overtravel::of_text as overtravel;
pub(super) use pass_too_deep::{KIND as PASS_TOO_DEEP, MOST as MOST_DIAMETERS};
pub(super) use rapid_in_material::KIND as RAPID_IN_MATERIAL;
pub(super) use revision::KIND as REVISION;

use rustc_hash::FxHashMap;

use crate::board::diagnostic::Stage;
use crate::board::{Board, Diagnostic, Shape, Words};
use crate::gcode::read::{Motion, Way};
use crate::geometry::{self, Arc, Nm, Point, Rect};

use super::bores::{Bore, Bores, Made};
use super::contours::Contours;
use super::drilled::Drilled;
use super::followed::Followed;
use super::machining::Machining;
use super::outcome::Outcome;
use super::report::Finding;
use super::{Input, Program, Settings, Severity};

/// A thing that is looked for.
pub struct Check {
    /// What it finds: the code of its findings, what it does to the board, what to try.
    pub kind: &'static Diagnostic,
    run: Run,
}

/// What a check is shown.
enum Run {
    /// A program, whatever it mills.
    Program(fn(&Followed, &Settings) -> Vec<Finding>),
    /// A program that mills a board.
    Motion(fn(&Machining, &Board, &Settings) -> Vec<Finding>),
    /// A side, milled.
    Isolation(fn(&Outcome<'_>, &Settings) -> Vec<Finding>),
    /// The board's holes, drilled.
    Drilling(fn(&Bores<'_>, &Board, &Settings) -> Vec<Finding>),
    /// A side's copper, drilled.
    Drilled(fn(&Drilled<'_, '_>, &Settings) -> Vec<Finding>),
    /// The board's outline, cut out.
    Cutout(fn(&Contours<'_>, &Board, &Settings) -> Vec<Finding>),
    /// All programs that drill holes on whose pins the board is flipped, and the x of the machine
    /// about which the others have it flipped.
    Alignment(fn(&[&Machining], Option<Nm>, &Board, &Settings) -> Vec<Finding>),
    /// All programs together.
    Whole(fn(&[Machining], &Board, &Settings) -> Vec<Finding>),
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
    copper_left::CHECK,
    net_too_near::CHECK,
    recut::CHECK,
    not_judged::CHECK,
    too_deep::CHECK,
    rapid_in_material::CHECK,
    plunge_spindle_off::CHECK,
    spindle_left_on::CHECK,
    tool_left_down::CHECK,
    feed_missing::CHECK,
    feed_per_turn::CHECK,
    pass_too_deep::CHECK,
    drill_sideways::CHECK,
    tool_not_changed::CHECK,
    code_after_end::CHECK,
    zero_differs::CHECK,
    mirror_image::CHECK,
    outside_stock::CHECK,
    overtravel::CHECK,
    hole_missing::CHECK,
    hole_extra::CHECK,
    hole_place::CHECK,
    hole_size::CHECK,
    hole_depth::CHECK,
    hole_in_copper::CHECK,
    ring_missing::CHECK,
    alignment_hole::CHECK,
    board_gouged::CHECK,
    board_left::CHECK,
    not_through::CHECK,
    tab_missing::CHECK,
    revision::CHECK,
    unclear::CHECK,
    word_not_taken::CHECK,
    dwell_length::CHECK,
    tab_extra::CHECK,
    tab_thin::CHECK,
    tab_spread::CHECK,
    program_missing::CHECK,
];

/// The check of this name.
#[must_use]
pub fn of(name: &str) -> Option<&'static Check> {
    ALL.iter().find(|check| check.kind.code == name)
}

/// The checks of any program, whatever it mills.
pub(super) fn any(program: &Followed, settings: &Settings) -> Vec<Finding> {
    each(|check| {
        let Run::Program(run) = check else { return None };
        Some(run(program, settings))
    })
}

/// Those, and the checks of any program that mills a board.
pub(super) fn motion(program: &Machining, board: &Board, settings: &Settings) -> Vec<Finding> {
    each(|check| match check {
        Run::Program(run) => Some(run(&program.followed, settings)),
        Run::Motion(run) => Some(run(program, board, settings)),
        _ => None,
    })
}

/// The checks of a milled side, and of what holes leave of its copper.
pub(super) fn isolation(sheet: &Outcome<'_>, drilled: &Drilled<'_, '_>, settings: &Settings) -> Vec<Finding> {
    let mut findings = each(|check| match check {
        Run::Isolation(run) => Some(run(sheet, settings)),
        Run::Drilled(run) => Some(run(drilled, settings)),
        _ => None,
    });
    findings.iter_mut().for_each(|finding| finding.side = Some(sheet.side));
    findings
}

/// The checks of what is drilled.
pub(super) fn drilling(bores: &Bores<'_>, board: &Board, settings: &Settings) -> Vec<Finding> {
    each(|check| {
        let Run::Drilling(run) = check else { return None };
        Some(run(bores, board, settings))
    })
}

/// The checks of what is cut out.
pub(super) fn cutout(contours: &Contours<'_>, board: &Board, settings: &Settings) -> Vec<Finding> {
    each(|check| {
        let Run::Cutout(run) = check else { return None };
        Some(run(contours, board, settings))
    })
}

/// The checks of holes on whose pins the board is flipped, as other programs have it about this x
/// of the machine.
pub(super) fn alignment(
    programs: &[&Machining],
    mirror: Option<Nm>,
    board: &Board,
    settings: &Settings,
) -> Vec<Finding> {
    each(|check| {
        let Run::Alignment(run) = check else { return None };
        Some(run(programs, mirror, board, settings))
    })
}

/// The checks of all programs together.
pub(super) fn whole(programs: &[Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    each(|check| {
        let Run::Whole(run) = check else { return None };
        Some(run(programs, board, settings))
    })
}

/// The checks of what a program was made from.
pub(super) fn inputs(program: &Program, inputs: &[Input]) -> Vec<Finding> {
    each(|check| {
        let Run::Inputs(run) = check else { return None };
        Some(run(program, inputs))
    })
}

/// What all checks find that `run` runs.
fn each(run: impl Fn(&Run) -> Option<Vec<Finding>>) -> Vec<Finding> {
    ALL.iter().filter_map(|check| run(&check.run)).flatten().collect()
}

/// A finding about a hole as it is made.
fn hole(
    bore: &Bore<'_>,
    made: &Made<'_>,
    name: &'static str,
    severity: Severity,
    message: String,
) -> Finding {
    Finding {
        at: Some(bore.hole.path.start),
        program: Some(made.cut.program.followed.file.clone()),
        line: Some(made.cut.swept.line),
        ..Finding::new(name, severity, message)
    }
}

/// What is wrong with a motion.
struct Wrong {
    severity: Severity,
    message: String,
    /// How much, in words of the check; none where it is wrong or not.
    size: Option<Nm>,
}

/// Where a motion ends on the board, or else begins; none where that is not known.
fn place(program: &Followed, motion: &Motion) -> Option<Point> {
    motion.to.point().or_else(|| motion.from.point()).map(|p| program.placement.undo(p))
}

/// The findings of a check of single motions, as [`stretches`] has them.
fn each_stretch(
    program: &Followed,
    name: &'static str,
    mut wrong: impl FnMut(&Motion) -> Option<Wrong>,
) -> Vec<Finding> {
    let all = program
        .listing
        .motions
        .iter()
        .map(|motion| wrong(motion).map(|wrong| (wrong, place(program, motion), motion.line)));
    stretches(program, name, all)
}

/// The findings of what may be wrong each with a place and a line, in order: one for each stretch
/// that is wrong without a break, as large as the largest.
fn stretches(
    program: &Followed,
    name: &'static str,
    all: impl Iterator<Item = Option<(Wrong, Option<Point>, u32)>>,
) -> Vec<Finding> {
    let mut findings: Vec<Finding> = Vec::new();
    let mut last: Option<(usize, Severity)> = None;
    for (index, wrong) in all.enumerate() {
        let Some((Wrong { severity, message, size }, at, line)) = wrong else { continue };
        let follows = last.is_some_and(|(before, same)| before + 1 == index && same == severity);
        last = Some((index, severity));
        if let Some(begun) = findings.last_mut().filter(|_| follows) {
            if size > begun.size {
                (begun.size, begun.message) = (size, message);
            }
            continue;
        }
        findings.push(found(program, name, Wrong { severity, message, size }, at, line));
    }
    findings
}

/// The finding of what is wrong in a line of a program.
fn found(
    program: &Followed,
    name: &'static str,
    Wrong { severity, message, size }: Wrong,
    at: Option<Point>,
    line: u32,
) -> Finding {
    Finding {
        at,
        program: Some(program.file.clone()),
        line: Some(line),
        size,
        ..Finding::new(name, severity, message)
    }
}

/// Findings that say the same as one, where the first is, with how many `things` there are.
fn once(findings: impl IntoIterator<Item = Finding>, things: &str) -> Vec<Finding> {
    let mut known: FxHashMap<String, usize> = FxHashMap::default();
    let mut counted: Vec<(Finding, u32)> = Vec::new();
    for finding in findings {
        let at = *known.entry(finding.message.clone()).or_insert(counted.len());
        match counted.get_mut(at) {
            Some((_, count)) => *count += 1,
            None => counted.push((finding, 1)),
        }
    }
    let message = |(mut finding, count): (Finding, u32)| {
        finding.message += &often(count, things);
        finding
    };
    counted.into_iter().map(message).collect()
}

/// How many `things` a sentence is about, behind it; nothing for one.
fn often(count: u32, things: &str) -> String {
    if count > 1 { format!(" ({count} {things})") } else { String::new() }
}

/// The rectangle that a motion stays in; none where it ends nobody knows where.
fn bounds(motion: &Motion) -> Option<Rect> {
    let to = motion.to.point()?;
    let from = motion.from.point().unwrap_or(to);
    Some(match motion.way {
        Way::Arc { center, turn } => Arc { start: from, end: to, center, turn }.bounds(),
        Way::Rapid | Way::Feed => Rect::new(from, from).union(Rect::new(to, to)),
    })
}

/// How deep below the surface a motion cuts; none for a rapid, and for what stays above.
pub(super) fn cut_depth(motion: &Motion) -> Option<Nm> {
    deepest(motion).filter(|depth| *depth > Nm::ZERO && motion.way != Way::Rapid)
}

/// How deep the end of the cutter goes in a motion; none where no height is known.
fn deepest(motion: &Motion) -> Option<Nm> {
    [motion.from.z, motion.to.z].into_iter().flatten().min().map(|lowest| -lowest)
}

/// So many pixels in mm².
#[expect(clippy::cast_precision_loss, reason = "a display figure")]
fn area(pixels: usize, pitch: Nm) -> f64 {
    pixels as f64 * pitch.to_mm() * pitch.to_mm()
}

/// The middles of `count` equal parts of a way, each with the part's length in nanometres; nothing
/// where it only goes down.
pub(super) fn along(way: &Shape, count: u32) -> Vec<(Point, f64)> {
    let spread = |length: f64, at: &dyn Fn(f64) -> (f64, f64)| {
        let parts = (0..count).map(|i| at((f64::from(i) + 0.5) / f64::from(count)));
        parts.map(|(x, y)| (Point::from_f64(x, y), length / f64::from(count))).collect()
    };
    match way {
        Shape::Stroke { from, to, .. } => {
            spread(from.distance(*to), &|f| geometry::between(from.to_f64(), to.to_f64(), f))
        }
        Shape::Arc { arc, .. } => spread(arc.radius() * arc.sweep().abs(), &|f| arc.at(f)),
        Shape::Disc { .. } | Shape::Polygon(_) => Vec::new(),
    }
}
