//! # What it checks
//!
//! Copper is left round each hole in a pad that belongs to more than itself.
//!
//! # Why
//!
//! Nothing can be soldered to a pad that was drilled away, and the trace that led to it ends at a
//! hole. Drills that are wider than what was asked for do this, holes of another revision, and pads
//! that were made for a factory, which plates holes.
//!
//! # What it can miss
//!
//! A ring that is there on one side of the hole. Holes that no program drills, and those of 2 mm
//! and more: they are for screws.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, hole};
use crate::geometry::Nm;
use crate::verify::drilled::{Drilled, Left, RING, Touched};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a hole as wide as its pad"),
    effect: Words::of("next to no copper is left round the hole: nothing can be soldered there"),
    advice: Words::of("drill it with a narrower drill ({drills}), or make the pad larger in the design"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Drilled(|drilled, _| check(drilled)) };

const NAME: &str = "ring-missing";

/// Holes from which on a screw goes through, and nothing is soldered. Chosen: the leads of
/// terminals and connectors are narrower, and M2 is not.
const SCREW: Nm = Nm::from_mm(2);

fn check(drilled: &Drilled<'_, '_>) -> Vec<Finding> {
    let mut findings = Vec::new();
    for opened in drilled.holes.iter().filter(|opened| opened.bore.hole.diameter < SCREW) {
        let is_pad = |touched: &&Touched| touched.is_centred && touched.left == Left::Whole;
        for touched in opened.nets.iter().filter(is_pad).filter(|touched| touched.ring < RING) {
            let name = drilled.sheet.nets.label(touched.net);
            let message = format!("next to nothing is left of the pad of {name} round a hole");
            let found = hole(opened.bore, &opened.made, NAME, Severity::Warning, message);
            findings.push(Finding { nets: vec![name], size: Some(opened.bore.hole.diameter), ..found });
        }
    }
    findings
}
