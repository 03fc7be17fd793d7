//! The descent from the whole picture to tiles: ever smaller squares with their bins.

use std::ops::Range;

use rayon::prelude::*;

use super::Scene;
use super::bin::Bin;
use super::cell::Cell;
use super::mosaic::{Cuts, Mosaic};

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

    /// The pixels of `count` × `count` tiles from the tile at (`column`, `row`), with their apron,
    /// as far as the picture goes; none of an empty picture.
    pub(super) fn cell(self, column: u32, row: u32, count: u32) -> Option<Cell> {
        let (x, width) = self.span(column, count, self.width);
        let (y, height) = self.span(row, count, self.height);
        (width > 0 && height > 0).then_some(Cell { x, y, width, height })
    }

    /// The first pixel and the length of `count` tiles with their apron in a picture `side` pixels
    /// long.
    pub(super) fn span(self, tile: u32, count: u32, side: u32) -> (i32, i32) {
        let (first, end) =
            (u64::from(tile) * u64::from(self.tile), u64::from(tile + count) * u64::from(self.tile));
        let apron = u64::from(self.apron);
        let (first, end) = (first.saturating_sub(apron), (end + apron).min(u64::from(side)));
        let pixels = |length: u64| i32::try_from(length).expect("a picture is at most 65 536 pixels wide");
        (pixels(first), pixels(end.saturating_sub(first)))
    }
}

/// The picture cut into ever smaller squares of tiles, depth first, a row of squares at a time from
/// top to bottom.
///
/// Only the rows on the way down are alive, so memory follows the bins along a line across the
/// picture.
pub(super) struct Descent<'a> {
    scene: &'a Scene,
    grid: Grid,
    levels: &'a [f32],
    skip: bool,
    /// Tiles along a side of the squares that come out.
    size: u32,
    rows: Vec<Row>,
}

/// A row of squares of `count` tiles a side, of whose rows of pieces the first few are already cut
/// off.
struct Row {
    count: u32,
    nodes: Vec<Node>,
    cut: u32,
}

/// Pieces along a side that a square is cut into at most. Chosen.
const FAN: u32 = 8;

/// Candidates in a row of squares beyond which its pieces are cut off a row at a time. In the
/// largest squares one may be seen in half a dozen pieces; cutting all at once would take that many
/// times the memory of the scene. Chosen: 1.5 MiB of them.
const HEAVY: usize = 65_536;

impl<'a> Descent<'a> {
    /// Cuts down to squares of `size` tiles (a power of two); squares that are uniform in respect
    /// of `levels` are left out where `skip` says so.
    pub(super) fn new(scene: &'a Scene, grid: Grid, size: u32, levels: &'a [f32], skip: bool) -> Self {
        let (columns, rows) = grid.size();
        let count = columns.max(rows).next_power_of_two().max(size);
        let root =
            grid.cell(0, 0, count).map(|cell| Node { column: 0, row: 0, cell, bin: Bin::root(scene, cell) });
        let rows = root.map(|root| Row { count, nodes: vec![root], cut: 0 }).into_iter().collect();
        Self { scene, grid, levels, skip, size, rows }
    }

    /// The squares of `count` tiles a side in a square of `from` tiles, by those rows of them that
    /// are asked for.
    fn children(
        &self,
        mosaic: &mut Mosaic,
        node: &Node,
        (from, count): (u32, u32),
        rows: Range<u32>,
    ) -> Vec<Vec<Node>> {
        let (columns, end) = self.grid.size();
        let firsts = |first: u32, end: u32| (first..end).step_by(count as usize);
        let columns = firsts(node.column, columns.min(node.column + from));
        let rows = firsts(node.row + rows.start * count, end.min(node.row + rows.end * count));
        let cuts = Cuts {
            columns: columns.clone().map(|tile| self.grid.span(tile, count, self.grid.width)).collect(),
            rows: rows.clone().map(|tile| self.grid.span(tile, count, self.grid.height)).collect(),
        };
        let mut bins = Vec::new();
        mosaic.split(self.scene, &node.bin, node.cell, &cuts, &mut bins);
        bins.iter_mut().for_each(Bin::shrink);
        let mut pieces = cuts.cells().zip(bins);
        let row_of = |row| {
            let row_pieces = columns.clone().zip(&mut pieces);
            let nodes = row_pieces.map(|(column, (cell, bin))| Node { column, row, cell, bin });
            nodes.filter(|node| !(self.skip && node.bin.uniform(self.scene, self.levels).is_some())).collect()
        };
        rows.map(row_of).collect()
    }
}

impl Iterator for Descent<'_> {
    type Item = Vec<Node>;

    fn next(&mut self) -> Option<Vec<Node>> {
        while let Some(Row { count: from, nodes, cut }) = self.rows.pop() {
            if from == self.size {
                return Some(nodes);
            }
            let count = (from / FAN).max(self.size);
            let heavy = nodes.iter().map(|node| node.bin.len()).sum::<usize>() > HEAVY;
            let ahead = cut..if heavy { cut + 1 } else { from / count };
            let split =
                |mosaic: &mut Mosaic, node: &Node| self.children(mosaic, node, (from, count), ahead.clone());
            let split: Vec<_> = nodes.par_iter().map_init(Mosaic::new, split).collect();
            if ahead.end < from / count {
                self.rows.push(Row { count: from, nodes, cut: ahead.end });
            }
            let mut rows: Vec<Vec<Node>> = Vec::new();
            rows.resize_with(split.first().map_or(0, Vec::len), Vec::new);
            for node in split {
                rows.iter_mut().zip(node).for_each(|(row, nodes)| row.extend(nodes));
            }
            let rows = rows.into_iter().rev().filter(|nodes| !nodes.is_empty());
            self.rows.extend(rows.map(|nodes| Row { count, nodes, cut: 0 }));
        }
        None
    }
}

/// A length in pixels as a signed number; those of a picture are small.
pub(super) fn signed(pixels: u32) -> i32 {
    i32::try_from(pixels).expect("a picture is at most 65 536 pixels wide")
}
