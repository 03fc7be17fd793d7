use rayon::prelude::*;

use super::bin::{Bin, Painter};
use super::block::count;
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

/// Rows that a worker draws at a time. Chosen: the height of a mosaic, and 32 jobs in a picture of 4096 rows.
const BAND: u32 = 128;

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
    pixels.zip(rows.par_iter()).for_each_init(Easel::new, |easel, ((labels, depths), nodes)| {
        let mut window = Window { labels, depths, stride: buffers.width, x: 0, y: nodes[0].cell.y };
        for node in nodes {
            easel.draw(scene, node, &mut window);
        }
    });
}

/// What a worker draws a square on before it goes into the picture.
///
/// Rows of a block are one line of the cache each, and a picture's width apart; memory takes the rows of a square,
/// eight lines at a time, a tenth faster (measured: see the module's doc).
struct Easel {
    painter: Painter,
    labels: Vec<u32>,
    depths: Vec<f32>,
}

impl Easel {
    const SIDE: usize = BAND as usize;

    fn new() -> Self {
        let pixels = Self::SIDE * Self::SIDE;
        Self { painter: Painter::new(), labels: vec![0; pixels], depths: vec![0.0; pixels] }
    }

    /// Draws a node of at most [`BAND`] pixels a side into `window`, where it lies inside.
    fn draw(&mut self, scene: &Scene, node: &Node, window: &mut Window<'_>) {
        let Cell { x, y, width, height } = node.cell;
        let (labels, depths) = (&mut self.labels[..], &mut self.depths[..]);
        Window { labels, depths, stride: Self::SIDE, x, y }.paint(
            &mut self.painter,
            scene,
            &node.bin,
            node.cell,
        );
        let rows = self.depths.chunks_exact(Self::SIDE).zip(self.labels.chunks_exact(Self::SIDE));
        let (width, mut at) = (count(width), window.index(node.cell));
        for (depths, labels) in rows.take(count(height)) {
            window.depths[at..at + width].copy_from_slice(&depths[..width]);
            window.labels[at..at + width].copy_from_slice(&labels[..width]);
            at += window.stride;
        }
    }
}

/// Where finished blocks go: a rectangle of pixels in memory.
pub(super) struct Window<'a> {
    pub labels: &'a mut [u32],
    pub depths: &'a mut [f32],
    /// From one row to the next.
    pub stride: usize,
    /// The first pixel.
    pub x: i32,
    pub y: i32,
}

impl Window<'_> {
    /// Where the first pixel of `cell` is.
    const fn index(&self, cell: Cell) -> usize {
        count(cell.y - self.y) * self.stride + count(cell.x - self.x)
    }

    /// Draws `cell`, which lies inside.
    pub(super) fn paint(&mut self, painter: &mut Painter, scene: &Scene, bin: &Bin, cell: Cell) {
        painter.paint(scene, bin, cell, &mut |block| {
            let mut at = self.index(block.cell());
            for (depths, labels) in block.finished() {
                self.depths[at..at + depths.len()].copy_from_slice(depths);
                self.labels[at..at + labels.len()].copy_from_slice(labels);
                at += self.stride;
            }
        });
    }
}
