//! What programs make of a sheet: what is left of it, and where cuts take copper of nets.

use std::collections::BTreeSet;
use std::ops::Deref;

use rayon::prelude::*;

use crate::topology::NetId;

use super::hit::Hits;
use super::pieces::Part;
use super::remains::remains;
use super::rest::{HINT, Remains, SMALL};
use super::sheet::Sheet;
use super::{Settings, milled};

/// A sheet, milled: all that checks of isolation go by.
pub(super) struct Outcome<'a> {
    sheet: Sheet<'a>,
    /// What is left where that is not beyond doubt.
    pub(super) remains: Remains,
    /// Where the cuts take copper of nets.
    pub(super) hits: Hits,
    /// Whether so many others run near a cut that not all is asked that would be.
    pub(super) crowded: Vec<bool>,
}

/// The sheet as it was designed, with the cuts.
impl<'a> Deref for Outcome<'a> {
    type Target = Sheet<'a>;

    fn deref(&self) -> &Self::Target {
        &self.sheet
    }
}

/// Ways, stretches of long ones each, of which no more may come near a stretch of one for all to be
/// asked. Chosen, and not compared with other numbers.
const CROWD: usize = 300;

impl<'a> Outcome<'a> {
    /// Mills `sheet`.
    pub(super) fn new(sheet: Sheet<'a>, settings: &Settings) -> Self {
        // Whatever may hang together does in this picture.
        let parts = milled::pieces(&sheet, &sheet.grid, milled::narrower(sheet.pitch()));
        let lost = lost(&sheet, &parts, settings);
        let hits = Hits::new(&sheet, &lost, settings.gouge);
        let remains = remains(&sheet, &parts, &hits, &lost, settings);
        Self { crowded: crowded(&sheet, settings), remains, hits, sheet }
    }
}

/// Beside which cuts, or stretches of them, more than a [`CROWD`] of others run.
fn crowded(sheet: &Sheet<'_>, settings: &Settings) -> Vec<bool> {
    let mut order = sheet.walls.order();
    order.retain(|&wall| wall < sheet.cuts.len());
    let is_crowded = |&cut: &usize| sheet.walls.is_crowded(cut, settings.sliver, CROWD);
    let found: Vec<bool> = order.par_iter().map(is_crowded).collect();
    let mut crowded = vec![false; sheet.cuts.len()];
    order.into_iter().zip(found).for_each(|(cut, is_crowded)| crowded[cut] = is_crowded);
    crowded
}

/// The nets of which nothing is left beyond doubt: no piece that the picture shows, which shows
/// too much rather than too little, holds as much of it as could count.
fn lost(sheet: &Sheet<'_>, parts: &[Part], settings: &Settings) -> BTreeSet<NetId> {
    let is_something = |part: &&Part| sheet.mm2(part.pixels) >= settings.crumb * HINT * SMALL;
    let left: BTreeSet<NetId> =
        parts.iter().filter(is_something).filter_map(|part| Sheet::net(part.label)).collect();
    let all = (0..).map(NetId).take(sheet.nets.nets().len());
    all.filter(|net| !left.contains(net)).collect()
}
