//! Depth bounds of many cells at once: the hierarchical z-buffer of the engine.

use std::ops::Range;

use super::Scene;
use super::bin::{Bin, Candidate, index};
use super::canvas::Field;
use super::cell::Cell;
use super::lanes::Lanes;
use super::primitive::{Reach, SLACK, Shape};
use super::processor::{LANES, Processor};
use super::simd::{Simd, WithSimd};

/// Pieces along a side of the largest mosaic: as many as most processors work on at once.
pub(super) const ACROSS: usize = LANES as usize;

/// One number for each piece in a row of pieces.
pub(super) type Across = [f32; ACROSS];

const NOWHERE: Across = [f32::INFINITY; ACROSS];

/// Candidates beyond which a split looks at some of them first. Chosen: 64 bins of so many are 400
/// KiB.
const MANY: usize = 512;

/// After so many candidates it is looked up how deep one sees in each row. Chosen.
const OFTEN: usize = 32;

/// Where a cell is cut: columns and rows of pieces, each with its first pixel and its length.
/// Pieces may overlap.
#[derive(Clone, Debug, Default)]
pub(super) struct Cuts {
    pub columns: Vec<(i32, i32)>,
    pub rows: Vec<(i32, i32)>,
}

impl Cuts {
    /// Cuts a cell into pieces of about `grain` pixels, or of an eighth of its side if that is
    /// more; columns are cut at multiples of [`LANES`] from its left.
    pub(super) fn even(&mut self, cell: Cell, grain: i32) {
        let pieces = |from: i32, length: i32, multiple: i32, out: &mut Vec<(i32, i32)>| {
            let count = ((length + grain - 1) / grain).clamp(1, LANES);
            let step = ((length + count - 1) / count + multiple - 1) / multiple * multiple;
            out.clear();
            out.extend(
                (0..length).step_by(super::canvas::count(step)).map(|at| (from + at, step.min(length - at))),
            );
        };
        pieces(cell.x, cell.width, LANES, &mut self.columns);
        pieces(cell.y, cell.height, 1, &mut self.rows);
    }

    /// The pieces in reading order.
    pub(super) fn cells(&self) -> impl Iterator<Item = Cell> {
        self.rows
            .iter()
            .flat_map(|&(y, height)| self.columns.iter().map(move |&(x, width)| Cell { x, y, width, height }))
    }
}

/// How a surface lies in the pieces of a mosaic, row by row: see [`Candidate`] for what each says.
#[derive(Clone, Copy)]
struct Weights {
    near: [Across; ACROSS],
    far: [Across; ACROSS],
    way_x: [Across; ACROSS],
    way_y: [Across; ACROSS],
    curve: [Across; ACROSS],
}

impl Weights {
    /// Of a surface that has no fragment anywhere.
    const NOWHERE: Self = Self {
        near: [NOWHERE; ACROSS],
        far: [NOWHERE; ACROSS],
        way_x: [NOWHERE; ACROSS],
        way_y: [NOWHERE; ACROSS],
        curve: [NOWHERE; ACROSS],
    };
}

/// Cuts the bin of a cell into bins of its pieces.
///
/// It draws a coarse picture of the cell with the formulas that draw the fine one: one sample in
/// the middle of each piece, and the piece's radius as the doubt. So a candidate is weighed for 64
/// pieces by as many instructions as drawing 64 pixels takes.
pub(super) struct Mosaic {
    pub processor: Processor,
    /// The middles of the columns and rows of pieces, in steps.
    xs: Across,
    ys: Across,
    /// How far a sample lies from the middle of its piece at most, in pixels.
    radius: f32,
    weights: Weights,
    /// The rows of pieces that the surface weighed last may be seen in.
    rows: Range<usize>,
    /// The depth beyond which nothing is seen in each piece.
    hidden: [Across; ACROSS],
    /// And beyond which nothing is seen in any piece of a row, as it was a while ago.
    deepest: Across,
}

impl Mosaic {
    pub(super) fn new() -> Self {
        Self {
            processor: Processor::new(),
            xs: [0.0; ACROSS],
            ys: [0.0; ACROSS],
            radius: 0.0,
            weights: Weights::NOWHERE,
            rows: 0..0,
            hidden: [NOWHERE; ACROSS],
            deepest: NOWHERE,
        }
    }

