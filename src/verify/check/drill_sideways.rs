//! # What it checks
//!
//! No drill goes sideways below the surface.
//!
//! # Why
//!
//! A drill has no edges at its side and is thin for its length: it breaks. It comes of slots that
//! another program meant for an end mill, or of a retract that is missing between two holes.
//!
//! # What it can miss
//!
//! A drill that a program calls an end mill.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, cut_depth, each_stretch, once};
use crate::gcode::read::{Motion, Way};
use crate::geometry::Nm;
use crate::verify::CutterKind;
use crate::verify::followed::{Followed, Tools};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a drill that goes sideways in the board"),
    effect: Words::of("a drill cuts with its point alone: it bends, and breaks"),
    advice: Words::of("retract between holes, or name the end mill that it is ({tool})"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(|program, _| check(program)) };

const NAME: &str = "drill-sideways";

/// A drill bends so far, or the program rounds. Chosen.
const BENDS: Nm = Nm::from_um(50);

fn check(program: &Followed) -> Vec<Finding> {
    once(each_stretch(program, NAME, |motion| wrong(motion, &program.tools)), "places")
}

fn wrong(motion: &Motion, tools: &Tools) -> Option<Wrong> {
    let (from, to) = (motion.from.point()?, motion.to.point()?);
    let is_far = matches!(motion.way, Way::Arc { .. }) || from.distance(to) > BENDS.to_f64();
    let depth = cut_depth(motion).filter(|_| is_far)?;
    let drills = tools.at(motion.line)?.kind == CutterKind::Drill;
    drills.then(|| {
        let message = format!("a drill goes sideways {depth:.3} mm below the surface");
        Wrong { severity: Severity::Error, message, size: Some(depth) }
    })
}
