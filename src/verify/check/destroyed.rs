//! # What it checks
//!
//! Of every net something is left: more than a crumb, or of a small net three tenths.
//!
//! # Why
//!
//! A pad that is milled away cannot be soldered to.
//!
//! # What it can miss
//!
//! Nets of which a useless rest is left; `gouge` tells of them.

use std::collections::BTreeMap;

use super::{Check, Run, Severity, considerable, designed};
use crate::topology::NetId;
use crate::verify::Settings;
use crate::verify::report::Finding;
use crate::verify::sheet::Sheet;

pub(super) const CHECK: Check = Check { name: NAME, about: "a net milled away", run: Run::Isolation(check) };

const NAME: &str = "destroyed";

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let mut left: BTreeMap<NetId, u64> = BTreeMap::new();
    for part in &sheet.parts {
        if let Some(net) = Sheet::net(part.label) {
            let most = left.entry(net).or_default();
            *most = (*most).max(part.pixels);
        }
    }
    let count = u32::try_from(sheet.nets.nets().len()).unwrap_or(u32::MAX);
    (0..count).map(NetId).filter_map(|net| destroyed(sheet, net, left.get(&net).copied(), settings)).collect()
}

fn destroyed(sheet: &Sheet<'_>, net: NetId, left: Option<u64>, settings: &Settings) -> Option<Finding> {
    let left = sheet.mm2(left.unwrap_or(0));
    if left >= settings.crumb || (left > 0.0 && left >= considerable(sheet, net, left, settings)) {
        return None;
    }
    let area = designed(sheet, net);
    let first = sheet.nets.nets()[net.index()].features[0] as usize;
    let name = sheet.nets.label(net);
    // What lies beyond the outline was never on the board.
    (area > 0.0).then(|| Finding {
        at: Some(sheet.copper.features[first].shape.anchor()),
        area: Some(area),
        nets: vec![name.clone()],
        ..Finding::new(NAME, Severity::Error, format!("nothing is left of {name}"))
    })
}
