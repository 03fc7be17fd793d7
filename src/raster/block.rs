use std::ops::Range;

use super::cell::Cell;
use super::subpixel::sample;
use super::{Fragment, Label};

/// Pixels that a loop draws at once: two SSE registers, one AVX register. Cells are cut at multiples of it.
pub(super) const LANES: i32 = 8;

/// Pixels along a side of the largest block. Chosen: 8 KiB, a quarter of a first-level cache.
pub(super) const SIDE: i32 = 32;

const CHUNKS: usize = (SIDE / LANES) as usize;

const WIDTH: usize = LANES as usize;

/// Depths and labels of a small cell while primitives are laid on it.
///
/// Rows are padded to whole lanes; what lies beyond the cell is drawn along and never read.
pub(super) struct Block {
    cell: Cell,
    depths: Vec<[f32; WIDTH]>,
    labels: Vec<[u32; WIDTH]>,
}

/// One row of a block, from the column of its cell on.
pub(super) struct Row<'a> {
    /// The row's sample position in steps.
    pub y: i32,
    /// The leftmost sample position in steps.
    pub x: i32,
    /// The leftmost column.
    pub column: i32,
    depths: &'a mut [[f32; WIDTH]],
    labels: &'a mut [[u32; WIDTH]],
}

impl Block {
    /// A block to be used again and again.
    pub(super) fn new() -> Self {
        let chunks = CHUNKS * CHUNKS * WIDTH;
        let cell = Cell { x: 0, y: 0, width: 1, height: 1 };
        Self { cell, depths: vec![[0.0; WIDTH]; chunks], labels: vec![[0; WIDTH]; chunks] }
    }

    /// Takes the place of `cell`, at most [`SIDE`] wide and high, with nothing drawn.
    pub(super) fn clear(&mut self, cell: Cell) {
        self.cell = cell;
        let chunks = self.chunks() * count(cell.height);
        self.depths[..chunks].fill([f32::INFINITY; WIDTH]);
        self.labels[..chunks].fill([Label::BACKGROUND.0; WIDTH]);
    }

    /// The pixels it stands for.
    pub(super) const fn cell(&self) -> Cell {
        self.cell
    }

    fn chunks(&self) -> usize {
        count(self.cell.width).div_ceil(WIDTH)
    }

    /// Its rows from the top, to be drawn on.
    pub(super) fn rows(&mut self) -> impl Iterator<Item = Row<'_>> {
        let (cell, chunks) = (self.cell, self.chunks());
        let rows = self.depths.chunks_exact_mut(chunks).zip(self.labels.chunks_exact_mut(chunks));
        (cell.y..cell.y + cell.height).zip(rows).map(move |(row, (depths, labels))| Row {
            y: sample(row),
            x: sample(cell.x),
            column: cell.x,
            depths,
            labels,
        })
    }

    /// Its finished rows from the top, as wide as the cell.
    pub(super) fn finished(&self) -> impl Iterator<Item = (&[f32], &[u32])> {
        let (width, chunks) = (count(self.cell.width), self.chunks());
        let rows = self.depths.chunks_exact(chunks).zip(self.labels.chunks_exact(chunks));
        rows.take(count(self.cell.height))
            .map(move |(depths, labels)| (&depths.as_flattened()[..width], &labels.as_flattened()[..width]))
    }
}

impl Row<'_> {
    /// The columns the row reaches, padding included.
    pub(super) fn columns(&self) -> Range<i32> {
        let width = i32::try_from(self.depths.len()).expect("a few chunks") * LANES;
        self.column..self.column + width
    }

    /// Draws a fragment on every pixel; `depth` gets the sample position in steps.
    ///
    /// Primitives come in the order of their labels, so that a tie is left with the earlier.
    #[inline(always)]
    pub(super) fn draw(&mut self, label: Label, depth: impl Fn(i32) -> f32) {
        let mut x = self.x;
        for (depths, labels) in self.depths.iter_mut().zip(self.labels.iter_mut()) {
            for (lane, (old, owner)) in (0..).zip(depths.iter_mut().zip(labels.iter_mut())) {
                let new = depth(x + lane * 256);
                let closer = new < *old;
                *old = if closer { new } else { *old };
                *owner = if closer { label.0 } else { *owner };
            }
            x += LANES * 256;
        }
    }

    /// Draws fragments on `columns` only, and only where they are no deeper than `limit`.
    #[inline(always)]
    pub(super) fn draw_part(
        &mut self,
        label: Label,
        columns: &Range<i32>,
        limit: f32,
        depth: impl Fn(i32) -> f32,
    ) {
        let (from, to) = (sample(columns.start), sample(columns.end));
        self.draw(label, |x| {
            let new = depth(x);
            if (x >= from) & (x < to) & (new <= limit) { new } else { f32::INFINITY }
        });
    }

    /// Draws one fragment on the pixel at `column`.
    pub(super) fn draw_pixel(&mut self, column: i32, fragment: Fragment) {
        let index = count(column - self.column);
        let (old, owner) =
            (&mut self.depths[index / WIDTH][index % WIDTH], &mut self.labels[index / WIDTH][index % WIDTH]);
        if fragment.depth < *old {
            (*old, *owner) = (fragment.depth, fragment.label.0);
        }
    }
}

/// A length or an index of a pixel as a `usize`.
#[expect(clippy::cast_sign_loss, reason = "lengths and indices are not negative")]
pub(super) const fn count(pixels: i32) -> usize {
    debug_assert!(pixels >= 0, "a length is not negative");
    pixels as usize
}
