//! # What it checks
//!
//! What isolates the back is mirrored, and what isolates the front is not.
//!
//! # Why
//!
//! Layers are drawn as they are seen from the front, through the board. The back lies upward when
//! it is milled, so that a program must be mirrored that is for it; one that is not makes a board
//! on which no part fits.
//!
//! # What it can miss
//!
//! Layers that were plotted mirrored. Holes and edges, which may be made from either side.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::Side;
use crate::verify::Role;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a side that becomes its own mirror image"),
    effect: Words::of("no part fits its pads, and pads lie beside their holes"),
    advice: Words::of(
        "mirror the program for the back, and no other; where it is mirrored say so ({mirror-axis}, {register})",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Motion(|program, _, _| check(program)) };

const NAME: &str = "mirror-image";

fn check(program: &Machining) -> Vec<Finding> {
    let message = match (program.role, program.followed.placement.mirror) {
        (Role::Isolation(Side::Back), None) => {
            "the back is milled as it is seen through the board, and comes out mirrored"
        }
        (Role::Isolation(Side::Front), Some(_)) => "the front is milled mirrored",
        _ => return Vec::new(),
    };
    vec![Finding {
        program: Some(program.followed.file.clone()),
        ..Finding::new(NAME, Severity::Error, message.to_owned())
    }]
}
