//! Levelled programs beside those that they were made of. They follow the surface as it was probed,
//! which nobody here knows; along it they do what the others do on a flat one, so these are judged.

use crate::gcode::level;
use crate::gcode::read::lines;

use super::Program;
use super::check::REVISION;
use super::machining::Machining;
use super::report::Finding;

/// Takes the levelled programs out of `read`, which is what `programs` do, that have others beside
/// them for the same part of the board and with the same tools; tells those that were not made of
/// these, going by their comments.
pub(super) fn set_aside(read: &mut Vec<Machining>, programs: &[Program]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let origin = |levelled: &Machining| {
        let fits = |other: &Machining| {
            !other.is_levelled && other.role == levelled.role && other.tools.are(&levelled.tools)
        };
        let mut origins = read.iter().zip(programs).filter(|(other, _)| fits(other)).map(|(_, text)| text);
        origins.next().filter(|_| levelled.is_levelled)
    };
    let mut stays = Vec::with_capacity(read.len());
    for (machining, program) in read.iter().zip(programs) {
        let origin = origin(machining);
        stays.push(origin.is_none());
        let stale = origin.filter(|origin| comments(&origin.text).ne(comments(&program.text)));
        findings.extend(stale.map(|origin| Finding {
            program: Some(program.file.clone()),
            ..Finding::new(
                REVISION.code,
                REVISION.severity,
                format!("it was levelled from another program than {} is now: level that again", origin.file),
            )
        }));
    }
    let mut stays = stays.into_iter();
    read.retain(|_| stays.next().unwrap_or(true));
    findings
}

/// The lines of a program that are comments and do not say that it is levelled.
fn comments(text: &str) -> impl Iterator<Item = &str> {
    lines(text).map(str::trim).filter(|line| line.starts_with(['(', ';']) && !level::is_levelled(line))
}
