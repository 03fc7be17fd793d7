//! The height of a surface, probed in a grid and bilinear in between.

use crate::geometry::{Nm, Point, Rect};

use super::error::MapError;
use super::touch::Touch;

/// The height of a crossing and the line that tells it, where it was touched.
type Touched = Option<(f64, usize)>;

/// How high the surface is, touched at the crossings of a grid of lines, bilinear in between.
///
/// ```text
///   y₁ ┼────────┼──────┼     the lines need not be equally far apart
///      │  h     │      │     beyond the outermost the surface goes on level
///   y₀ ┼────────┼──────┼
///      x₀       x₁     x₂
/// ```
///
/// # Guarantees
///
/// At least two columns and two rows, each further than the one before; no two neighbouring
/// crossings are steeper than 1 in 4.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    /// In nanometres, as all that follows.
    columns: Vec<f64>,
    rows: Vec<f64>,
    /// Row by row.
    heights: Vec<f64>,
}

/// Coordinates this near are those of one line of the grid: what a machine rounds to its steps.
/// Chosen.
const SAME: f64 = 50_000.0;
/// Touches of one place this near agree, in nanometres. Chosen: a quick touch and the slow one
/// after it differ by less.
const AGREE: f64 = 50_000.0;
/// The steepest surface. Chosen: a sheet on a bed rises by a hundredth; a quarter is inches for
/// millimetres, or a probe that slipped.
const STEEPEST: f64 = 0.25;

impl HeightMap {
    /// The surface through touched points in nanometres, in any order; of several touches of one
    /// place that agree the last holds.
    ///
    /// # Errors
    ///
    /// [`MapError`] where the points are no grid, or no sheet is like that.
    pub fn through(points: &[[f64; 3]]) -> Result<Self, MapError> {
        let touches: Vec<Touch> = (1..).zip(points).map(|(line, &place)| Touch { line, place }).collect();
        Self::touched(&touches)
    }

    /// The same, of touches that know their lines.
    pub(super) fn touched(touches: &[Touch]) -> Result<Self, MapError> {
        let is_near = |value: &f64| value.abs() <= Nm::MAX.to_f64();
        if let Some(touch) = touches.iter().find(|touch| !touch.place.iter().all(is_near)) {
            return Err(MapError::Range(touch.line));
        }
        let columns = lines(touches.iter().map(|touch| touch.place[0]).collect());
        let rows = lines(touches.iter().map(|touch| touch.place[1]).collect());
        if columns.len() < 2 || rows.len() < 2 {
            return Err(MapError::Few { columns: columns.len(), rows: rows.len() });
        }
        let mut heights: Vec<Touched> = vec![None; columns.len() * rows.len()];
        for &Touch { line, place: [x, y, z] } in touches {
            let height = &mut heights[nearest(&rows, y) * columns.len() + nearest(&columns, x)];
            if let Some((before, other)) = height.filter(|(before, _)| (z - before).abs() > AGREE) {
                let ([x, y], [first, second]) = ([x, y].map(Nm::from_f64), [before, z].map(Nm::from_f64));
                return Err(MapError::Contradicting { line, other, x, y, first, second });
            }
            *height = Some((z, line));
        }
        let missing = heights.iter().filter(|height| height.is_none()).count();
        // One that is missing is as likely as one too many.
        if missing > 1
            && let Some(beside) = beside(&columns, &rows, &heights)
        {
            return Err(beside);
        }
        if let Some(first) = heights.iter().position(Option::is_none) {
            let (x, y) = (columns[first % columns.len()], rows[first / columns.len()]);
            let (x, y) = (Nm::from_f64(x), Nm::from_f64(y));
            return Err(MapError::Missing { count: missing, columns: columns.len(), rows: rows.len(), x, y });
        }
        let map = Self {
            columns,
            rows,
            heights: heights.into_iter().flatten().map(|(height, _)| height).collect(),
        };
        map.steepest().map_or(Ok(()), Err)?;
        Ok(map)
    }

    /// The rectangle that was touched.
    #[must_use]
    pub fn area(&self) -> Rect {
        let last = |lines: &[f64]| lines[lines.len() - 1];
        Rect::new(
            Point::from_f64(self.columns[0], self.rows[0]),
            Point::from_f64(last(&self.columns), last(&self.rows)),
        )
    }