    /// Makes `bins`, from the first on, the bins of the pieces that `cuts` makes of `around`, whose
    /// bin is `from`.
    ///
    /// A primitive that covers a whole piece no deeper than `far` hides all that lie entirely
    /// behind. Only what is strictly behind goes: a tie is decided pixel by pixel.
    pub(super) fn split(
        &mut self,
        scene: &Scene,
        from: &Bin,
        around: Cell,
        cuts: &Cuts,
        bins: &mut Vec<Bin>,
    ) {
        let count = cuts.columns.len() * cuts.rows.len();
        if bins.len() < count {
            bins.resize_with(count, Bin::default);
        }
        let bins = &mut bins[..count];
        bins.iter_mut().for_each(|bin| bin.clear(from));
        self.place(cuts);
        self.split_parts(scene, from, around, cuts, bins);
        let shape = |candidate: &Candidate| &scene.primitives[index(candidate.primitive)].shape;
        if from.shapes.len() > MANY {
            for candidate in from.shapes.iter().step_by(from.shapes.len() / (MANY / 2)) {
                self.weigh(shape(candidate), around, cuts, from.sees_through);
            }
        }
        for some in from.shapes.chunks(OFTEN) {
            self.look_up(cuts);
            for candidate in some {
                self.weigh(shape(candidate), around, cuts, from.sees_through);
                self.hand_out(candidate.primitive, cuts, bins);
            }
        }
        let hidden = self.hidden.iter().flat_map(|row| &row[..cuts.columns.len()]);
        for (bin, &hidden) in bins.iter_mut().zip(hidden) {
            bin.settle(scene, hidden, self.radius);
        }
    }

    fn place(&mut self, cuts: &Cuts) {
        for (x, &(from, length)) in self.xs.iter_mut().zip(&cuts.columns) {
            *x = middle(from, length);
        }
        for (y, &(from, length)) in self.ys.iter_mut().zip(&cuts.rows) {
            *y = middle(from, length);
        }
        let longest = |pieces: &[(i32, i32)]| pieces.iter().map(|piece| piece.1).max().unwrap_or(1);
        let largest = Cell { x: 0, y: 0, width: longest(&cuts.columns), height: longest(&cuts.rows) };
        #[expect(clippy::cast_possible_truncation, reason = "the slack is far above the rounding")]
        let radius = largest.radius() as f32;
        self.radius = radius;
        self.hidden = [NOWHERE; ACROSS];
        self.deepest = NOWHERE;
    }

    /// Finds how deep one sees at most in each row.
    fn look_up(&mut self, cuts: &Cuts) {
        for (deepest, hidden) in self.deepest.iter_mut().zip(&self.hidden) {
            *deepest = hidden[..cuts.columns.len()].iter().copied().fold(f32::NEG_INFINITY, f32::max);
        }
    }

    /// The rows in which a surface may be seen.
    fn rows_of(&self, shape: &Shape, cuts: &Cuts) -> Range<usize> {
        let bounds = shape.bounds();
        let rows = cuts.rows.iter().zip(&self.deepest);
        let seen = |(&(first, count), &deepest): (&(i32, i32), &f32)| {
            let nearest = bounds.nearest_in_rows(first, count);
            nearest < f32::INFINITY && nearest <= deepest
        };
        let first = rows.clone().take_while(|&row| !seen(row)).count();
        let below = rows.skip(first).rev().take_while(|&row| !seen(row)).count();
        first..cuts.rows.len() - below
    }

    fn split_parts(&mut self, scene: &Scene, from: &Bin, around: Cell, cuts: &Cuts, bins: &mut [Bin]) {
        for part in &from.parts {
            let Shape::Polygon(polygon) = &scene.primitives[index(part.primitive)].shape else { continue };
            polygon.split(part, &from.edges, around, cuts, bins, |row, column| {
                if !from.sees_through {
                    self.hidden[row][column] = self.hidden[row][column].min(polygon.depth());
                }
            });
        }
    }

    /// Finds how deep a surface lies in all pieces of the rows where it may be seen, and what it
    /// hides.
    fn weigh(&mut self, shape: &Shape, around: Cell, cuts: &Cuts, sees_through: bool) {
        self.rows = self.rows_of(shape, cuts);
        if !shape.weigh(self) {
            self.weigh_each(shape, around, cuts);
        }
        if !sees_through {
            let rows = self.rows.clone();
            for (hidden, far) in self.hidden[rows.clone()].iter_mut().zip(&self.weights.far[rows]) {
                for (hidden, &far) in hidden.iter_mut().zip(far) {
                    let far = if far > 0.0 { far } else { 0.0 };
                    *hidden = if far < *hidden { far } else { *hidden };
                }
            }
        }
    }

