use pulp::{Arch, Simd, WithSimd};

use super::block::{Field, LANES};
use super::cell::Cell;
use super::half_plane::Cover;
use super::lanes::Lanes;
use super::primitive::{Reach, SLACK, Shape};

/// Blocks along a side of the largest mosaic: as many as a processor works on at once.
const ACROSS: usize = LANES as usize;

/// Pixels along a side of a block. Measured: see the module's doc.
const GRAIN: i32 = 16;

/// One number for each block in a row of blocks.
type Across = [f32; ACROSS];

const NOWHERE: Across = [f32::INFINITY; ACROSS];

/// A cell cut into blocks, and for each surface how deep it lies in each block.
///
/// It is a coarse picture of the cell, drawn by the same formulas that draw the fine one: one sample in the middle
/// of each block, and the block's radius as the doubt.
pub(super) struct Mosaic {
    arch: Arch,
    /// Where blocks begin, and how long they are.
    columns: Vec<(i32, i32)>,
    rows: Vec<(i32, i32)>,
    /// The middles of the columns and rows of blocks in steps, and how far a sample lies from the middle of its
    /// block at most, in pixels.
    xs: Across,
    ys: Vec<f32>,
    radius: f32,
    /// For each surface and row of blocks: no fragment in the block is nearer; infinite where there is none.
    near: Vec<Across>,
    /// And none is deeper, where the surface covers all of the block; else infinite.
    far: Vec<Across>,
    /// For each row of blocks the least `far` of all surfaces.
    hidden: Vec<Across>,
}

impl Mosaic {
    /// Pixels along a side of the largest cell.
    pub(super) const SIDE: i32 = GRAIN * LANES;

    pub(super) fn new() -> Self {
        Self {
            arch: Arch::new(),
            columns: Vec::new(),
            rows: Vec::new(),
            xs: [0.0; ACROSS],
            ys: Vec::new(),
            radius: 0.0,
            near: Vec::new(),
            far: Vec::new(),
            hidden: Vec::new(),
        }
    }

