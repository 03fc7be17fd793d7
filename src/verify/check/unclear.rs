//! # What it checks
//!
//! What the text of a program leaves open, and how it was taken: no unit, no speed of the spindle,
//! no height before it moves sideways, places of the machine, words that were passed over. That it
//! cuts where nobody knows is an error.
//!
//! # Why
//!
//! The rest of the verdict holds as far as that was taken right.
//!
//! # What it can miss
//!
//! What the controller remembers from before the program. What the motion depends on, and nobody
//! can know, is no finding: such a program is not judged.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, cut_depth, often};
use crate::gcode::read::{Motion, Note, Odd, Spindle, Tally, Way};
use crate::verify::followed::Followed;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("something that the program does not set"),
    effect: Words::of("what the machine does depends on the state that it is in"),
    advice: Words::of(
        "write it into the program: the unit (G21), the spindle speed (S), the coordinate system (G54)",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(|program, _| check(program)) };

const NAME: &str = "unclear";

fn check(program: &Followed) -> Vec<Finding> {
    let of = |severity: Severity, line: u32, message: String| Finding {
        program: Some(program.file.clone()),
        line: Some(line),
        ..Finding::new(NAME, severity, message)
    };
    let note = |Note { warns, line, count, message }: &Note| {
        let severity = if *warns { Severity::Warning } else { Severity::Info };
        of(severity, *line, message.clone() + &often(*count, "times"))
    };
    let unstated = |motion: &&Motion| motion.way != Way::Rapid && motion.spindle == Spindle::Unstated;
    let knob = program.listing.motions.iter().find(unstated).map(|motion| {
        let what = "the spindle turns at a speed that the program does not give: set it by hand";
        of(Severity::Info, motion.line, what.to_owned())
    });
    // Straight down it goes wherever it is.
    let lost = |motion: &&Motion| motion.to.point().is_none() && cut_depth(motion).is_some();
    let lost = program.listing.motions.iter().find(lost).map(|motion| {
        let what = "it cuts at a place that the program has not given: that cut was not judged";
        of(Severity::Error, motion.line, what.to_owned())
    });
    // Of a controller that is known, `word-not-taken` says what it does.
    let contrary = program.listing.odd.get(&Odd::Contrary).filter(|_| program.controller.is_none());
    let contrary = contrary.map(|&Tally { line, count }| {
        let what = "of its codes one alone can hold: most controllers stop there, and others take the last";
        of(Severity::Warning, line, what.to_owned() + &often(count, "times"))
    });
    program.listing.notes.iter().map(note).chain(knob).chain(contrary).chain(lost).collect()
}
