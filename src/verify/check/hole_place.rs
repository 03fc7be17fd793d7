//! # What it checks
//!
//! Every round hole has its middle where the board has it.
//!
//! # Why
//!
//! A lead does not fit, or the hole breaks out of its pad. A program that is moved, turned or
//! scaled against its board is found so.
//!
//! # What it can miss
//!
//! Slots: what is off in them is a wrong size, at one end or one side.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, hole};
use crate::board::Board;
use crate::geometry::Nm;
use crate::verify::Settings;
use crate::verify::bores::{Bore, Bores, Made};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a hole off its place"),
    effect: Words::of("pins do not fit, and the pad round the hole is broken"),
    advice: Words::of("check offset, mirror axis and scale of the program"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Drilling(check) };

const NAME: &str = "hole-place";

/// Less is not told. Chosen: what cheap machines repeat to.
const NOTABLE: f64 = 20_000.0;

fn check(bores: &Bores<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    bores.holes.iter().filter_map(|bore| off(bore, bore.made.as_ref()?, settings)).collect()
}

fn off(bore: &Bore<'_>, made: &Made<'_>, settings: &Settings) -> Option<Finding> {
    let off = f64::midpoint(made.short, made.beyond);
    if bore.hole.is_slot() || off <= NOTABLE {
        return None;
    }
    let severity = if off > settings.place.to_f64() { Severity::Error } else { Severity::Warning };
    let message = format!("the hole of {:.3} mm is {:.3} mm off its place", bore.hole.diameter, off / 1e6);
    Some(Finding { size: Some(Nm::from_f64(off)), ..hole(bore, made, NAME, severity, message) })
}
