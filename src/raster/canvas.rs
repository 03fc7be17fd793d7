//! Blocks of pixels and the loops that draw on them: the inner loops of the engine.

use std::ops::Range;

use super::cell::Cell;
use super::lanes::Lanes;
use super::processor::{LANES, Processor, WIDEST};
use super::simd::{Simd, WithSimd};
use super::subpixel::sample;
use super::{Fragment, Label};

/// Pixels along a side of the largest block of pixels drawn at a time. Chosen: 8 KiB, a quarter of
/// a first-level cache.
pub(super) const SIDE: i32 = 32;

/// Sample positions of neighbouring pixels from the first one on, in steps.
const OFFSETS: [f32; WIDEST] = [
    0.0, 256.0, 512.0, 768.0, 1024.0, 1280.0, 1536.0, 1792.0, 2048.0, 2304.0, 2560.0, 2816.0, 3072.0, 3328.0,
    3584.0, 3840.0,
];

/// A surface whose depth is computed many pixels at a time.
///
/// Positions are sample positions in steps: whole numbers below 2²⁴, so exact in an `f32`.
pub(super) trait Field {
    /// What is constant in some columns side by side, one for each lane.
    type Columns<S: Simd>: Copy;

    /// Sets up the columns at `x`.
    fn columns<S: Simd>(&self, simd: S, x: Lanes<S>) -> Self::Columns<S>;

    /// The depth in the row at `y`, the same in all lanes; never NaN, never −0.
    fn depth<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S>;

    /// How it lies around the row at `y`, as far as `radius` pixels away.
    fn slope<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>, radius: Lanes<S>) -> Slope<S>;

    /// How many pixels the row at `y` lies outside of what the surface covers; negative inside, by
    /// as much.
    #[inline(always)]
    fn beyond<S: Simd>(_columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        y.all(f32::NEG_INFINITY)
    }
}

/// How a surface lies around a place: what bounds its depth in a piece of a mosaic.
#[derive(Clone, Copy)]
pub(super) struct Slope<S: Simd> {
    /// Its depth is nowhere less than `near` + `way` · h, at a place h pixels away.
    pub near: Lanes<S>,
    /// And nowhere more than the larger of 0 and `far` + `way` · h + `curve` · h² / 2, nor than
    /// `far` + |h|.
    pub far: Lanes<S>,
    /// Along x and y; infinite where there is no such plane: then `near` − |h| is the bound.
    pub way: (Lanes<S>, Lanes<S>),
    pub curve: Lanes<S>,
}

/// Which pixels of a block a surface is laid on.
#[derive(Clone, Copy)]
pub(super) enum Extent<'a> {
    /// All, and nothing has been laid before.
    First,
    /// All.
    Whole,
    /// One range of columns for each row, where no deeper than the limit.
    Part(&'a [Range<i32>], f32),
}

/// Depths and labels of a rectangle of pixels, its frame, while primitives are laid on it block by
/// block.
///
/// Rows of a block are padded to whole lanes; what lies beyond it is drawn along. Blocks that are
/// cut from the left of the frame at multiples of [`LANES`] do not reach into each other.
pub(super) struct Canvas {
    pub processor: Processor,
    frame: Cell,
    /// From one row to the next.
    stride: usize,
    depths: Vec<f32>,
    labels: Vec<u32>,
    /// The block that is drawn on, and where its first pixel is.
    block: Cell,
    at: usize,
    /// Scratch for the columns of a part.
    pub columns: Vec<Range<i32>>,
}

impl Canvas {
    /// A canvas to be used again and again.
    pub(super) fn new() -> Self {
        let cell = Cell { x: 0, y: 0, width: 1, height: 1 };
        let (depths, labels, columns) = (Vec::new(), Vec::new(), Vec::new());
        Self {
            processor: Processor::new(),
            frame: cell,
            stride: 1,
            depths,
            labels,
            block: cell,
            at: 0,
            columns,
        }
    }

