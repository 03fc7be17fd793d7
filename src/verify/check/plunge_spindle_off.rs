//! # What it checks
//!
//! The spindle turns whenever the tool is below the surface.
//!
//! # Why
//!
//! A tool that stands still breaks, or drags the board away.
//!
//! # What it can miss
//!
//! Whether the spindle is up to speed: see the dwell after M3 yourself. Spindles switched by hand.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, cut_depth, each_stretch};
use crate::gcode::read::Motion;

pub(in crate::verify) const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("the tool is in material while the spindle is off"),
    effect: Words::of("a tool that does not turn is pressed into the board: it breaks"),
    advice: Words::of("start the spindle (M3 S…) before the first plunge"),
};

pub(super) const CHECK: Check =
    Check { kind: &KIND, run: Run::Motion(|program, _, _| each_stretch(program, NAME, wrong)) };

const NAME: &str = "plunge-spindle-off";

fn wrong(motion: &Motion) -> Option<Wrong> {
    let depth = cut_depth(motion)?;
    let still = !motion.spindle.turns();
    let message = || format!("the tool is {depth:.3} mm below the surface and the spindle is off");
    still.then(|| Wrong { severity: Severity::Error, message: message(), size: Some(depth) })
}
