//! Half-planes in integers: ends of strips, sides of sectors, edges of triangles.

use std::ops::Range;

use super::cell::Cell;
use super::subpixel::sample;

/// The samples with a x + b y + c ≥ 0 (in steps): where a strip ends, a sector begins, a triangle
/// has its edge.
///
/// Decided in integers, without error: |a|, |b| ≤ 2³¹ and coordinates within ±2³⁰ keep every term
/// below 2⁶³.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfPlane {
    a: i64,
    b: i64,
    c: i64,
}

/// How a region lies to a cell of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cover {
    /// No sample is in it.
    Empty,
    /// Some may be.
    Part,
    /// All are.
    Whole,
}

impl Cover {
    /// How the intersection of two regions lies.
    pub(super) fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Empty, _) | (_, Self::Empty) => Self::Empty,
            (Self::Whole, Self::Whole) => Self::Whole,
            _ => Self::Part,
        }
    }
}

impl HalfPlane {
    /// The samples p with `way` · (p − `from`) ≥ 0.
    pub(super) fn ahead(from: (i32, i32), way: (i64, i64)) -> Self {
        let (x, y) = (i64::from(from.0), i64::from(from.1));
        Self { a: way.0, b: way.1, c: -(way.0 * x + way.1 * y) }
    }

    /// The samples p that lie clockwise of `way` as seen from `from` (at its right hand), those on
    /// the line included.
    pub(super) fn clockwise(from: (i32, i32), way: (i64, i64)) -> Self {
        Self::ahead(from, (-way.1, way.0))
    }

    /// The samples on the other side, without those on the line.
    pub(super) const fn complement(self) -> Self {
        Self { a: -self.a, b: -self.b, c: -self.c - 1 }
    }

    /// The same with the samples on the line only where it is a left edge or a flat top edge.
    ///
    /// That is the half-plane of the sample moved by (ε, ε²): right by next to nothing, down by
    /// still less.
    pub(super) const fn top_left(self) -> Self {
        let keeps = self.a > 0 || (self.a == 0 && self.b > 0);
        Self { c: if keeps { self.c } else { self.c - 1 }, ..self }
    }

    fn at(&self, x: i32, y: i32) -> i64 {
        self.a * i64::from(x) + self.b * i64::from(y) + self.c
    }

    /// How it lies to the samples of `cell`.
    pub(super) fn cover(&self, cell: Cell) -> Cover {
        let (first, last) = (cell.first(), cell.last());
        let (near_x, far_x) = if self.a >= 0 { (first.0, last.0) } else { (last.0, first.0) };
        let (near_y, far_y) = if self.b >= 0 { (first.1, last.1) } else { (last.1, first.1) };
        if self.at(near_x, near_y) >= 0 {
            Cover::Whole
        } else if self.at(far_x, far_y) < 0 {
            Cover::Empty
        } else {
            Cover::Part
        }
    }

    /// Which of `columns` are in it on the row whose samples lie at `y` steps.
    pub(super) fn columns(&self, y: i32, columns: Range<i32>) -> Range<i32> {
        let at_zero = self.at(sample(0), y);
        let step = self.a * 256;
        if step == 0 {
            return if at_zero >= 0 { columns } else { columns.start..columns.start };
        }
        let clamp = |column: i64| {
            let clamped = column.clamp(i64::from(columns.start), i64::from(columns.end));
            i32::try_from(clamped).expect("between two columns")
        };
        if step > 0 {
            let first = -(at_zero.div_euclid(step));
            clamp(first)..columns.end
        } else {
            let last = at_zero.div_euclid(-step);
            columns.start..clamp(last.saturating_add(1))
        }
    }
}

/// A convex region: what all its half-planes share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Convex<const N: usize>(pub [Option<HalfPlane>; N]);

impl<const N: usize> Convex<N> {
    /// How it lies to the samples of `cell`; may say [`Cover::Part`] where it is empty.
    pub(super) fn cover(&self, cell: Cell) -> Cover {
        self.0.iter().flatten().fold(Cover::Whole, |cover, plane| cover.and(plane.cover(cell)))
    }

    /// Whether the sample of a pixel is in it.
    pub(super) fn holds(&self, column: i32, row: i32) -> bool {
        self.0.iter().flatten().all(|plane| plane.at(sample(column), sample(row)) >= 0)
    }

    /// Which of `columns` are in it on the row whose samples lie at `y` steps.
    pub(super) fn columns(&self, y: i32, columns: Range<i32>) -> Range<i32> {
        self.0.iter().flatten().fold(columns, |left, plane| plane.columns(y, left))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_columns_of_a_row_are_those_whose_samples_are_in_it() {
        for way in [(3, 2), (-3, 2), (300, -70), (-1, 0), (0, 5), (0, -5), (0, 0), (256, 0), (-256, 256)] {
            for from in [(128, 128), (129, 128), (-700, 1500), (1280, 0)] {
                for plane in [HalfPlane::ahead(from, way), HalfPlane::ahead(from, way).complement()] {
                    for row in -3..4 {
                        let span = plane.columns(sample(row), -9..9);
                        for column in -9..9 {
                            let inside = plane.at(sample(column), sample(row)) >= 0;
                            assert_eq!(span.contains(&column), inside, "{plane:?} at {column}, {row}");
                        }
                    }
                }
            }
        }
    }
}
