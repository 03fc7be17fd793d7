//! # What it checks
//!
//! No hole cuts a net in two, reaches into two nets, or into copper beside its middle that is no
//! ring round it. What counts is the copper as designed, less the holes as they are drilled.
//!
//! # Why
//!
//! A trace that a hole goes through does not conduct, and what is put into a hole that two nets
//! reach joins them. Holes of another revision do this, files that lie beside each other, and
//! drills that are wider than what was asked for.
//!
//! # What it can miss
//!
//! How much narrower a hole makes a trace. Parts that are left joined on the other side.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, hole};
use crate::geometry::Nm;
use crate::verify::Settings;
use crate::verify::drilled::{Drilled, Left, Opened};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a hole through copper that is not its pad"),
    effect: Words::of("a net is interrupted or made narrower, or what is put into the hole joins two nets"),
    advice: Words::of(
        "check that the drill file belongs to this board and lies on it, and the drills ({drills})",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Drilled(check) };

const NAME: &str = "hole-in-copper";

/// The part of the way round a hole from which on copper is its ring, though its middle is bare.
/// Chosen: pads whose middle is left bare for the drill have all of it but a slit.
const BARE: f64 = 0.75;

fn check(drilled: &Drilled<'_, '_>, settings: &Settings) -> Vec<Finding> {
    let label = |net| drilled.sheet.nets.label(net);
    let find = |opened: &Opened<'_, '_>, nets: Vec<String>, size: Option<Nm>, message: String| {
        let found = hole(opened.bore, &opened.made, NAME, Severity::Warning, message);
        Finding { nets, size, ..found }
    };
    let mut findings = Vec::new();
    for opened in &drilled.holes {
        for touched in opened.nets.iter().filter(|touched| touched.left == Left::Parts) {
            let name = label(touched.net);
            let message = format!("{name} is cut in two by a hole");
            findings.push(find(opened, vec![name], None, message));
        }
        let nets: Vec<String> = opened.nets.iter().map(|touched| label(touched.net)).collect();
        if nets.len() > 1 {
            let message = format!("a hole reaches into {}", nets.join(" and "));
            findings.push(find(opened, nets, None, message));
            continue;
        }
        let Some(touched) = opened.nets.first() else { continue };
        let depth = Nm::from_f64(touched.depth);
        if !touched.is_centred && depth > settings.place && touched.ring < BARE {
            let message = format!("a hole reaches {depth:.3} mm into {}", nets[0]);
            findings.push(find(opened, nets, Some(depth), message));
        }
    }
    findings
}
