//! # What it checks
//!
//! Every net that a cut reaches into is left in one connected piece. Crumbs do not count. Where the picture cannot tell, the exact
//! shapes say how wide what joins two parts is.
//!
//! # Why
//!
//! A net in two pieces does not conduct.
//!
//! # What it can miss
//!
//! A net cut in two whose parts stay joined through clad beside it: those conduct, and count as one. A hair of copper that
//! holds two parts together counts too; `minimum-width` tells of it.

use std::collections::BTreeMap;

use super::{Check, Run, Severity, area, considerable};
use crate::geometry::{Nm, Point, Rect};
use crate::topology::NetId;
use crate::verify::Settings;
use crate::verify::flood::{Basin, Join, Water};
use crate::verify::pieces::Part;
use crate::verify::report::Finding;
use crate::verify::sheet::{NETS, Sheet};

pub(super) const CHECK: Check = Check { name: NAME, about: "a net cut in two", run: Run::Isolation(check) };

const NAME: &str = "open";

fn check(sheet: &Sheet<'_>, settings: &Settings) -> Vec<Finding> {
    let Some(parted) = &sheet.parted else { return Vec::new() };
    let mut nets: BTreeMap<NetId, Vec<&Part>> = BTreeMap::new();
    for part in parted {
        if let Some(net) = Sheet::net(part.label) {
            nets.entry(net).or_default().push(part);
        }
    }
    let hit = |net: NetId| sheet.hits.binary_search_by(|hit| hit.net.cmp(&net)).is_ok();
    let several = nets.into_iter().filter(|(net, parts)| parts.len() > 1 && hit(*net));
    several.filter_map(|(net, parts)| open(sheet, net, &parts, settings)).collect()
}

fn open(sheet: &Sheet<'_>, net: NetId, parts: &[&Part], settings: &Settings) -> Option<Finding> {
    let left = parts.iter().map(|part| sheet.mm2(part.pixels)).sum();
    let least = considerable(sheet, net, left, settings);
    if parts.iter().filter(|part| sheet.mm2(part.pixels) >= least).count() < 2 {
        return None;
    }
    let place = parts.iter().map(|part| sheet.place(part.extent)).reduce(Rect::union)?;
    let gaps = gaps(sheet, &Basin::new(sheet, place), net, least);
    let largest = gaps.iter().copied().reduce(|a, b| if b.area > a.area { b } else { a })?;
    let name = sheet.nets.label(net);
    let message = format!("{name} is cut into {} pieces", gaps.len() + 1);
    let cut = sheet
        .walls
        .around(largest.at, sheet.half * 4)
        .iter()
        .find_map(|wall| sheet.cuts.get(wall.index).copied());
    Some(Finding {
        nets: vec![name],
        at: Some(largest.at),
        area: Some(largest.area),
        program: cut.map(|cut| cut.program.file.clone()),
        line: cut.map(|cut| cut.swept.line),
        ..Finding::new(NAME, Severity::Error, message)
    })
}

/// A place where two parts of a net are apart.
#[derive(Clone, Copy, Debug)]
struct Apart {
    at: Point,
    /// Of the smaller part, in mm².
    area: f64,
}

/// Where parts of `net` of at least so many mm² are apart.
fn gaps(sheet: &Sheet<'_>, basin: &Basin, net: NetId, least: f64) -> Vec<Apart> {
    let label = net.0 + NETS;
    let mut water = Water::new(basin.labels.len());
    // Pixels of the net in each part, by root.
    let mut own: Vec<u32> = basin.labels.iter().map(|&pixel| u32::from(pixel == label)).collect();
    let mm2 = |pixels: u32| area(pixels as usize, basin.grid.pitch());
    let mut gaps = Vec::new();
    basin.flood(&mut water, &[], |Join { pixel, roots: (one, other) }| {
        let smaller = mm2(own[one as usize].min(own[other as usize]));
        own[one as usize] += own[other as usize];
        if smaller >= least {
            let (width, at) = basin.width(sheet, pixel);
            if width.is_some_and(|width| width <= Nm::ZERO) {
                gaps.push(Apart { at, area: smaller });
            }
        }
        false
    });
    gaps
}
