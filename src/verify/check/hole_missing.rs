//! # What it checks
//!
//! Every hole of the board is drilled, or milled by a cutter that stays within it; every slot at both its ends.
//!
//! # Why
//!
//! A lead does not fit where there is no hole.
//!
//! # What it can miss
//!
//! How deep: nobody has told it how thick the board is. The middle of slots, and how round a milled hole is.

use super::{Check, Run, Severity, plunges};
use crate::board::{Board, Hole, Shape};
use crate::geometry::{Nm, Point};
use crate::verify::Settings;
use crate::verify::machining::Machining;
use crate::verify::report::Finding;

pub(super) const CHECK: Check =
    Check { name: NAME, about: "a hole that is not drilled", run: Run::Drilling(check) };

const NAME: &str = "hole-missing";

fn check(programs: &[&Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    let mut drilled: Vec<Point> = plunges(programs).map(|(_, plunge)| plunge.at).collect();
    drilled.sort_unstable();
    let reach = settings.place;
    let is_drilled = |p: Point| {
        let from = drilled.partition_point(|at| at.x < p.x - reach);
        let near = drilled[from..].iter().take_while(|at| at.x <= p.x + reach);
        near.copied().any(|at| at.distance(p) <= reach.to_f64())
    };
    let milled: Vec<(Point, Nm)> = programs.iter().flat_map(|program| milled(program)).collect();
    let is_milled = |hole: &Hole, p: Point| {
        let room = hole.diameter / 2 + reach;
        milled.iter().any(|(at, radius)| *radius <= room && at.distance(p) <= (room - *radius).to_f64())
    };
    let is_made = |hole: &Hole, p: Point| is_drilled(p) || is_milled(hole, p);
    let missing = board
        .holes
        .iter()
        .filter(|hole| ![hole.path.start, hole.path.end()].iter().all(|&p| is_made(hole, p)));
    missing.map(finding).collect()
}

/// Where the cutter goes sideways in the board: the ends of its ways, with its radius.
fn milled(program: &Machining) -> impl Iterator<Item = (Point, Nm)> {
    program.swept.iter().flat_map(|swept| {
        let ends = match &swept.shape {
            Shape::Stroke { from, to, .. } => vec![*from, *to],
            Shape::Arc { arc, .. } => vec![arc.start, arc.end],
            Shape::Disc { .. } | Shape::Polygon(_) => Vec::new(),
        };
        ends.into_iter().map(|at| (at, swept.half()))
    })
}

fn finding(hole: &Hole) -> Finding {
    let what = if hole.is_slot() { "slot" } else { "hole" };
    let message = format!("the {what} of {:.3} mm is not drilled", hole.diameter);
    Finding {
        at: Some(hole.path.start),
        size: Some(hole.diameter),
        ..Finding::new(NAME, Severity::Error, message)
    }
}
