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

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::Board;
use crate::verify::Settings;
use crate::verify::contours::Contours;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("more tabs than were asked for"),
    effect: Words::of("more is left to be cut by hand"),
    advice: Words::of("check {tabs}"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Cutout(check) };

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
