//! # What it checks
//!
//! The cutout goes through the board, all the way round but for tabs.
//!
//! # Why
//!
//! A board that is not cut through stays in its stock; breaking it out tears copper off.
//!
//! # What it can miss
//!
//! Stock that is thicker than was told (`--thickness`), or does not lie flat.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::Board;
use crate::verify::Settings;
use crate::verify::contours::{Contours, Ring, State, Stretch};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("an edge that is not cut through the board"),
    effect: Words::of("the board does not come out of the stock"),
    advice: Words::of("cut deeper ({cutout-depth}), or set the thickness of the board ({thickness})"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Cutout(check) };

const NAME: &str = "not-through";

/// A shorter bridge breaks by itself. Chosen.
const SHORT: f64 = 500_000.0;

fn check(contours: &Contours<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    let of = |ring| stretches(contours, ring, settings);
    contours.rings.iter().flat_map(of).collect()
}

fn stretches(contours: &Contours<'_>, ring: &Ring, settings: &Settings) -> Vec<Finding> {
    let (program, line) = contours.last();
    let wrong = ring
        .stretches
        .iter()
        .filter(|stretch| stretch.state == State::Shallow && !contours.is_tab(stretch, ring, settings));
    let finding = |stretch: &Stretch| {
        let (depth, board) = (stretch.depth, settings.board);
        let message = format!(
            "{:.3} mm of the edge is not cut through: {depth:.3} mm deep where it is least, in a board of \
             {board:.3} mm",
            stretch.length / 1e6
        );
        let severity = if stretch.length > SHORT { Severity::Error } else { Severity::Warning };
        Finding {
            at: Some(stretch.at),
            size: Some(board - depth),
            program: program.clone(),
            line,
            ..Finding::new(NAME, severity, message)
        }
    };
    wrong.map(finding).collect()
}
