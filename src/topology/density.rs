//! How many rectangles cover each point of a lattice: a place where hundreds do is known as crowded
//! without looking at any of them.

use crate::geometry::{Nm, Point, Rect};

/// How far apart the points are, unless that makes too many. Chosen: half of what a stretch of a
/// usual cut is asked about, so that some lie in it.
const STEP: Nm = Nm::from_um(250);
/// Points along either axis at most. Chosen: some megabytes of them.
const MOST: i64 = 1_024;
/// Fewer rectangles are counted one by one. Chosen.
const MANY: usize = 50_000;

/// For each point of a lattice, how many rectangles cover it.
#[derive(Debug)]
pub(super) struct Density {
    corner: Point,
    step: i64,
    columns: usize,
    /// Row by row, upwards.
    counts: Vec<i32>,
}

impl Density {
    /// Counts `rects`; none where they are few.
    pub(super) fn new(rects: &[Rect]) -> Option<Self> {
        let bounds = rects.iter().copied().reduce(Rect::union).filter(|_| rects.len() >= MANY)?;
        let step = STEP.max(bounds.width().max(bounds.height()) / MOST).get();
        let points = |length: Nm| usize::try_from(length.get() / step).map_or(1, |count| count + 1);
        // One more each way, beyond which nothing is counted.
        let (columns, rows) = (points(bounds.width()) + 1, points(bounds.height()) + 1);
        let mut density = Self { corner: bounds.min(), step, columns, counts: vec![0; columns * rows] };
        // What changes from point to point along each row, and from row to row; then the sums of
        // both.
        for &rect in rects {
            let Some([left, low, right, high]) = density.within(rect) else { continue };
            let at = |column: usize, row: usize| row * columns + column;
            density.counts[at(left, low)] += 1;
            density.counts[at(right + 1, low)] -= 1;
            density.counts[at(left, high + 1)] -= 1;
            density.counts[at(right + 1, high + 1)] += 1;
        }
        for row in density.counts.chunks_exact_mut(columns) {
            (1..columns).for_each(|column| row[column] += row[column - 1]);
        }
        (columns..columns * rows).for_each(|at| density.counts[at] += density.counts[at - columns]);
        Some(density)
    }

    /// So many rectangles at least share a point with `window`.
    pub(super) fn least(&self, window: Rect) -> usize {
        let Some([left, low, right, high]) = self.within(window) else { return 0 };
        let row = |row: usize| &self.counts[row * self.columns..][left..=right];
        let most = (low..=high).flat_map(row).copied().max().unwrap_or(0);
        usize::try_from(most).unwrap_or(0)
    }

    /// The first and last columns and rows of points in `rect`, as left, low, right and high; none
    /// where it lies between points, or beyond them.
    fn within(&self, rect: Rect) -> Option<[usize; 4]> {
        let rows = self.counts.len() / self.columns;
        let (min, max) = (rect.min() - self.corner, rect.max() - self.corner);
        let first = |way: Nm| usize::try_from((way.get() + self.step - 1).div_euclid(self.step).max(0)).ok();
        let last = |way: Nm, count: usize| {
            Some(usize::try_from(way.get().div_euclid(self.step)).ok()?.min(count.checked_sub(2)?))
        };
        let found = [first(min.x)?, first(min.y)?, last(max.x, self.columns)?, last(max.y, rows)?];
        (found[0] <= found[2] && found[1] <= found[3]).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::random;

    #[test]
    fn no_more_are_counted_than_touch_a_window() {
        let mut chance = random();
        let mut rect = |room: i64, size: i64| {
            let (x, y) = (Nm::from_um(chance(room) - 3_000), Nm::from_um(chance(room) + 1_000));
            let (width, height) = (Nm::from_um(chance(size)), Nm::from_um(chance(size)));
            Rect::new(Point::new(x, y), Point::new(x + width, y + height))
        };
        let rects: Vec<Rect> = (0..MANY).map(|_| rect(20_000, 1_500)).collect();
        assert!(Density::new(&rects[1..]).is_none(), "they are few");
        let density = Density::new(&rects).expect("they are many");
        let mut crowded = 0;
        for _ in 0..300 {
            let window = rect(24_000, 1_000);
            let (least, all) =
                (density.least(window), rects.iter().filter(|rect| rect.touches(window)).count());
            assert!(least <= all, "{least} of {all} touch {window:?}");
            crowded += usize::from(least > 40);
        }
        assert!(crowded > 150, "{crowded} of 300 windows are known to be crowded");
    }
}
