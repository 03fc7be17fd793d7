//! # What it checks
//!
//! A dwell (G4) is neither minutes nor next to nothing in the unit that the controller reads P in.
//!
//! # Why
//!
//! P counts seconds for some controllers and milliseconds for others. Read as milliseconds, the
//! time that a spindle is given to come up to speed is over before it turns; read as seconds, the
//! machine stands for most of an hour, and seems to hang.
//!
//! # What it can miss
//!
//! Programs that do not say which controller they are for; Mach and Smoothieware, of which a
//! setting says what P counts.
//!
//! # Sources
//!
//! Grbl 1.1h, grblHAL (f80fc34), FluidNC 4.0, TinyG (39df38c), g2core (1fb5940), LinuxCNC's manual;
//! Marlin 2, RepRapFirmware 3.5.3, Klipper (84104bb).

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, found, often};
use crate::gcode::read::Dwell;
use crate::verify::followed::Followed;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a dwell in the unit of another controller"),
    effect: Words::of(
        "the spindle is not up to speed when the tool goes down, or the machine stands for long",
    ),
    advice: Words::of("make the program for this controller ({dialect}), or write the time in its unit"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(|program, _| check(program)) };

const NAME: &str = "dwell-length";

/// Controllers whose P counts seconds, and those whose P counts milliseconds.
const SECONDS: &[&str] = &["linuxcnc", "grbl", "grblhal", "fluidnc", "tinyg", "g2core"];
const MILLISECONDS: &[&str] = &["marlin", "reprapfirmware", "klipper"];
/// In milliseconds, the longest dwell that a spindle asks for, and one that nothing asks for.
/// Chosen: some warm a spindle up for minutes; it comes up to speed within seconds, and in no
/// twentieth of one.
const LONGEST: u64 = 300_000;
const SHORTEST: u64 = 50;

fn check(program: &Followed) -> Vec<Finding> {
    let Some(controller) = program.controller.as_deref() else { return Vec::new() };
    let finding = |dwell: &Dwell| {
        let Dwell { thousandths, line, count } = *dwell;
        let (time, wrong) = if SECONDS.contains(&controller) {
            (format!("{} s, as P counts seconds", thousandths / 1000), thousandths > LONGEST)
        } else {
            let milliseconds = thousandths / 1000;
            let is_short = (1..SHORTEST * 1000).contains(&thousandths);
            (
                format!("{milliseconds} ms, as P counts milliseconds"),
                MILLISECONDS.contains(&controller) && is_short,
            )
        };
        let message = format!("{controller} waits {time}{}", often(count, "times"));
        let finding = Wrong { severity: Severity::Warning, message, size: None };
        wrong.then(|| found(program, NAME, finding, None, line))
    };
    program.listing.dwells.iter().filter_map(finding).collect()
}