    /// How many columns and rows were touched.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.columns.len(), self.rows.len())
    }

    /// The lowest and the highest place, each a point and its height.
    #[must_use]
    pub fn extremes(&self) -> [(Point, Nm); 2] {
        let mut places = (0..self.heights.len()).map(|index| self.crossing(index));
        let first = places.next().expect("a map has crossings");
        places.fold([first; 2], |[low, high], place| {
            [if place.1 < low.1 { place } else { low }, if place.1 > high.1 { place } else { high }]
        })
    }

    /// The same surface with the height at `p` taken as zero: for a tool whose zero was set there.
    #[must_use]
    pub fn zeroed_at(mut self, p: Point) -> Self {
        let (x, y) = p.to_f64();
        let zero = self.height(x, y);
        for height in &mut self.heights {
            *height -= zero;
        }
        self
    }

    /// The height at a place, in nanometres as the place.
    pub(super) fn height(&self, x: f64, y: f64) -> f64 {
        let ((i, u), (j, v)) = (cell(&self.columns, x), cell(&self.rows, y));
        let row = |j: usize| {
            let at = j * self.columns.len() + i;
            self.heights[at] + (self.heights[at + 1] - self.heights[at]) * u
        };
        row(j) + (row(j + 1) - row(j)) * v
    }

    /// The height over a point.
    #[must_use]
    pub fn over(&self, p: Point) -> Nm {
        let (x, y) = p.to_f64();
        Nm::from_f64(self.height(x, y))
    }

    /// How much it rises at most for each unit of way: within a cell each slope lies between those
    /// of two edges.
    pub(super) fn slope(&self) -> f64 {
        let (mut x, mut y) = (0.0_f64, 0.0_f64);
        for (a, b, run) in self.edges() {
            let slope = (self.heights[b] - self.heights[a]).abs() / run;
            if b == a + 1 {
                x = x.max(slope);
            } else {
                y = y.max(slope);
            }
        }
        (x * x + y * y).sqrt()
    }

    /// Neighbouring crossings, and how far they are apart.
    fn edges(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let wide = self.columns.len();
        (0..self.heights.len()).flat_map(move |at| {
            let (i, j) = (at % wide, at / wide);
            let right = (i + 1 < wide).then(|| (at, at + 1, self.columns[i + 1] - self.columns[i]));
            let up = (j + 1 < self.rows.len()).then(|| (at, at + wide, self.rows[j + 1] - self.rows[j]));
            right.into_iter().chain(up)
        })
    }

    /// The first edge that is too steep.
    fn steepest(&self) -> Option<MapError> {
        let (a, b, run) =
            self.edges().find(|&(a, b, run)| (self.heights[b] - self.heights[a]).abs() > STEEPEST * run)?;
        let ((p, low), (_, high)) = (self.crossing(a), self.crossing(b));
        Some(MapError::Steep { rise: (high - low).abs(), run: Nm::from_f64(run), x: p.x, y: p.y })
    }

    /// Where a crossing is and how high, in nanometres.
    pub(super) fn touch(&self, index: usize) -> [f64; 3] {
        let (i, j) = (index % self.columns.len(), index / self.columns.len());
        [self.columns[i], self.rows[j], self.heights[index]]
    }

    /// The same, rounded.
    pub(super) fn crossing(&self, index: usize) -> (Point, Nm) {
        let (i, j) = (index % self.columns.len(), index / self.columns.len());
        (Point::from_f64(self.columns[i], self.rows[j]), Nm::from_f64(self.heights[index]))
    }
}

/// The lines of a grid on which coordinates lie: the middle of each bunch.
#[expect(clippy::cast_precision_loss, reason = "as many as there are touches")]
fn lines(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    let bunches = values.chunk_by(|a, b| b - a <= SAME);
    bunches.map(|bunch| bunch.iter().sum::<f64>() / bunch.len() as f64).collect()
}

fn nearest(lines: &[f64], value: f64) -> usize {
    let after = lines.partition_point(|&line| line < value).min(lines.len() - 1);
    let before = after.saturating_sub(1);
    if value - lines[before] < lines[after] - value { before } else { after }
}

