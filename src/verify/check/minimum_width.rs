//! # What it checks
//!
//! How wide what is left of a net is at its narrowest, against the design: at every place where a
//! cut reaches into it, straight across. Told where less than a stated part is left
//! (`Settings::keep`). It is the width at the surface, where it is least: what is cut away of a
//! trace and what is left are as wide together as the trace was designed.
//!
//! # Why
//!
//! A trace of half the width carries half the current, and breaks where it narrows.
//!
//! # What it can miss
//!
//! It looks straight across at the deepest place of each cut, no farther than 0.6 mm: what was
//! wider than that is not narrow. Where the cutter's middle goes through a net, or takes an end or
//! a corner of it, `gouge` and `open` tell of it.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::topology::NetId;
use crate::verify::Settings;
use crate::verify::hit::Hit;
use crate::verify::outcome::Outcome;
use crate::verify::report::Finding;
use crate::verify::sheet::Sheet;
use crate::verify::width::{Width, narrowest};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a net left with less than half its width"),
    effect: Words::of("a trace keeps less than half of its width: it carries less current and breaks easily"),
    advice: Words::of("use a narrower tool, or a smaller {depth} with a V-bit"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Isolation(check) };

const NAME: &str = "minimum-width";

fn check(sheet: &Outcome<'_>, settings: &Settings) -> Vec<Finding> {
    let mut nets: BTreeMap<NetId, Vec<Hit>> = BTreeMap::new();
    for hit in &sheet.hits.all {
        nets.entry(hit.net).or_default().push(*hit);
    }
    let nets: Vec<Vec<Hit>> = nets.into_values().collect();
    nets.into_par_iter()
        .filter_map(|hits| narrowest(sheet, &hits))
        .filter(|width| width.share() < settings.keep)
        .map(|width| finding(sheet, &width))
        .collect()
}

fn finding(sheet: &Sheet<'_>, width: &Width) -> Finding {
    let Width { hit, left, designed } = *width;
    let cut = sheet.cuts[hit.cut];
    let name = sheet.nets.label(hit.net);
    let message = format!("{name} is {left:.3} mm wide where the design has {designed:.3} mm");
    Finding {
        nets: vec![name],
        at: Some(hit.at),
        size: Some(left),
        program: Some(cut.program.followed.file.clone()),
        line: Some(cut.swept.line),
        ..Finding::new(NAME, Severity::Warning, message)
    }
}
