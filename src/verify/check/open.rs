//! # What it checks
//!
//! Every net is left in one connected piece. Crumbs do not count.
//!
//! # Why
//!
//! A net in two pieces does not conduct.
//!
//! # What it can miss
//!
//! A net cut in two whose parts stay joined through clad beside it: those conduct, and count as one.

use std::collections::BTreeMap;

use super::{Check, Run, Severity, considerable};
use crate::geometry::Rect;
use crate::topology::NetId;
use crate::verify::Settings;
use crate::verify::pieces::Part;
use crate::verify::report::Finding;
use crate::verify::sheet::Sheet;

pub(super) const CHECK: Check = Check { name: NAME, about: "a net cut in two", run: Run::Isolation(check) };

const NAME: &str = "open";

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let mut nets: BTreeMap<NetId, Vec<&Part>> = BTreeMap::new();
    for part in &sheet.parts {
        if let Some(net) = Sheet::net(part.label) {
            nets.entry(net).or_default().push(part);
        }
    }
    let several = nets.into_iter().filter(|(_, parts)| parts.len() > 1);
    several.filter_map(|(net, parts)| open(sheet, net, &parts, settings)).collect()
}

fn open(sheet: &Sheet<'_>, net: NetId, parts: &[&Part], settings: &Settings) -> Option<Finding> {
    let left = parts.iter().map(|part| sheet.mm2(part.pixels)).sum();
    let least = considerable(sheet, net, left, settings);
    let mut pieces: Vec<&Part> =
        parts.iter().copied().filter(|part| sheet.mm2(part.pixels) >= least).collect();
    pieces.sort_by_key(|part| (std::cmp::Reverse(part.pixels), part.piece));
    let smaller = pieces.get(1)?;
    let name = sheet.nets.label(net);
    let message = format!("{name} is cut into {} pieces", pieces.len());
    let place: Rect = sheet.place(smaller.extent);
    Some(Finding {
        nets: vec![name],
        at: Some(place.min().midpoint(place.max())),
        area: Some(sheet.mm2(smaller.pixels)),
        ..Finding::new(NAME, Severity::Error, message)
    })
}
