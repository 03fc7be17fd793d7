//! Touches that no sheet has: a chip under the probe, a wire that slipped, a line of the log that
//! was lost.
//!
//! A sheet is smooth, so a place lies near the plane through its neighbours; how near, the rest of
//! the map says. A touch that lies farther off than that is named, one at a time, the one without
//! which its neighbourhood becomes smoothest first: it spoils the planes of its neighbours too, and
//! they are judged again without it.
//!
//! ```text
//!   ·   ·   ·   ·        off = height − plane through the up to eight neighbours
//!   ·   ┌───────┐        outlier: off > 50 µm and off > 12 × the median of the others' off
//!   ·   │ ·  ·  │·
//!   ·   └───×───┘·       at a corner three neighbours are left, whose plane scatters twice as far
//! ```

use crate::geometry::{Nm, Point};

use super::height_map::HeightMap;

/// A touch that lies off the plane of its neighbours by more than the rest scatters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outlier {
    /// Where.
    pub at: Point,
    /// How high it was touched.
    pub height: Nm,
    /// How far above the plane of its neighbours that is.
    pub off: Nm,
    /// How far the others lie off theirs: half of them no farther.
    pub scatter: Nm,
}

/// What is never called an outlier, in nanometres. Chosen: half of the depth of a usual cut.
const LEAST: f64 = 50_000.0;
/// How often the median of the others. Chosen: of a normal scatter the farthest of a hundred is 4.5
/// medians off, and at a corner twice that.
const TIMES: f64 = 12.0;
/// With fewer touches there is no telling.
const FEWEST: usize = 9;
/// How many are looked for. Chosen: with more the map is bad as a whole.
const MOST: usize = 50;

impl HeightMap {
    /// The touches that lie off their neighbours, the worst first.
    #[must_use]
    pub fn outliers(&self) -> Vec<Outlier> {
        let (columns, rows) = self.size();
        let count = columns * rows;
        let mut found = Vec::new();
        if count < FEWEST {
            return found;
        }
        let mut left_out = vec![false; count];
        let mut offs: Vec<Option<f64>> = (0..count).map(|at| self.off_plane(at, &left_out)).collect();
        while found.len() < MOST.min(count / 4) {
            let Some(at) = self.spoiler(&offs, &mut left_out) else { break };
            left_out[at] = true;
            for neighbour in self.neighbours(at) {
                offs[neighbour] = self.off_plane(neighbour, &left_out);
            }
            let off = offs[at].take().unwrap_or_default();
            let scatter = median(offs.iter().flatten().map(|off| off.abs()).collect());
            if off.abs() <= LEAST.max(TIMES * scatter) {
                break;
            }
            let (place, height) = self.crossing(at);
            found.push(Outlier { at: place, height, off: Nm::from_f64(off), scatter: Nm::from_f64(scatter) });
        }
        found
    }

