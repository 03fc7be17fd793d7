//! Levelled programs beside those that they were made of. They follow the surface as it was probed,
//! which nobody here knows; along it they do what the others do on a flat one, so these are judged.

use crate::gcode::level;
use crate::gcode::read::{Listing, Motion, Way, lines};
use crate::geometry::Arc;

use super::Program;
use super::check::REVISION;
use super::machining::Machining;
use super::report::Finding;

/// Takes the levelled programs out of `read`, which is what `programs` do, that have others beside
/// them for the same part of the board and with the same tools; tells those that were not made of
/// these, going by their comments and how far they mill.
pub(super) fn set_aside(read: &mut Vec<Machining>, programs: &[Program]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let origin = |levelled: &Machining| {
        let fits = |other: &Machining| {
            !other.is_levelled
                && other.role == levelled.role
                && other.followed.tools.are(&levelled.followed.tools)
        };
        let mut origins = read.iter().zip(programs).filter(|(other, _)| fits(other));
        origins.next().filter(|_| levelled.is_levelled)
    };
    let mut stays = Vec::with_capacity(read.len());
    for (machining, program) in read.iter().zip(programs) {
        let origin = origin(machining);
        stays.push(origin.is_none());
        let Some((made_of, origin)) = origin else { continue };
        let [way, whole] = [machining, made_of].map(|program| way(&program.followed.listing));
        let message = if comments(&origin.text).ne(comments(&program.text)) {
            format!("it was levelled from another program than {} is now: level that again", origin.file)
        } else if (way - whole).abs() > ROUNDED * whole {
            let [way, whole] = [way, whole].map(|way| way / 1e6);
            format!("it mills {way:.1} mm where {} mills {whole:.1} mm: level that again", origin.file)
        } else {
            continue;
        };
        let found = Finding::new(REVISION.code, REVISION.severity, message);
        findings.push(Finding { program: Some(program.file.clone()), ..found });
    }
    let mut stays = stays.into_iter();
    read.retain(|_| stays.next().unwrap_or(true));
    findings
}

/// How much longer or shorter levelling may make a way, as a part of it. Chosen: it divides cuts
/// into parts whose ends are rounded, and some programs do so with chords of arcs.
const ROUNDED: f64 = 0.01;

/// How long the way of the tool is where it does not go at full speed, seen from above, in
/// nanometres.
fn way(listing: &Listing) -> f64 {
    let length = |motion: &Motion| {
        let (from, to) = motion.from.point().zip(motion.to.point())?;
        Some(match motion.way {
            Way::Rapid => 0.0,
            Way::Feed => from.distance(to),
            Way::Arc { center, turn } => Arc { start: from, end: to, center, turn }.length(),
        })
    };
    listing.motions.iter().filter_map(length).sum()
}

/// The lines of a program that are comments and do not say that it is levelled.
fn comments(text: &str) -> impl Iterator<Item = &str> {
    lines(text).map(str::trim).filter(|line| line.starts_with(['(', ';']) && !level::is_levelled(line))
}
