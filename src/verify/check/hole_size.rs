//! # What it checks
//!
//! What is drilled at a hole has its diameter.
//!
//! # Why
//!
//! Too small and the lead does not fit; too large and the pad is gone.
//!
//! # What it can miss
//!
//! Which drill is really in the spindle. Plating, which makes holes narrower, is not counted.

use super::{Check, Run, Severity, from_hole, plunges};
use crate::board::Board;
use crate::geometry::Nm;
use crate::verify::Settings;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;

pub(super) const CHECK: Check =
    Check { name: NAME, about: "a hole drilled with another diameter", run: Run::Drilling(check) };

const NAME: &str = "hole-size";

fn check(programs: &[&Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    let reach = settings.place;
    let holes: Vec<_> = board.holes.iter().map(|hole| (hole.path.bounds().inflate(reach), hole)).collect();
    let mut findings = Vec::new();
    for (program, plunge) in plunges(programs).filter(|(_, plunge)| plunge.diameter > Nm::ZERO) {
        let near = holes.iter().filter(|(bounds, _)| bounds.contains(plunge.at));
        let near = near.filter(|(_, hole)| from_hole(hole, plunge.at) <= reach.to_f64());
        // Of holes over one another any may be the one that is meant.
        let Some(off) = near.map(|(_, hole)| plunge.diameter - hole.diameter).min_by_key(|off| off.abs())
        else {
            continue;
        };
        if off.abs() > settings.diameter {
            let message = format!(
                "drilled with {:.3} mm where the board has {:.3} mm",
                plunge.diameter,
                plunge.diameter - off
            );
            findings.push(Finding {
                at: Some(plunge.at),
                size: Some(off.abs()),
                program: Some(program.file.clone()),
                line: Some(plunge.line),
                ..Finding::new(NAME, Severity::Error, message)
            });
        }
    }
    findings
}
