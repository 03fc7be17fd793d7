//! # What it checks
//!
//! No net that the design has comes nearer to those of `--distance-for` than the distance asked
//! for: cuts clear what belongs to nobody, and leave the copper of nets as it is.
//!
//! # Why
//!
//! Whoever asks for a distance for a high voltage should know where the design itself falls short
//! of it.
//!
//! # What it can miss
//!
//! Distances along a way round a slot in the board, and through the board: it measures straight
//! across one side.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::geometry::Nm;
use crate::topology::{Near, NetId};
use crate::verify::Settings;
use crate::verify::asked::meant;
use crate::verify::report::Finding;
use crate::verify::sheet::Sheet;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Warning,
    what: Words::of("a net that the design has nearer to others than the distance asked for"),
    effect: Words::of("clearing does not move nets apart: the distance is as short as the design has it"),
    advice: Words::of("move the nets apart in the design, or mill a slot between them"),
};

pub(super) const CHECK: Check =
    Check { kind: &KIND, run: Run::Isolation(|outcome, settings| check(outcome, settings)) };

const NAME: &str = "net-too-near";

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let each = sheet.asked.distances.iter().flat_map(|(pattern, distance)| {
        let nets = meant(std::iter::once(pattern), sheet.copper, &sheet.nets);
        let round = |&net: &NetId| nearest(sheet, net, &nets, *distance, settings.gouge);
        nets.par_iter().filter_map(round).collect::<Vec<_>>()
    });
    each.collect()
}

/// The nearest of the other nets that are too near to `own`, and how many more are.
fn nearest(sheet: &Sheet<'_>, own: NetId, all: &[NetId], distance: Nm, slack: Nm) -> Option<Finding> {
    let is_other = |feature: usize| all.binary_search(&sheet.nets.of(feature)).is_err();
    let mut near: BTreeMap<NetId, Near> = BTreeMap::new();
    for &feature in &sheet.nets.nets()[own.index()].features {
        let shape = &sheet.copper.features[feature as usize].shape;
        for found in sheet.proximity.near_of(shape, distance - slack, is_other) {
            let known = near.entry(sheet.nets.of(found.feature)).or_insert(found);
            if found.width < known.width {
                *known = found;
            }
        }
    }
    let (&other, nearest) = near.iter().min_by(|a, b| a.1.width.total_cmp(&b.1.width))?;
    let names = [own, other].map(|net| sheet.nets.label(net));
    let width = Nm::from_f64(nearest.width);
    let more = match near.len() - 1 {
        0 => String::new(),
        1 => ", and one more net is too near".to_owned(),
        more => format!(", and {more} more nets are too near"),
    };
    let message = format!(
        "{} is {width:.3} mm from {} in the design, where {distance:.3} mm are asked for{more}",
        names[0], names[1]
    );
    let found = Finding::new(NAME, Severity::Warning, message).of(names);
    Some(Finding { at: Some(nearest.at), size: Some(width), ..found })
}
