//! # What it checks
//!
//! Where a program says in its comments that it goes on with another tool it waits for it (M0), or
//! changes it (T with M6), and not for the number of the tool that is in. Where its comments give
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
use crate::verify::Cutter;
use crate::verify::machining::Machining;
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

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Motion(|program, _, _| check(program)) };

const NAME: &str = "tool-not-changed";

fn check(program: &Machining) -> Vec<Finding> {
    let mut findings = Vec::new();
    // The tool that cut last, its number, and how many motions there were.
    let mut last: Option<(Cutter, Option<u32>, usize)> = None;
    for (index, motion) in program.motions.iter().enumerate() {
        let Some(cutter) = cut_depth(motion).and_then(|_| program.tools.at(motion.line)) else { continue };
        let mut add = |message: String| {
            let wrong = Wrong { severity: Severity::Error, message, size: None };
            findings.push(found(program, NAME, wrong, place(program, motion), motion.line));
        };
        let before = last.replace((cutter, motion.tool, index));
        let since = before.map_or(0, |(.., since)| since + 1);
        let between = || program.stops.iter().filter(|stop| (since..=index).contains(&stop.before));
        let told = program.tools.number_at(motion.line).zip(motion.tool);
        if let Some((told, number)) =
            told.filter(|(told, number)| told != number && between().any(|stop| stop.changes))
        {
            add(format!("its comments say tool {told} for {cutter}, but T{number} is put in"));
        }
        let Some((old, number, _)) = before.filter(|(old, ..)| *old != cutter) else { continue };
        // For the tool that is in already nobody waits.
        let is_in = number.is_some() && number == motion.tool;
        let stops = between().any(|stop| !(stop.changes && is_in));
        if !stops && number == motion.tool {
            add(format!("it goes on with {cutter}, and does not stop for {old} to be taken out"));
        }
    }
    findings
}
