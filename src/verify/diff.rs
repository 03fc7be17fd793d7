//! What another program cuts that this one does not: copper, not lines.
//!
//! Both are drawn on one picture, row of tiles by row of tiles. A pixel is a difference where one
//! cuts it and the other stays clear of it by more than a tolerance, so that programs that say the
//! same in other words (lines for arcs, another order, other digits) do not differ. Differences
//! that hang together are one.

use rayon::prelude::*;

use crate::board::{Board, Shape};
use crate::geometry::{Nm, Point, Rect};
use crate::grid::Grid;
use crate::raster::{Buffers, Label, Scene, render};
use crate::topology::surface;

use super::machining::{Machining, with_radius};
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
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Where, the largest first.
    pub regions: Vec<Region>,
    /// The pixel of the picture.
    pub resolution: Nm,
    /// What both together cut lies within; none where neither cuts.
    pub rect: Option<Rect>,
    before: Vec<Shape>,
    after: Vec<Shape>,
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
    let mut comparison = Comparison { regions: Vec::new(), resolution, rect, before, after, tolerance };
    if let Some(rect) = rect {
        let grid = Grid::covering(rect.inflate(resolution), resolution)?;
        comparison.regions = comparison.regions(&grid)?;
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
    Ok(read.swept.into_iter().map(|swept| swept.shape).collect())
}

const fn half(shape: &Shape) -> Nm {
    match shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => *radius,
        Shape::Polygon(_) => Nm::ZERO,
    }
}

/// Rows that are drawn at once. Chosen: as many as tiles are high in the renderer's own squares.
const BAND: u32 = 256;

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
        Ok((grid, self.spots(&grid)))
    }

    /// What lies at each pixel.
    fn spots(&self, grid: &Grid) -> Vec<Spot> {
        let sides = [
            (&self.before, Nm::ZERO),
            (&self.after, Nm::ZERO),
            (&self.before, self.tolerance),
            (&self.after, self.tolerance),
        ];
        let drawn: Vec<Buffers> =
            sides.into_par_iter().map(|(shapes, wider)| draw(shapes, grid, wider)).collect();
        let [before, after, near_before, near_after] = [0, 1, 2, 3].map(|side: usize| drawn[side].labels());
        let spot = |pixel: usize| match (before[pixel], after[pixel], near_before[pixel], near_after[pixel]) {
            (0, 0, _, _) => Spot::Neither,
            (0, _, 0, _) => Spot::One(Change::Cut),
            (_, 0, _, 0) => Spot::One(Change::Left),
            _ => Spot::Both,
        };
        (0..before.len()).map(spot).collect()
    }

    /// What differs, on this grid, band by band.
    fn regions(&self, grid: &Grid) -> Result<Vec<Region>, Error> {
        // What is cut and what is left each hang together by themselves, though they may touch.
        let (mut cut, mut left) = (Joiner::default(), Joiner::default());
        for top in (0..grid.height()).step_by(BAND as usize) {
            let height = BAND.min(grid.height() - top);
            let corner = grid.corner(0, i64::from(top));
            let below = grid.corner(i64::from(grid.width()), i64::from(top + height));
            let band = Grid::covering(Rect::new(corner, below), grid.pitch())?;
            let spots = self.spots(&band);
            for (row, spots) in (top..).zip(spots.chunks_exact(grid.width() as usize)) {
                cut.row(row, &runs(spots, Change::Cut));
                left.row(row, &runs(spots, Change::Left));
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
        Ok(regions)
    }
}

/// The differences of one kind in a row of pixels.
fn runs(spots: &[Spot], change: Change) -> Vec<Run> {
    let mut start = 0_u32;
    let mut runs = Vec::new();
    for same in spots.chunk_by(|a, b| a == b) {
        let end = start + u32::try_from(same.len()).expect("a picture is at most 2¹⁶ wide");
        if same[0] == Spot::One(change) {
            runs.push(Run { start, end, label: 0 });
        }
        start = end;
    }
    runs
}

fn draw(shapes: &[Shape], grid: &Grid, wider: Nm) -> Buffers {
    let mut scene = Scene::new(grid.width(), grid.height());
    for shape in shapes {
        let shape = with_radius(shape, half(shape) + wider);
        if shape.bounds().touches(grid.rect()) {
            scene.add(Label(1), surface(&shape, grid, Some(0.0)));
        }
    }
    let mut buffers = Buffers::new();
    render(&scene, &mut buffers);
    buffers
}

impl Region {
    /// Its middle.
    #[must_use]
    pub fn middle(&self) -> Point {
        self.rect.min().midpoint(self.rect.max())
    }
}
