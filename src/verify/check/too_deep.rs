//! # What it checks
//!
//! No isolating cut goes through half the board, or more than twice as deep as most of the program
//! does.
//!
//! # Why
//!
//! Copper is a few hundredths of a millimetre thick. A cut far deeper breaks a fine cutter, and a
//! V-bit's groove is wider the deeper it goes. It comes of a surface that was measured wrong, a
//! slipped decimal point, a tool that was not set to zero.
//!
//! # What it can miss
//!
//! A program that is too deep throughout, but less than half the board.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, each_stretch};
use crate::gcode::read::{Motion, Way};
use crate::geometry::Nm;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;
use crate::verify::{Role, Settings};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("an isolating cut that is far deeper than needed"),
    effect: Words::of("the cut is wider than planned, and may go through the board"),
    advice: Words::of("check the unit and the Z words of the program"),
};

pub(super) const CHECK: Check =
    Check { kind: &KIND, run: Run::Motion(|program, _, settings| check(program, settings)) };

const NAME: &str = "too-deep";

/// Below this depth twice the usual is not remarkable: boards are not flat to less. Chosen.
const UNREMARKABLE: Nm = Nm::from_um(200);

fn check(program: &Machining, settings: &Settings) -> Vec<Finding> {
    if !matches!(program.role, Role::Isolation(_)) {
        return Vec::new();
    }
    let most = (usual(&program.motions) * 2).max(UNREMARKABLE).min(settings.board / 2);
    each_stretch(program, NAME, |motion| {
        let depth = -[motion.from.z, motion.to.z].into_iter().flatten().min()?;
        let wrong = motion.way != Way::Rapid && depth > most;
        let message = || format!("a cut {depth:.3} mm deep, where {most:.3} mm is enough");
        wrong.then(|| Wrong { severity: Severity::Error, message: message(), size: Some(depth) })
    })
}

/// The depth of the middle one of all ways below the surface, by length.
fn usual(motions: &[Motion]) -> Nm {
    let depth = |motion: &Motion| Some(-motion.to.z.filter(|z| *z < Nm::ZERO)?);
    let length = |motion: &Motion| Some(motion.from.point()?.distance(motion.to.point()?));
    let mut ways: Vec<(Nm, f64)> =
        motions.iter().filter_map(|motion| Some((depth(motion)?, length(motion)?))).collect();
    ways.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let half = ways.iter().map(|(_, length)| length).sum::<f64>() / 2.0;
    let mut before = 0.0;
    let middle = ways.iter().find(|(_, length)| {
        before += length;
        before >= half
    });
    middle.map_or(Nm::ZERO, |(depth, _)| *depth)
}
