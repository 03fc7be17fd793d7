//! # What it checks
//!
//! In a folder of programs there is one for each side that has copper, one that drills where the
//! board has holes, and one that cuts it out where it has an outline.
//!
//! # Why
//!
//! A program that was not written, or not copied to the machine, is missed when the board is off
//! the table.
//!
//! # What it can miss
//!
//! Programs that were named one by one: somebody chose them.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::{Board, Side};
use crate::verify::machining::Machining;
use crate::verify::report::Finding;
use crate::verify::{Role, Settings};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("no program for a side, the holes or the cutout"),
    effect: Words::of("the board is not finished"),
    advice: Words::of("make the missing program, or ignore the layer with {skip}"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Whole(check) };

const NAME: &str = "program-missing";

fn check(programs: &[Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    if !settings.complete {
        return Vec::new();
    }
    let sides = [Side::Front, Side::Back].into_iter();
    let sides = sides.filter(|&side| board.copper(side).is_some_and(|copper| !copper.features.is_empty()));
    let drilling = (!board.holes.is_empty()).then_some(Role::Drilling);
    let cutout = board.outline.as_ref().map(|_| Role::Cutout);
    let wanted = sides.map(Role::Isolation).chain(drilling).chain(cutout);
    let missing = wanted.filter(|role| !programs.iter().any(|program| program.role == *role));
    missing
        .map(|role| {
            let why = match role {
                Role::Isolation(side) => {
                    format!("the board has copper on the {side}, and no program isolates it")
                }
                Role::Drilling => format!("the board has {} holes, and no program drills", board.holes.len()),
                Role::Cutout | Role::Alignment => {
                    "the board has an outline, and no program cuts it out".to_owned()
                }
            };
            Finding::new(NAME, Severity::Error, why)
        })
        .collect()
}