    /// The same for a surface without a formula for many pieces at once.
    fn weigh_each(&mut self, shape: &Shape, around: Cell, cuts: &Cuts) {
        self.weights = Weights::NOWHERE;
        if shape.reach(around).is_none() {
            return;
        }
        for row in self.rows.clone() {
            let (y, height) = cuts.rows[row];
            for (column, &(x, width)) in cuts.columns.iter().enumerate() {
                if let Some(reach) = shape.reach(Cell { x, y, width, height }) {
                    (self.weights.near[row][column], self.weights.far[row][column]) = single(reach);
                }
            }
        }
    }

    /// Gives a primitive that has been weighed to all pieces where it may be seen.
    fn hand_out(&self, primitive: u32, cuts: &Cuts, bins: &mut [Bin]) {
        let Weights { near, far, way_x, way_y, curve } = &self.weights;
        let bins = bins.chunks_exact_mut(cuts.columns.len()).enumerate();
        for (row, bins) in bins.take(self.rows.end).skip(self.rows.start) {
            let seen = |near: f32, hidden: f32| (near <= hidden) & (near < f32::INFINITY) & (hidden >= 0.0);
            let seen = near[row].iter().zip(&self.hidden[row]).map(|(&near, &hidden)| seen(near, hidden));
            let mut bits =
                seen.enumerate().fold(0_u32, |bits, (column, seen)| bits | (u32::from(seen) << column));
            bits &= (1 << bins.len()) - 1;
            while bits != 0 {
                let column = bits.trailing_zeros() as usize;
                bits &= bits - 1;
                bins[column].shapes.push(Candidate {
                    primitive,
                    near: near[row][column],
                    far: far[row][column],
                    way: (way_x[row][column], way_y[row][column]),
                    curve: curve[row][column],
                });
            }
        }
    }

    /// Samples a field in the middle of each piece of the rows where it may be seen.
    pub(super) fn sample(&mut self, field: &impl Field, offset: f32, size: f32, limit: f32) {
        let size = size + 2.0 * offset.abs() + self.radius;
        let Self { processor, xs, ys, radius, weights, rows, .. } = self;
        let rows = rows.clone();
        processor.dispatch(ACROSS, Sample { field, xs, ys, rows, radius: *radius, size, limit, weights });
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
    ys: &'a Across,
    rows: Range<usize>,
    radius: f32,
    size: f32,
    limit: f32,
    weights: &'a mut Weights,
}

impl<F: Field> WithSimd for Sample<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let splat = |number| Lanes::splat(simd, number);
        let (radius, size, limit, slack) =
            (splat(self.radius), splat(self.size), splat(self.limit), splat(SLACK));
        let nowhere = splat(f32::INFINITY);
        let zero = splat(0.0);
        let xs = S::as_simd_f32s(self.xs).0;
        let Weights { near, far, way_x, way_y, curve } = self.weights;
        for (at, &x) in xs.iter().enumerate() {
            let columns = self.field.columns(simd, Lanes::new(simd, x));
            for number in self.rows.clone() {
                let y = splat(self.ys[number]);
                let slope = F::slope(columns, y, radius);
                let margin = radius + (slope.far.max(zero) + size) * slack;
                let (least, most) = (slope.near - margin, slope.far + margin);
                let beyond = F::beyond(columns, y);
                let (none, some) = (margin.less(beyond), (zero - margin).less(beyond));
                let near_seen = none.select(nowhere, least.at_most(limit).select(least, nowhere));
                let far_seen = some.select(nowhere, most.at_most(limit).select(most, nowhere));
                S::as_mut_simd_f32s(&mut near[number]).0[at] = near_seen.value;
                S::as_mut_simd_f32s(&mut far[number]).0[at] = far_seen.value;
                S::as_mut_simd_f32s(&mut way_x[number]).0[at] = slope.way.0.value;
                S::as_mut_simd_f32s(&mut way_y[number]).0[at] = slope.way.1.value;
                S::as_mut_simd_f32s(&mut curve[number]).0[at] = slope.curve.value;
            }
        }
    }
}
