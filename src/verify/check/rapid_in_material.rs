//! # What it checks
//!
//! No rapid goes sideways below the surface, or down into it but for where it was cut before as
//! wide as the tool, as in pecking. One that goes sideways less than the clearance above the
//! surface is a warning.
//!
//! # Why
//!
//! A rapid through material breaks the tool.
//!
//! # What it can miss
//!
//! Rapids at a height that the program has not said; clamps and screws, which nobody has told it
//! of.

use rustc_hash::FxHashMap;

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, each_stretch};
use crate::gcode::read::{Motion, Place, Way};
use crate::geometry::{Nm, Point};
use crate::verify::followed::Followed;
use crate::verify::report::Finding;

pub(in crate::verify) const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a rapid through material, or just above it"),
    effect: Words::of("the tool is driven through material at full speed: it breaks"),
    advice: Words::of("retract before each rapid, higher than the surface ({safe-z})"),
};

pub(super) const CHECK: Check =
    Check { kind: &KIND, run: Run::Program(|program, settings| check(program, settings.clearance)) };

const NAME: &str = "rapid-in-material";

fn check(program: &Followed, clearance: Nm) -> Vec<Finding> {
    // How deep it was cut where motions end, and how wide by the last tool that did.
    let mut cut: FxHashMap<Point, (Nm, Nm)> = FxHashMap::default();
    each_stretch(program, NAME, |motion| {
        let width = |z: Nm| program.tools.at(motion.line).map_or(Nm::ZERO, |tool| tool.width_at(-z));
        if motion.way == Way::Rapid {
            let fits = |&(bottom, wide): &(Nm, Nm)| (width(bottom) <= wide).then_some(bottom);
            let hollow = motion.to.point().and_then(|p| cut.get(&p)).and_then(fits);
            return wrong(motion, clearance, hollow);
        }
        for place in [motion.from, motion.to] {
            if let Some((p, z)) = place.point().zip(place.z.filter(|z| *z < Nm::ZERO)) {
                let made = cut.entry(p).or_insert((z, width(z)));
                if z < made.0 || width(made.0) != made.1 {
                    *made = (z, width(z));
                }
            }
        }
        None
    })
}

/// Its size is how deep below the surface it runs, or how much too low above it.
fn wrong(motion: &Motion, clearance: Nm, hollow: Option<Nm>) -> Option<Wrong> {
    let to = motion.to.z?;
    // From a place that nobody knows, or to one, is sideways, and any height below.
    let across = |place: Place| (place.x, place.y);
    let sideways = across(motion.from) != across(motion.to);
    let low = motion.from.z.map_or(to, |from| from.min(to));
    let goes_down = motion.from.z.is_none_or(|from| to < from);
    let (severity, message, size) = if sideways && low < Nm::ZERO {
        (Severity::Error, format!("a rapid goes sideways {:.3} mm below the surface", -low), -low)
    } else if to < Nm::ZERO && goes_down && hollow.is_none_or(|bottom| to < bottom) {
        (Severity::Error, format!("a rapid goes down to {:.3} mm below the surface", -to), -to)
    } else if sideways && low < clearance {
        let message = format!("a rapid goes sideways only {low:.3} mm above the surface");
        (Severity::Warning, message, clearance - low)
    } else {
        return None;
    };
    Some(Wrong { severity, message, size: Some(size) })
}
