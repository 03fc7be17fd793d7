//! # What it checks
//!
//! No contour has more tabs than were asked for.
//!
//! # Why
//!
//! Each must be cut and filed off; and what looks like a tab may be a stretch that somebody forgot.
//!
//! # What it can miss
//!
//! Programs that do not say how many there should be (`--tabs`).

use super::{Check, Run, Severity};
use crate::board::Board;
use crate::verify::Settings;
use crate::verify::contours::Contours;
use crate::verify::report::Finding;

pub(super) const CHECK: Check = Check {
    name: NAME,
    about: "more tabs than were asked for",
    cost: "more is left to be cut by hand",
    cure: "check --tabs",
    run: Run::Cutout(check),
};

const NAME: &str = "tab-extra";

fn check(contours: &Contours<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    let Some(wanted) = settings.tabs.and_then(|tabs| usize::try_from(tabs).ok()) else { return Vec::new() };
    let (program, line) = contours.last();
    let mut findings = Vec::new();
    for ring in &contours.rings {
        let tabs: Vec<_> = contours.tabs(ring, settings).collect();
        if tabs.len() > wanted {
            findings.push(Finding {
                at: tabs.first().map(|tab| tab.at),
                program: program.clone(),
                line,
                ..Finding::new(
                    NAME,
                    Severity::Warning,
                    format!("a contour has {} tabs, where {wanted} were asked for", tabs.len()),
                )
            });
        }
    }
    findings
}
