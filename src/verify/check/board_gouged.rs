//! # What it checks
//!
//! What cuts the board out stays outside the outline: the cutter's side reaches no further into the
//! board than tolerated. What lies within a hole of the board may be cut.
//!
//! # Why
//!
//! A board that was cut too small does not fit its case, and copper beside its edge is gone. A
//! contour on the wrong side of the outline, for another cutter, or moved, is found so.
//!
//! # What it can miss
//!
//! Scratches less deep than the copper is thick.

use std::collections::BTreeSet;

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::{Board, Shape};
use crate::geometry::Nm;
use crate::topology::{Method, NetId, Proximity, recover};
use crate::verify::Settings;
use crate::verify::contours::{Contours, Taken};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a cutout that cuts into the board"),
    effect: Words::of("the board loses a part of its edge, and maybe copper"),
    advice: Words::of("check the cutter ({cutout-tool}) and the offset of the program"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Cutout(check) };

const NAME: &str = "board-gouged";

fn check(contours: &Contours<'_>, board: &Board, settings: &Settings) -> Vec<Finding> {
    if contours.taken.is_empty() {
        return Vec::new();
    }
    let copper = hit(contours, board);
    let finding = |(taken, nets): (&Taken<'_>, &BTreeSet<String>)| {
        let depth = Nm::from_f64(taken.depth);
        let severity = if depth > settings.edge { Severity::Error } else { Severity::Warning };
        let with = match nets.len() {
            0 => String::new(),
            1..=3 => format!(", and into {}", nets.iter().cloned().collect::<Vec<_>>().join(", ")),
            many => format!(", and into {many} nets"),
        };
        let message = format!("the cutter goes {depth:.3} mm into the board{with}");
        Finding {
            at: Some(taken.at),
            size: Some(depth),
            program: Some(taken.cut.program.followed.file.clone()),
            line: Some(taken.cut.swept.line),
            nets: nets.iter().cloned().collect(),
            ..Finding::new(NAME, severity, message)
        }
    };
    contours.taken.iter().zip(&copper).map(finding).collect()
}

/// The nets on either side that each piece takes copper of, inside the outline.
fn hit(contours: &Contours<'_>, board: &Board) -> Vec<BTreeSet<String>> {
    let mut found: Vec<BTreeSet<String>> = vec![BTreeSet::new(); contours.taken.len()];
    for copper in [&board.front, &board.back].into_iter().flatten() {
        let (nets, proximity) = (recover(copper, Method::default()), Proximity::new(copper));
        for (taken, names) in contours.taken.iter().zip(&mut found) {
            let shape: &Shape = &taken.cut.swept.shape;
            let near = proximity.near(shape, Nm::ZERO).into_iter();
            // Copper that goes on beyond the edge is cut there by anybody.
            let inside = near.filter(|near| near.width <= 0.0 && contours.edges.contains(near.at));
            let ids: BTreeSet<NetId> = inside.map(|near| nets.of(near.feature)).collect();
            names.extend(ids.into_iter().map(|net| nets.label(net)));
        }
    }
    found
}
