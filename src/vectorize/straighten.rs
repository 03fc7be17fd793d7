//! Few straight lines for a contour of many points: staircases vanish, corners stay.
//!
//! From each corner the contour is followed as long as a line may leave no point by more than the
//! tolerance (a window of directions that every point narrows, Williams 1978), and then back to
//! where the line that fits best, by least squares, does so. The corner moves to where two of these
//! lines meet, unless that is farther than a pixel. The tolerance is what the pixels leave open:
//! half a pixel where they are black or white, less where greys tell more.

type Place = (f64, f64);

/// How far the middle of a line's points may lie beside their ends, on average, in pixels: a curve
/// bows to one side, a staircase to both. Chosen.
const BOW: f64 = 0.12;

/// How far a corner may move, in pixels: along lines that nearly run alike, three times as far.
/// Chosen.
const REACH: f64 = 1.0;

/// A closed line with few corners that leaves that through `points` by little more than
/// `tolerance`; as it was where it is too small to have fewer.
#[must_use]
pub fn straighten(points: &[Place], tolerance: f64) -> Vec<Place> {
    if points.len() < 8 {
        return points.to_vec();
    }
    let start = sharpest(points);
    let ring: Vec<Place> = points[start..].iter().chain(&points[..start]).copied().collect();
    let corners = corners(&ring, tolerance, BOW);
    if corners.len() < 3 {
        return points.to_vec();
    }
    let ends = corners.iter().copied().zip(corners.iter().copied().skip(1).chain([ring.len()]));
    let lines: Vec<Line> = ends.map(|(from, to)| Line::fit(&ring, from, to)).collect();
    let moved = |at: usize| {
        let before = &lines[(at + lines.len() - 1) % lines.len()];
        meet(before, &lines[at], ring[corners[at]])
    };
    (0..corners.len()).map(moved).collect()
}

/// A straight piece of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The direction of the line that fits its points best, of length one; x to the right, y down.
    pub way: Place,
    /// How long it is, in pixels.
    pub length: f64,
}

/// The straight pieces of a closed line through `points`, each within `tolerance` of them, whether
/// they bow or not.
///
/// Where a staircase has few steps, each of which is a bow, nothing is to be cut at a step: what is
/// left between steps runs along the pixels.
#[must_use]
pub fn edges(points: &[Place], tolerance: f64) -> Vec<Edge> {
    /// Points at either end that may be of a bend. Chosen.
    const BEND: usize = 4;
    if points.len() < 8 {
        return Vec::new();
    }
    let start = sharpest(points);
    let ring: Vec<Place> = points[start..].iter().chain(&points[..start]).copied().collect();
    let corners = corners(&ring, tolerance, tolerance);
    let ends = corners.iter().copied().zip(corners.iter().copied().skip(1).chain([ring.len()]));
    let edge = |(from, to): (usize, usize)| {
        let (a, b) = (ring[from], ring[to % ring.len()]);
        let length = libm::hypot(b.0 - a.0, b.1 - a.1);
        // Where it bends at its ends is none of it.
        let trimmed = if to - from > 4 * BEND { (from + BEND, to - BEND) } else { (from, to) };
        Edge { way: Line::fit(&ring, trimmed.0, trimmed.1).way, length }
    };
    ends.map(edge).collect()
}

/// The point at which the contour turns most: a corner, where it has one.
fn sharpest(points: &[Place]) -> usize {
    /// Points to either side between which a turn is seen. Chosen.
    const SPAN: usize = 4;
    let count = points.len();
    let turn = |at: usize| {
        let (a, b, c) = (points[(at + count - SPAN) % count], points[at], points[(at + SPAN) % count]);
        let (ux, uy, vx, vy) = (b.0 - a.0, b.1 - a.1, c.0 - b.0, c.1 - b.1);
        (ux * vy - uy * vx).abs() - (ux * vx + uy * vy)
    };
    (0..count).max_by(|&a, &b| turn(a).total_cmp(&turn(b)).then(b.cmp(&a))).unwrap_or(0)
}

/// Where the ring turns, beginning with its first point: indices.
fn corners(ring: &[Place], tolerance: f64, bow: f64) -> Vec<usize> {
    let mut corners = vec![0];
    let mut from = 0;
    // The point that a line begins at may itself be off by the tolerance, to the other side.
    while let Some(to) = farthest(ring, from, tolerance * 2.0) {
        let to = fitting(ring, from, to, (tolerance, bow));
        if to >= ring.len() {
            break;
        }
        corners.push(to);
        from = to;
    }
    corners
}

