//! # What it checks
//!
//! The tabs of a board lie on several sides of it: no way round its contour without a tab is longer
//! than three fifths of the contour. One tab alone is told of, too, unless just one was asked for.
//!
//! ```text
//!   ┌──────┬─┬───────┬─┬──────┐   tabs on one side: the cutter presses the other side down, and lifts it
//!   │                         │
//!   └─────────────────────────┘
//! ```
//!
//! # Why
//!
//! A board that is held at one side tips and swings when the last of it is cut: its edge is spoilt,
//! and the tabs break.
//!
//! # What it can miss
//!
//! A narrow board whose tabs lie on both of its long sides, but near one end. Boards that hang
//! together by more than tabs, as where a stretch is not cut: other findings tell of these. How
//! heavy and how stiff the board is.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::Board;
use crate::geometry::Nm;
use crate::verify::Settings;
use crate::verify::contours::{Contours, Ring, State, Stretch};
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("the tabs of a board all lie at one side of it"),
    effect: Words::of("the far side of the board tips under the cutter: its edge is spoilt, and tabs break"),
    advice: Words::of("ask for more tabs ({tabs} 4), or put them on opposite sides ({tab-at})"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Cutout(check) };

const NAME: &str = "tab-spread";

/// The part of the contour that may be without a tab. Chosen: two tabs opposite each other leave a
/// half, and corners move them a little; three on three sides of a square leave less.
const SHARE: f64 = 0.6;
/// A way so long needs no tab, in nanometres. Chosen: round a board of 15 mm, which hardly tips.
const SHORT: f64 = 60_000_000.0;

fn check(contours: &Contours<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    let boards = contours.rings.iter().filter(|ring| ring.is_board);
    boards.filter_map(|ring| one_sided(contours, ring, settings)).collect()
}

fn one_sided(contours: &Contours<'_>, ring: &Ring, settings: &Settings) -> Option<Finding> {
    let holds = |stretch: &Stretch| {
        let is_uncut = matches!(stretch.state, State::Shallow | State::Uncut);
        is_uncut && !contours.is_tab(stretch, ring, settings)
    };
    if ring.stretches.iter().any(holds) {
        return None;
    }
    let ways = contours.ways(ring, settings);
    let tabs = ways.len();
    let longest = ways.into_iter().reduce(|a, b| if b.length > a.length { b } else { a })?;
    let as_asked = tabs == 1 && settings.tabs == Some(1);
    if as_asked || longest.length <= SHORT || longest.length <= ring.length() * SHARE {
        return None;
    }
    let held = if tabs == 1 {
        "one tab alone holds it".to_owned()
    } else {
        format!("its {tabs} tabs lie at one side")
    };
    let (way, around) = (Nm::from_f64(longest.length), Nm::from_f64(ring.length()));
    let message = format!("{way:.1} mm of the {around:.1} mm round the board have no tab: {held}");
    let (program, line) = contours.last();
    Some(Finding {
        at: Some(longest.stretch.middle),
        size: Some(way),
        program,
        line,
        ..Finding::new(NAME, Severity::Warning, message)
    })
}
