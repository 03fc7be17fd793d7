//! Holes that lie off the board: another board's, in another unit, or digits that were damaged.

use super::advice::NO_DRILL;
use super::archive::Found;
use super::error::Error;
use super::excellon::FRAME;
use crate::board::{Hole, Sentence, Warning, Words};
use crate::geometry::{Nm, Rect};
use crate::import::diagnostic;

/// How far off no hole lies that anybody means. Chosen: beyond what small mills reach, and within
/// what programs can be judged.
const FARTHEST: Nm = Nm::from_mm(300);

/// Holes most of which lie beside the board, however they are read.
pub(super) fn most(file: &Found, off: &Warning) -> Error {
    let hint = Words::of("if they are right, use {drill} {0}").with([&file.name]).then(NO_DRILL);
    Error::content(&file.shown, off.message.as_str(), hint)
}

/// Holes off the board.
pub(super) struct Stray {
    /// What is said of them.
    pub(super) warning: Warning,
    /// One lies farther than any that is meant.
    pub(super) refusal: Option<Error>,
}

/// The holes of `file` that lie off the `board`.
pub(super) fn some(file: &Found, holes: &[Hole], board: Rect) -> Option<Stray> {
    let off = || holes.iter().map(|hole| (hole, distance(hole, board))).filter(|(_, off)| *off > FRAME);
    let (farthest, distance) = off().max_by_key(|(hole, off)| (*off, hole.line))?;
    let what = if farthest.is_slot() { "slot" } else { "hole" };
    let message = format!(
        "{} of {} holes of {} lie off the board, the farthest {what} by {distance:.1} mm",
        off().count(),
        holes.len(),
        file.name
    );
    let warning = diagnostic::HOLES_OFF_BOARD.warning(message).at(farthest.path.start);
    let refusal = (distance > FARTHEST).then(|| {
        let what = format!("a {what} of line {} lies {distance:.1} mm off the board", farthest.line);
        let hint = Sentence::from("a number in the file may be damaged, or in the wrong unit").then(NO_DRILL);
        Error::content(&file.shown, what, hint)
    });
    Some(Stray { warning: warning.caused_by(file.at_line(farthest.line)), refusal })
}

/// How far a hole reaches beyond the board to one side.
fn distance(hole: &Hole, board: Rect) -> Nm {
    let hole = hole.bounds();
    let beyond = [
        board.min().x - hole.min().x,
        board.min().y - hole.min().y,
        hole.max().x - board.max().x,
        hole.max().y - board.max().y,
    ];
    beyond.into_iter().max().unwrap_or_default()
}