/// The last point up to `to` that a fitted line from `from` reaches within the tolerance, found by
/// halving.
fn fitting(ring: &[Place], from: usize, to: usize, (tolerance, bow): (f64, f64)) -> usize {
    let fits = |to: usize| {
        let line = Line::fit(ring, from, to);
        let off = |at: usize| line.off(ring[at % ring.len()]);
        let mean = |range: std::ops::Range<usize>| {
            let count = range.clone().map(|_| 1.0).sum::<f64>();
            range.map(off).sum::<f64>() / f64::max(count, 1.0)
        };
        let third = (to - from) / 3;
        let middle = mean(from + third..to - third);
        let outer = f64::midpoint(mean(from..from + third), mean(to - third..to));
        (from + 1..to).all(|at| off(at).abs() <= tolerance) && (middle - outer).abs() <= bow
    };
    if fits(to) {
        return to;
    }
    let (mut good, mut bad) = (from + 1, to);
    while bad - good > 1 {
        let middle = usize::midpoint(good, bad);
        if fits(middle) { good = middle } else { bad = middle }
    }
    good
}

/// The last point that a line from `from` reaches, past none of the others by more than
/// `tolerance`; the ring's length stands for its first point.
fn farthest(ring: &[Place], from: usize, tolerance: f64) -> Option<usize> {
    let (x0, y0) = ring[from];
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut first: Option<f64> = None;
    let (mut reached, mut longest) = (from + 1, 0.0_f64);
    for to in from + 1..=ring.len() {
        let (x, y) = ring[to % ring.len()];
        let (dx, dy) = (x - x0, y - y0);
        let distance = (dx * dx + dy * dy).sqrt();
        // There and back again is no line.
        if distance < longest - 1.0 {
            break;
        }
        longest = longest.max(distance);
        if distance <= tolerance {
            reached = to;
            continue;
        }
        let angle = libm::atan2(dy, dx);
        let base = *first.get_or_insert(angle);
        let off = turned(angle - base);
        if off < low || off > high {
            // The point itself is past the window: a later one may be within, but seldom is.
            if off < low - 0.5 || off > high + 0.5 {
                break;
            }
        } else {
            reached = to;
        }
        let spread = libm::asin((tolerance / distance).min(1.0));
        (low, high) = (low.max(off - spread), high.min(off + spread));
        if low > high {
            break;
        }
    }
    (from < ring.len()).then_some(reached)
}

/// An angle within half a turn.
fn turned(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    if angle > PI {
        angle - TAU
    } else if angle < -PI {
        angle + TAU
    } else {
        angle
    }
}

/// A line through the middle of some points.
struct Line {
    middle: Place,
    way: Place,
}

impl Line {
    /// The line that fits the points from `from` to `to` best, without those near its ends, where
    /// corners are cut off.
    fn fit(ring: &[Place], from: usize, to: usize) -> Self {
        let inner = if to - from > 5 { from + 2..=to - 2 } else { from..=to };
        let points = inner.map(|at| ring[at % ring.len()]);
        let count = points.clone().map(|_| 1.0).sum::<f64>();
        let sum = points.clone().fold((0.0, 0.0), |sum, p| (sum.0 + p.0, sum.1 + p.1));
        let middle = (sum.0 / count, sum.1 / count);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (x, y) in points {
            let (dx, dy) = (x - middle.0, y - middle.1);
            (xx, xy, yy) = (xx + dx * dx, xy + dx * dy, yy + dy * dy);
        }
        let angle = libm::atan2(2.0 * xy, xx - yy) / 2.0;
        let (sin, cos) = libm::sincos(angle);
        Self { middle, way: (cos, sin) }
    }

    /// How far `p` is to one side of the line.
    fn off(&self, p: Place) -> f64 {
        (p.0 - self.middle.0) * self.way.1 - (p.1 - self.middle.1) * self.way.0
    }

    /// The place of the line nearest to `p`.
    fn nearest(&self, p: Place) -> Place {
        let along = (p.0 - self.middle.0) * self.way.0 + (p.1 - self.middle.1) * self.way.1;
        (self.middle.0 + self.way.0 * along, self.middle.1 + self.way.1 * along)
    }
}

