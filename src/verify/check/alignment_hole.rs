//! # What it checks
//!
//! The holes on whose pins the board is flipped lie beside it, there are at least two of them, and
//! they go far enough below the board at their full diameter that pins stand in what lies under it,
//! and no farther than beds are thick. Flipped about the line that the other programs are mirrored
//! about, each lies on a pin.
//!
//! # Why
//!
//! A pin that falls over holds nothing, and a board that is flipped on it has its back beside
//! its front.
//!
//! # What it can miss
//!
//! How thick what lies under the board is.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::{Board, FLATTEN};
use crate::geometry::{Nm, Point, Rect};
use crate::verify::Settings;
use crate::verify::cut::Cut;
use crate::verify::edges::Edges;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("an alignment hole that holds no pin"),
    effect: Words::of("a pin does not stand, and the back is not milled in register with the front"),
    advice: Words::of(
        "drill deeper ({alignment-depth}) or farther from the board ({alignment-margin}), and make the holes in one \
         run with the programs for the back ({mirror-axis})",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Alignment(check) };

const NAME: &str = "alignment-hole";

/// How far a pin stands in what lies under the board, at least. Chosen.
const STAND: Nm = Nm::from_mm(1);

/// A hole that goes farther below the board is told. Chosen: boards to be drilled into are one to
/// two centimetres thick.
const DEEP: Nm = Nm::from_mm(15);

/// A hole as it was drilled, or bored.
struct Drilled<'a> {
    /// What is cut of it, and a place in it.
    around: Rect,
    at: Point,
    /// How deep it has its full diameter.
    depth: Nm,
    cut: Cut<'a>,
}

impl Drilled<'_> {
    fn middle(&self) -> Point {
        self.around.min().midpoint(self.around.max())
    }
}

fn check(programs: &[&Machining], mirror: Option<Nm>, board: &Board, settings: &Settings) -> Vec<Finding> {
    let mut holes: Vec<Drilled<'_>> = Vec::new();
    for cut in Cut::all(programs) {
        let (shape, depth) = (&cut.swept.shape, cut.swept.full);
        let (at, around) = (shape.anchor(), shape.bounds());
        // Holes are far from each other; of one that is bored each piece touches those before.
        match holes.iter_mut().find(|hole| hole.around.touches(around)) {
            Some(hole) => {
                hole.around = hole.around.union(around);
                if hole.depth < depth {
                    (hole.depth, hole.cut) = (depth, cut);
                }
            }
            None => holes.push(Drilled { around, at, depth, cut }),
        }
    }
    let outline = board.outline.as_ref().map(|outline| outline.polygon(FLATTEN));
    let edges = Edges::new(outline.as_slice());
    let inside = |hole: &Drilled<'_>| {
        let (middle, radius) = (hole.middle(), hole.around.width().to_f64() / 2.0);
        outline
            .as_ref()
            .is_some_and(|outline| outline.contains(middle) || edges.nearest(middle.to_f64()).0 < radius)
    };
    let on_machine = |hole: &Drilled<'_>| hole.cut.program.followed.placement.apply(hole.middle());
    let pins: Vec<Point> = holes.iter().map(on_machine).collect();
    let mut findings = Vec::new();
    let mut add = |hole: &Drilled<'_>, severity: Severity, message: String, size: Option<Nm>| {
        findings.push(Finding {
            at: Some(hole.at),
            size,
            program: Some(hole.cut.program.followed.file.clone()),
            line: Some(hole.cut.swept.line),
            ..Finding::new(NAME, severity, message)
        });
    };
    for (hole, pin) in holes.iter().zip(&pins) {
        let below = hole.depth - settings.board;
        if inside(hole) {
            add(hole, Severity::Error, "an alignment hole reaches into the board".to_owned(), None);
        }
        if below < Nm::ZERO {
            let message = "an alignment hole does not go through the board".to_owned();
            add(hole, Severity::Error, message, Some(-below));
        } else if below < STAND {
            let message = format!("an alignment hole goes {below:.3} mm below the board: a pin falls over");
            add(hole, Severity::Warning, message, Some(below));
        } else if below > DEEP {
            let message = format!("an alignment hole goes {below:.3} mm below the board, into the machine");
            add(hole, Severity::Warning, message, Some(below));
        }
        let Some(axis) = mirror else { continue };
        let flipped = Point::new(axis * 2 - pin.x, pin.y);
        let off = pins.iter().map(|pin| pin.distance(flipped)).fold(f64::INFINITY, f64::min);
        if off > settings.place.to_f64() {
            let off = Nm::from_f64(off);
            let message = format!(
                "flipped about x = {axis:.3} mm, an alignment hole lies {off:.3} mm beside the next pin"
            );
            add(hole, Severity::Error, message, Some(off));
        }
    }
    match holes.as_slice() {
        [] => findings.extend(programs.iter().map(|program| Finding {
            program: Some(program.followed.file.clone()),
            ..Finding::new(NAME, Severity::Error, "it drills no alignment hole".to_owned())
        })),
        [only] => {
            let message = "one alignment hole alone does not hold a board that is flipped".to_owned();
            add(only, Severity::Error, message, None);
        }
        _ => {}
    }
    findings
}
