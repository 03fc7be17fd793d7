//! A staircase as the fewest straight segments, in the manner of Potrace (the paper's reference 9).
//!
//! From a corner, look at each next corner of the path through a window of a pixel round it. As
//! long as one line of sight passes all the windows, a segment may run from the first corner to the
//! last one. Of all ways to walk the path in such segments, one with the fewest is taken, and of
//! those the one that hugs the corners best: the least sum of each segment's length times the root
//! mean square distance of its corners. The ends of a path stay; what lies between may be left out
//! even where another path ends, which then hangs loose.

use super::paths::Corner;

/// The corners of `path` that the fewest segments need.
pub(super) fn simplify(path: &[Corner]) -> Vec<Corner> {
    let sums = Sums::new(path);
    let mut best: Vec<Option<Reached>> = vec![None; path.len()];
    best[0] = Some(Reached { segments: 0, penalty: 0.0, from: 0 });
    for i in 0..path.len() - 1 {
        let Some(here) = best[i] else { continue };
        let reach = farthest(path, i);
        for (j, known) in best.iter_mut().enumerate().take(reach + 1).skip(i + 1) {
            let penalty = here.penalty + sums.penalty(i, j);
            let offer = Reached { segments: here.segments + 1, penalty, from: i };
            if known.is_none_or(|known| offer.is_better(&known)) {
                *known = Some(offer);
            }
        }
    }
    let mut corners = vec![path[path.len() - 1]];
    let mut at = path.len() - 1;
    while let Some(reached) = best[at].filter(|_| at > 0) {
        at = reached.from;
        corners.push(path[at]);
    }
    corners.reverse();
    corners
}

/// How a corner was reached.
#[derive(Clone, Copy)]
struct Reached {
    segments: u32,
    penalty: f64,
    from: usize,
}

impl Reached {
    fn is_better(&self, other: &Self) -> bool {
        (self.segments, self.penalty) < (other.segments, other.penalty)
    }
}

/// The last corner that is seen from corner `i` through the windows of all between.
fn farthest(path: &[Corner], i: usize) -> usize {
    let mut sight: Option<Sector> = None;
    for (j, &corner) in path.iter().enumerate().skip(i + 1) {
        let Some(window) = Sector::of((corner.0 - path[i].0, corner.1 - path[i].1)) else { continue };
        let Some(narrowed) = sight.map_or(Some(window), |sight| sight.and(window)) else { return j - 1 };
        sight = Some(narrowed);
    }
    path.len() - 1
}

type Vector = (i64, i64);

const fn cross(a: Vector, b: Vector) -> i64 {
    a.0 * b.1 - a.1 * b.0
}

/// The directions between two others, less than half a turn: from `low` counter-clockwise to
/// `high`.
#[derive(Clone, Copy)]
struct Sector {
    low: Vector,
    high: Vector,
}

impl Sector {
    /// The directions in which the square of a pixel round a corner is seen from the origin; none
    /// where it surrounds it.
    fn of((x, y): (i32, i32)) -> Option<Self> {
        if x == 0 && y == 0 {
            return None;
        }
        // In half pixels, so that the square's corners are whole.
        let (x, y) = (i64::from(x) * 2, i64::from(y) * 2);
        let corners = [(x - 1, y - 1), (x + 1, y - 1), (x + 1, y + 1), (x - 1, y + 1)];
        let extreme = |turn: i64| {
            corners
                .into_iter()
                .reduce(|most, corner| if cross(most, corner) * turn > 0 { corner } else { most })
        };
        Some(Self { low: extreme(-1)?, high: extreme(1)? })
    }

    /// The directions in both; none where there are none.
    fn and(self, other: Self) -> Option<Self> {
        let holds = |sector: Self, v: Vector| cross(sector.low, v) >= 0 && cross(v, sector.high) >= 0;
        let low = if holds(self, other.low) { other.low } else { self.low };
        let high = if holds(self, other.high) { other.high } else { self.high };
        let both = Self { low, high };
        let valid = |v: Vector| holds(self, v) && holds(other, v);
        (valid(low) && valid(high) && cross(low, high) >= 0).then_some(both)
    }
}

/// Sums over the first corners of a path, for the mean square distance of any run of them from a
/// chord.
struct Sums<'a> {
    path: &'a [Corner],
    /// x, y, x², x y, y² of all corners before.
    sums: Vec<[f64; 5]>,
}

impl<'a> Sums<'a> {
    fn new(path: &'a [Corner]) -> Self {
        let mut sum = [0.0; 5];
        let mut sums = vec![sum];
        for &corner in path {
            let (x, y) = Self::relative(path, corner);
            for (sum, term) in sum.iter_mut().zip([x, y, x * x, x * y, y * y]) {
                *sum += term;
            }
            sums.push(sum);
        }
        Self { path, sums }
    }

    fn relative(path: &[Corner], corner: Corner) -> (f64, f64) {
        (f64::from(corner.0 - path[0].0), f64::from(corner.1 - path[0].1))
    }

    /// Potrace's penalty of the segment from corner `i` to corner `j`: its length times the root
    /// mean square distance of the corners from `i` to `j` to the line through its middle.
    #[expect(clippy::cast_precision_loss, reason = "paths have few corners")]
    fn penalty(&self, i: usize, j: usize) -> f64 {
        let n = (j - i + 1) as f64;
        let mut sum = [0.0; 5];
        for (sum, (above, below)) in sum.iter_mut().zip(self.sums[j + 1].iter().zip(&self.sums[i])) {
            *sum = above - below;
        }
        let [x, y, xx, xy, yy] = sum;
        let ((x0, y0), (x1, y1)) =
            (Self::relative(self.path, self.path[i]), Self::relative(self.path, self.path[j]));
        let (px, py) = (f64::midpoint(x0, x1), f64::midpoint(y0, y1));
        let (ex, ey) = (-(y1 - y0), x1 - x0);
        let a = (xx - 2.0 * x * px) / n + px * px;
        let b = (xy - x * py - y * px) / n + px * py;
        let c = (yy - 2.0 * y * py) / n + py * py;
        (ex * ex * a + 2.0 * ex * ey * b + ey * ey * c).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_run_is_one_segment() {
        let path: Vec<Corner> = (0..50).map(|x| (x, 0)).collect();
        assert_eq!(simplify(&path), [(0, 0), (49, 0)], "its ends");
    }

    #[test]
    fn a_diagonal_staircase_is_one_segment() {
        let path: Vec<Corner> = (0..60).map(|i| ((i + 1) / 2, i / 2)).collect();
        assert_eq!(simplify(&path).len(), 2, "within half a pixel of a line");
    }

    #[test]
    fn a_corner_needs_two() {
        let path: Vec<Corner> = (0..20).map(|x| (x, 0)).chain((1..20).map(|y| (19, y))).collect();
        let found = simplify(&path);
        assert_eq!(found.len(), 3, "{found:?}");
        assert!((found[1].0 - 19).abs() <= 1 && found[1].1 <= 1, "at the corner: {found:?}");
    }
}
