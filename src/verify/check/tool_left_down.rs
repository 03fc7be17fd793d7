//! # What it checks
//!
//! The tool is above the board where a program waits for a person, and at its end.
//!
//! # Why
//!
//! A tool that is taken out of the spindle in a hole breaks, and what starts next goes sideways
//! through the board.
//!
//! # What it can miss
//!
//! Pauses that are macros of the controller.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, found, place};
use crate::gcode::read::{Stop, Waits};
use crate::geometry::Nm;
use crate::verify::followed::Followed;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a tool that is left in the board"),
    effect: Words::of("it breaks when it is taken out, or when the machine goes on sideways"),
    advice: Words::of("retract before each pause and at the end"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(|program, _| check(program)) };

const NAME: &str = "tool-left-down";

fn check(program: &Followed) -> Vec<Finding> {
    let finding = |before: usize, line: Option<u32>, does: &str| {
        let last = program.listing.motions[..before].last()?;
        let depth = -last.to.z.filter(|z| *z < Nm::ZERO)?;
        let message = format!("it {does} with the tool {depth:.3} mm below the surface");
        let wrong = Wrong { severity: Severity::Warning, message, size: Some(depth) };
        Some(found(program, NAME, wrong, place(program, last), line.unwrap_or(last.line)))
    };
    let pause = |stop: &Stop| finding(stop.before, Some(stop.line), "waits");
    let pauses = program.listing.stops.iter().filter(|stop| stop.waits != Waits::Perhaps).filter_map(pause);
    pauses.chain(finding(program.listing.motions.len(), None, "ends")).collect()
}
