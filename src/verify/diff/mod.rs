//! What another program cuts that this one does not: copper, not lines.
//!
//! Where one has cuts that the other has not, tile by tile, the plane is quartered until each
//! square is settled: it differs where one cuts it and the other stays clear of it by more than a
//! tolerance, so that programs that say the same in other words (lines for arcs, another order,
//! other digits) do not differ. Pixels gather differences, and do not limit how narrow they are.
//! Those that hang together are one.

mod capsule;
mod joined;
mod quadtree;

use bitvec::vec::BitVec;
use rayon::prelude::*;
use rustc_hash::FxHashSet;

use crate::board::{Board, Shape};
use crate::geometry::{Arc, Nm, Point, Rect, RectIndex, Turn};
use crate::grid::Grid;
use crate::raster::{Buffers, Label, Scene, render};
use crate::topology::surface;

use capsule::Capsule;
use joined::{Joined, Strip, strips};

use super::machining::Machining;
use super::sheet::pixel;
use super::{Error, Placement, Program, Role, Settings};

/// What became of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Change {
    /// It was left, and is cut now.
    Cut,
    /// It was cut, and is left now.
    Left,
}

/// A place where two programs differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// What became of it.
    pub change: Change,
    /// What it lies within, where the machine has it.
    pub rect: Rect,
    /// How large, in mm².
    pub area: f64,
}

/// How two programs differ.
#[derive(Debug)]
pub struct Comparison {
    /// Where, the largest first.
    pub regions: Vec<Region>,
    /// The pixel in which they are gathered.
    pub resolution: Nm,
    /// What both together cut lies within; none where neither cuts.
    pub rect: Option<Rect>,
    before: Cuts,
    after: Cuts,
    tolerance: Nm,
}

/// What lies at a pixel of a picture of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// Cut by neither.
    Neither,
    /// Cut by both.
    Both,
    /// Cut by one alone.
    One(Change),
}

/// Compares what two programs cut, each deeper than the copper of `settings` is thick; a difference
/// counts from `tolerance` on. An empty text cuts nothing.
///
/// # Errors
///
/// [`Error`] where one cannot be followed, nothing says what tool cuts, or the pixels are too fine.
pub fn diff(
    before: &Program,
    after: &Program,
    tolerance: Nm,
    settings: &Settings,
) -> Result<Comparison, Error> {
    let (before, after) = (swept(before, settings)?, swept(after, settings)?);
    let shapes = || before.iter().chain(&after);
    let rect = shapes().map(Shape::bounds).reduce(Rect::union);
    let narrowest = shapes().map(half).min().unwrap_or(Nm::from_um(100));
    let resolution = settings.pixel.unwrap_or_else(|| pixel(narrowest));
    let alone = |cuts: &[Shape], others: &[Shape]| {
        let others: FxHashSet<&Shape> = others.iter().collect();
        cuts.iter().map(|cut| !others.contains(cut)).collect::<BitVec>()
    };
    let (only_before, only_after) = (alone(&before, &after), alone(&after, &before));
    let (before, after) = (Cuts::new(before, only_before), Cuts::new(after, only_after));
    let mut comparison = Comparison { regions: Vec::new(), resolution, rect, before, after, tolerance };
    if let Some(rect) = rect {
        let grid = Grid::covering(rect.inflate(resolution), resolution)?;
        comparison.regions = comparison.regions(&grid);
    }
    Ok(comparison)
}

/// What a program cuts, where the machine has it; of an empty text nothing.
fn swept(program: &Program, settings: &Settings) -> Result<Vec<Shape>, Error> {
    if program.text.is_empty() {
        return Ok(Vec::new());
    }
    // Where the board lies and what for is no matter: both are compared as the machine moves.
    let role = program.role.unwrap_or(Role::Cutout);
    let placed = Program { role: Some(role), placement: Some(Placement::default()), ..program.clone() };
    let read = Machining::read(&placed, &Board::default(), settings)?;
    // The same way is cut again and again, deeper each time.
    let mut known = FxHashSet::default();
    let shapes = read.swept.into_iter().map(|swept| undirected(swept.shape));
    Ok(shapes.filter(|shape| known.insert(shape.clone())).collect())
}

/// The same shape whichever way it is cut.
fn undirected(shape: Shape) -> Shape {
    match shape {
        Shape::Stroke { from, to, radius } if to < from => Shape::Stroke { from: to, to: from, radius },
        Shape::Arc { arc, radius } if arc.turn == Turn::Clockwise => {
            let arc = Arc { start: arc.end, end: arc.start, turn: Turn::CounterClockwise, ..arc };
            Shape::Arc { arc, radius }
        }
        other => other,
    }
}

/// What a program cuts, by place.
#[derive(Debug)]
struct Cuts {
    shapes: Vec<Shape>,
    /// Those that the other program does not have.
    alone: BitVec,
    index: RectIndex,
}

impl Cuts {
    fn new(shapes: Vec<Shape>, alone: BitVec) -> Self {
        let index = RectIndex::new(shapes.iter().map(Shape::bounds));
        Self { shapes, alone, index }
    }

    /// The cuts that touch `rect`, arcs as chords within `chord`; of those alone that the other
    /// program does not have, where `alone`.
    fn near(&self, rect: Rect, alone: bool, chord: Nm) -> Vec<Capsule> {
        let near = self.index.touching(rect).into_iter().filter(|&cut| !alone || self.alone[cut]);
        near.flat_map(|cut| Capsule::of(&self.shapes[cut], chord)).collect()
    }