/// Where two lines meet, if that is near `corner` and they do not run alike; else between them.
fn meet(a: &Line, b: &Line, corner: Place) -> Place {
    let cross = a.way.0 * b.way.1 - a.way.1 * b.way.0;
    let between = || {
        let (p, q) = (a.nearest(corner), b.nearest(corner));
        let middle = (f64::midpoint(p.0, q.0), f64::midpoint(p.1, q.1));
        if is_near(middle, corner, REACH) { middle } else { corner }
    };
    if cross.abs() < 0.02 {
        return between();
    }
    let (dx, dy) = (b.middle.0 - a.middle.0, b.middle.1 - a.middle.1);
    let along = (dx * b.way.1 - dy * b.way.0) / cross;
    let met = (a.middle.0 + a.way.0 * along, a.middle.1 + a.way.1 * along);
    let reach = REACH / cross.abs().max(1.0 / 3.0);
    if is_near(met, corner, reach) { met } else { between() }
}

fn is_near(p: Place, q: Place, reach: f64) -> bool {
    let (dx, dy) = (p.0 - q.0, p.1 - q.1);
    dx * dx + dy * dy <= reach * reach
}

#[cfg(test)]
mod tests {
    use super::super::{Field, Inside, contours};
    use super::*;

    /// The contour of what `holds` of a picture of 100 × 100 pixels, straightened.
    fn drawn(holds: impl Fn(f64, f64) -> bool) -> Vec<Place> {
        let place = |at: u32| f64::from(at) + 0.5;
        let sample = |at: u32| if holds(place(at % 100), place(at / 100)) { u16::MAX } else { 0 };
        let field = Field::new(100, (0..10_000).map(sample).collect()).expect("a picture");
        let found = contours(&field, Inside::new(1 << 15, true, 0), 10_000).expect("few points");
        assert_eq!(found.len(), 1, "one piece");
        straighten(&found[0].points, 0.51)
    }

    #[test]
    fn a_slanted_square_has_four_corners_where_they_were() {
        let (sin, cos) = libm::sincos(0.3);
        let square = drawn(|x, y| {
            let (dx, dy) = (x - 50.0, y - 50.0);
            (dx * cos + dy * sin).abs() < 30.0 && (dy * cos - dx * sin).abs() < 30.0
        });
        assert!(square.len() <= 6, "staircases are gone: {square:?}");
        for (u, v) in [(30.0, 30.0), (-30.0, 30.0), (-30.0, -30.0), (30.0, -30.0)] {
            let corner = (50.0 + u * cos - v * sin, 50.0 + u * sin + v * cos);
            let near = square.iter().map(|p| libm::hypot(p.0 - corner.0, p.1 - corner.1));
            let off = near.fold(f64::INFINITY, f64::min);
            assert!(off < 0.4, "{corner:?} is {off} pixels off: {square:?}");
        }
    }

    #[test]
    fn a_flat_between_two_rounds_stays_where_it_is() {
        // An obround: 18.4 pixels wide round a line of 31 pixels.
        let off = |x: f64, y: f64| libm::hypot((x - 50.2).abs() - (x - 50.2).abs().min(15.5), y - 50.3) - 9.2;
        let few = drawn(|x, y| off(x, y) < 0.0);
        assert!(few.len() < 40, "few lines: {}", few.len());
        let ends = few.iter().zip(few.iter().cycle().skip(1));
        let places = ends.flat_map(|(a, b)| {
            (0..20).map(move |step| {
                let part = f64::from(step) / 20.0;
                (a.0 + (b.0 - a.0) * part, a.1 + (b.1 - a.1) * part)
            })
        });
        let offs: Vec<f64> = places.map(|(x, y)| off(x, y).abs()).collect();
        let worst = offs.iter().copied().fold(0.0, f64::max);
        assert!(worst < 0.8, "half a pixel of sampling, and a little more: {worst}");
    }

    #[test]
    fn a_line_as_thin_as_a_pixel_is_not_lost() {
        let line = drawn(|x, y| (20.0..80.0).contains(&x) && (50.0..51.0).contains(&y));
        let ends = line.iter().zip(line.iter().cycle().skip(1));
        let area = ends.map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum::<f64>().abs() / 2.0;
        assert!((55.0..61.0).contains(&area), "sixty pixels: {area}, {line:?}");
    }
}
