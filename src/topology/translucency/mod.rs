//! Algorithm 2 of the paper, TOPOLOGY-FROM-TRANSLUCENCY (§III-A.2): traces drawn as translucent
//! sheets show a mixed colour where they overlap.
//!
//! Every trace that Algorithm 1 left gets a random colour; the picture is scanned for colours not
//! seen before; where one turns up, a pick lists the traces stacked there, which become one. What
//! was merged is drawn anew at once, and the colour enters the set of those seen, so an overlap of
//! a thousand pixels costs one pick. It is a Monte Carlo algorithm: an overlap is missed if its
//! colour was seen before by chance ([`Odds`]), or if no pixel's centre lies in it.
//!
//! Three things differ from the paper. The picture is drawn tile by tile, and only tiles that hold
//! several traces are, so memory does not grow with the board; the raster draws each trace once,
//! and a pixel's mix is worked out when the scan comes to it, from the traces as merged by then,
//! which is what drawing all anew would show. A pick counts only where the exact copper of both
//! traces holds the pixel's centre, so Theorem 4 (no overlap is reported where none is) holds to
//! the nanometre, not to the rounding of the picture. And beyond seven sheets, where the paper's
//! footnote 5 gives up because a colour has eight bits, merging and drawing anew leaves ever fewer
//! sheets, so the depth costs picks, not overlaps; [`Translucency::deepest`] says how deep it was.

mod colour;
mod sheets;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::board::Copper;
use crate::geometry::{Nm, Point, Rect};
use crate::grid::{Grid, GridError};
use crate::raster::blend::{Window, mix, render_translucent};
use crate::raster::{Label, Scene};

use super::contact::Bodies;
use super::sets::DisjointSets;
use super::{NetId, Nets, surface};

pub use colour::{Colour, Odds};

use colour::{Colours, Random};
use sheets::Sheets;

/// How Algorithm 2 looks at a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// The side of a pixel; overlaps thinner than that may be missed.
    pub pitch: Nm,
    /// Where the random colours begin.
    pub seed: u64,
}

impl Default for Sampling {
    /// The paper's 500 DPI.
    fn default() -> Self {
        Self { pitch: Nm::new(50_800), seed: 1 }
    }
}

/// What Algorithm 2 found.
#[derive(Clone, Debug)]
pub struct Translucency {
    /// The traces after merging.
    pub nets: Nets,
    /// How the layer was looked at.
    pub sampling: Sampling,
    /// The colour of each trace before merging, by number.
    pub colours: Vec<Colour>,
    /// The overlaps found, in the order of the scan.
    pub overlaps: Vec<Overlap>,
    /// The most traces, before merging, that lie on one pixel. Beyond 7, the paper's own version
    /// may fail.
    pub deepest: usize,
    /// How likely it was that an overlap was missed by a confusion of colours.
    pub odds: Odds,
}

impl Translucency {
    /// The paper's picture: every trace as it was before merging, 50 % translucent, in its colour;
    /// row by row from the top. `traces` are those that [`translucency`] was given.
    #[must_use]
    pub fn picture(&self, copper: &Copper, traces: &Nets, grid: &Grid) -> Vec<Colour> {
        let mut scene = Scene::new(grid.width(), grid.height());
        let features = copper.features.iter().enumerate();
        for (index, feature) in features.filter(|(_, feature)| feature.shape.bounds().touches(grid.rect())) {
            // Label 0 is the background's.
            scene.add(Label(traces.of(index).0 + 1), surface(&feature.shape, grid, Some(0.0)));
        }
        let colours: Vec<Colour> = std::iter::once([0; 3]).chain(self.colours.iter().copied()).collect();
        render_translucent(&scene, &colours, Window::all(&scene))
    }
}

/// A pixel that showed a new colour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Overlap {
    /// The centre of the pixel.
    pub at: Point,
    /// The traces stacked there, the top one first, as numbered before merging (of those merged
    /// already, the first).
    pub traces: Vec<NetId>,
    /// The colour it had.
    pub colour: Colour,
}

/// Pixels along the side of a tile. Chosen: a tile's colours fit the second cache.
const TILE: i64 = 256;

/// Tiles that are drawn at a time, before they are scanned one by one. Chosen.
const BATCH: usize = 32;

/// Merges those of `traces` that overlap, by Algorithm 2.
///
/// # Errors
///
/// [`GridError`] where the pixels are too fine for the raster.
pub fn translucency(copper: &Copper, traces: &Nets, sampling: Sampling) -> Result<Translucency, GridError> {
    let mut scan = Scan::new(copper, traces, sampling.seed);
    if let Some(bounds) = copper.bounds() {
        let grid = Grid::covering(bounds, sampling.pitch)?;
        let tiles: Vec<_> = tiles(copper, &grid).into_iter().collect();
        for batch in tiles.chunks(BATCH) {
            let drawn: Result<Vec<_>, _> = batch
                .par_iter()
                .map(|((row, column), features)| {
                    let tile = tile(&grid, *column, *row)?;
                    Ok((tile, Sheets::draw(copper, traces, features, &tile)?))
                })
                .collect();
            for (tile, sheets) in drawn? {
                scan.tile(&tile, &sheets);
            }
        }
    }
    Ok(scan.finish(sampling))
}

