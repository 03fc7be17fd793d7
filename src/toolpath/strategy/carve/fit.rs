//! Few lines and arcs, rising and falling evenly, within a tolerance of the course of a tip.
//!
//! ```text
//!   what the tip mills is off by      │→ across       Off sideways by a, one flank of the groove is off by a and the other by −a; too
//!   across + deep · flank at most     ↓ deep          deep by d, both are off by d · flank: so the two are added up.
//! ```
//!
//! Greedy as [`fit_points`](crate::voronoi::fit_points) is: the longest line or arc, found by
//! doubling and halving, and an arc only where it reaches half as far again as a line.

use crate::geometry::{Nm, Path, Point, Segment, Turn, part_nearest};

use super::clip::{Tip, between};

/// Arcs outside these radii are left to lines. Chosen: smaller ones are noise, larger ones
/// straight.
const RADII: std::ops::Range<f64> = 5_000.0..2e8;

/// How far what is milled at the surface may be off, in nanometres, and what rounding takes of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub(super) tolerance: f64,
    /// How much wider the tool cuts on either side for each unit of depth.
    pub(super) flank: f64,
}

impl Fit {
    /// A path with the depth at its start and at the end of each segment; none for less than two
    /// places.
    pub(super) fn path(&self, tips: &[Tip]) -> Option<(Path, Vec<Nm>)> {
        let first = tips.first()?;
        let mut path = Path { start: point(first.at), segments: Vec::new() };
        let mut depths = vec![Nm::from_f64(first.depth)];
        let mut i = 0;
        while i + 1 < tips.len() {
            let (j, segment) = self.longest(tips, i);
            i = j;
            let depth = Nm::from_f64(tips[i].depth);
            if segment.to() != path.end() || depths.last() != Some(&depth) {
                path.segments.push(segment);
                depths.push(depth);
            }
        }
        (!path.segments.is_empty()).then_some((path, depths))
    }

    fn longest(&self, tips: &[Tip], i: usize) -> (usize, Segment) {
        let last = tips.len() - 1;
        let line = farthest(i + 1, last, |j| self.is_line(&tips[i..=j]));
        let straight = Segment::Line { to: point(tips[line].at) };
        if line == last {
            return (line, straight);
        }
        let arc = farthest((i + 2).min(last), last, |j| self.arc(&tips[i..=j]).is_some());
        let reach = |j: usize| distance(tips[i].at, tips[j].at);
        match self.arc(&tips[i..=arc]) {
            Some(segment) if arc > line && reach(arc) > 1.5 * reach(line) => (arc, segment),
            _ => (line, straight),
        }
    }

    /// Whether the groove at a place is near enough to that at another.
    fn is_near(&self, a: Tip, b: Tip) -> bool {
        distance(a.at, b.at) + (a.depth - b.depth).abs() * self.flank <= self.tolerance
    }

    /// Whether all places lie on the line from the first to the last.
    fn is_line(&self, tips: &[Tip]) -> bool {
        let (a, b) = (tips[0], tips[tips.len() - 1]);
        tips.iter().all(|&p| self.is_near(p, between(a, b, part_nearest(p.at, a.at, b.at))))
    }

    /// The arc from the first place to the last, if all lie on it.
    fn arc(&self, tips: &[Tip]) -> Option<Segment> {
        let (a, m, b) = (*tips.first()?, tips[tips.len() / 2], *tips.last()?);
        let center = point(circle(a.at, m.at, b.at)?);
        let from = |at: (f64, f64)| (at.0 - center.x.to_f64(), at.1 - center.y.to_f64());
        let (u, v) = (from(a.at), from(b.at));
        let radius = f64::midpoint(length(u), length(v));
        let turn = cross(u, from(m.at)).signum();
        if !RADII.contains(&radius) || cross(u, v) * turn <= 0.0 {
            return None;
        }
        let whole = angle(u, v);
        let mut gone = -1.0;
        for pair in tips.windows(2) {
            for p in [between(pair[0], pair[1], 0.5), pair[1]] {
                let w = from(p.at);
                let part = if cross(u, w) * turn < 0.0 { return None } else { angle(u, w) / whole };
                let deep = (p.depth - (a.depth + (b.depth - a.depth) * part)).abs() * self.flank;
                // What lies behind the place before is no arc.
                if part < gone || part > 1.0 + 1e-9 || (length(w) - radius).abs() + deep > self.tolerance {
                    return None;
                }
                gone = part;
            }
        }
        let turn = if turn > 0.0 { Turn::CounterClockwise } else { Turn::Clockwise };
        Some(Segment::Arc { to: point(b.at), center, turn })
    }
}

