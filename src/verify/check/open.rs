//! # What it checks
//!
//! Every net that a cut reaches into is left in one connected piece. Negligible residues do not
//! count. Which nets a cut may part, and what is left of them, is asked of the exact shapes.
//!
//! # Why
//!
//! A net in two pieces does not conduct.
//!
//! # What it can miss
//!
//! A net cut in two whose parts stay joined through clad beside it: those conduct, and count as
//! one. A hair of copper that holds two parts together counts too; `minimum-width` tells of it.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::Shape;
use crate::geometry::{Nm, Point};
use crate::topology::{NetId, Proximity};
use crate::verify::outcome::Outcome;
use crate::verify::report::Finding;
use crate::verify::rest::{Remnant, Rest};
use crate::verify::sheet::Sheet;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a net cut in two"),
    effect: Words::of("a net is interrupted: one part of it is not connected to the other"),
    advice: Words::of(
        "use a narrower tool, or a smaller {depth} with a V-bit; for a program of other CAM check tool and offset",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Isolation(|sheet, _| check(sheet)) };

const NAME: &str = "open";

fn check(sheet: &Outcome<'_>) -> Vec<Finding> {
    sheet.remains.nets.iter().filter_map(|(&net, rest)| open(sheet, net, rest)).collect()
}

fn open(sheet: &Sheet<'_>, net: NetId, rest: &Rest) -> Option<Finding> {
    let groups = rest.apart();
    let (largest, others) = groups.split_first()?;
    let next = others.first()?;
    let name = sheet.nets.label(net);
    let message = format!("{name} is cut into {} pieces", groups.len());
    let (at, width) = between(sheet, largest, next);
    let walls = sheet.walls.around(at, sheet.half * 4);
    let cut = walls.iter().find_map(|wall| sheet.cuts.get(wall.index));
    Some(Finding {
        nets: vec![name],
        at: Some(at),
        size: width.map(Nm::from_f64),
        area: Some(next.iter().map(|part| part.area).sum()),
        program: cut.map(|cut| cut.program.followed.file.clone()),
        line: cut.map(|cut| cut.swept.line),
        ..Finding::new(NAME, Severity::Error, message)
    })
}

/// Where two groups of parts are nearest to each other: the middle between them, and how far in
/// nanometres.
fn between(sheet: &Sheet<'_>, one: &[&Remnant], other: &[&Remnant]) -> (Point, Option<f64>) {
    let shape = |part: &&Remnant| Shape::Polygon(part.polygon.clone());
    let near = Proximity::of(&one.iter().map(shape).collect::<Vec<_>>());
    let (mut reach, most) = (sheet.half * 4, (sheet.rect().width() + sheet.rect().height()) * 2);
    while reach < most {
        let places = other.iter().flat_map(|part| near.near(&shape(part), reach));
        if let Some(place) = places.reduce(|a, b| if b.width < a.width { b } else { a }) {
            return (place.at, Some(place.width));
        }
        reach = reach * 4;
    }
    (other[0].polygon.contours()[0][0], None)
}
