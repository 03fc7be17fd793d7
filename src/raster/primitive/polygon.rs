//! Flat areas inside contours, by winding number, pixel-exact as OpenGL fills them.

use std::ops::Range;

use super::super::bin::Bin;
use super::super::canvas::{Canvas, Extent, Field, SIDE, Slope, count, put};
use super::super::cell::Cell;
use super::super::lanes::Lanes;
use super::super::mosaic::{ACROSS, Cuts};
use super::super::simd::Simd;
use super::super::subpixel::sample;
use super::super::{FillRule, Fragment, Label, PixelPoint};
use super::Bounds;

/// A flat area inside contours.
///
/// A cell knows it by the edges that touch the cell and by how often the contours wind round the
/// cell's top left sample; from there every other sample of the cell is reached without leaving it,
/// down the left column and then along the row, counting edges crossed. So no edge outside the cell
/// is ever looked at.
///
/// A sample counts as moved by (ε, ε²): right by next to nothing, down by still less. Then it lies
/// on no edge, and left and top edges keep the samples on them, right and bottom edges do not.
#[derive(Clone, Debug)]
pub(in super::super) struct Polygon {
    edges: Vec<Edge>,
    rule: FillRule,
    depth: f32,
}

/// What a cell knows of a polygon.
#[derive(Clone, Debug)]
pub(in super::super) struct Part {
    /// Which primitive.
    pub primitive: u32,
    /// How often it winds round the top left sample of the cell.
    pub winding: i32,
    /// Its edges that may touch the cell, in a list kept beside.
    pub edges: Range<usize>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    from: (i32, i32),
    to: (i32, i32),
}

impl Edge {
    /// On which side of the edge's line the sample at (`x`, `y`) lies: whether clockwise of its
    /// direction.
    fn clockwise(&self, x: i32, y: i32) -> bool {
        let (ux, uy) =
            (i64::from(self.to.0) - i64::from(self.from.0), i64::from(self.to.1) - i64::from(self.from.1));
        let cross =
            ux * (i64::from(y) - i64::from(self.from.1)) - uy * (i64::from(x) - i64::from(self.from.0));
        // On the line the moved sample decides: first its ε along x, then its ε² along y.
        cross > 0 || (cross == 0 && (uy < 0 || (uy == 0 && ux > 0)))
    }

    /// What crossing the edge adds to the winding number on the way from one sample to another.
    fn crossing(&self, from: (i32, i32), to: (i32, i32)) -> i32 {
        i32::from(self.clockwise(from.0, from.1)) - i32::from(self.clockwise(to.0, to.1))
    }

    /// Whether the row of samples at `y` meets it.
    fn spans_row(&self, y: i32) -> bool {
        (self.from.1 <= y) != (self.to.1 <= y)
    }

    /// Whether the column of samples at `x` meets it.
    fn spans_column(&self, x: i32) -> bool {
        (self.from.0 <= x) != (self.to.0 <= x)
    }

    /// Whether it comes as high or low as the rows of samples from `first` to `last`.
    fn meets_rows(&self, first: i32, last: i32) -> bool {
        self.from.1.max(self.to.1) >= first && self.from.1.min(self.to.1) <= last
    }

    /// Whether it may come between the samples of `cell`.
    fn touches(&self, cell: Cell) -> bool {
        let (first, last) = (cell.first(), cell.last());
        let apart = self.from.0.max(self.to.0) < first.0
            || self.from.0.min(self.to.0) > last.0
            || self.from.1.max(self.to.1) < first.1
            || self.from.1.min(self.to.1) > last.1;
        if apart {
            return false;
        }
        let corners = [first, (last.0, first.1), (first.0, last.1), last];
        let clockwise = corners.iter().filter(|corner| self.clockwise(corner.0, corner.1)).count();
        clockwise != 0 && clockwise != corners.len()
    }

    /// The first of `columns` whose sample at row `y` lies to the right of the edge, which spans
    /// the row.
    fn first_right(&self, y: i32, columns: Range<i32>) -> i32 {
        let (top, bottom) = if self.from.1 < self.to.1 { (self.from, self.to) } else { (self.to, self.from) };
        // x ≥ top.x + (bottom.x − top.x) (y − top.y) / (bottom.y − top.y), multiplied out and
        // rounded up.
        let (ux, uy) = (i64::from(bottom.0) - i64::from(top.0), i64::from(bottom.1) - i64::from(top.1));
        let along = ux * (i64::from(y) - i64::from(top.1));
        let before = i64::from(top.0) - i64::from(sample(0));
        let column = -((-(before * uy + along)).div_euclid(uy * 256));
        i32::try_from(column.clamp(i64::from(columns.start), i64::from(columns.end)))
            .expect("between two columns")
    }
}

