//! # What it checks
//!
//! A program that says what it was made from (`from FILE design HASH` in its comments) was made
//! from the files that it is judged by.
//!
//! # Why
//!
//! A drill program of the revision before fits the copper almost everywhere. What differs may be
//! found by other checks, as a short or a missing hole; this one says why, and that the program is
//! to be made again.
//!
//! It is a warning: a program says all files of its board, and a change in one of them need not
//! change what this program does.
//!
//! # What it can miss
//!
//! Programs of others say nothing of their files. The hash is of what this version of voromill
//! reads; another one may read curves otherwise, and then all programs are of another revision.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::verify::declared::origins;
use crate::verify::report::Finding;
use crate::verify::{Input, Program};

pub(in crate::verify) const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a program that was made from other files than these"),
    effect: Words::of("the board is milled as it was before its files changed"),
    advice: Words::of("make the programs again from these files"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Inputs(check) };

const NAME: &str = "revision";

fn check(program: &Program, inputs: &[Input]) -> Vec<Finding> {
    let is_known =
        |design: &str| !design.is_empty() && inputs.iter().any(|input| input.design.starts_with(design));
    let mut others = origins(&program.text);
    others.retain(|(_, design, _)| !is_known(design));
    let Some((first, _, line)) = others.first() else { return Vec::new() };
    let more = match others.len() - 1 {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let is_there = inputs.iter().any(|input| input.file == *first);
    let what = if is_there { "which has another content now" } else { "which is not among these" };
    let message =
        format!("it was made from other files than these: from {first}, {what}{more}; make it again");
    vec![Finding {
        program: Some(program.file.clone()),
        line: Some(*line),
        ..Finding::new(NAME, Severity::Warning, message)
    }]
}
