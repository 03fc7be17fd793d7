//! # What it checks
//!
//! Every hole and slot of the board is drilled or milled.
//!
//! # Why
//!
//! A lead does not fit where there is no hole.
//!
//! # What it can miss
//!
//! How well: place, size and depth are for `hole-place`, `hole-size` and `hole-depth` to say.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::{Board, Hole};
use crate::verify::Settings;
use crate::verify::bores::Bores;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a hole that is not drilled"),
    effect: Words::of("a part does not fit, or a via is missing"),
    advice: Words::of(
        "mill the drill programs too, name the drill file ({drill}), or add a drill that fits ({drills}, {drill-tolerance})",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Drilling(check) };

const NAME: &str = "hole-missing";

fn check(bores: &Bores<'_>, _: &Board, _: &Settings) -> Vec<Finding> {
    bores.holes.iter().filter(|bore| bore.made.is_none()).map(|bore| finding(bore.hole)).collect()
}

fn finding(hole: &Hole) -> Finding {
    let what = if hole.is_slot() { "slot" } else { "hole" };
    let message = format!("the {what} of {:.3} mm is not drilled", hole.diameter);
    Finding {
        at: Some(hole.path.start),
        size: Some(hole.diameter),
        ..Finding::new(NAME, Severity::Error, message)
    }
}
