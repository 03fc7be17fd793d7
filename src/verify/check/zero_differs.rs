//! # What it checks
//!
//! Programs that say how the board lies (`origin`, `offset`, `rotate` in their comments) all say
//! the same, and those that are mirrored are mirrored about the same line.
//!
//! # Why
//!
//! Zero is set once. A program of another run, whose zero was elsewhere, fits the board by itself
//! and lies beside the others on the machine: holes beside their pads, an edge through the copper.
//!
//! # What it can miss
//!
//! Programs of other CAM say nothing of their zero. Where one zero is said for all (`--offset`,
//! `--register`), that is taken.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::geometry::Nm;
use crate::verify::machining::Machining;
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

/// Each program that differs from what most say.
fn check(programs: &[Machining]) -> Vec<Finding> {
    let told: Vec<&Machining> = programs.iter().filter(|program| program.says_zero).collect();
    let agree = |a: &Machining| told.iter().filter(|b| differs(a.placement, b.placement).is_none()).count();
    // The first of those that most agree with.
    let Some(usual) = told.iter().rev().max_by_key(|program| agree(program)) else { return Vec::new() };
    let finding = |program: &&Machining| {
        let how = differs(usual.placement, program.placement)?;
        let message = format!("{how} {}", usual.file);
        Some(Finding {
            program: Some(program.file.clone()),
            ..Finding::new(NAME, Severity::Warning, message)
        })
    };
    told.iter().filter_map(finding).collect()
}

/// How the board lies otherwise in the second than in the first; none where it does not.
fn differs(a: Placement, b: Placement) -> Option<String> {
    let (turned, way) = (b.degrees - a.degrees, b.shift + -a.shift);
    let flipped = a.mirror.zip(b.mirror).map_or(Nm::ZERO, |(a, b)| b - a);
    if turned.abs() > 1e-6 {
        Some(format!("the board is turned by {turned:.3}° against"))
    } else if (way.x, way.y) != (Nm::ZERO, Nm::ZERO) {
        Some(format!("zero lies {:.3}, {:.3} mm away from that of", -way.x, -way.y))
    } else if flipped != Nm::ZERO {
        Some(format!("the board is flipped about a line {flipped:.3} mm to the right of that of"))
    } else {
        None
    }
}
