//! # What it checks
//!
//! Nothing is drilled or milled where the board has neither hole nor slot.
//!
//! # Why
//!
//! It may go through a trace.
//!
//! # What it can miss
//!
//! What is less deep than the copper is thick.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::{Board, Shape};
use crate::verify::Settings;
use crate::verify::bores::Bores;
use crate::verify::cut::Cut;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a hole that the board does not have"),
    effect: Words::of("a hole that the design does not have may cut a trace"),
    advice: Words::of("check that the program belongs to this board, and its offset"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Drilling(check) };

const NAME: &str = "hole-extra";

fn check(bores: &Bores<'_>, _: &Board, _: &Settings) -> Vec<Finding> {
    let finding = |cut: &Cut<'_>| {
        let how = match cut.swept.shape {
            Shape::Disc { .. } => "drilled",
            Shape::Stroke { .. } | Shape::Arc { .. } | Shape::Polygon(_) => "milled",
        };
        Finding {
            at: Some(cut.swept.shape.anchor()),
            size: Some(cut.swept.half() * 2),
            program: Some(cut.program.followed.file.clone()),
            line: Some(cut.swept.line),
            ..Finding::new(NAME, Severity::Error, format!("{how} where the board has no hole"))
        }
    };
    bores.strays.iter().map(finding).collect()
}
