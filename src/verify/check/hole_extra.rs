//! # What it checks
//!
//! Nothing is drilled where the board has neither hole nor slot.
//!
//! # Why
//!
//! It may go through a trace.
//!
//! # What it can miss
//!
//! Nothing that goes straight down; what is milled is not looked at.

use super::{Check, Run, Severity, from_hole, plunges};
use crate::board::Board;
use crate::verify::Settings;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;

pub(super) const CHECK: Check =
    Check { name: NAME, about: "a hole that the board has not", run: Run::Drilling(check) };

const NAME: &str = "hole-extra";

fn check(programs: &[&Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    let reach = settings.place;
    let holes: Vec<_> = board.holes.iter().map(|hole| (hole.path.bounds().inflate(reach), hole)).collect();
    let extra = plunges(programs).filter(|(_, plunge)| {
        let mut near = holes.iter().filter(|(bounds, _)| bounds.contains(plunge.at));
        !near.any(|(_, hole)| from_hole(hole, plunge.at) <= reach.to_f64())
    });
    extra
        .map(|(program, plunge)| Finding {
            at: Some(plunge.at),
            size: Some(plunge.diameter),
            program: Some(program.file.clone()),
            line: Some(plunge.line),
            ..Finding::new(NAME, Severity::Error, "drilled where the board has no hole")
        })
        .collect()
}
