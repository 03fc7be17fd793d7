//! What another program cuts that this one does not: copper, not lines.
//!
//! Both are drawn tile by tile where one has cuts that the other has not; a pixel that no such cut
//! covers cannot differ. It does where one cuts it and the other stays clear of it by more than a
//! tolerance, so that programs that say the same in other words (lines for arcs, another order,
//! other digits) do not differ. Differences that hang together are one.

use rayon::prelude::*;
use rustc_hash::FxHashSet;

use crate::board::{Board, Shape};
use crate::geometry::{Arc, Nm, Point, Rect, RectIndex, Turn};
use crate::grid::Grid;
use crate::raster::{Buffers, Label, Scene, render};
use crate::topology::surface;

use super::machining::Machining;
use super::pieces::{Joiner, Run};
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
    /// The pixel of the picture.
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
    let others = [&after, &before].map(|shapes| shapes.iter().collect::<FxHashSet<_>>());
    let only = [&before, &after].into_iter().zip(&others).map(|(own, other)| Index::without(own, other));
    let only: Vec<Index> = only.collect();
    let [before, after] = [before, after].map(|shapes| Cuts::new(shapes, tolerance));
    let mut comparison = Comparison { regions: Vec::new(), resolution, rect, before, after, tolerance };
    if let Some(rect) = rect {
        let grid = Grid::covering(rect.inflate(resolution), resolution)?;
        comparison.regions = comparison.regions(&grid, &only);
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
    Ok(read.swept.into_iter().map(|swept| undirected(swept.shape)).collect())
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
    /// As far as what counts as cut reaches.
    index: RectIndex,
}

impl Cuts {
    fn new(shapes: Vec<Shape>, tolerance: Nm) -> Self {
        let index = RectIndex::new(shapes.iter().map(|shape| shape.bounds().inflate(tolerance)));
        Self { shapes, index }
    }

    /// How far pixels lie beyond the cuts, up to `tolerance`; 0 where they are cut.
    fn draw(&self, grid: &Grid, tolerance: Nm, buffers: &mut Buffers) {
        let mut scene = Scene::new(grid.width(), grid.height());
        for number in self.index.touching(grid.rect()) {
            scene.add(Label(1), surface(&self.shapes[number], grid, Some(grid.pixels(tolerance))));
        }
        render(&scene, buffers);
    }
}

/// Where one program has cuts that the other has not.
struct Index(RectIndex);

impl Index {
    /// Of what is in `own` and not in `other`.
    fn without(own: &[Shape], other: &FxHashSet<&Shape>) -> Self {
        let only: Vec<Rect> = own.iter().filter(|shape| !other.contains(shape)).map(Shape::bounds).collect();
        Self(RectIndex::new(only.into_iter()))
    }
}

const fn half(shape: &Shape) -> Nm {
    match shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => *radius,
        Shape::Polygon(_) => Nm::ZERO,
    }
}

/// Pixels along a side of what is drawn at once. Chosen: half as much took a tenth longer, twice as
/// much draws more beside what differs.
const TILE: u32 = 128;

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

    /// What lies at each pixel.
    fn spots(&self, grid: &Grid) -> Vec<Spot> {
        let [mut before, mut after] = [Buffers::new(), Buffers::new()];
        self.before.draw(grid, self.tolerance, &mut before);
        self.after.draw(grid, self.tolerance, &mut after);
        let spot = |(&before, &after): (&f32, &f32)| match (before <= 0.0, after <= 0.0) {
            (false, false) => Spot::Neither,
            (false, true) if before.is_infinite() => Spot::One(Change::Cut),
            (true, false) if after.is_infinite() => Spot::One(Change::Left),
            _ => Spot::Both,
        };
        before.depths().iter().zip(after.depths()).map(spot).collect()
    }

    /// What differs in each row of a tile, of which the first pixel is in this column.
    fn differing(&self, column: u32, tile: &Grid) -> Vec<Differing> {
        let [mut before, mut after] = [Buffers::new(), Buffers::new()];
        self.before.draw(tile, self.tolerance, &mut before);
        self.after.draw(tile, self.tolerance, &mut after);
        let width = tile.width() as usize;
        let rows = before.depths().chunks_exact(width).zip(after.depths().chunks_exact(width));
        rows.map(|(before, after)| (runs(column, before, after), runs(column, after, before))).collect()
    }

    /// What differs, on this grid, tile by tile: only those where one program has cuts that the
    /// other has not.
    fn regions(&self, grid: &Grid, only: &[Index]) -> Vec<Region> {
        // What is cut and what is left each hang together by themselves, though they may touch.
        let (mut cut, mut left) = (Joiner::default(), Joiner::default());
        for top in tops(grid) {
            let differs =
                |(_, tile): &(u32, Grid)| only.iter().any(|only| !only.0.touching(tile.rect()).is_empty());
            let drawn: Vec<Vec<Differing>> = tiles(grid, top)
                .collect::<Vec<_>>()
                .into_par_iter()
                .filter(differs)
                .map(|(column, tile)| self.differing(column, &tile))
                .collect();
            for row in 0..TILE.min(grid.height() - top) {
                let of = |tile: &Vec<Differing>| tile[row as usize].clone();
                let (now_cut, now_left): (Vec<_>, Vec<_>) = drawn.iter().map(of).unzip();
                cut.row(top + row, &now_cut.concat());
                left.row(top + row, &now_left.concat());
            }
        }
        let mm2 = grid.pitch().to_mm() * grid.pitch().to_mm();
        let region = |change: Change, part: super::pieces::Part| {
            let corner = |column: u32, row: u32| grid.corner(i64::from(column), i64::from(row));
            let extent = part.extent;
            let rect =
                Rect::new(corner(extent.left, extent.top), corner(extent.right + 1, extent.bottom + 1));
            #[expect(clippy::cast_precision_loss, reason = "a display figure")]
            let area = part.pixels as f64 * mm2;
            Region { change, rect, area }
        };
        let cut = cut.parts().into_iter().map(|part| region(Change::Cut, part));
        let left = left.parts().into_iter().map(|part| region(Change::Left, part));
        let mut regions: Vec<Region> = cut.chain(left).collect();
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

/// The runs of pixels in a row that are newly cut, and that are newly left.
type Differing = (Vec<Run>, Vec<Run>);

/// The pixels of a row, of which the first is in this column, that `one` cuts and that are clear of
/// what `other` cuts; both as far as the pixels lie beyond the cuts.
fn runs(column: u32, other: &[f32], one: &[f32]) -> Vec<Run> {
    let differs = |(&other, &one): (&f32, &f32)| (one <= 0.0) & (other == f32::INFINITY);
    let pixels = || other.iter().zip(one);
    let mut runs: Vec<Run> = Vec::new();
    // Of most rows none: that is told many pixels at a time.
    if pixels().map(differs).fold(false, |any, differs| any | differs) {
        for (at, _) in (column..).zip(pixels().map(differs)).filter(|(_, differs)| *differs) {
            match runs.last_mut().filter(|run| run.end == at) {
                Some(run) => run.end += 1,
                None => runs.push(Run { start: at, end: at + 1, label: 0 }),
            }
        }
    }
    runs
}

impl Region {
    /// Its middle.
    #[must_use]
    pub fn middle(&self) -> Point {
        self.rect.min().midpoint(self.rect.max())
    }
}
