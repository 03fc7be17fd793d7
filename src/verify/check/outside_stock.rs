//! # What it checks
//!
//! No cut goes further beyond the rectangle round the board, as it lies on the machine, than the
//! stock's margin.
//!
//! # Why
//!
//! There are clamps, the table, the end of the axis; and a program laid elsewhere than its board is
//! found so.
//!
//! # What it can miss
//!
//! Stock that is smaller than it was told.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, bounds, each_stretch};
use crate::board::Board;
use crate::geometry::{Nm, Rect};
use crate::verify::Settings;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a cut beyond the stock"),
    effect: Words::of("the tool may cut the bed or a clamp"),
    advice: Words::of("check unit, origin and offset of the program ({origin}, {offset})"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Motion(check) };

const NAME: &str = "outside-stock";

fn check(program: &Machining, board: &Board, settings: &Settings) -> Vec<Finding> {
    let laid =
        |bounds: Rect| Rect::around(bounds.corners().map(|corner| program.followed.placement.apply(corner)));
    let Some(stock) = board.bounds().and_then(laid).map(|laid| laid.inflate(settings.margin)) else {
        return Vec::new();
    };
    each_stretch(&program.followed, NAME, |motion| {
        let below = [motion.from.z, motion.to.z].into_iter().flatten().any(|z| z < Nm::ZERO);
        let way = bounds(motion)?;
        let past = [stock.min() - way.min(), way.max() - stock.max()];
        let beyond = past.into_iter().flat_map(|past| [past.x, past.y]).max()?;
        let message = || format!("a cut {beyond:.3} mm beyond the stock");
        (below && beyond > Nm::ZERO).then(|| Wrong {
            severity: Severity::Error,
            message: message(),
            size: Some(beyond),
        })
    })
}
