//! Which points are near which: points in square buckets, searched ring by ring.

use crate::geometry::{Point, Rect};

/// Points in buckets of about two each.
pub(super) struct Buckets<'a> {
    points: &'a [Point],
    cells: Vec<Vec<u32>>,
    columns: i64,
    rows: i64,
    corner: Point,
    /// The side of a bucket in nanometres.
    side: i64,
    left: usize,
}

impl<'a> Buckets<'a> {
    pub(super) fn new(points: &'a [Point]) -> Self {
        let bounds =
            Rect::around(points.iter().copied()).unwrap_or(Rect::new(Point::default(), Point::default()));
        let (width, height) = (bounds.width().get() + 1, bounds.height().get() + 1);
        let share = (width.max(height) / i64::try_from(points.len().max(1)).unwrap_or(i64::MAX)).max(1);
        // Two points a bucket if they lie evenly; a long thin board gets buckets that are not too
        // many either.
        let side = (width / 2 * height / i64::try_from(points.len().max(1)).unwrap_or(i64::MAX) * 4)
            .isqrt()
            .max(share);
        let (columns, rows) = (width / side + 1, height / side + 1);
        let cells = vec![Vec::new(); usize::try_from(columns * rows).expect("about a bucket for two points")];
        let mut buckets =
            Self { points, cells, columns, rows, corner: bounds.min(), side, left: points.len() };
        for (index, &point) in points.iter().enumerate() {
            let (column, row) = buckets.cell(point);
            let cell = buckets.index(column, row);
            buckets.cells[cell].push(u32::try_from(index).expect("points are numbered in 32 bits"));
        }
        buckets
    }

    fn cell(&self, p: Point) -> (i64, i64) {
        let (x, y) = ((p.x - self.corner.x).get() / self.side, (p.y - self.corner.y).get() / self.side);
        (x.clamp(0, self.columns - 1), y.clamp(0, self.rows - 1))
    }

    fn index(&self, column: i64, row: i64) -> usize {
        usize::try_from(row * self.columns + column).expect("within the buckets")
    }

    /// Takes a point out.
    pub(super) fn remove(&mut self, index: usize) {
        let (column, row) = self.cell(self.points[index]);
        let cell = self.index(column, row);
        if let Some(place) = self.cells[cell].iter().position(|&other| other as usize == index) {
            self.cells[cell].remove(place);
            self.left -= 1;
        }
    }

    /// The nearest point that is left, the first of several as near.
    pub(super) fn nearest(&self, to: Point) -> Option<usize> {
        self.nearest_few(to, 1, |_| true).first().map(|&(_, index)| index as usize)
    }

    /// The `count` nearest points that `wanted` lets pass, each with its squared distance, nearest
    /// first.
    pub(super) fn nearest_few(
        &self,
        to: Point,
        count: usize,
        wanted: impl Fn(u32) -> bool,
    ) -> Vec<(i64, u32)> {
        let mut found: Vec<(i64, u32)> = Vec::with_capacity(count + 1);
        if self.left == 0 {
            return found;
        }
        let (column, row) = self.cell(to);
        for ring in 0..self.columns.max(self.rows) {
            // Whatever lies in this ring is at least ring − 1 whole buckets away.
            let away = (ring - 1).max(0) * self.side;
            if found.len() == count && found[count - 1].0 <= away.saturating_mul(away) {
                break;
            }
            self.ring(column, row, ring, |index| {
                if wanted(index) {
                    let entry = ((self.points[index as usize] - to).length_squared(), index);
                    let place = found.partition_point(|other| *other < entry);
                    if place < count {
                        found.insert(place, entry);
                        found.truncate(count);
                    }
                }
            });
        }
        found
    }

    /// Visits the points in the buckets exactly `ring` away.
    fn ring(&self, column: i64, row: i64, ring: i64, mut visit: impl FnMut(u32)) {
        for r in (row - ring).max(0)..=(row + ring).min(self.rows - 1) {
            let step = if (r - row).abs() == ring { 1 } else { (2 * ring).max(1) };
            let mut c = column - ring;
            while c <= column + ring {
                if c >= 0 && c < self.columns {
                    self.cells[self.index(c, r)].iter().copied().for_each(&mut visit);
                }
                c += step;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::Nm;

    proptest! {
        #[test]
        fn the_nearest_few_are_what_sorting_all_gives(
            points in prop::collection::vec((0..5000_i64, 0..200_i64), 1..80),
            to in (-100..5100_i64, -100..300_i64),
        ) {
            let at = |(x, y): (i64, i64)| Point::new(Nm::new(x), Nm::new(y));
            let points: Vec<_> = points.into_iter().map(at).collect();
            let to = at(to);
            let mut all: Vec<(i64, u32)> =
                (0_u32..).zip(&points).map(|(i, &p)| ((p - to).length_squared(), i)).collect();
            all.sort_unstable();
            all.truncate(5);
            prop_assert_eq!(Buckets::new(&points).nearest_few(to, 5, |_| true), all);
        }
    }
}