/// The features that may reach each tile, by (row, column), as the scan goes.
fn tiles(copper: &Copper, grid: &Grid) -> BTreeMap<(i64, i64), Vec<u32>> {
    let side = grid.pitch().get() * TILE;
    let (left, top) = (grid.rect().min().x, grid.rect().max().y);
    let mut tiles: BTreeMap<_, Vec<u32>> = BTreeMap::new();
    for (feature, index) in copper.features.iter().zip(0_u32..) {
        let bounds = feature.shape.bounds();
        let count = |extent: Nm| extent.get().div_euclid(side);
        for row in count(top - bounds.max().y)..=count(top - bounds.min().y) {
            for column in count(bounds.min().x - left)..=count(bounds.max().x - left) {
                tiles.entry((row, column)).or_default().push(index);
            }
        }
    }
    tiles
}

/// The pixels of a tile.
fn tile(grid: &Grid, column: i64, row: i64) -> Result<Grid, GridError> {
    let corner = grid.corner(column * TILE, row * TILE);
    let opposite = grid.corner((column + 1) * TILE, (row + 1) * TILE);
    Grid::covering(Rect::new(corner, opposite), grid.pitch())
}

/// The state of the algorithm between tiles.
struct Scan<'a> {
    copper: &'a Copper,
    traces: &'a Nets,
    bodies: Bodies,
    colours: Vec<Colour>,
    seen: Colours,
    /// Of trace numbers.
    merged: DisjointSets,
    overlaps: Vec<Overlap>,
    deepest: usize,
}

impl<'a> Scan<'a> {
    fn new(copper: &'a Copper, traces: &'a Nets, seed: u64) -> Self {
        let mut seen = Colours::black();
        let mut random = Random::new(seed);
        Self {
            copper,
            traces,
            bodies: Bodies::new(copper),
            colours: traces.nets().iter().map(|_| random.colour(&mut seen)).collect(),
            seen,
            merged: DisjointSets::new(traces.nets().len()),
            overlaps: Vec::new(),
            deepest: 0,
        }
    }

    /// Scans a tile. A pixel's colour is that of the traces as merged so far; it is looked at until
    /// it is no longer new.
    fn tile(&mut self, tile: &Grid, sheets: &Sheets) {
        for ((column, row), mut stack) in sheets.stacks() {
            self.deepest = self.deepest.max(stack.len());
            loop {
                for trace in &mut stack {
                    *trace = self.merged.find(*trace);
                }
                stack.sort_unstable();
                stack.dedup();
                let colour = mix(stack.iter().map(|&trace| self.colours[trace as usize]));
                let at = tile.center(column.into(), row.into());
                if self.seen.contains(colour) || !self.pick(at, &stack, colour) {
                    break;
                }
                self.seen.insert(colour);
            }
        }
    }

    /// Merges the traces stacked at a pixel; false where the exact copper does not overlap there.
    fn pick(&mut self, at: Point, stack: &[u32], colour: Colour) -> bool {
        let there = self.traces_at(at);
        let picked: Vec<NetId> =
            stack.iter().filter(|trace| there.contains(trace)).copied().map(NetId).collect();
        if picked.len() < 2 {
            return false;
        }
        for &trace in &picked {
            self.merged.union(picked[0].0, trace.0);
        }
        self.overlaps.push(Overlap { at, traces: picked, colour });
        true
    }

    /// The traces whose exact copper holds a point, merged ones by their first.
    fn traces_at(&mut self, at: Point) -> BTreeSet<u32> {
        let Self { bodies, traces, merged, .. } = self;
        let mut found = BTreeSet::new();
        let _ = bodies.index.visit(Rect::new(at, at), |feature| {
            if bodies.bodies[feature].holds(at) {
                found.insert(merged.find(traces.of(feature).0));
            }
            ControlFlow::Continue(())
        });
        found
    }

    fn finish(mut self, sampling: Sampling) -> Translucency {
        let mut pairs = Vec::with_capacity(self.copper.features.len());
        for (net, trace) in self.traces.nets().iter().zip(0_u32..) {
            let first = self.traces.nets()[self.merged.find(trace) as usize].features[0];
            pairs.extend(net.features.iter().map(|&feature| (first, feature)));
        }
        let count = |n: usize| u32::try_from(n).expect("fewer than 2³² features");
        Translucency {
            nets: Nets::from_pairs(self.copper, pairs),
            sampling,
            odds: Odds::new(count(self.traces.nets().len()), count(self.overlaps.len())),
            colours: self.colours,
            overlaps: self.overlaps,
            deepest: self.deepest,
        }
    }
}
