//! # What it checks
//!
//! Every hole has its diameter, drilled or milled; every slot its width and its length.
//!
//! # Why
//!
//! Too small and the lead does not fit; too large and the pad is gone.
//!
//! # What it can miss
//!
//! Which drill is really in the spindle. Plating, which makes holes narrower, is not counted.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, hole};
use crate::board::Board;
use crate::geometry::Nm;
use crate::verify::Settings;
use crate::verify::bores::{Bore, Bores, Made};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a hole or slot of another size"),
    effect: Words::of("pins do not fit, or the pad is drilled away"),
    advice: Words::of(
        "choose another drill ({drills}, {drill-tolerance}), or bore the hole ({drill-bore-from})",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Drilling(check) };

const NAME: &str = "hole-size";

fn check(bores: &Bores<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    bores.holes.iter().filter_map(|bore| wrong(bore, bore.made.as_ref()?, settings)).collect()
}

fn wrong(bore: &Bore<'_>, made: &Made<'_>, settings: &Settings) -> Option<Finding> {
    let (size, message) =
        if bore.hole.is_slot() { slot(made, settings) } else { round(bore, made, settings) }?;
    Some(Finding { size: Some(Nm::from_f64(size)), ..hole(bore, made, NAME, Severity::Error, message) })
}

/// How much wider it is than it should be, wherever it is.
fn round(bore: &Bore<'_>, made: &Made<'_>, settings: &Settings) -> Option<(f64, String)> {
    let (off, wanted) = (made.beyond - made.short, bore.hole.diameter);
    let message = || format!("{:.3} mm wide, where the board has {wanted:.3} mm", wanted + Nm::from_f64(off));
    // Doubled from a radius.
    (off.abs() > settings.diameter.to_f64() + 10.0).then(|| (off.abs(), message()))
}

/// How far its wall is off anywhere.
fn slot(made: &Made<'_>, settings: &Settings) -> Option<(f64, String)> {
    let most = (settings.place + settings.diameter / 2).to_f64();
    if made.short > most {
        Some((made.short, format!("the slot ends {:.3} mm before its wall", made.short / 1e6)))
    } else if made.beyond > most {
        Some((made.beyond, format!("the slot goes {:.3} mm beyond its wall", made.beyond / 1e6)))
    } else {
        None
    }
}
