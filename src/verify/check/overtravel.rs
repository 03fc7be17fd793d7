//! # What it checks
//!
//! The program fits the machine: in no axis do its motions, arcs included, span more than the
//! machine can travel, where somebody has said how much that is.
//!
//! # Why
//!
//! At the end of an axis the machine stops, or loses steps, and everything after is cut elsewhere.
//!
//! # What it can miss
//!
//! Where on the table zero lies: a program that fits may still begin too near to an end. Motions to
//! places that the program does not give are refused by the reader.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::gcode::read::{self, Motion, Way};
use crate::geometry::{Arc, Nm};
use crate::verify::followed::Followed;
use crate::verify::report::Finding;
use crate::verify::{Error, Program, Settings};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a program that spans more than the machine can travel"),
    effect: Words::of("the machine runs into its end stops"),
    advice: Words::of("turn the board ({rotate} 90deg), or mill fewer tiles at once ({tile})"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(check) };

const NAME: &str = "overtravel";

/// How low and how high a motion goes along an axis.
type Axis = fn(&Motion) -> Option<(Nm, Nm)>;

fn check(program: &Followed, settings: &Settings) -> Vec<Finding> {
    let Some(travel) = settings.travel else { return Vec::new() };
    let found = |beyond: Beyond<'_>| Finding {
        at: beyond.motion.to.point().map(|p| program.placement.undo(p)),
        ..beyond.finding(&program.file)
    };
    all(&program.listing.motions, travel).map(found).collect()
}

/// The same of a program's text, without places on the board.
pub(in crate::verify) fn of_text(program: &Program, travel: [Nm; 3]) -> Result<Vec<Finding>, Error> {
    let failed = |reason| Error::Read { file: program.file.clone(), reason };
    let listing = read::read(&read::without_own_code(&program.text)).map_err(failed)?;
    Ok(all(&listing.motions, travel).map(|beyond| beyond.finding(&program.file)).collect())
}

fn all(motions: &[Motion], [x, y, z]: [Nm; 3]) -> impl Iterator<Item = Beyond<'_>> {
    let axes: [(&str, Nm, Axis); 3] = [("x", x, along_x), ("y", y, along_y), ("z", z, along_z)];
    axes.into_iter().filter_map(|(name, travel, axis)| beyond(motions, name, travel, axis))
}

fn along_x(motion: &Motion) -> Option<(Nm, Nm)> {
    let bounds = arc(motion).map(|arc| arc.bounds());
    bounds.map(|bounds| (bounds.min().x, bounds.max().x)).or_else(|| motion.to.x.map(|x| (x, x)))
}

fn along_y(motion: &Motion) -> Option<(Nm, Nm)> {
    let bounds = arc(motion).map(|arc| arc.bounds());
    bounds.map(|bounds| (bounds.min().y, bounds.max().y)).or_else(|| motion.to.y.map(|y| (y, y)))
}

fn along_z(motion: &Motion) -> Option<(Nm, Nm)> {
    motion.to.z.map(|z| (z, z))
}

fn arc(motion: &Motion) -> Option<Arc> {
    let Way::Arc { center, turn } = motion.way else { return None };
    Some(Arc { start: motion.from.point()?, end: motion.to.point()?, center, turn })
}

/// An axis that spans more than it can.
struct Beyond<'a> {
    /// After which it does.
    motion: &'a Motion,
    by: Nm,
    message: String,
}

impl Beyond<'_> {
    fn finding(self, file: &str) -> Finding {
        Finding {
            size: Some(self.by),
            program: Some(file.to_owned()),
            line: Some(self.motion.line),
            ..Finding::new(NAME, Severity::Error, self.message)
        }
    }
}

fn beyond<'a>(motions: &'a [Motion], name: &str, travel: Nm, axis: Axis) -> Option<Beyond<'a>> {
    let mut span: Option<(Nm, Nm)> = None;
    let mut first: Option<&Motion> = None;
    for motion in motions {
        let Some(own) = axis(motion) else { continue };
        let (low, high) = span.map_or(own, |(low, high)| (low.min(own.0), high.max(own.1)));
        span = Some((low, high));
        if high - low > travel {
            first = first.or(Some(motion));
        }
    }
    let (motion, (low, high)) = (first?, span?);
    let message =
        format!("{name} goes from {low:.3} to {high:.3} mm, and the machine travels {travel:.3} mm");
    Some(Beyond { motion, by: high - low - travel, message })
}
