//! # What it checks
//!
//! No rapid goes sideways below the surface, or down into it. One that goes sideways less than the clearance above the
//! surface is a warning.
//!
//! # Why
//!
//! A rapid through material breaks the tool.
//!
//! # What it can miss
//!
//! Rapids before the program's first height; clamps and screws, which nobody has told it of.

use super::{Check, Run, Severity, each_stretch};
use crate::gcode::read::{Motion, Way};
use crate::geometry::Nm;

pub(super) const CHECK: Check = Check {
    name: NAME,
    about: "a rapid through material, or just above it",
    run: Run::Motion(|program, _, settings| {
        each_stretch(program, NAME, |motion| wrong(motion, settings.clearance))
    }),
};

const NAME: &str = "rapid-in-material";

fn wrong(motion: &Motion, clearance: Nm) -> Option<(Severity, String)> {
    if motion.way != Way::Rapid {
        return None;
    }
    let (from, to) = (motion.from.z.or(motion.to.z)?, motion.to.z?);
    let sideways = motion.from.point().is_some() && motion.from.point() != motion.to.point();
    if sideways && from.min(to) < Nm::ZERO {
        Some((Severity::Error, format!("a rapid goes sideways {:.3} mm below the surface", -from.min(to))))
    } else if to < Nm::ZERO && to < from {
        Some((Severity::Error, format!("a rapid goes down to {:.3} mm below the surface", -to)))
    } else if sideways && from.min(to) < clearance {
        Some((
            Severity::Warning,
            format!("a rapid goes sideways only {:.3} mm above the surface", from.min(to)),
        ))
    } else {
        None
    }
}
