//! What each code means: what was found, what it does to the board, and what to try.
//!
//! Three lists are put together here: the checks of [`verify`](crate::verify), the diagnostics of
//! files that [`import`](crate::import) knows, and what is noticed while programs are made,
//! `planning`.

use std::fmt::Write as _;

use crate::board::Diagnostic;
use crate::board::diagnostic::{Stage, planning};
use crate::import::diagnostic;
use crate::verify::check;

const fn heading(stage: Stage) -> &'static str {
    match stage {
        Stage::Verification => "Findings of verification",
        Stage::Planning => "Warnings of planning",
        Stage::Files => "Warnings about files",
    }
}

/// What [`Diagnostic::effect`] is called.
const fn effect_label(stage: Stage) -> &'static str {
    match stage {
        Stage::Verification | Stage::Planning => "effect",
        Stage::Files => "expected",
    }
}

/// Every kind, by stage and code.
#[must_use]
pub fn all() -> Vec<Diagnostic> {
    let checks = check::ALL.iter().map(|check| check.kind);
    let mut all: Vec<Diagnostic> = checks.chain(planning::ALL).chain(diagnostic::ALL).copied().collect();
    all.sort_by_key(|kind| (kind.stage, kind.code));
    all
}

/// The kind of a finding in a program.
pub(super) fn of_programs(code: &str) -> Option<&'static Diagnostic> {
    check::of(code).map(|check| check.kind).or_else(|| planning::ALL.iter().find(|kind| kind.code == code))
}

/// What a code means, in lines; none for a code that there is not.
#[must_use]
pub fn explain(code: &str) -> Option<String> {
    let text: String = all().iter().filter(|kind| kind.code == code).map(text).collect();
    (!text.is_empty()).then_some(text)
}

/// Every code with a line, under headings.
#[must_use]
pub fn list() -> String {
    let mut text = String::new();
    for same in all().chunk_by(|a, b| a.stage == b.stage) {
        let _ = writeln!(text, "{}:", heading(same[0].stage));
        for Diagnostic { code, what, .. } in same {
            let _ = writeln!(text, "  {code:28} {what}");
        }
    }
    text
}

/// `docs/findings.md`.
#[must_use]
pub fn page() -> String {
    let mut text = "# Findings and warnings\n\nEach message ends with a code in brackets. `voromill explain CODE` prints the same text.\n"
        .to_owned();
    for same in all().chunk_by(|a, b| a.stage == b.stage) {
        let (heading, cost) = (heading(same[0].stage), effect_label(same[0].stage));
        let _ = write!(text, "\n## {heading}\n\n| code | what | {cost} | what to try |\n|---|---|---|---|\n");
        for Diagnostic { code, what, effect, advice, .. } in same {
            let cell = |words: &dyn ToString| words.to_string().replace('|', "\\|");
            let _ = writeln!(text, "| `{code}` | {} | {} | {} |", cell(what), cell(effect), cell(advice));
        }
    }
    text
}

fn text(Diagnostic { code, stage, what, effect, advice, .. }: &Diagnostic) -> String {
    let label = effect_label(*stage);
    format!("{code}: {what}\n  {label:9} {effect}\n  try       {advice}\n")
}