    /// The place without which all others fit their planes best; none where all are near theirs.
    fn spoiler(&self, offs: &[Option<f64>], left_out: &mut [bool]) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        for (at, off) in offs.iter().enumerate() {
            let Some(off) = off.filter(|off| off.abs() > LEAST) else { continue };
            left_out[at] = true;
            let mut gain = off.abs();
            for neighbour in self.neighbours(at) {
                if let (Some(before), Some(after)) = (offs[neighbour], self.off_plane(neighbour, left_out)) {
                    gain += before.abs() - after.abs();
                }
            }
            left_out[at] = false;
            if best.is_none_or(|(most, _)| gain > most) {
                best = Some((gain, at));
            }
        }
        best.map(|(_, at)| at)
    }

    /// The up to eight crossings round one.
    fn neighbours(&self, at: usize) -> impl Iterator<Item = usize> + '_ {
        let (wide, high) = self.size();
        let (i, j) = (at % wide, at / wide);
        let rows = j.saturating_sub(1)..(j + 2).min(high);
        rows.flat_map(move |row| {
            (i.saturating_sub(1)..(i + 2).min(wide)).map(move |column| row * wide + column)
        })
        .filter(move |&other| other != at)
    }

    /// How far a crossing lies above the plane that fits its neighbours best; none where they make
    /// no plane.
    #[expect(clippy::cast_precision_loss, reason = "at most eight")]
    fn off_plane(&self, at: usize, left_out: &[bool]) -> Option<f64> {
        if left_out[at] {
            return None;
        }
        let [x, y, z] = self.touch(at);
        let near: Vec<[f64; 3]> = self
            .neighbours(at)
            .filter(|&other| !left_out[other])
            .map(|other| {
                let [a, b, c] = self.touch(other);
                [a - x, b - y, c - z]
            })
            .collect();
        let count = near.len() as f64;
        let mean = [0, 1, 2].map(|axis| near.iter().map(|point| point[axis]).sum::<f64>() / count);
        let sum = |a: usize, b: usize| -> f64 {
            near.iter().map(|point| (point[a] - mean[a]) * (point[b] - mean[b])).sum()
        };
        let (xx, xy, yy) = (sum(0, 0), sum(0, 1), sum(1, 1));
        let determinant = xx * yy - xy * xy;
        // On one line they leave the plane free to turn.
        if near.len() < 3 || determinant <= xx * yy * 1e-9 {
            return None;
        }
        let (xz, yz) = (sum(0, 2), sum(1, 2));
        let slope_x = (xz * yy - yz * xy) / determinant;
        let slope_y = (yz * xx - xz * xy) / determinant;
        Some(slope_x * mean[0] + slope_y * mean[1] - mean[2])
    }
}

/// The one in the middle; zero of none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bowed and tilted sheet, touched every 10 mm with a scatter of a few micrometres, and some
    /// places lower.
    fn sheet(columns: u32, rows: u32, wrong: &[(u32, u32, f64)]) -> HeightMap {
        let touch = |at: u32| {
            let (i, j) = (at % columns, at / columns);
            let (x, y) = (f64::from(i) * 10.0, f64::from(j) * 10.0);
            let scatter = f64::from((at * 7919 + 13) % 17) * 0.0005 - 0.004;
            let off = wrong.iter().find(|(column, row, _)| (*column, *row) == (i, j)).map_or(0.0, |w| w.2);
            [x, y, 0.0001 * (x - 30.0) * (x - 30.0) - 0.002 * y + scatter + off].map(|mm| mm * 1e6)
        };
        let points: Vec<_> = (0..columns * rows).map(touch).collect();
        HeightMap::through(&points).expect("a map")
    }

    #[test]
    fn a_smooth_sheet_has_no_outlier() {
        for (columns, rows) in [(3, 3), (7, 5), (2, 6), (12, 2), (30, 20)] {
            assert_eq!(sheet(columns, rows, &[]).outliers(), [], "{columns} by {rows}");
        }
    }

    #[test]
    fn one_touch_that_is_low_is_named_wherever_it_lies() {
        for (columns, rows) in [(3, 3), (7, 5), (2, 6)] {
            for at in 0..columns * rows {
                let (i, j) = (at % columns, at / columns);
                let found = sheet(columns, rows, &[(i, j, -2.0)]).outliers();
                let place = Point::new(Nm::from_mm(i64::from(i) * 10), Nm::from_mm(i64::from(j) * 10));
                let places: Vec<Point> = found.iter().map(|outlier| outlier.at).collect();
                assert_eq!(places, [place], "{columns} by {rows}, at {i}, {j}: {found:?}");
                let off = found[0].off.to_mm();
                assert!((-2.1..-1.9).contains(&off), "2 mm low, not {off}");
            }
        }
    }

    #[test]
    fn several_are_named_though_they_spoil_each_others_planes() {
        let wrong = [(1, 1, -1.5), (2, 1, 0.5), (5, 3, -0.2), (6, 0, 0.4)];
        let found = sheet(7, 5, &wrong).outliers();
        let mut places: Vec<(i64, i64)> =
            found.iter().map(|o| (o.at.x.get() / 10_000_000, o.at.y.get() / 10_000_000)).collect();
        places.sort_unstable();
        assert_eq!(places, [(1, 1), (2, 1), (5, 3), (6, 0)], "{found:?}");
    }

    #[test]
    fn too_few_touches_tell_nothing() {
        assert_eq!(sheet(2, 4, &[(1, 1, -2.0)]).outliers(), [], "eight");
    }
}
