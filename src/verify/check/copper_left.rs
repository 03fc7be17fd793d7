//! # What it checks
//!
//! What was asked to be cleared is clear: all of the board (`--clear`), areas, regions of nets, and
//! what lies within a distance of nets. Where the middle of a tool may be, half its kerf and a
//! little more from copper and on the board, all that is as near as it is wide at the copper's
//! bottom must be swept. Larger pieces than a crumb that are not are told, each with its area.
//!
//! # Why
//!
//! Copper that stays within the distance asked for carries a spark from net to net; elsewhere it
//! is an island that nobody wanted.
//!
//! # What it can miss
//!
//! Strips less than 10 µm wide, and pieces that together are more than a crumb but none of them
//! is. Where a file says what was to be cleared it must be given. Along the edge of a net's region
//! it looks no nearer than half a kerf.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::verify::Settings;
use crate::verify::asked::meant;
use crate::verify::cleared::Cleared;
use crate::verify::report::Finding;
use crate::verify::runs::Piece;
use crate::verify::sheet::Sheet;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("copper is left where it was to be cleared"),
    effect: Words::of(
        "copper stays where none was wanted; within the distance asked for by {distance-for}, which is then an error, it bridges part of it",
    ),
    advice: Words::of(
        "check that the programs of all tools are given, that none was changed, and that files of {clear-area} and {keep-area} are given",
    ),
};

pub(super) const CHECK: Check =
    Check { kind: &KIND, run: Run::Isolation(|outcome, settings| check(outcome, settings)) };

const NAME: &str = "copper-left";

/// So many pieces are listed. Chosen.
const MOST_LISTED: usize = 50;

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let asked = &sheet.asked;
    if let Some(file) = asked.unread.first() {
        let message = format!(
            "whether what was to be cleared is clear is not checked: `{file}` says where, and is not given"
        );
        return vec![Finding::new(NAME, Severity::Info, message)];
    }
    if !asked.is_something() || sheet.cuts.is_empty() {
        return Vec::new();
    }
    let cleared = Cleared::new(sheet, asked);
    let mut findings = Vec::new();
    for (pattern, distance) in &asked.distances {
        let nets = meant(std::iter::once(pattern), sheet.copper, &sheet.nets);
        let message = |mm2: f64| {
            format!("{mm2:.3} mm² of copper are left within {distance:.3} mm of the nets `{pattern}`")
        };
        let pieces = cleared.left_round(&nets, *distance);
        findings.extend(listed(&pieces, settings, Severity::Error, message));
    }
    if asked.everything || !asked.areas.is_empty() || !asked.nets.is_empty() {
        let message = |mm2: f64| format!("{mm2:.3} mm² of copper are left where it was to be cleared");
        findings.extend(listed(&cleared.left_of_areas(), settings, Severity::Warning, message));
    }
    findings
}

/// The largest of some pieces, as findings; what is no larger than a crumb is none.
fn listed(
    pieces: &[Piece],
    settings: &Settings,
    severity: Severity,
    message: impl Fn(f64) -> String,
) -> Vec<Finding> {
    let large = pieces.iter().take_while(|piece| piece.mm2 > settings.crumb).take(MOST_LISTED);
    let finding = |piece: &Piece| Finding {
        at: Some(piece.at),
        area: Some(piece.mm2),
        ..Finding::new(NAME, severity, message(piece.mm2))
    };
    large.map(finding).collect()
}
