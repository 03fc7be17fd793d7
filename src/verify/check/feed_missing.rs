//! # What it checks
//!
//! Every motion at a feed has one above zero.
//!
//! # Why
//!
//! Controllers stop there with an error, the tool in the board; or go on at whatever feed came
//! last.
//!
//! # What it can miss
//!
//! Feeds that are given but absurd.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, each_stretch};
use crate::gcode::read::{Motion, Way};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a motion at a feed that was never given"),
    effect: Words::of("the controller stops with an error, or moves at an unknown speed"),
    advice: Words::of("give a feed (F) with the first cut ({feed})"),
};

pub(super) const CHECK: Check =
    Check { kind: &KIND, run: Run::Program(|program, _| each_stretch(program, NAME, wrong)) };

const NAME: &str = "feed-missing";

fn wrong(motion: &Motion) -> Option<Wrong> {
    let missing = motion.way != Way::Rapid && motion.feed.is_none_or(|feed| feed <= 0);
    let message = || "a cut before the first feed above zero".to_owned();
    missing.then(|| Wrong { severity: Severity::Error, message: message(), size: None })
}
