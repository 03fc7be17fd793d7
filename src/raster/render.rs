//! Whole pictures: label and depth of every pixel, drawn by all workers.

use rayon::prelude::*;

use super::bin::Painter;
use super::canvas::count;
use super::cell::Cell;
use super::node::{Descent, Grid, Node};
use super::{Fragment, Label, Scene};

/// Label and depth of every pixel of a picture, row by row from the top; kept to be drawn on again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Buffers {
    width: usize,
    labels: Vec<u32>,
    depths: Vec<f32>,
}

impl Buffers {
    /// Empty buffers; [`render()`] makes them as large as it needs.
    #[must_use]
    pub const fn new() -> Self {
        Self { width: 0, labels: Vec::new(), depths: Vec::new() }
    }

    /// The label of every pixel.
    #[must_use]
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// The depth of every pixel, infinite where no primitive covers it.
    #[must_use]
    pub fn depths(&self) -> &[f32] {
        &self.depths
    }

    /// The pixel at a column and row.
    ///
    /// # Panics
    ///
    /// Outside the picture.
    #[must_use]
    pub fn pixel(&self, column: usize, row: usize) -> Fragment {
        assert!(column < self.width, "column {column} lies outside the picture");
        let index = row * self.width + column;
        Fragment { depth: self.depths[index], label: Label(self.labels[index]) }
    }

    fn resize(&mut self, width: u32, height: u32) {
        self.width = width as usize;
        let pixels = self.width * height as usize;
        self.labels.resize(pixels, Label::BACKGROUND.0);
        self.depths.resize(pixels, f32::INFINITY);
    }
}

/// Rows that a worker draws at a time. Chosen: the height of a mosaic, and 32 jobs in a picture of
/// 4096 rows.
const BAND: u32 = 128;

/// Squares side by side that are drawn before they go into the picture. Rows of a block are one
/// line of the cache each, and a picture's width apart; memory takes long rows faster, and a canvas
/// of so many fits a second-level cache. Measured: see the module's doc.
const RUN: usize = 8;

/// Draws the whole picture into `buffers`.
pub fn render(scene: &Scene, buffers: &mut Buffers) {
    buffers.resize(scene.width(), scene.height());
    if buffers.labels.is_empty() {
        return;
    }
    let grid = Grid { tile: BAND, apron: 0, width: scene.width(), height: scene.height() };
    let rows: Vec<Vec<Node>> = Descent::new(scene, grid, 1, &[], false).collect();
    let band = buffers.width * BAND as usize;
    let pixels = buffers.labels.par_chunks_mut(band).zip(buffers.depths.par_chunks_mut(band));
    pixels.zip(rows.par_iter()).for_each_init(Painter::new, |painter, ((labels, depths), nodes)| {
        for run in nodes.chunks(RUN) {
            let ([Node { cell: first, .. }, ..], [.., Node { cell: last, .. }]) = (run, run) else {
                continue;
            };
            painter.canvas.stretch(Cell { width: last.x + last.width - first.x, ..*first });
            for node in run {
                painter.paint(scene, &node.bin, node.cell);
            }
            let picture = depths.chunks_exact_mut(buffers.width).zip(labels.chunks_exact_mut(buffers.width));
            for ((depths, labels), drawn) in picture.zip(painter.canvas.finished()) {
                let columns = count(first.x)..count(last.x + last.width);
                depths[columns.clone()].copy_from_slice(drawn.0);
                labels[columns].copy_from_slice(drawn.1);
            }
        }
    });
}