    /// Stretches it on `frame`; what was drawn before is still there.
    pub(super) fn stretch(&mut self, frame: Cell) {
        self.frame = frame;
        // Room for a block that does not begin at the frame's left, and a stride that is no power
        // of two: rows of a block a power of two apart would push one another out of the cache.
        self.stride = count(frame.width).next_multiple_of(WIDEST) + WIDEST;
        let pixels = self.stride * count(frame.height);
        if self.depths.len() < pixels {
            self.depths.resize(pixels, f32::INFINITY);
            self.labels.resize(pixels, Label::BACKGROUND.0);
        }
    }

    /// Draws from now on at `block`, at most [`SIDE`] wide and high and inside the frame.
    pub(super) const fn place(&mut self, block: Cell) {
        self.block = block;
        self.at = self.index(block.x, block.y);
    }

    const fn index(&self, x: i32, y: i32) -> usize {
        count(y - self.frame.y) * self.stride + count(x - self.frame.x)
    }

    /// Wipes what was drawn on the block.
    pub(super) fn clear(&mut self) {
        for (_, depths, labels) in self.rows() {
            depths.fill(f32::INFINITY);
            labels.fill(Label::BACKGROUND.0);
        }
    }

    /// Wipes what was drawn in the frame outside of `cell`, which lies in it.
    pub(super) fn clear_around(&mut self, cell: Cell) {
        if cell == self.frame {
            return;
        }
        let Self { frame, stride, .. } = *self;
        let rows = self.depths.chunks_exact_mut(stride).zip(self.labels.chunks_exact_mut(stride));
        let inside = count(cell.x - frame.x)..count(cell.x + cell.width - frame.x);
        for (y, (depths, labels)) in (frame.y..frame.y + frame.height).zip(rows) {
            let kept = if (cell.y..cell.y + cell.height).contains(&y) { inside.clone() } else { 0..0 };
            for outside in [0..kept.start, kept.end..stride] {
                depths[outside.clone()].fill(f32::INFINITY);
                labels[outside].fill(Label::BACKGROUND.0);
            }
        }
    }

    /// The pixels it stands for.
    pub(super) const fn frame(&self) -> Cell {
        self.frame
    }

    /// The pixels of the block.
    pub(super) const fn block(&self) -> Cell {
        self.block
    }

    /// The columns of the block's rows, padding included.
    pub(super) const fn padded_columns(&self) -> Range<i32> {
        let lanes = (self.block.width + LANES - 1) / LANES;
        self.block.x..self.block.x + lanes * LANES
    }

    const fn padded_width(&self) -> usize {
        count(self.block.width).next_multiple_of(count(LANES))
    }

    /// Lays a surface on it.
    ///
    /// Primitives come in the order of their labels, so that a tie is left with the earlier.
    pub(super) fn lay(&mut self, label: Label, field: &impl Field, extent: Extent<'_>) {
        let Self { stride, block, at, .. } = *self;
        let width = self.padded_width();
        let (depths, labels) = (&mut self.depths[at..], &mut self.labels[at..]);
        self.processor.dispatch(width, Lay { field, label, extent, block, width, stride, depths, labels });
    }

    /// The block's rows from the top as (row, depths, labels), padding included.
    pub(super) fn rows(&mut self) -> impl Iterator<Item = (i32, &mut [f32], &mut [u32])> {
        let Self { block, stride, at, .. } = *self;
        let width = self.padded_width();
        let rows = self.depths[at..].chunks_mut(stride).zip(self.labels[at..].chunks_mut(stride));
        let rows = (block.y..block.y + block.height).zip(rows);
        rows.map(move |(row, (depths, labels))| (row, &mut depths[..width], &mut labels[..width]))
    }

    /// The pixels of the frame: depths, labels, and how many pixels it is from one row to the next.
    pub(super) fn pixels(&self) -> (&[f32], &[u32], usize) {
        let pixels = self.stride * count(self.frame.height);
        (&self.depths[..pixels], &self.labels[..pixels], self.stride)
    }

