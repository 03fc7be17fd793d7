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
        of(Zero::Given, |program| program.placement.mirror.is_none()),
        of(Zero::Given, |program| program.placement.mirror.is_some()),
    ];
    let told = among(&of(Zero::Told, |_| true), Nm::ZERO);
    told.into_iter().chain(found.iter().flat_map(|programs| among(programs, FOUND))).collect()
}

/// Each of `programs` that lies elsewhere than most of them.
fn among(programs: &[&Machining], tolerance: Nm) -> Vec<Finding> {
    let differs = |a: &Machining, b: &Machining| differs(a.placement, b.placement, tolerance);
    let agree = |a: &Machining| programs.iter().filter(|b| differs(a, b).is_none()).count();
    // The first of those that most agree with.
    let Some(usual) = programs.iter().rev().max_by_key(|program| agree(program)) else { return Vec::new() };
    let finding = |program: &&Machining| {
        let message = format!("{} {}", differs(usual, program)?, usual.file);
        Some(Finding {
            program: Some(program.file.clone()),
            ..Finding::new(NAME, Severity::Warning, message)
        })
    };
    programs.iter().filter_map(finding).collect()
}

/// How the board lies otherwise in the second than in the first; none where it does not.
fn differs(a: Placement, b: Placement, tolerance: Nm) -> Option<String> {
    let (turned, way) = (b.degrees - a.degrees, b.shift + -a.shift);
    let flipped = a.mirror.zip(b.mirror).map_or(Nm::ZERO, |(a, b)| b - a);
    if turned.abs() > 1e-6 {
        Some(format!("the board is turned by {turned:.3}° against"))
    } else if way.x.abs().max(way.y.abs()) > tolerance {
        Some(format!("zero lies {:.3}, {:.3} mm away from that of", -way.x, -way.y))
    } else if flipped != Nm::ZERO {
        Some(format!("the board is flipped about a line {flipped:.3} mm to the right of that of"))
    } else {
        None
    }
}
