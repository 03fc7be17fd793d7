//! # What it checks
//!
//! Nothing stands behind the end of a program (M2, M30) but what ends it once more, and
//! subprograms.
//!
//! # Why
//!
//! Grbl and its kin take M2 for a line like any other, and Marlin does not know it: what follows is
//! carried out, with whatever tool is in. LinuxCNC never reads it. It comes of programs that were
//! put into one file.
//!
//! # What it can miss
//!
//! What the code does: nothing behind the end is followed.
//!
//! # Sources
//!
//! Grbl 1.1h, gcode.c: M2 and M30 reset modes, stop spindle and coolant, and that is all. NIST
//! RS274/NGC version 3 §3.6.1 for what ends a program.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, found};
use crate::verify::followed::Followed;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("code behind the end of a program"),
    effect: Words::of(
        "some controllers carry it out, with the tool that is in, others never: it was not judged",
    ),
    advice: Words::of("give each program a file of its own, or take the M2 or M30 in its middle out"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(|program, _| check(program)) };

const NAME: &str = "code-after-end";

fn check(program: &Followed) -> Vec<Finding> {
    let wrong = |line: u32| {
        let message = "it goes on behind its end: what follows was not judged".to_owned();
        found(program, NAME, Wrong { severity: Severity::Error, message, size: None }, None, line)
    };
    program.listing.behind_end.map(wrong).into_iter().collect()
}