    /// Marks the pixels of `grid` that are cut with zero.
    fn draw(&self, grid: &Grid, scene: &mut Scene) {
        for cut in self.index.touching(grid.rect()) {
            scene.add(Label(1), surface(&self.shapes[cut], grid, Some(0.0)));
        }
    }
}

const fn half(shape: &Shape) -> Nm {
    match shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => *radius,
        Shape::Polygon(_) => Nm::ZERO,
    }
}

/// Pixels along a side of what is compared at once. Chosen: half as many take a tenth longer.
const TILE: u32 = 256;

impl Comparison {
    /// Whether both cut the same.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.regions.is_empty()
    }

    /// In how many places, and on how many mm², this happened.
    #[must_use]
    pub fn total(&self, change: Change) -> (usize, f64) {
        let of = || self.regions.iter().filter(|region| region.change == change);
        (of().count(), of().map(|region| region.area).fold(0.0, |all, area| all + area))
    }

    /// A picture of a part of the plane, of at most so many pixels each way; row 0 on top.
    ///
    /// # Errors
    ///
    /// Where the pixels would be too fine.
    pub fn picture(&self, rect: Rect, most: u32) -> Result<(Grid, Vec<Spot>), Error> {
        let least = Nm::new((rect.width().max(rect.height()) / i64::from(most)).get() + 1);
        let grid = Grid::covering(rect, least.max(self.resolution))?;
        let mut spots = vec![Spot::Neither; grid.width() as usize * grid.height() as usize];
        let band = grid.width() as usize * TILE as usize;
        spots.par_chunks_mut(band).zip(tops(&grid)).for_each(|(band, top)| {
            for (column, tile) in tiles(&grid, top) {
                let (width, drawn) = (tile.width() as usize, self.spots(&tile));
                let rows = band.chunks_exact_mut(grid.width() as usize).zip(drawn.chunks_exact(width));
                rows.for_each(|(row, drawn)| row[column as usize..][..width].copy_from_slice(drawn));
            }
        });
        Ok((grid, spots))
    }

    /// What lies at each pixel; a difference where there is any.
    fn spots(&self, tile: &Grid) -> Vec<Spot> {
        let mut scene = Scene::new(tile.width(), tile.height());
        self.before.draw(tile, &mut scene);
        self.after.draw(tile, &mut scene);
        let mut buffers = Buffers::new();
        render(&scene, &mut buffers);
        let cut = |&depth: &f32| if depth <= 0.0 { Spot::Both } else { Spot::Neither };
        let mut spots: Vec<Spot> = buffers.depths().iter().map(cut).collect();
        let [cut, left] = self.shares(tile);
        let mut least = vec![0.0; spots.len()];
        for (change, shares) in [(Change::Cut, cut), (Change::Left, left)] {
            for ((spot, least), share) in spots.iter_mut().zip(&mut least).zip(shares) {
                if share > *least {
                    (*spot, *least) = (Spot::One(change), share);
                }
            }
        }
        spots
    }

    /// How much of each pixel of a tile is newly cut, and newly left; empty where nothing is.
    fn shares(&self, tile: &Grid) -> [Vec<f32>; 2] {
        // A small part of what is tolerated, but far above a nanometre.
        let chord = (self.tolerance / 16).max(Nm::new(50)).min(Nm::new(500));
        [(&self.after, &self.before), (&self.before, &self.after)].map(|(cuts, others)| {
            let cuts = cuts.near(tile.rect(), true, chord);
            if cuts.is_empty() {
                return Vec::new();
            }
            let others = others.near(tile.rect().inflate(self.tolerance), false, chord);
            quadtree::shares(tile, &cuts, &others, self.tolerance.to_f64())
        })
    }

    /// What differs, on this grid, tile by tile.
    fn regions(&self, grid: &Grid) -> Vec<Region> {
        // What is cut and what is left each hang together by themselves, though they may touch.
        let mut found = [Change::Cut, Change::Left].map(Joined::new);
        for top in tops(grid) {
            let tiles: Vec<(u32, Grid)> = tiles(grid, top).collect();
            let of_tile = |(column, tile): (u32, Grid)| {
                let rows = |shares: Vec<f32>| {
                    shares.chunks_exact(tile.width() as usize).map(|row| strips(column, row)).collect()
                };
                self.shares(&tile).map(rows)
            };
            let found_there: Vec<[Vec<Vec<Strip>>; 2]> = tiles.into_par_iter().map(of_tile).collect();
            for row in 0..TILE.min(grid.height() - top) {
                for (side, joined) in found.iter_mut().enumerate() {
                    let of = found_there.iter().filter_map(|tile| tile[side].get(row as usize));
                    joined.row(top + row, of.flatten().copied());
                }
            }
        }
        let mut regions: Vec<Region> = found.into_iter().flat_map(|joined| joined.regions(grid)).collect();
        regions.sort_by(|a, b| {
            b.area.total_cmp(&a.area).then((a.rect.min(), a.change).cmp(&(b.rect.min(), b.change)))
        });
        regions
    }
}

/// The first rows of the rows of tiles.
fn tops(grid: &Grid) -> Vec<u32> {
    (0..grid.height()).step_by(TILE as usize).collect()
}

/// The tiles of a row of them, each with its first column.
fn tiles(grid: &Grid, top: u32) -> impl Iterator<Item = (u32, Grid)> {
    let height = TILE.min(grid.height() - top);
    (0..grid.width())
        .step_by(TILE as usize)
        .map(move |column| (column, grid.part((column, top), TILE.min(grid.width() - column), height)))
}

impl Region {
    /// Its middle.
    #[must_use]
    pub fn middle(&self) -> Point {
        self.rect.min().midpoint(self.rect.max())
    }
}
