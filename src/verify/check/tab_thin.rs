//! # What it checks
//!
//! Every tab is at least half as wide as was asked for, or half a millimetre where nobody said how
//! wide, and a fifth of a millimetre thick.
//!
//! # Why
//!
//! A thin tab breaks while the cutter is still turning.
//!
//! # What it can miss
//!
//! How strong the material is.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::Board;
use crate::geometry::Nm;
use crate::verify::Settings;
use crate::verify::contours::{Contours, State, Stretch};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a tab that breaks"),
    effect: Words::of("the tab breaks while the board is cut out"),
    advice: Words::of("make tabs wider or higher ({tab-width}, {tab-height})"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Cutout(check) };

const NAME: &str = "tab-thin";

/// The narrowest tab where nobody said how wide they are, and the thinnest. Chosen.
const NARROWEST: Nm = Nm::from_um(500);
const THINNEST: Nm = Nm::from_um(200);

fn check(contours: &Contours<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    let (program, line) = contours.last();
    let least = settings.tab_width.map_or(NARROWEST, |width| width / 2);
    let finding = |tab: &Stretch| {
        let width = Nm::from_f64(contours.width(tab, settings).max(0.0));
        let thick = if tab.state == State::Uncut { settings.board } else { settings.board - tab.depth };
        let is_thin = width < least || thick < THINNEST;
        is_thin.then(|| Finding {
            at: Some(tab.at),
            size: Some(width.min(thick)),
            program: program.clone(),
            line,
            ..Finding::new(
                NAME,
                Severity::Warning,
                format!("a tab is {width:.3} mm wide and {thick:.3} mm thick"),
            )
        })
    };
    contours.rings.iter().flat_map(|ring| contours.tabs(ring, settings)).filter_map(finding).collect()
}
