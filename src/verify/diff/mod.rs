//! What another program cuts that this one does not, and how deep: copper, not lines.
//!
//! Where one has cuts that the other has not, tile by tile, the plane is quartered until each
//! square is settled: it differs where one cuts it and the other stays clear of it by more than a
//! tolerance, so that programs that say the same in other words (lines for arcs, another order,
//! other digits) do not differ. Pixels gather differences, and do not limit how narrow they are.
//! Those that hang together are one. Where both cut, one may cut deeper.

mod capsule;
mod cuts;
mod joined;
mod quadtree;

use rayon::prelude::*;

use crate::board::Shape;
use crate::geometry::{Nm, Point, Rect, Vector};
use crate::grid::Grid;
use crate::raster::{Buffers, Scene, render};

use cuts::Cuts;
use joined::{Joined, Strip, strips};

use super::machining::half;
use super::sheet::pixel;
use super::{Error, Program, Settings};

/// What became of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Change {
    /// It was left, and is cut now.
    Cut,
    /// It was cut, and is left now.
    Left,
    /// It was cut, and is cut deeper now.
    Deeper,
    /// It was cut, and is cut less deep now.
    Shallower,
}

impl Change {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Cut, Self::Left, Self::Deeper, Self::Shallower];
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
    /// How deep it was cut and is cut now where that differs most, if both cut it.
    pub depths: Option<[Nm; 2]>,
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
    /// Not the same: cut by one alone, or deeper.
    Changed(Change),
}

/// Compares what two programs cut, each deeper than the copper of `settings` is thick, and how
/// deep; a difference counts from `tolerance` on. An empty text cuts nothing.
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
    let [before, after] = Cuts::of([before, after], tolerance, settings)?;
    let shapes = || before.grooves.iter().chain(&after.grooves).map(|groove| &groove.shape);
    let rect = shapes().map(Shape::bounds).reduce(Rect::union);
    let narrowest = shapes().map(half).min().unwrap_or(Nm::from_um(100));
    let resolution = settings.pixel.unwrap_or_else(|| pixel(narrowest));
    let mut comparison = Comparison { regions: Vec::new(), resolution, rect, before, after, tolerance };
    if let Some(rect) = rect {
        let grid = Grid::covering(rect.inflate(resolution), resolution)?;
        comparison.regions = comparison.regions(&grid);
    }
    Ok(comparison)
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
        let mut least = vec![0.0; spots.len()];
        for (change, shares) in Change::ALL.into_iter().zip(self.shares(tile)) {
            for ((spot, least), share) in spots.iter_mut().zip(&mut least).zip(shares) {
                if share > *least {
                    (*spot, *least) = (Spot::Changed(change), share);
                }
            }
        }
        spots
    }

    /// How much of each pixel of a tile this became of, in the order of [`Change::ALL`]; empty
    /// where nothing did.
    fn shares(&self, tile: &Grid) -> [Vec<f32>; 4] {
        let [cut, deeper] = self.beyond(tile, &self.after, &self.before);
        let [left, shallower] = self.beyond(tile, &self.before, &self.after);
        [cut, left, deeper, shallower]
    }

    /// How much of each pixel of a tile is cut where `others` do not cut, and where they do, but
    /// less deep.
    fn beyond(&self, tile: &Grid, cuts: &Cuts, others: &Cuts) -> [Vec<f32>; 2] {
        let cuts = cuts.alone(tile.rect(), self.chord());
        if cuts.is_empty() {
            return [Vec::new(), Vec::new()];
        }
        let others = others.near(tile.rect(), self.chord(), self.tolerance);
        quadtree::shares(tile, &cuts, &others, self.tolerance.to_f64())
    }

    /// How far chords may leave an arc: a small part of what is tolerated, but far above a
    /// nanometre.
    fn chord(&self) -> Nm {
        (self.tolerance / 16).max(Nm::new(50)).min(Nm::new(500))
    }

    /// What differs, on this grid, tile by tile.
    fn regions(&self, grid: &Grid) -> Vec<Region> {
        // What became of places each hangs together by itself, though they may touch.
        let mut found = Change::ALL.map(Joined::new);
        for top in tops(grid) {
            let tiles: Vec<(u32, Grid)> = tiles(grid, top).collect();
            let of_tile = |(column, tile): (u32, Grid)| {
                let rows = |shares: Vec<f32>| {
                    shares.chunks_exact(tile.width() as usize).map(|row| strips(column, row)).collect()
                };
                self.shares(&tile).map(rows)
            };
            let found_there: Vec<[Vec<Vec<Strip>>; 4]> = tiles.into_par_iter().map(of_tile).collect();
            for row in 0..TILE.min(grid.height() - top) {
                for (side, joined) in found.iter_mut().enumerate() {
                    let of = found_there.iter().filter_map(|tile| tile[side].get(row as usize));
                    joined.row(top + row, of.flatten().copied());
                }
            }
        }
        let found = found.into_iter().flat_map(|joined| joined.regions(grid));
        let mut regions: Vec<Region> =
            found.map(|(region, pixel)| self.with_depths(region, grid, pixel)).collect();
        regions.sort_by(|a, b| {
            b.area.total_cmp(&a.area).then((a.rect.min(), a.change).cmp(&(b.rect.min(), b.change)))
        });
        regions
    }

    /// The region, and how deep both cut it at a place of the pixel where they differ most.
    fn with_depths(&self, region: Region, grid: &Grid, (column, row): (u32, u32)) -> Region {
        let (deep, shallow) = match region.change {
            Change::Cut | Change::Left => return region,
            Change::Deeper => (&self.after, &self.before),
            Change::Shallower => (&self.before, &self.after),
        };
        let pixel = grid.part((column, row), 1, 1).rect();
        let parts = [4, 0, 1, 2, 3, 5, 6, 7, 8].map(|eighth| pixel.width() * eighth / 8);
        let places = parts.into_iter().flat_map(|x| parts.map(|y| pixel.min() + Vector::new(x, y)));
        let mut depths = places.filter_map(|place| {
            let deep = deep.depth_at(place, Nm::ZERO)?;
            let shallow = shallow.depth_at(place, self.tolerance)?;
            let depths = if region.change == Change::Deeper { [shallow, deep] } else { [deep, shallow] };
            (deep > shallow + self.tolerance).then_some(depths)
        });
        Region { depths: depths.next(), ..region }
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
