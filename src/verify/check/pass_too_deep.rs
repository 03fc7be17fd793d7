//! # What it checks
//!
//! No end mill takes more than three times its diameter in one pass: what the program cut there
//! before counts.
//!
//! # Why
//!
//! An end mill bears a load sideways that grows with its depth in the material, and what it bends
//! by grows with the third power of how far it reaches out. Cutouts are milled in passes of half a
//! diameter; three are what routers with spindles far faster than those of desktop mills cut.
//!
//! # What it can miss
//!
//! How far the cutting edges of this tool reach. Passes that other programs cut before.

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, once, stretches};
use crate::board::Shape;
use crate::geometry::{Nm, Point, Rect, RectIndex, Turn, Vector};
use crate::verify::CutterKind;
use crate::verify::bores::from_axis;
use crate::verify::machining::{Machining, Swept};
use crate::verify::report::Finding;

pub(in crate::verify) const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a pass that is too deep for the end mill"),
    effect: Words::of("the end mill bends, cuts beside its way, and breaks"),
    advice: Words::of(
        "mill in several passes ({cutout-pass}, or {depth-pass} for pockets), or with a wider end mill",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Motion(|program, _, _| check(program)) };

const NAME: &str = "pass-too-deep";

/// So many diameters. Chosen: the flutes of end mills for boards are four to six diameters long,
/// and makers of routers have two to three cut at once.
pub(in crate::verify) const MOST: i64 = 3;

/// How far within the edge of what is cut a place lies that is looked at. Chosen: programs round to
/// a micrometre, and longer is what is cut at once.
const WITHIN: Nm = Nm::from_um(2);

fn check(program: &Machining) -> Vec<Finding> {
    let deep = |swept: &Swept| {
        let cutter = program.followed.tools.at(swept.line)?;
        let sideways = !matches!(swept.shape, Shape::Disc { .. });
        let most = cutter.tip * MOST;
        (cutter.kind == CutterKind::EndMill && sideways && swept.depth > most).then_some(most)
    };
    if !program.swept.iter().any(|swept| deep(swept).is_some()) {
        return Vec::new();
    }
    let index = RectIndex::new(program.swept.iter().map(|swept| swept.shape.bounds()));
    // How deep it was cut before the cutter came.
    let before = |piece: usize, p: Point| {
        let near = index.touching(Rect::new(p, p)).into_iter().filter(|&other| other < piece);
        let earlier = near.map(|other| &program.swept[other]);
        let there = earlier.filter(|swept| from_axis(&swept.shape, p) <= swept.half().to_f64());
        there.map(|swept| swept.depth).max().unwrap_or(Nm::ZERO)
    };
    let wrong = |(piece, swept): (usize, &Swept)| {
        let most = deep(swept)?;
        let taken = ahead(swept).map(|p| swept.depth - before(piece, p));
        let taken = taken.into_iter().max().filter(|taken| *taken > most)?;
        let width = swept.half() * 2;
        let message = format!("a pass {taken:.3} mm deep with an end mill of {width:.3} mm");
        let wrong = Wrong { severity: Severity::Warning, message, size: Some(taken) };
        Some((wrong, Some(swept.shape.at(0.5)), swept.line))
    };
    once(stretches(&program.followed, NAME, program.swept.iter().enumerate().map(wrong)), "places")
}

/// Where the front of the cutter is in the middle of a way and at its end.
fn ahead(swept: &Swept) -> [Point; 2] {
    let radius = (swept.half() - WITHIN).to_f64();
    [0.5, 1.0].map(|share| {
        let at = swept.shape.at(share);
        let way = match &swept.shape {
            Shape::Stroke { from, to, .. } => *to - *from,
            Shape::Arc { arc, .. } => {
                let out = at - arc.center;
                match arc.turn {
                    Turn::CounterClockwise => Vector::new(-out.y, out.x),
                    Turn::Clockwise => Vector::new(out.y, -out.x),
                }
            }
            Shape::Disc { .. } | Shape::Polygon(_) => Vector::default(),
        };
        let ((x, y), dx, dy) = (at.to_f64(), way.x.to_f64(), way.y.to_f64());
        let length = (dx * dx + dy * dy).sqrt().max(1.0);
        Point::from_f64(x + dx / length * radius, y + dy / length * radius)
    })
}