    /// The finished rows of the frame from the top, as wide as it is.
    pub(super) fn finished(&self) -> impl Iterator<Item = (&[f32], &[u32])> {
        let width = count(self.frame.width);
        let (depths, labels, stride) = self.pixels();
        let rows = depths.chunks_exact(stride).zip(labels.chunks_exact(stride));
        rows.map(move |(depths, labels)| (&depths[..width], &labels[..width]))
    }
}

/// The call of [`Canvas::lay`], to be compiled for each kind of processor.
struct Lay<'a, F> {
    field: &'a F,
    label: Label,
    extent: Extent<'a>,
    block: Cell,
    /// Columns, padding included.
    width: usize,
    /// From one row to the next.
    stride: usize,
    depths: &'a mut [f32],
    labels: &'a mut [u32],
}

impl<F: Field> WithSimd for Lay<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let label = simd.splat_u32s(self.label.0);
        let Self { field, extent, block, width, stride, depths, labels, .. } = self;
        let (depths, labels) = (S::as_mut_simd_f32s(depths).0, S::as_mut_simd_u32s(labels).0);
        // One bound for both is looked at once.
        let (depths, labels) = (&mut depths[..labels.len()], labels);
        let (lanes, stride) = (S::F32_LANES, stride / S::F32_LANES);
        let offsets = Lanes::new(simd, S::as_simd_f32s(&OFFSETS).0[0]);
        let top = Lanes::splat(simd, position(block.y));
        // Whole numbers below 2²⁴ all the way: adding them is exact, and a position is what it is
        // wherever a column starts.
        let step = Lanes::splat(simd, OFFSETS[1]);
        for (at, first) in (block.x..).step_by(lanes).take(width / lanes).enumerate() {
            let x = Lanes::splat(simd, position(first)) + offsets;
            let columns = field.columns(simd, x);
            let (mut at, mut y) = (at, top);
            match extent {
                Extent::First => {
                    for _ in 0..block.height {
                        (depths[at], labels[at]) = (F::depth(columns, y).value, label);
                        (at, y) = (at + stride, y + step);
                    }
                }
                Extent::Whole => {
                    for _ in 0..block.height {
                        let (depth, old) = (F::depth(columns, y), Lanes::new(simd, depths[at]));
                        labels[at] = depth.less(old).merge(label, labels[at]);
                        depths[at] = depth.min(old).value;
                        (at, y) = (at + stride, y + step);
                    }
                }
                Extent::Part(parts, limit) => {
                    let (limit, far) = (Lanes::splat(simd, limit), Lanes::splat(simd, f32::INFINITY));
                    for part in parts.iter().take(count(block.height)) {
                        let from = Lanes::splat(simd, position(part.start));
                        let to = Lanes::splat(simd, position(part.end));
                        let (depth, old) = (F::depth(columns, y), Lanes::new(simd, depths[at]));
                        let inside = from.at_most(x).and(x.less(to)).and(depth.at_most(limit));
                        let depth = inside.select(depth, far);
                        labels[at] = depth.less(old).merge(label, labels[at]);
                        depths[at] = depth.min(old).value;
                        (at, y) = (at + stride, y + step);
                    }
                }
            }
        }
    }
}

/// The sample position of a column or row as a float; exact.
#[inline(always)]
#[expect(clippy::cast_precision_loss, reason = "below 2²⁴")]
pub(super) fn position(index: i32) -> f32 {
    sample(index) as f32
}

/// Puts a fragment on the pixel it fell on, where it is nearer.
pub(super) fn put(depth: &mut f32, label: &mut u32, fragment: Fragment) {
    if fragment.depth < *depth {
        (*depth, *label) = (fragment.depth, fragment.label.0);
    }
}

/// A length or an index of a pixel as a `usize`.
#[expect(clippy::cast_sign_loss, reason = "lengths and indices are not negative")]
pub(super) const fn count(pixels: i32) -> usize {
    debug_assert!(pixels >= 0, "a length is not negative");
    pixels as usize
}
