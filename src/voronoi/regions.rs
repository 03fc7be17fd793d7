//! The regions of a diagram as the rasterizer draws them, from cones and curtains.

use std::ops::Range;

use crate::board::Copper;
use crate::grid::{Grid, GridError};
use crate::raster::{self, Scene, TileContent};
use crate::topology::Nets;

use super::edge::Border;
use super::{Owner, Settings, cones};

/// Who owns each place of a board: what is left of a [`Diagram`](super::Diagram) for pictures.
pub struct Regions {
    pub(super) border: Border,
    pub(super) settings: Settings,
    /// Whether each net has anything on the board.
    pub(super) kept: Vec<bool>,
    /// What they are made of, where some nets have loops and others not.
    pub(super) parts: Option<Box<Parts>>,
}

/// Loops round some nets, and between them fields with regions of the others.
pub(super) struct Parts {
    pub(super) looped: Vec<bool>,
    pub(super) fields: Vec<Regions>,
}

impl Regions {
    /// The grid of a picture of the board.
    ///
    /// # Errors
    ///
    /// [`GridError`] for pixels that are too fine for it.
    pub fn grid(&self) -> Result<Grid, GridError> {
        Grid::covering(self.border.window, self.settings.pitch)
    }

    /// Shows `paint` who owns the pixels of `grid` (row, columns, owner), tile by tile: nothing
    /// holds the whole picture but what `paint` makes of it. A pixel may be painted again. The
    /// regions are those of the nets of this `copper`.
    pub fn paint(
        &self,
        copper: &Copper,
        nets: &Nets,
        grid: &Grid,
        mut paint: impl FnMut(u32, Range<u32>, Owner),
    ) {
        let Some(Parts { looped, fields }) = self.parts.as_deref() else {
            return self.paint_sites(copper, nets, grid, &mut paint);
        };
        self.paint_sites(copper, nets, grid, &mut |row, columns, owner| {
            paint(row, columns, if has_loop(looped, owner) { owner } else { Owner::Background });
        });
        for field in fields {
            field.paint_sites(copper, nets, grid, &mut |row, columns, owner| {
                if matches!(owner, Owner::Net(_)) {
                    paint(row, columns, owner);
                }
            });
        }
    }

    /// [`Regions::paint`] of these sites alone.
    fn paint_sites(
        &self,
        copper: &Copper,
        nets: &Nets,
        grid: &Grid,
        paint: &mut dyn FnMut(u32, Range<u32>, Owner),
    ) {
        let scene = self.scene(copper, nets, grid);
        let work = |tile: raster::Tile<'_>| {
            let rows = tile.row0..tile.row0 + tile.height;
            let all = tile.column0..tile.column0 + tile.width;
            match &tile.content {
                TileContent::Uniform(owner) => rows.map(|row| (row, all.clone(), owner.0)).collect(),
                TileContent::Pixels(pixels) => {
                    let labels = (0_i32..).map(|row| pixels.label_row(row));
                    let stretches = |(row, labels)| stretches(row, all.start, labels);
                    rows.zip(labels).flat_map(stretches).collect()
                }
            }
        };
        raster::stream(&scene, &raster::Options::default(), work, |stretches: Vec<_>| {
            for (row, columns, owner) in stretches {
                paint(row, columns, Owner::from_number(owner));
            }
        });
    }

    /// How far the centre of each pixel of a grid is from the sites, in pixels, row by row from the
    /// top; infinite where nothing is in reach.
    pub fn depths(&self, copper: &Copper, nets: &Nets) -> impl Fn(&Grid) -> Vec<f32> {
        |grid| {
            let mut buffers = raster::Buffers::default();
            raster::render(&self.scene(copper, nets, grid), &mut buffers);
            buffers.depths().to_vec()
        }
    }

    fn scene(&self, copper: &Copper, nets: &Nets, grid: &Grid) -> Scene {
        let keep = |feature: usize| self.kept[nets.of(feature).index()];
        cones::scene(copper, nets, keep, (&self.settings, &self.border), grid)
    }
}

/// What each owner has of a row of labels, the first of which is that of `column`.
fn stretches(row: u32, column: u32, labels: &[u32]) -> impl Iterator<Item = (u32, Range<u32>, u32)> {
    labels.chunk_by(|a, b| a == b).scan(column, move |column, same| {
        let from = *column;
        *column += u32::try_from(same.len()).expect("as wide as a tile");
        Some((row, from..*column, same[0]))
    })
}

/// Whether `owner` is a net that is `looped`.
pub(super) fn has_loop(looped: &[bool], owner: Owner) -> bool {
    matches!(owner, Owner::Net(net) if looped[net.index()])
}
