//! The pixels of a tile that several traces cover, and the mixed colours that they show.

use std::collections::BTreeMap;

use crate::board::{Copper, Shape};
use crate::geometry::Rect;
use crate::grid::{Grid, GridError};
use crate::raster::{Buffers, Label, Scene, render};
use crate::topology::{Nets, surface};

/// The pixels of a tile that several traces cover.
///
/// Each trace is drawn on a sheet of its own; the sheets lie on each other by number, the smallest
/// nearest to the eye. A pixel's colour is mixed when the scan comes to it, from what has been
/// merged by then, so nothing need be drawn twice.
#[derive(Debug)]
pub(super) struct Sheets {
    /// Pixel and trace, ascending.
    stacked: Vec<(u32, u32)>,
    width: u32,
}

impl Sheets {
    /// Draws the features with these indices, each on the sheet of its trace.
    ///
    /// # Errors
    ///
    /// [`GridError`] as for the tile itself.
    pub(super) fn draw(
        copper: &Copper,
        traces: &Nets,
        features: &[u32],
        tile: &Grid,
    ) -> Result<Self, GridError> {
        let mut sheets: BTreeMap<u32, Vec<&Shape>> = BTreeMap::new();
        for &feature in features {
            let shape = &copper.features[feature as usize].shape;
            sheets.entry(traces.of(feature as usize).0).or_default().push(shape);
        }
        let mut drawn = Drawn { tile, buffers: Buffers::new(), layers: Vec::new(), covered: Vec::new() };
        if sheets.len() > 1 {
            drawn.layers = vec![0; tile.width() as usize * tile.height() as usize];
            for (trace, shapes) in sheets {
                drawn.sheet(trace, &shapes)?;
            }
        }
        Ok(Self { stacked: drawn.stacked(), width: tile.width() })
    }

    /// Each such pixel by column and row, with its traces; row by row from the top.
    pub(super) fn stacks(&self) -> impl Iterator<Item = ((u32, u32), Vec<u32>)> {
        self.stacked.chunk_by(|a, b| a.0 == b.0).map(|stack| {
            let pixel = stack[0].0;
            ((pixel % self.width, pixel / self.width), stack.iter().map(|(_, trace)| *trace).collect())
        })
    }
}

/// What has been drawn of a tile.
struct Drawn<'a> {
    tile: &'a Grid,
    buffers: Buffers,
    /// How many sheets cover each pixel, up to 255.
    layers: Vec<u8>,
    /// Every covered pixel with its trace.
    covered: Vec<(u32, u32)>,
}

impl Drawn<'_> {
    /// Draws a sheet, no larger than its shapes.
    fn sheet(&mut self, trace: u32, shapes: &[&Shape]) -> Result<(), GridError> {
        let bounds = shapes.iter().map(|shape| shape.bounds()).reduce(Rect::union);
        let Some(window) = bounds.and_then(|bounds| bounds.common(self.tile.rect())) else { return Ok(()) };
        let pitch = self.tile.pitch().get();
        let (left, top) = (self.tile.rect().min().x, self.tile.rect().max().y);
        let column = (window.min().x - left).get() / pitch;
        let row = (top - window.max().y).get() / pitch;
        let part =
            Grid::covering(Rect::new(self.tile.corner(column, row), window.corners()[1]), self.tile.pitch())?;
        let mut scene = Scene::new(part.width(), part.height());
        for shape in shapes {
            scene.add(Label(1), surface(shape, &part, Some(0.0)));
        }
        render(&scene, &mut self.buffers);
        let count = |n: i64| u32::try_from(n).expect("a pixel of the tile");
        let mut first = count(row) * self.tile.width() + count(column);
        for labels in self.buffers.labels().chunks_exact(part.width() as usize) {
            for (pixel, _) in (first..).zip(labels).filter(|(_, label)| **label != 0) {
                self.layers[pixel as usize] = self.layers[pixel as usize].saturating_add(1);
                self.covered.push((pixel, trace));
            }
            first += self.tile.width();
        }
        Ok(())
    }

    /// The covered pixels that several sheets cover.
    fn stacked(self) -> Vec<(u32, u32)> {
        let Self { mut covered, layers, .. } = self;
        covered.retain(|(pixel, _)| layers[*pixel as usize] > 1);
        covered.sort_unstable();
        covered
    }
}
