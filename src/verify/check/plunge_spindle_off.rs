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
//!
//! # Sources
//!
//! The firmwares, for what M3 does before the first S: Grbl 1.1h, grblHAL (f80fc34), FluidNC 4.0;
//! the manual of LinuxCNC.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, cut_depth, each_stretch};
use crate::gcode::read::{Motion, Spindle};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("the tool is in material while the spindle is off"),
    effect: Words::of("a tool that does not turn is pressed into the board: it breaks"),
    advice: Words::of("start the spindle (M3 S…) before the first plunge"),
};

pub(super) const CHECK: Check = Check {
    kind: &KIND,
    run: Run::Program(|program, _| {
        let controller = program.controller.as_deref().filter(|name| AT_ZERO.contains(name));
        each_stretch(program, NAME, |motion| wrong(motion, controller))
    }),
};

const NAME: &str = "plunge-spindle-off";

/// Controllers whose speed is zero until the first S: after M3 alone the spindle stands.
const AT_ZERO: &[&str] = &["grbl", "grblhal", "fluidnc", "linuxcnc"];

fn wrong(motion: &Motion, at_zero: Option<&str>) -> Option<Wrong> {
    let depth = cut_depth(motion)?;
    let (severity, message) = match (motion.spindle, at_zero) {
        (Spindle::Unstated, Some(name)) => {
            let what = format!("the spindle is on without a speed (S): {name} begins with S0, and it stands");
            (Severity::Warning, what)
        }
        (spindle, _) if !spindle.turns() => {
            let what = format!("the tool is {depth:.3} mm below the surface and the spindle is off");
            (Severity::Error, what)
        }
        _ => return None,
    };
    Some(Wrong { severity, message, size: Some(depth) })
}