fn point((x, y): (f64, f64)) -> Point {
    Point::from_f64(x, y)
}

fn length((x, y): (f64, f64)) -> f64 {
    (x * x + y * y).sqrt()
}

fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
    length((a.0 - b.0, a.1 - b.1))
}

fn cross(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.1 - a.1 * b.0
}

/// The angle between two directions, without its sign.
fn angle(a: (f64, f64), b: (f64, f64)) -> f64 {
    libm::atan2(cross(a, b).abs(), a.0 * b.0 + a.1 * b.1)
}

/// The largest j in `least..=most` up to which `holds` is seen to hold, by doubling and then
/// halving; at least `least`.
fn farthest(least: usize, most: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut good, mut step) = (least, 1);
    let mut bad = most + 1;
    while good + step <= most {
        if !holds(good + step) {
            bad = good + step;
            break;
        }
        good += step;
        step *= 2;
    }
    while good + 1 < bad {
        let middle = usize::midpoint(good, bad);
        if holds(middle) { good = middle } else { bad = middle }
    }
    good
}

/// The centre of the circle through three points; none where they lie on a line.
fn circle(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> Option<(f64, f64)> {
    let (u, v) = ((b.0 - a.0, b.1 - a.1), (c.0 - a.0, c.1 - a.1));
    let twice = 2.0 * cross(u, v);
    if twice.abs() < 1.0 {
        return None;
    }
    let (uu, vv) = (u.0 * u.0 + u.1 * u.1, v.0 * v.0 + v.1 * v.1);
    Some((a.0 + (v.1 * uu - u.1 * vv) / twice, a.1 + (u.0 * vv - v.0 * uu) / twice))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIT: Fit = Fit { tolerance: 1_000.0, flank: 0.5 };

    fn tip(x: f64, y: f64, depth: f64) -> Tip {
        Tip { at: (x, y), depth }
    }

    #[test]
    fn a_bend_in_the_depth_alone_is_kept() {
        let straight: Vec<Tip> = (0..=20_i32).map(|i| tip(f64::from(i) * 1e5, 0.0, 2e5)).collect();
        let bent: Vec<Tip> = (0..=20_i32)
            .map(|i| tip(f64::from(i) * 1e5, 0.0, 2e5 + 5e4 * f64::from((i - 10).abs())))
            .collect();
        assert_eq!(FIT.path(&straight).expect("a path").0.segments.len(), 1, "level");
        let (path, depths) = FIT.path(&bent).expect("a path");
        assert_eq!((path.segments.len(), depths[1]), (2, Nm::new(200_000)), "up to the middle, and down");
    }

    #[test]
    fn a_helix_is_one_arc_and_one_that_rises_unevenly_is_none() {
        let on_circle = |depth: fn(f64) -> f64| -> Vec<Tip> {
            let place = |i: i32| {
                let (sin, cos) = libm::sincos(f64::from(i) * 0.02);
                tip(1e6 * cos, 1e6 * sin, depth(f64::from(i)))
            };
            (0..=60).map(place).collect()
        };
        let even = FIT.path(&on_circle(|i| 1e5 + 1e3 * i)).expect("a path").0;
        assert_eq!(even.segments.len(), 1, "{even:?}");
        let uneven = FIT.path(&on_circle(|i| 1e5 + 50.0 * i * i)).expect("a path").0;
        assert!(uneven.segments.len() > 2, "{uneven:?}");
    }
}
