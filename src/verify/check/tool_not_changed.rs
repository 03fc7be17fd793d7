//! # What it checks
//!
//! Where a program says in its comments that it goes on with another tool it waits for it (M0), or
//! changes it (T with M6), and not for the number of the tool that is in. M1, which waits on
//! request, is a warning. Where its comments give
//! the tool a number, too, T has the same.
//!
//! # Why
//!
//! The machine goes on with the tool that is in. It comes of programs for one tool each that were
//! put into one file, and of lines that were taken out since the controller did not know them.
//!
//! # What it can miss
//!
//! What the controller does at M6: some do nothing. A code that is unknown may be what waits.
//! Comments of other CAM, which are not read.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, cut_depth, found, place};
use crate::gcode::read::{Stop, Waits};
use crate::verify::Cutter;
use crate::verify::followed::Followed;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("another tool that nobody has time to fit"),
    effect: Words::of("the machine goes on with the tool that is in: cuts and holes have another width"),
    advice: Words::of(
        "stop for the change (M0, or T with M6), or run a program for each tool ({tool-change})",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(|program, _| check(program)) };

const NAME: &str = "tool-not-changed";

fn check(program: &Followed) -> Vec<Finding> {
    let mut findings = Vec::new();
    // The tool that cut last, its number, and how many motions there were.
    let mut last: Option<(Cutter, Option<u32>, usize)> = None;
    for (index, motion) in program.listing.motions.iter().enumerate() {
        let Some(cutter) = cut_depth(motion).and_then(|_| program.tools.at(motion.line)) else { continue };
        let mut add = |severity: Severity, message: String| {
            let wrong = Wrong { severity, message, size: None };
            findings.push(found(program, NAME, wrong, place(program, motion), motion.line));
        };
        let before = last.replace((cutter, motion.tool, index));
        let since = before.map_or(0, |(.., since)| since + 1);
        let between = || program.listing.stops.iter().filter(|stop| (since..=index).contains(&stop.before));
        let told = program.tools.number_at(motion.line).zip(motion.tool);
        if let Some((told, number)) =
            told.filter(|(told, number)| told != number && between().any(|stop| stop.changes))
        {
            let what = format!("its comments say tool {told} for {cutter}, but T{number} is put in");
            add(Severity::Error, what);
        }
        let Some((old, number, _)) = before.filter(|(old, ..)| *old != cutter) else { continue };
        // For the tool that is in already nobody waits.
        let is_in = number.is_some() && number == motion.tool;
        let waits = |stop: &&Stop| !(stop.changes && is_in);
        let stops = between().filter(waits).any(|stop| stop.waits != Waits::OnRequest);
        if stops || number != motion.tool {
            continue;
        }
        if between().any(|stop| stop.waits == Waits::OnRequest) {
            let what = format!(
                "it goes on with {cutter} after M1, which stops only where somebody has switched that on"
            );
            add(Severity::Warning, what);
        } else {
            let what = format!("it goes on with {cutter}, and does not stop for {old} to be taken out");
            add(Severity::Error, what);
        }
    }
    findings
}
