//! # What it checks
//!
//! Programs that say how the board lies (`origin`, `offset`, `rotate` in their comments) all say
//! the same, and those that are mirrored are mirrored about the same line. So do programs of other
//! CAM whose place was found from what they cut, within half a millimetre.
//!
//! # Why
//!
//! Zero is set once. A program of another run, whose zero was elsewhere, fits the board by itself
//! and lies beside the others on the machine: holes beside their pads, an edge through the copper.
//!
//! # What it can miss
//!
//! Programs that say nothing of their zero. About which line the back was meant to be flipped,
//! where that was found from what it cuts.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::gcode::read::Coded;
use crate::geometry::Nm;
use crate::verify::machining::{Machining, Zero};
use crate::verify::placement::Placement;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("programs whose zero lies at different places of the board"),
    effect: Words::of("on the machine they lie beside each other unless zero is set anew in between"),
    advice: Words::of("make all programs in one run, with the same {origin}, {offset} and {rotate}"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Whole(|programs, _, _| check(programs)) };

const NAME: &str = "zero-differs";

/// How far off a place may be that was found from cuts. Chosen: more than how the lead-ins of a
/// cutout lie may change it, less than what anybody moves zero by.
const FOUND: Nm = Nm::from_um(500);

/// Each program that differs from what most say.
fn check(programs: &[Machining]) -> Vec<Finding> {
    let of = |zero: Zero, also: fn(&Machining) -> bool| -> Vec<&Machining> {
        programs.iter().filter(|program| program.zero == Some(zero) && also(program)).collect()
    };
    // Of a place that was found, the line about which it is mirrored is any.
    let found = [
        of(Zero::Given, |program| program.followed.placement.mirror.is_none()),
        of(Zero::Given, |program| program.followed.placement.mirror.is_some()),
    ];
    let lies = |programs: &[&Machining], tolerance: Nm| {
        among(programs, |a, b| lies_elsewhere(a.followed.placement, b.followed.placement, tolerance))
    };
    let told = lies(&of(Zero::Told, |_| true), Nm::ZERO);
    // Of those that are not mirrored nobody knows about which line they would be.
    let mirrored = of(Zero::Told, |program| program.followed.placement.mirror.is_some());
    let flipped = among(&mirrored, |a, b| flipped_elsewhere(a.followed.placement, b.followed.placement));
    let found = found.iter().flat_map(|programs| lies(programs, FOUND));
    let all: Vec<&Machining> = programs.iter().collect();
    let systems = among(&all, |a, b| {
        let (one, other) = (systems(a), systems(b));
        (one != other).then(|| format!("it counts from {other}, where {one} is that of"))
    });
    told.into_iter().chain(flipped).chain(found).chain(systems).collect()
}

/// The coordinate systems of a program: G54 is that of controllers when they start.
fn systems(program: &Machining) -> String {
    let is_system = |code: &&Coded| code.letter == 'G' && (540..=599).contains(&code.key);
    let mut names: Vec<String> =
        program.followed.listing.codes.iter().filter(is_system).map(Coded::to_string).collect();
    names.sort_unstable();
    if names.is_empty() { "G54".to_owned() } else { names.join(", ") }
}

/// Each of `programs` that differs from most of them, and how.
fn among(
    programs: &[&Machining],
    differs: impl Fn(&Machining, &Machining) -> Option<String>,
) -> Vec<Finding> {
    let agree = |a: &Machining| programs.iter().filter(|b| differs(a, b).is_none()).count();
    // The first of those that most agree with.
    let Some(usual) = programs.iter().rev().max_by_key(|program| agree(program)) else { return Vec::new() };
    let finding = |program: &&Machining| {
        let message = format!("{} {}", differs(usual, program)?, usual.followed.file);
        Some(Finding {
            program: Some(program.followed.file.clone()),
            ..Finding::new(NAME, Severity::Warning, message)
        })
    };
    programs.iter().filter_map(finding).collect()
}

/// How the board lies otherwise in the second than in the first; none where it does not.
fn lies_elsewhere(a: Placement, b: Placement, tolerance: Nm) -> Option<String> {
    let (turned, way) = (b.degrees - a.degrees, b.shift + -a.shift);
    if turned.abs() > 1e-6 {
        Some(format!("the board is turned by {turned:.3}° against"))
    } else if way.x.abs().max(way.y.abs()) > tolerance {
        Some(format!("zero lies {:.3}, {:.3} mm away from that of", -way.x, -way.y))
    } else {
        None
    }
}

/// The same of the lines about which they are mirrored.
fn flipped_elsewhere(a: Placement, b: Placement) -> Option<String> {
    let by = b.mirror? - a.mirror?;
    (by != Nm::ZERO).then(|| format!("the board is flipped about a line {by:.3} mm to the right of that of"))
}
