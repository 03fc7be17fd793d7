//! Where a cut must be split to follow a surface.

use crate::geometry::{self, Arc, Nm, Point, Rect};

use super::height_map::HeightMap;

/// A way over the surface, from 0 at its start to 1 at its end.
#[derive(Clone, Copy, Debug)]
pub(super) enum Course {
    /// Straight.
    Line {
        /// Where it begins.
        from: Point,
        /// Where it ends.
        to: Point,
    },
    /// Round a centre.
    Arc(Arc),
}

impl Course {
    /// The rectangle that holds it.
    pub(super) fn bounds(&self) -> Rect {
        match self {
            Self::Line { from, to } => Rect::new(*from, *to),
            Self::Arc(arc) => arc.bounds(),
        }
    }

    /// The place at `fraction` of the way.
    pub(super) fn at(&self, fraction: f64) -> (f64, f64) {
        match self {
            Self::Line { from, to } => geometry::between(from.to_f64(), to.to_f64(), fraction),
            Self::Arc(arc) => arc.at(fraction),
        }
    }

    fn length(&self) -> f64 {
        match self {
            Self::Line { from, to } => from.distance(*to),
            Self::Arc(arc) => arc.length(),
        }
    }

    /// The fractions at which it must be split so that, going evenly up or down between them, it is
    /// nowhere more than `tolerance` above or below a constant depth; ends with 1.
    ///
    /// The surface is looked at so often that it cannot leave its chords by a fifth of the
    /// tolerance between two looks: it rises by `slope` at most. What is left of the tolerance is
    /// for the pieces.
    ///
    /// D. H. Douglas, T. K. Peucker, *Algorithms for the reduction of the number of points required
    /// to represent a digitized line or its caricature*, The Canadian Cartographer 10, 1973.
    pub(super) fn splits(&self, map: &HeightMap, slope: f64, tolerance: Nm) -> Vec<f64> {
        let tolerance = tolerance.to_f64();
        let looks = count(self.length() * slope * 5.0 / tolerance);
        let fraction = |look: usize| ratio(look, looks);
        let heights: Vec<f64> = (0..=looks)
            .map(|look| {
                let (x, y) = self.at(fraction(look));
                map.height(x, y)
            })
            .collect();
        simplify(&heights, tolerance * 0.8).into_iter().map(fraction).collect()
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative, and `as` saturates"
)]
fn count(looks: f64) -> usize {
    (looks.ceil() as usize).clamp(1, 1 << 24)
}

#[expect(clippy::cast_precision_loss, reason = "at most 2²⁴")]
fn ratio(part: usize, whole: usize) -> f64 {
    part as f64 / whole as f64
}

/// The indices of the values that are to be kept, so that straight lines between them stay within
/// `tolerance` of all; without the first.
fn simplify(values: &[f64], tolerance: f64) -> Vec<usize> {
    let mut kept = Vec::new();
    let mut open = vec![(0, values.len() - 1)];
    while let Some((from, to)) = open.pop() {
        let line = |at: usize| values[from] + (values[to] - values[from]) * ratio(at - from, to - from);
        let off = |at: usize| (values[at] - line(at)).abs();
        let worst = (from + 1..to).max_by(|&a, &b| off(a).total_cmp(&off(b)).then(b.cmp(&a)));
        match worst.filter(|&at| off(at) > tolerance) {
            Some(at) => open.extend([(at, to), (from, at)]),
            None => kept.push(to),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_values_need_no_point_between_and_a_bend_needs_one() {
        assert_eq!(simplify(&[0.0, 1.0, 2.0, 3.0], 0.1), [3], "a straight line");
        assert_eq!(simplify(&[0.0, 2.0, 1.0, 0.0, -1.0], 0.1), [1, 4], "up and down");
    }
}
