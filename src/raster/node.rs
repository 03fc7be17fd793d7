use rayon::prelude::*;

use super::Scene;
use super::bin::Bin;
use super::cell::Cell;

/// A square of tiles and the bin of their pixels.
#[derive(Debug)]
pub(super) struct Node {
    /// The first tile, counted along and down.
    pub column: u32,
    pub row: u32,
    /// The tiles' pixels with their apron, as far as the picture goes.
    pub cell: Cell,
    pub bin: Bin,
}

/// How a picture is cut into tiles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    pub tile: u32,
    pub apron: u32,
    pub width: u32,
    pub height: u32,
}

impl Grid {
    /// Tiles along and down.
    pub(super) const fn size(self) -> (u32, u32) {
        (self.width.div_ceil(self.tile), self.height.div_ceil(self.tile))
    }

    /// The pixels of `count` × `count` tiles from the tile at (`column`, `row`), with their apron, as far as the
    /// picture goes.
    pub(super) fn cell(self, column: u32, row: u32, count: u32) -> Option<Cell> {
        let side = signed(count * self.tile + 2 * self.apron);
        let corner = |tile: u32| signed(tile * self.tile) - signed(self.apron);
        Cell { x: corner(column), y: corner(row), width: side, height: side }
            .within(signed(self.width), signed(self.height))
    }
}

/// The picture cut into ever smaller squares of tiles, depth first, a row of squares at a time from top to bottom.
///
/// Only the rows on the way down are alive, so memory follows the bins along a line across the picture.
pub(super) struct Descent<'a> {
    scene: &'a Scene,
    grid: Grid,
    levels: &'a [f32],
    skip: bool,
    /// Tiles along a side of the squares that come out.
    size: u32,
    rows: Vec<(u32, Vec<Node>)>,
}

impl<'a> Descent<'a> {
    /// Cuts down to squares of `size` tiles (a power of two); squares that are uniform in respect of `levels` are
    /// left out where `skip` says so.
    pub(super) fn new(scene: &'a Scene, grid: Grid, size: u32, levels: &'a [f32], skip: bool) -> Self {
        let (columns, rows) = grid.size();
        let count = columns.max(rows).next_power_of_two().max(size);
        let root =
            grid.cell(0, 0, count).map(|cell| Node { column: 0, row: 0, cell, bin: Bin::root(scene, cell) });
        Self {
            scene,
            grid,
            levels,
            skip,
            size,
            rows: root.map(|root| (count, vec![root])).into_iter().collect(),
        }
    }
}

impl Iterator for Descent<'_> {
    type Item = Vec<Node>;

    fn next(&mut self) -> Option<Vec<Node>> {
        while let Some((count, nodes)) = self.rows.pop() {
            if count == self.size {
                return Some(nodes);
            }
            let half = count / 2;
            let halves: Vec<_> = nodes
                .par_iter()
                .map(|node| {
                    [0, half]
                        .map(|down| children(self.scene, self.grid, node, half, down, self.levels, self.skip))
                })
                .collect();
            let (mut upper, mut lower) = (Vec::new(), Vec::new());
            for [above, below] in halves {
                upper.extend(above);
                lower.extend(below);
            }
            self.rows
                .extend([(half, lower), (half, upper)].into_iter().filter(|(_, nodes)| !nodes.is_empty()));
        }
        None
    }
}

/// The quarters of a square, `count` tiles wide each, that lie `down` tiles below its top.
fn children(
    scene: &Scene,
    grid: Grid,
    node: &Node,
    count: u32,
    down: u32,
    levels: &[f32],
    skip: bool,
) -> Vec<Node> {
    let mut nodes = Vec::with_capacity(2);
    for along in [0, count] {
        let (column, row) = (node.column + along, node.row + down);
        let (columns, rows) = grid.size();
        if column >= columns || row >= rows {
            continue;
        }
        let Some(cell) = grid.cell(column, row, count) else { continue };
        let mut bin = Bin::default();
        bin.narrow(scene, &node.bin, node.cell, cell);
        if !(skip && bin.uniform(scene, levels).is_some()) {
            nodes.push(Node { column, row, cell, bin });
        }
    }
    nodes
}

/// A length in pixels as a signed number; those of a picture are small.
pub(super) fn signed(pixels: u32) -> i32 {
    i32::try_from(pixels).expect("a picture is at most 65 536 pixels wide")
}
