//! # What it checks
//!
//! Of every net something is left: more than a negligible residue, or of a small net three tenths.
//!
//! # Why
//!
//! A pad that is milled away cannot be soldered to.
//!
//! # What it can miss
//!
//! Nets of which a useless rest is left; `gouge` tells of them.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::topology::NetId;
use crate::verify::outcome::Outcome;
use crate::verify::report::Finding;
use crate::verify::rest::Rest;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a net milled away"),
    effect: Words::of("all copper of a net is gone"),
    advice: Words::of(
        "check tool, offset and scale of the program; a net narrower than the kerf needs a narrower tool",
    ),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Isolation(|sheet, _| check(sheet)) };

const NAME: &str = "destroyed";

fn check(sheet: &Outcome<'_>) -> Vec<Finding> {
    sheet.remains.nets.iter().filter_map(|(&net, rest)| destroyed(sheet, net, rest)).collect()
}

fn destroyed(sheet: &Outcome<'_>, net: NetId, rest: &Rest) -> Option<Finding> {
    let area = rest.area();
    let first = sheet.nets.nets()[net.index()].features[0] as usize;
    let name = sheet.nets.label(net);
    let hits = sheet.hits.all.iter().filter(|hit| hit.net == net);
    let deepest = hits.reduce(|a, b| if b.depth > a.depth { b } else { a });
    let cut = deepest.map(|hit| sheet.cuts[hit.cut]);
    let many = sheet.hits.many.get(&net);
    let many = many.map_or(String::new(), |many| {
        let or_more = if many.or_more { " or more" } else { "" };
        format!(": {}{or_more} cuts reach into it", many.count)
    });
    // What lies beyond the outline was never on the board.
    (rest.parts.is_empty() && area > 0.0).then(|| Finding {
        at: Some(sheet.copper.features[first].shape.anchor()),
        area: Some(area),
        program: cut.map(|cut| cut.program.followed.file.clone()),
        line: cut.map(|cut| cut.swept.line),
        nets: vec![name.clone()],
        ..Finding::new(NAME, Severity::Error, format!("nothing is left of {name}{many}"))
    })
}