impl Polygon {
    /// None where no contour encloses anything.
    ///
    /// # Panics
    ///
    /// Where the depth is not finite.
    pub(in super::super) fn new(contours: &[Vec<PixelPoint>], rule: FillRule, depth: f32) -> Option<Self> {
        assert!(depth.is_finite(), "a depth is a finite number");
        let rings = contours.iter().filter(|ring| ring.len() >= 3);
        let edges: Vec<_> = rings
            .flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)))
            .filter(|(from, to)| from != to)
            .map(|(from, to)| Edge { from: from.raw(), to: to.raw() })
            .collect();
        (!edges.is_empty()).then_some(Self { edges, rule, depth: depth + 0.0 })
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds::flat(self.edges.iter().map(|edge| edge.from), self.depth)
    }

    /// Its depth at a pixel; none beside it. Asks every edge.
    pub(super) fn fragment(&self, column: i32, row: i32) -> Option<f32> {
        self.encloses(self.winding(sample(column), sample(row))).then_some(self.depth)
    }

    pub(in super::super) const fn depth(&self) -> f32 {
        self.depth
    }

    fn encloses(&self, winding: i32) -> bool {
        match self.rule {
            FillRule::NonZero => winding != 0,
            FillRule::EvenOdd => winding & 1 != 0,
        }
    }

    /// How many edges it has.
    pub(in super::super) fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// How often it winds round the sample at (`x`, `y`), from all its edges.
    pub(in super::super) fn winding(&self, x: i32, y: i32) -> i32 {
        let row = self.edges.iter().filter(|edge| edge.spans_row(y));
        // Seen from far to the left, a downward edge (to.y > from.y) is crossed where the sample is
        // not clockwise.
        row.map(|edge| {
            let far_left_is_clockwise = edge.from.1 < edge.to.1;
            i32::from(far_left_is_clockwise) - i32::from(edge.clockwise(x, y))
        })
        .sum()
    }

    /// Gives each piece that `cuts` makes of `around` its part of `part`; `covered` gets row and
    /// column of those it covers entirely.
    pub(in super::super) fn split(
        &self,
        part: &Part,
        edges: &[u32],
        around: Cell,
        cuts: &Cuts,
        bins: &mut [Bin],
        mut covered: impl FnMut(usize, usize),
    ) {
        let across = cuts.columns.len();
        let start = around.first();
        let mut begins = [0; ACROSS * ACROSS];
        begins.iter_mut().zip(bins.iter()).for_each(|(begin, bin)| *begin = bin.edges.len());
        // The winding at the first sample of each piece, less the part's own.
        let mut winding = [[0; ACROSS]; ACROSS];
        for &index in &edges[part.edges.clone()] {
            let edge = self.edges[index as usize];
            let spans_start = edge.spans_column(start.0);
            for ((row, &(y, height)), winding) in cuts.rows.iter().enumerate().zip(&mut winding) {
                let y_first = sample(y);
                let down = if spans_start { edge.crossing(start, (start.0, y_first)) } else { 0 };
                let spans_row = edge.spans_row(y_first);
                let meets = edge.meets_rows(y_first, sample(y + height - 1));
                if down == 0 && !spans_row && !meets {
                    continue;
                }
                for ((column, &(x, width)), winding) in cuts.columns.iter().enumerate().zip(winding) {
                    let along =
                        if spans_row { edge.crossing((start.0, y_first), (sample(x), y_first)) } else { 0 };
                    *winding += down + along;
                    if meets && edge.touches(Cell { x, y, width, height }) {
                        bins[row * across + column].edges.push(index);
                    }
                }
            }
        }
        for (number, bin) in bins.iter_mut().enumerate() {
            let (row, column) = (number / across, number % across);
            let winding = part.winding + winding[row][column];
            let edges = begins[number]..bin.edges.len();
            let bare = edges.is_empty();
            if bare && !self.encloses(winding) {
                continue;
            }
            if bare {
                covered(row, column);
            }
            bin.parts.push(Part { primitive: part.primitive, winding, edges });
        }
    }

    /// Draws what `part` says of it on the block.
    pub(in super::super) fn draw(
        &self,
        label: Label,
        part: &Part,
        edges: &[u32],
        extent: Extent<'_>,
        canvas: &mut Canvas,
    ) {
        if part.edges.is_empty() {
            canvas.lay(label, &Flat(self.depth), extent);
            return;
        }
        let edges = &edges[part.edges.clone()];
        let (cell, depth) = (canvas.block(), self.depth);
        for (row, depths, labels) in canvas.rows() {
            let changes = self.changes(part.winding, edges, cell, sample(row));
            let mut winding = 0;
            for ((old, owner), change) in depths.iter_mut().zip(labels).zip(changes) {
                winding += change;
                if self.encloses(winding) {
                    put(old, owner, Fragment { depth, label });
                }
            }
        }
    }

    /// By how much the winding number changes at each sample of a row of `cell`, from 0 before the
    /// first.
    fn changes(&self, winding: i32, edges: &[u32], cell: Cell, y: i32) -> [i32; SIDE as usize + 1] {
        let mut changes = [0; SIDE as usize + 1];
        let first = cell.first();
        let columns = cell.x + 1..cell.x + cell.width;
        changes[0] = winding;
        for edge in edges.iter().map(|&index| self.edges[index as usize]) {
            if edge.spans_column(first.0) {
                changes[0] += edge.crossing(first, (first.0, y));
            }
            if edge.spans_row(y) {
                let column = edge.first_right(y, columns.clone());
                let from = (sample(cell.x), y);
                let to = (sample(column.min(columns.end - 1)), y);
                changes[count(column - cell.x)] += edge.crossing(from, to);
            }
        }
        changes
    }
}

/// The same depth everywhere.
struct Flat(f32);

impl Field for Flat {
    type Columns<S: Simd> = Lanes<S>;

    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, _: Lanes<S>) -> Lanes<S> {
        Lanes::splat(simd, self.0)
    }

    #[inline(always)]
    fn depth<S: Simd>(depth: Lanes<S>, _: Lanes<S>) -> Lanes<S> {
        depth
    }

    #[inline(always)]
    fn slope<S: Simd>(depth: Lanes<S>, _: Lanes<S>, _: Lanes<S>) -> Slope<S> {
        let zero = depth.all(0.0);
        Slope { near: depth, far: depth, way: (zero, zero), curve: zero }
    }
}
