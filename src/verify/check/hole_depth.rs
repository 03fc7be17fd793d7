//! # What it checks
//!
//! Every hole goes through the board at its full diameter: the point of a drill (118° unless its
//! tool says another angle) does not count.
//!
//! # Why
//!
//! A lead does not fit through a hole that ends in a cone, or in the board.
//!
//! # What it can miss
//!
//! Stock that is thicker than was told (`--thickness`), or does not lie flat.

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
    what: Words::of("a hole that does not go through the board"),
    effect: Words::of("the hole does not go through the board"),
    advice: Words::of(
        "drill deeper ({break-through}, {drill-depth}), or set the thickness of the board ({thickness})",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Drilling(check) };

const NAME: &str = "hole-depth";

/// A wall that is so much less deep at its full width is still a hole. Chosen: a sixteenth of the
/// usual board.
const SLIGHT: Nm = Nm::from_um(100);

fn check(bores: &Bores<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    bores.holes.iter().filter_map(|bore| shallow(bore, bore.made.as_ref()?, settings)).collect()
}

fn shallow(bore: &Bore<'_>, made: &Made<'_>, settings: &Settings) -> Option<Finding> {
    let missing = settings.board - made.depth;
    if missing <= Nm::ZERO {
        return None;
    }
    let (what, wanted) = (if bore.hole.is_slot() { "slot" } else { "hole" }, bore.hole.diameter);
    let depth = if made.end > made.depth && made.end >= settings.board {
        format!("goes {:.3} mm deep at its full width, and only the point beyond", made.depth.max(Nm::ZERO))
    } else {
        format!("goes {:.3} mm deep", made.end)
    };
    let message = format!("the {what} of {wanted:.3} mm {depth}, in a board of {:.3} mm", settings.board);
    let severity = if missing > SLIGHT { Severity::Error } else { Severity::Warning };
    Some(Finding { size: Some(missing), ..hole(bore, made, NAME, severity, message) })
}
