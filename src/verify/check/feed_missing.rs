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

use super::{Check, Run, Severity, Wrong, each_stretch};
use crate::gcode::read::{Motion, Way};

pub(super) const CHECK: Check = Check {
    name: NAME,
    about: "a motion at a feed that was never given",
    cost: "the controller stops with an error, or moves at a speed that nobody chose",
    cure: "give a feed (F) with the first cut (--feed)",

    run: Run::Motion(|program, _, _| each_stretch(program, NAME, wrong)),
};

const NAME: &str = "feed-missing";

fn wrong(motion: &Motion) -> Option<Wrong> {
    let missing = motion.way != Way::Rapid && motion.feed.is_none_or(|feed| feed <= 0);
    let message = || "a cut before the first feed above zero".to_owned();
    missing.then(|| Wrong { severity: Severity::Error, message: message(), size: None })
}