/// The touch without which the others fill a grid: such is the one by which z was set to zero,
/// where the same log holds it.
///
/// ```text
///     ┼────┼────┼
///   ● ┼────┼────┼     alone in its column, in its row, or in both
/// ```
fn beside(columns: &[f64], rows: &[f64], heights: &[Touched]) -> Option<MapError> {
    let wide = columns.len();
    let touched = || heights.iter().enumerate().filter_map(|(at, height)| Some((at, (*height)?)));
    let (mut in_column, mut in_row) = (vec![0_usize; wide], vec![0_usize; rows.len()]);
    for (at, _) in touched() {
        in_column[at % wide] += 1;
        in_row[at / wide] += 1;
    }
    let others = touched().count() - 1;
    touched().find_map(|(at, (_, line))| {
        let columns_left = wide - usize::from(in_column[at % wide] == 1);
        let rows_left = rows.len() - usize::from(in_row[at / wide] == 1);
        let fills = others == columns_left * rows_left && columns_left > 1 && rows_left > 1;
        let [x, y] = [columns[at % wide], rows[at / wide]].map(Nm::from_f64);
        fills.then_some(MapError::Beside { line, x, y, columns: columns_left, rows: rows_left })
    })
}

/// Between which lines a value lies, and how far on; at the edge for what lies beyond.
fn cell(lines: &[f64], value: f64) -> (usize, f64) {
    let index = lines.partition_point(|&line| line <= value).clamp(1, lines.len() - 1) - 1;
    let fraction = (value - lines[index]) / (lines[index + 1] - lines[index]);
    (index, fraction.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MM: f64 = 1e6;

    fn saddle() -> HeightMap {
        let points = [[0.0, 0.0, 0.1], [10.0, 0.0, 0.3], [0.0, 20.0, 0.5], [10.0, 20.0, 0.1]];
        HeightMap::through(&points.map(|point| point.map(|value| value * MM))).expect("a map")
    }

    #[test]
    fn between_the_crossings_it_is_bilinear_and_beyond_them_level() {
        let map = saddle();
        for (x, y, height) in
            [(0.0, 0.0, 0.1), (5.0, 0.0, 0.2), (5.0, 10.0, 0.25), (10.0, 20.0, 0.1), (-3.0, 25.0, 0.5)]
        {
            let found = map.height(x * MM, y * MM) / MM;
            assert!((found - height).abs() < 1e-9, "at {x}, {y} it is {found}, not {height}");
        }
    }

    #[test]
    fn no_way_on_it_is_steeper_than_it_says() {
        let map = saddle();
        let slope = map.slope();
        let ends = [(0.0, 0.0), (9.9, 19.8), (3.0, 17.0), (10.0, 0.0)];
        for (a, b) in ends.iter().zip(ends.iter().skip(1)) {
            let rise = (map.height(a.0 * MM, a.1 * MM) - map.height(b.0 * MM, b.1 * MM)).abs();
            let (dx, dy) = ((a.0 - b.0) * MM, (a.1 - b.1) * MM);
            let run = (dx * dx + dy * dy).sqrt();
            assert!(rise <= slope * run, "{rise} within {run} is steeper than {slope}");
        }
    }

    #[test]
    fn touches_a_few_steps_beside_their_line_are_on_it() {
        let points = [[0.0, 0.001, 0.0], [10.0, 0.0, 0.0], [0.002, 9.999, 0.0], [9.998, 10.0, 0.2]];
        let map = HeightMap::through(&points.map(|point| point.map(|value| value * MM))).expect("a map");
        assert_eq!(map.size(), (2, 2), "four touches, two lines each way");
    }

    #[test]
    fn what_is_no_sheet_is_refused() {
        let map = |points: &[[f64; 3]]| {
            let points: Vec<_> = points.iter().map(|point| point.map(|value| value * MM)).collect();
            HeightMap::through(&points).expect_err("no sheet")
        };
        let hole = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0]];
        assert!(matches!(map(&hole), MapError::Missing { count: 1, .. }), "a crossing is missing");
        let row = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0]];
        assert!(matches!(map(&row), MapError::Few { columns: 2, rows: 1 }), "a row is no surface");
        let cliff = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]];
        assert!(matches!(map(&cliff), MapError::Steep { .. }), "a cliff");
        for far in [f64::INFINITY, f64::NAN, -1e30] {
            let square = [[0.0, 0.0, far], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
            assert!(matches!(map(&square), MapError::Range(_)), "a height of {far}");
        }
    }
}
