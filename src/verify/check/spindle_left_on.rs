//! # What it checks
//!
//! The spindle stands while a program waits for a person, and after its end.
//!
//! # Why
//!
//! A person reaches for the tool, or for the board. M0 only holds the feed.
//!
//! # What it can miss
//!
//! Pauses that are macros of the controller. An optional stop (M1) and M6 count as their controller
//! has it: M6 stops the spindle where it waits.
//!
//! # Sources
//!
//! Grbl 1.1h for M0; NIST RS274/NGC version 3 §3.6.1 for M2 and M30, which stop the spindle.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, found, once};
use crate::gcode::read::{Place, Stop};
use crate::verify::followed::Followed;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a spindle that turns while somebody reaches for the tool"),
    effect: Words::of("whoever changes the tool or takes the board out is hurt, or the tool is broken"),
    advice: Words::of("switch the spindle off (M5) before each pause and at the end"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(|program, _| check(program)) };

const NAME: &str = "spindle-left-on";

fn check(program: &Followed) -> Vec<Finding> {
    let finding = |before: usize, line: Option<u32>, message: &str| {
        let last = program.listing.motions[..before].last();
        let line = line.or(last.map(|motion| motion.line)).unwrap_or(1);
        let at = last.map_or(Place::default(), |motion| motion.to).point();
        let wrong = Wrong { severity: Severity::Warning, message: message.to_owned(), size: None };
        found(program, NAME, wrong, at.map(|p| program.placement.undo(p)), line)
    };
    let pause = |stop: &Stop| finding(stop.before, Some(stop.line), "it waits while the spindle turns");
    let pauses = program.listing.stops.iter().filter(|stop| stop.spinning).map(pause);
    let ends = program.listing.spinning.then(|| {
        finding(
            program.listing.motions.len(),
            None,
            "it ends, without M5, M2 or M30: the spindle goes on turning",
        )
    });
    once(pauses.chain(ends), "times")
}
