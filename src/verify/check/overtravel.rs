//! # What it checks
//!
//! The program fits the machine: in no axis do its motions span more than the machine can travel, where somebody has said how much
//! that is.
//!
//! # Why
//!
//! At the end of an axis the machine stops, or loses steps, and everything after is cut elsewhere.
//!
//! # What it can miss
//!
//! Where on the table zero lies: a program that fits may still begin too near to an end. Motions to places that the program does
//! not give are refused by the reader.

use super::{Check, Run, Severity};
use crate::gcode::read::{Motion, Place};
use crate::geometry::Nm;
use crate::verify::Settings;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;

pub(super) const CHECK: Check = Check {
    name: NAME,
    about: "a program that spans more than the machine can travel",
    run: Run::Motion(|program, _, settings| check(program, settings)),
};

const NAME: &str = "overtravel";

/// The coordinate of one axis.
type Axis = fn(&Place) -> Option<Nm>;

fn check(program: &Machining, settings: &Settings) -> Vec<Finding> {
    let Some([x, y, z]) = settings.travel else { return Vec::new() };
    let axes: [(&str, Nm, Axis); 3] = [("x", x, |at| at.x), ("y", y, |at| at.y), ("z", z, |at| at.z)];
    axes.into_iter().filter_map(|(name, travel, axis)| beyond(program, name, travel, axis)).collect()
}

/// The motion after which an axis has spanned more than it can.
fn beyond(program: &Machining, name: &str, travel: Nm, axis: Axis) -> Option<Finding> {
    let mut span: Option<(Nm, Nm)> = None;
    let mut first: Option<&Motion> = None;
    for motion in &program.motions {
        let Some(at) = axis(&motion.to) else { continue };
        let (low, high) = span.map_or((at, at), |(low, high)| (low.min(at), high.max(at)));
        span = Some((low, high));
        if high - low > travel {
            first = first.or(Some(motion));
        }
    }
    let (motion, (low, high)) = (first?, span?);
    let message =
        format!("{name} goes from {low:.3} to {high:.3} mm, and the machine travels {travel:.3} mm");
    Some(Finding {
        at: motion.to.point().map(|p| program.placement.undo(p)),
        size: Some(high - low - travel),
        program: Some(program.file.clone()),
        line: Some(motion.line),
        ..Finding::new(NAME, Severity::Error, message)
    })
}
