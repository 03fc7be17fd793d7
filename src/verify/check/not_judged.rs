//! # What it checks
//!
//! Whether everything was asked that is asked of other programs. Where cuts cross by the hundred
//! thousand, looking at every pair of them would take hours; what was left out is told.
//!
//! # Why
//!
//! Nobody should take silence for a verdict.
//!
//! # What it can miss
//!
//! Nothing: it only tells of budgets that ended.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::diagnostic::count;
use crate::verify::outcome::Outcome;
use crate::verify::report::Finding;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("too many cuts in one place to check all of them"),
    effect: Words::of("the copper there is not verified"),
    advice: Words::of("look at the program: it cuts the same places hundreds of times"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Isolation(|sheet, _| check(sheet)) };

const NAME: &str = "not-judged";

fn check(sheet: &Outcome<'_>) -> Vec<Finding> {
    unsure(sheet).into_iter().chain(many(sheet)).chain(crowded(sheet)).collect()
}

/// Nets of which pictures did not tell what became of them.
fn unsure(sheet: &Outcome<'_>) -> Option<Finding> {
    let nets: Vec<String> = sheet.remains.unsure.iter().map(|&net| sheet.nets.label(net)).collect();
    let (first, more) = (nets.first()?, nets.len() - 1);
    let others = if more > 0 { format!(" and {more} more nets") } else { String::new() };
    let message =
        format!("too many cuts cross to verify that {first}{others} are whole and separate from others");
    Some(Finding::new(NAME, Severity::Warning, message).of(nets))
}

/// Nets of which the deepest cuts alone were looked at.
fn many(sheet: &Outcome<'_>) -> Option<Finding> {
    let looked_at = |net| sheet.hits.all.iter().filter(|hit| hit.net == net).count();
    let left_out =
        sheet.hits.many.iter().map(|(&net, many)| (net, many.count.saturating_sub(looked_at(net))));
    let left_out: Vec<_> = left_out
        .filter(|(net, _)| sheet.remains.nets.get(net).is_none_or(|rest| !rest.parts.is_empty()))
        .collect();
    let count: usize = left_out.iter().map(|(_, count)| count).sum();
    let nets = left_out.iter().map(|&(net, _)| sheet.nets.label(net));
    let message = format!("{count} more cuts reach into nets, less deep than those that were checked");
    (count > 0).then(|| Finding::new(NAME, Severity::Warning, message).of(nets))
}

/// Cuts beside which no slivers were looked for.
fn crowded(sheet: &Outcome<'_>) -> Option<Finding> {
    let crowded = sheet.crowded.iter().filter(|crowded| **crowded).count();
    let first = sheet.crowded.iter().position(|crowded| *crowded)?;
    let cut = sheet.cuts[first];
    let cuts = count(crowded, "cut");
    let message = format!("slivers were not checked beside {cuts}: hundreds of others run near each");
    Some(Finding {
        at: Some(cut.swept.shape.anchor()),
        program: Some(cut.program.followed.file.clone()),
        line: Some(cut.swept.line),
        ..Finding::new(NAME, Severity::Warning, message)
    })
}