    /// Draws the coarse picture of `cell`, at most [`Mosaic::SIDE`] wide and high.
    pub(super) fn draw<'a>(&mut self, cell: Cell, shapes: impl Iterator<Item = &'a Shape>) {
        self.cut(cell);
        for shape in shapes {
            self.add(shape, cell);
        }
    }

    fn cut(&mut self, cell: Cell) {
        let pieces = |from: i32, length: i32, multiple: i32, out: &mut Vec<(i32, i32)>| {
            let count = (length + GRAIN - 1) / GRAIN;
            let step = ((length + count - 1) / count + multiple - 1) / multiple * multiple;
            out.clear();
            out.extend(
                (0..count)
                    .map(|i| i * step)
                    .filter(|&at| at < length)
                    .map(|at| (from + at, step.min(length - at))),
            );
        };
        pieces(cell.x, cell.width, LANES, &mut self.columns);
        pieces(cell.y, cell.height, 1, &mut self.rows);
        for (x, &(from, length)) in self.xs.iter_mut().zip(&self.columns) {
            *x = middle(from, length);
        }
        self.ys.clear();
        self.ys.extend(self.rows.iter().map(|&(from, length)| middle(from, length)));
        let largest = Cell { x: 0, y: 0, width: self.columns[0].1, height: self.rows[0].1 };
        #[expect(clippy::cast_possible_truncation, reason = "the slack is far above the rounding")]
        let radius = largest.radius() as f32;
        self.radius = radius;
        self.near.clear();
        self.far.clear();
        self.hidden.clear();
        self.hidden.resize(self.rows.len(), NOWHERE);
    }

    fn add(&mut self, shape: &Shape, cell: Cell) {
        let begin = self.near.len();
        self.near.resize(begin + self.rows.len(), NOWHERE);
        self.far.resize(begin + self.rows.len(), NOWHERE);
        let cover = shape.sample_blocks(self, cell, begin);
        if cover == Cover::Part {
            self.refine(shape, begin);
        }
        for (hidden, far) in self.hidden.iter_mut().zip(&self.far[begin..]) {
            for (hidden, &far) in hidden.iter_mut().zip(far) {
                *hidden = if far < *hidden { far } else { *hidden };
            }
        }
    }

    /// Asks a surface block by block.
    fn refine(&mut self, shape: &Shape, begin: usize) {
        for (row, &(y, height)) in self.rows.iter().enumerate() {
            for (column, &(x, width)) in self.columns.iter().enumerate() {
                let reach = shape.reach(Cell { x, y, width, height });
                let (near, far) = reach.map_or((f32::INFINITY, f32::INFINITY), single);
                self.near[begin + row][column] = near;
                self.far[begin + row][column] = far;
            }
        }
    }

    /// Samples a field in the middle of each block; what it says is for the surface that begins at `begin`.
    pub(super) fn sample(&mut self, field: &impl Field, offset: f32, size: f32, limit: f32, begin: usize) {
        let (near, far) = (&mut self.near[begin..], &mut self.far[begin..]);
        let size = size + 2.0 * offset.abs() + self.radius;
        let (xs, ys, radius) = (&self.xs, &self.ys, self.radius);
        self.arch.dispatch(Sample { field, xs, ys, radius, size, limit, near, far });
    }

    /// The blocks in reading order, with their place: row and column.
    pub(super) fn blocks(&self) -> impl Iterator<Item = (usize, usize, Cell)> {
        let rows = self.rows.iter().enumerate();
        rows.flat_map(|(row, &(y, height))| {
            let columns = self.columns.iter().enumerate();
            columns.map(move |(column, &(x, width))| (row, column, Cell { x, y, width, height }))
        })
    }

    /// How deep the surface added as number `index` lies in a block: no nearer than the first, no deeper than the
    /// second.
    #[inline]
    pub(super) fn depths(&self, index: usize, row: usize, column: usize) -> (f32, f32) {
        let at = index * self.rows.len() + row;
        (self.near[at][column], self.far[at][column])
    }

    /// The depth beyond which nothing is seen in a block.
    pub(super) fn hidden(&self, row: usize, column: usize) -> f32 {
        self.hidden[row][column]
    }
}

/// The middle of the samples of some columns or rows, in steps; exact.
#[expect(clippy::cast_precision_loss, reason = "below 2²⁴")]
fn middle(from: i32, length: i32) -> f32 {
    (from * 256 + length * 128) as f32
}

/// The bounds of a reach in single precision, rounded outwards.
#[expect(clippy::cast_possible_truncation, reason = "the slack is far above the rounding")]
fn single(reach: Reach) -> (f32, f32) {
    let near = reach.near - reach.near.abs() * f64::from(SLACK);
    let far = reach.far + reach.far.abs() * f64::from(SLACK);
    (near as f32, far as f32)
}

/// The call of [`Mosaic::sample`], to be compiled for each kind of processor.
struct Sample<'a, F> {
    field: &'a F,
    xs: &'a Across,
    ys: &'a [f32],
    radius: f32,
    size: f32,
    limit: f32,
    near: &'a mut [Across],
    far: &'a mut [Across],
}

impl<F: Field> WithSimd for Sample<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let splat = |number| Lanes::splat(simd, number);
        let (radius, size, limit, slack) =
            (splat(self.radius), splat(self.size), splat(self.limit), splat(SLACK));
        let nowhere = splat(f32::INFINITY);
        let xs = S::as_simd_f32s(self.xs).0;
        for (&y, (near, far)) in self.ys.iter().zip(self.near.iter_mut().zip(self.far)) {
            let row = self.field.row(simd, y);
            let (near, far) = (S::as_mut_simd_f32s(near).0, S::as_mut_simd_f32s(far).0);
            for (&x, (near, far)) in xs.iter().zip(near.iter_mut().zip(far)) {
                let depth = F::depth(row, Lanes::new(simd, x));
                let margin = radius + (depth + size) * slack;
                let (least, most) = (depth - margin, depth + margin);
                *near = least.at_most(limit).select(least, nowhere).value;
                *far = most.at_most(limit).select(most, nowhere).value;
            }
        }
    }
}
