//! # What it checks
//!
//! In one turn of the spindle a drill goes on by no more than an eighth of its width, an end mill
//! by no more than half, and a V-bit by no more than the width that it cuts.
//!
//! # Why
//!
//! Tools for boards bear a tenth of their width in a turn, those of hardened steel less. What is
//! far more breaks them. It comes of inches a minute read as millimetres or the other way round, a
//! feed for travel left in force, or a spindle speed that lacks a zero.
//!
//! # What it can miss
//!
//! A feed that is too fast by less. How fast a spindle turns whose speed is set by hand, or by
//! S1000 or S255, which are full speed on controllers that were not told otherwise: it is taken to
//! be as fast as any.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, cut_depth, found, once, place};
use crate::gcode::read::{Motion, Spindle};
use crate::geometry::Nm;
use crate::verify::followed::Followed;
use crate::verify::report::Finding;
use crate::verify::{Cutter, CutterKind};

pub(in crate::verify) const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a feed that the tool does not bear"),
    effect: Words::of("the tool is driven into material faster than it can cut: it breaks"),
    advice: Words::of("check F and its unit, and the spindle speed S ({feed}, {plunge}, {spindle})"),
};

pub(super) const CHECK: Check =
    Check { kind: &KIND, run: Run::Motion(|program, _, _| check(&program.followed)) };

const NAME: &str = "feed-per-turn";

/// Revolutions per minute of a spindle whose speed nobody tells. Chosen: that of a fast one for
/// boards.
const FAST: u32 = 60_000;

/// What is full speed, however fast that is, where nobody has set the controller up: of Grbl ($30),
/// and of firmware that has S set the duty cycle.
const FULL: [u32; 2] = [1_000, 255];

fn check(program: &Followed) -> Vec<Finding> {
    once(program.listing.motions.iter().filter_map(|motion| wrong(motion, program)), "motions")
}

fn wrong(motion: &Motion, program: &Followed) -> Option<Finding> {
    let depth = cut_depth(motion).filter(|_| !lifts(motion))?;
    let cutter = program.tools.at(motion.line)?;
    let (step, message) = too_fast(motion, cutter, depth)?;
    let wrong = Wrong { severity: Severity::Warning, message, size: Some(step) };
    Some(found(program, NAME, wrong, place(program, motion), motion.line))
}

/// Whether it goes straight up, through what is cut already.
fn lifts(motion: &Motion) -> bool {
    motion.from.point() == motion.to.point() && motion.from.z < motion.to.z
}

/// How far a tool that cuts so deep goes in a turn, in words, too, where it bears that not.
pub(in crate::verify) fn too_fast(motion: &Motion, cutter: Cutter, depth: Nm) -> Option<(Nm, String)> {
    let (turns, how) = match motion.spindle {
        Spindle::Off | Spindle::At(0) => return None,
        Spindle::At(turns) if !FULL.contains(&turns) => (turns, "at"),
        Spindle::Unstated | Spindle::At(_) => (FAST, "even at"),
    };
    let feed = motion.feed.filter(|feed| *feed > 0)?;
    let step = Nm::try_new(feed / i64::from(turns)).unwrap_or(Nm::MAX);
    let width = cutter.width_at(depth);
    let feed = (feed + 500_000) / 1_000_000;
    let message = || {
        format!("a cut {width:.3} mm wide at {feed} mm/min: {how} {turns} rpm that is {step:.3} mm in a turn")
    };
    (step > most(cutter, width)).then(|| (step, message()))
}

/// How far a tool may go in a turn. Chosen: an end mill with two teeth takes a quarter of its width
/// with each, and a drill as a whole an eighth, several times what the makers of any allow; in
/// copper V-bits are seen to bear more.
fn most(cutter: Cutter, width: Nm) -> Nm {
    match cutter.kind {
        CutterKind::VBit => width,
        CutterKind::EndMill => width / 2,
        CutterKind::Drill => width / 8,
    }
}
