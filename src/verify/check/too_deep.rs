//! # What it checks
//!
//! No isolating cut goes through half the board, or more than twice as deep as most of the program
//! does. No hole and no cutout goes far below the board, the point of a drill aside.
//!
//! # Why
//!
//! Copper is a few hundredths of a millimetre thick. A cut far deeper breaks a fine cutter, and a
//! V-bit's groove is wider the deeper it goes. Below the board lies a sheet that may be cut, and
//! below that the table of the machine. It comes of a surface that was measured wrong, a slipped
//! decimal point, a wrong unit, a tool that was not set to zero.
//!
//! # What it can miss
//!
//! An isolating program that is too deep throughout, but less than half the board. A table that is
//! nearer than two millimetres. Holes for pins on which the board is flipped go into the table.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, cut_depth, each_stretch};
use crate::gcode::read::{Motion, Way};
use crate::geometry::{Arc, Nm};
use crate::verify::machining::Machining;
use crate::verify::report::Finding;
use crate::verify::{Role, Settings};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a cut that is far deeper than needed"),
    effect: Words::of(
        "isolating cuts are wider than planned and may go through the board; holes and cutouts go into the \
         machine's table",
    ),
    advice: Words::of(
        "check the unit and the Z words of the program, or set the thickness of the board ({thickness})",
    ),
};

pub(super) const CHECK: Check =
    Check { kind: &KIND, run: Run::Motion(|program, _, settings| check(program, settings)) };

const NAME: &str = "too-deep";

/// Below this depth twice the usual is not remarkable: boards are not flat to less. Chosen.
const UNREMARKABLE: Nm = Nm::from_um(200);

/// Farther below the board only thick sheets are cut, and nothing but the table. Chosen: most of
/// what lies below boards is thicker than the first and thinner than the second.
const BELOW: Nm = Nm::from_mm(2);
const FAR_BELOW: Nm = Nm::from_mm(10);

fn check(program: &Machining, settings: &Settings) -> Vec<Finding> {
    match program.role {
        Role::Isolation(_) => {
            let most =
                (usual(&program.followed.listing.motions) * 2).max(UNREMARKABLE).min(settings.board / 2);
            each_stretch(&program.followed, NAME, |motion| {
                let depth = cut_depth(motion).filter(|depth| *depth > most)?;
                let message = format!("a cut {depth:.3} mm deep, where {most:.3} mm is enough");
                Some(Wrong { severity: Severity::Error, message, size: Some(depth) })
            })
        }
        Role::Drilling | Role::Cutout => each_stretch(&program.followed, NAME, |motion| {
            let depth = cut_depth(motion)?;
            let point = program.followed.tools.at(motion.line).map_or(Nm::ZERO, |cutter| cutter.point());
            let below = Some(depth - point - settings.board).filter(|below| *below > BELOW)?;
            let message = format!("a cut {depth:.3} mm deep, in a board of {:.3} mm", settings.board);
            let severity = if below > FAR_BELOW { Severity::Error } else { Severity::Warning };
            Some(Wrong { severity, message, size: Some(depth) })
        }),
        Role::Alignment => Vec::new(),
    }
}

/// The depth of the middle one of all ways below the surface, by length.
fn usual(motions: &[Motion]) -> Nm {
    let depth = |motion: &Motion| Some(-motion.to.z.filter(|z| *z < Nm::ZERO)?);
    let length = |motion: &Motion| {
        let (start, end) = (motion.from.point()?, motion.to.point()?);
        Some(match motion.way {
            Way::Arc { center, turn } => Arc { start, end, center, turn }.length(),
            Way::Rapid | Way::Feed => start.distance(end),
        })
    };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_count_by_their_length() {
        let circle = "G2 X1 Y0 I1 J0\n";
        let text = format!("G21\nG0 X1 Y0 Z2\nG1 Z-0.3 F100\n{circle}{circle}G1 Z-0.1\nG1 X3\nG0 Z2\n");
        let listing = crate::gcode::read::read(&text).expect("it reads");
        assert_eq!(usual(&listing.motions), Nm::from_um(300), "two of them are longer than 2 mm");
    }
}
