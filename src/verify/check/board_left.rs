//! # What it checks
//!
//! Along every contour of the outline the board ends where it should: it is cut through just beyond
//! the edge, all the way round but for tabs; cut-outs may be drilled instead. Stretches that are
//! not cut, or cut too far out, are told with their length and how much is left.
//!
//! # Why
//!
//! What is left must be sawn and filed off, or the board stays in its stock. A contour that was not
//! closed, made for another cutter, moved, or left out, is found so.
//!
//! # What it can miss
//!
//! In programs that do not say how wide their tabs are, stretches up to 10 mm may be tabs. Inner
//! corners keep the round that the cutter leaves.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::Board;
use crate::geometry::Nm;
use crate::verify::Settings;
use crate::verify::contours::{Contours, Ring, State, Stretch};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("an edge that is not cut, or too far out"),
    effect: Words::of("the board stays too large, or hangs on the stock"),
    advice: Words::of("check the cutter ({cutout-tool}), and that the outline is closed"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Cutout(check) };

const NAME: &str = "board-left";

/// Shorter stretches are filed off without a thought. Chosen.
const BURR: f64 = 500_000.0;

fn check(contours: &Contours<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    let of = |ring| left(contours, ring, settings);
    contours.rings.iter().flat_map(of).collect()
}

fn left(contours: &Contours<'_>, ring: &Ring, settings: &Settings) -> Vec<Finding> {
    let (program, line) = contours.last();
    let finding = |stretch: &Stretch| {
        let (severity, message) = judged(contours, ring, stretch, settings)?;
        let left = match stretch.state {
            State::Through => stretch.mean,
            _ if stretch.left.is_finite() => stretch.left,
            _ => stretch.length,
        };
        Some(Finding {
            at: Some(stretch.at),
            size: Some(Nm::from_f64(left)),
            program: program.clone(),
            line,
            ..Finding::new(NAME, severity, message)
        })
    };
    ring.stretches.iter().filter_map(finding).collect()
}

fn judged(
    contours: &Contours<'_>,
    ring: &Ring,
    stretch: &Stretch,
    settings: &Settings,
) -> Option<(Severity, String)> {
    let (left, length) = (stretch.left / 1e6, stretch.length / 1e6);
    match stretch.state {
        State::Shallow => None,
        State::Uncut if contours.is_tab(stretch, ring, settings) => None,
        // Beside a tab the cutter's round end leaves as much.
        State::Through if stretch.off <= contours.half.to_f64() * 2.0 => None,
        State::Through => {
            let message = format!("the edge is cut {:.3} mm too far out", stretch.mean / 1e6);
            Some((Severity::Warning, message))
        }
        State::Narrow => {
            let message = format!(
                "the cutter of {:.3} mm does not fit in along {length:.3} mm of the edge: it is not cut",
                contours.half * 2
            );
            Some((Severity::Warning, message))
        }
        State::Uncut => {
            let severity = if stretch.length > BURR { Severity::Error } else { Severity::Warning };
            let message = if stretch.left.is_finite() {
                format!("along {length:.3} mm of the edge {left:.3} mm of material is left beyond it")
            } else {
                format!("{length:.3} mm of the edge is not cut")
            };
            Some((severity, message))
        }
    }
}
