//! # What it checks
//!
//! The holes on whose pins the board is flipped lie beside it, there are at least two of them, and
//! they go far enough below the board at their full diameter that pins stand in what lies under it.
//!
//! # Why
//!
//! A pin that falls over holds nothing, and a board that is flipped on it has its back beside
//! its front.
//!
//! # What it can miss
//!
//! How thick what lies under the board is, and whether the holes lie on the line about which the
//! board is flipped.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::{Board, FLATTEN};
use crate::geometry::{Nm, Point};
use crate::verify::Settings;
use crate::verify::cut::Cut;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("an alignment hole that holds no pin"),
    effect: Words::of("a pin does not stand, and the back is not milled in register with the front"),
    advice: Words::of("drill deeper ({alignment-depth}), or farther from the board ({alignment-margin})"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Alignment(check) };

const NAME: &str = "alignment-hole";

/// How far a pin stands in what lies under the board, at least. Chosen.
const STAND: Nm = Nm::from_mm(1);

fn check(programs: &[&Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    let mut deepest: Vec<(Point, Nm, Cut<'_>)> = Vec::new();
    for &program in programs {
        for swept in &program.swept {
            let (at, depth) = (swept.shape.anchor(), swept.full);
            let cut = Cut { program, swept };
            match deepest.iter_mut().find(|(known, ..)| known.distance(at) <= swept.half().to_f64() * 4.0) {
                Some(known) if known.1 < depth => (known.1, known.2) = (depth, cut),
                Some(_) => {}
                None => deepest.push((at, depth, cut)),
            }
        }
    }
    let outline = board.outline.as_ref().map(|outline| outline.polygon(FLATTEN));
    let inside = |at: Point| outline.as_ref().is_some_and(|outline| outline.contains(at));
    let mut findings = Vec::new();
    let mut add =
        |(at, _, cut): &(Point, Nm, Cut<'_>), severity: Severity, message: String, size: Option<Nm>| {
            findings.push(Finding {
                at: Some(*at),
                size,
                program: Some(cut.program.file.clone()),
                line: Some(cut.swept.line),
                ..Finding::new(NAME, severity, message)
            });
        };
    for hole in &deepest {
        let below = hole.1 - settings.board;
        if inside(hole.0) {
            add(hole, Severity::Error, "an alignment hole lies in the board".to_owned(), None);
        }
        if below < Nm::ZERO {
            let message = "an alignment hole does not go through the board".to_owned();
            add(hole, Severity::Error, message, Some(-below));
        } else if below < STAND {
            let message = format!("an alignment hole goes {below:.3} mm below the board: a pin falls over");
            add(hole, Severity::Warning, message, Some(below));
        }
    }
    if let [only] = deepest.as_slice() {
        add(
            only,
            Severity::Error,
            "one alignment hole alone does not hold a board that is flipped".to_owned(),
            None,
        );
    }
    findings
}
