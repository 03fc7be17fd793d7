//! Pictures tile by tile, for those that are too large to be kept.

use rayon::prelude::*;

use super::bin::{Bin, Painter};
use super::cell::Cell;
use super::mosaic::Cuts;
use super::node::{Descent, Grid, Node, signed};
use super::tile::{Tile, TileContent, TilePixels};
use super::{Label, Scene};

/// How a picture is streamed.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Pixels along a side of a tile; those at the right and bottom of the picture may be smaller.
    /// 64 unless told.
    pub tile: u32,
    /// Further pixels that every tile carries on all four sides. 0 unless told.
    pub apron: u32,
    /// Depths that the caller will tell apart: a tile is uniform only where none of them can lie
    /// within its range.
    pub levels: Vec<f32>,
    /// Whether uniform tiles are left out altogether, whole squares of them at a time. No unless
    /// told.
    pub skip_uniform: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { tile: 64, apron: 0, levels: Vec::new(), skip_uniform: false }
    }
}

/// Pixels along a side of what one worker takes at a time, at least. Chosen: sixteen tiles of 64
/// are weighed together.
const SQUARE: u32 = 256;

/// Draws the picture tile by tile: `work` gets every tile on some worker, `sink` gets what it made
/// of them on the calling thread, row by row from the top and from left to right.
///
/// A row of squares of tiles is drawn while the one before is handed over; no more than two are
/// held. A tile is uniform where it is certain, without drawing it, that all its pixels inside the
/// picture, its apron's included, have one label, and that none of [`Options::levels`] lies within
/// its range of depths.
///
/// # Panics
///
/// Where a tile is of no size, or has more than 65 536 pixels along a side or an apron wider than a
/// tile.
pub fn stream<T: Send>(
    scene: &Scene,
    options: &Options,
    work: impl Fn(Tile<'_>) -> T + Sync,
    mut sink: impl FnMut(T),
) {
    assert!((1..=Scene::MAX_SIDE).contains(&options.tile), "a tile has from 1 to 65 536 pixels along a side");
    assert!(options.apron <= options.tile, "an apron is no wider than a tile");
    let Options { tile, apron, .. } = *options;
    let grid = Grid { tile, apron, width: scene.width(), height: scene.height() };
    // A power of two, at most as many as are weighed together.
    let size = (SQUARE / tile).clamp(1, 8).next_power_of_two();
    let mut rows = Descent::new(scene, grid, size, &options.levels, options.skip_uniform);
    let mut ready: Vec<Vec<T>> = Vec::new();
    loop {
        let nodes = rows.next();
        let mut drawn: Vec<Vec<T>> = Vec::new();
        rayon::in_place_scope(|scope| {
            if let Some(nodes) = &nodes {
                scope.spawn(|_| drawn = draw_row(scene, grid, size, options, nodes, &work));
            }
            ready.drain(..).flatten().for_each(&mut sink);
        });
        if nodes.is_none() {
            break;
        }
        ready = drawn;
    }
}

/// Draws a row of squares; gives what `work` made of each row of tiles.
fn draw_row<T: Send>(
    scene: &Scene,
    grid: Grid,
    size: u32,
    options: &Options,
    nodes: &[Node],
    work: &(impl Fn(Tile<'_>) -> T + Sync),
) -> Vec<Vec<T>> {
    let drawn: Vec<Vec<(u32, T)>> = nodes
        .par_iter()
        .map_init(Worker::new, |worker, node| {
            let mut made = Vec::new();
            worker.square(&Job { scene, grid, options }, node, size, &mut |row, tile| {
                made.push((row, work(tile)))
            });
            made
        })
        .collect();
    let top = nodes.first().map_or(0, |node| node.row);
    let mut rows: Vec<Vec<T>> = (0..size).map(|_| Vec::new()).collect();
    for (row, made) in drawn.into_iter().flatten() {
        rows[(row - top) as usize].push(made);
    }
    rows
}

/// What all workers share.
struct Job<'a> {
    scene: &'a Scene,
    grid: Grid,
    options: &'a Options,
}

/// The memory a worker draws tiles in.
struct Worker {
    painter: Painter,
    cuts: Cuts,
    bins: Vec<Bin>,
}

impl Worker {
    fn new() -> Self {
        Self { painter: Painter::new(), cuts: Cuts::default(), bins: Vec::new() }
    }

    /// Draws a square of `size` × `size` tiles, row by row and from left to right.
    fn square(&mut self, job: &Job<'_>, node: &Node, size: u32, made: &mut impl FnMut(u32, Tile<'_>)) {
        let (columns, rows) = job.grid.size();
        let columns = node.column..columns.min(node.column + size);
        let rows = node.row..rows.min(node.row + size);
        let span = |tile, side| job.grid.span(tile, 1, side);
        self.cuts.columns.clear();
        self.cuts.columns.extend(columns.clone().map(|column| span(column, job.grid.width)));
        self.cuts.rows.clear();
        self.cuts.rows.extend(rows.clone().map(|row| span(row, job.grid.height)));
        let (mut bins, cuts) = (std::mem::take(&mut self.bins), std::mem::take(&mut self.cuts));
        self.painter.mosaic.split(job.scene, &node.bin, node.cell, &cuts, &mut bins);
        let places = rows.flat_map(|row| columns.clone().map(move |column| (column, row)));
        for ((place, cell), bin) in places.zip(cuts.cells()).zip(&bins) {
            let uniform = bin.uniform(job.scene, &job.options.levels);
            if uniform.is_none() || !job.options.skip_uniform {
                self.tile(job, bin, cell, place, uniform, made);
            }
        }
        (self.bins, self.cuts) = (bins, cuts);
    }

    fn tile(
        &mut self,
        job: &Job<'_>,
        bin: &Bin,
        cell: Cell,
        (column, row): (u32, u32),
        uniform: Option<Label>,
        made: &mut impl FnMut(u32, Tile<'_>),
    ) {
        let Grid { tile, apron, width, height } = job.grid;
        let (column0, row0) = (column * tile, row * tile);
        let (width, height) = (tile.min(width - column0), tile.min(height - row0));
        let content = match uniform {
            Some(label) => TileContent::Uniform(label),
            None => {
                let (x, y) = (signed(column0) - signed(apron), signed(row0) - signed(apron));
                let (width, height) = (signed(width + 2 * apron), signed(height + 2 * apron));
                self.painter.canvas.stretch(Cell { x, y, width, height });
                self.painter.paint(job.scene, bin, cell);
                self.painter.canvas.clear_around(cell);
                TileContent::Pixels(TilePixels::new(&self.painter.canvas, apron))
            }
        };
        made(row, Tile { column0, row0, width, height, content });
    }
}
