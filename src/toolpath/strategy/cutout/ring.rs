//! A closed path by the distance along it: where tabs begin and end.

use std::f64::consts::TAU;

use crate::geometry::{Nm, Path, Point, Segment};

/// Less of a segment, in nanometres, is nothing where both its ends are one point. Chosen: below
/// what programs write.
const NOTHING: f64 = 1_000.0;

/// A closed way, by the distance along it from its start, in nanometres.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    path: Path,
    /// The distance at which each segment begins, then the whole length.
    distances: Vec<f64>,
    /// How far the way has turned, in radians either way, before the corner at each of these
    /// distances, and after it.
    turned: Vec<(f64, f64)>,
}

impl Ring {
    /// A closed path.
    pub(super) fn new(path: Path) -> Self {
        let mut distances = vec![0.0];
        let mut turned = Vec::with_capacity(path.segments.len() + 1);
        let mut sum = 0.0;
        let headings: Vec<[(f64, f64); 2]> =
            path.steps().map(|(from, segment)| headings(from, segment)).collect();
        let mut before = headings.last().map_or((1.0, 0.0), |last| last[1]);
        let mut turn = 0.0;
        for ((from, segment), heading) in path.steps().zip(&headings) {
            let corner = angle(before, heading[0]);
            turned.push((turn, turn + corner));
            turn += corner + segment.arc(from).map_or(0.0, |arc| arc.sweep().abs());
            sum += segment.length(from);
            distances.push(sum);
            before = heading[1];
        }
        turned.push((turn, turn));
        Self { path, distances, turned }
    }

    pub(super) const fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn length(&self) -> f64 {
        self.distances[self.path.segments.len()]
    }

    /// Where its segments begin.
    pub(super) fn corners(&self) -> impl Iterator<Item = f64> {
        self.distances[..self.path.segments.len()].iter().copied()
    }

    /// How far the way turns, in radians either way, within `reach` before and after the place at
    /// `distance`; corners at the very ends count.
    pub(super) fn turn_around(&self, distance: f64, reach: f64) -> f64 {
        self.turned_by(distance + reach, true) - self.turned_by(distance - reach, false)
    }

    /// How far the way has turned at `distance`, which may lie a lap off; a corner just there
    /// counts if it is `passed`.
    fn turned_by(&self, distance: f64, passed: bool) -> f64 {
        let (length, last) = (self.length(), self.path.segments.len());
        let lap = (distance / length).floor();
        let within = distance - lap * length;
        let next =
            self.distances.partition_point(|&begin| if passed { begin <= within } else { begin < within });
        let whole = self.turned[last].0 * lap;
        let Some(i) = next.checked_sub(1).filter(|&i| i < last) else {
            return whole + if next == 0 { 0.0 } else { self.turned[last].0 };
        };
        let share = (within - self.distances[i]) / (self.distances[i + 1] - self.distances[i]).max(1.0);
        let (begin, end) = (self.turned[i].1, self.turned[i + 1].0);
        whole + begin + (end - begin) * share.clamp(0.0, 1.0)
    }

    /// The point at `distance`.
    pub(super) fn at(&self, distance: f64) -> Point {
        let i = self.segment_at(distance);
        let (from, segment) = self.path.steps().nth(i).expect("a segment of the ring");
        let length = self.distances[i + 1] - self.distances[i];
        segment.at(from, (distance - self.distances[i]) / length.max(1.0))
    }

    fn segment_at(&self, distance: f64) -> usize {
        self.distances.partition_point(|&begin| begin <= distance).clamp(1, self.path.segments.len()) - 1
    }

    /// The way from one distance to a later one; an arc of no length would be cut as a full circle.
    pub(super) fn between(&self, from: f64, to: f64) -> Path {
        let (first, last) = (self.segment_at(from), self.segment_at(to));
        let start = self.at(from);
        let mut segments = self.path.segments[first..=last].to_vec();
        let end = if to >= self.length() { self.path.start } else { self.at(to) };
        if let Some(segment) = segments.last_mut() {
            *segment = segment.ending(end);
        }
        let mut way = Path { start, segments };
        // What is left of a segment may be nothing.
        if way.segments.len() > 1 && way.segments[0].to() == start {
            way.segments.remove(0);
        }
        let before_last = way.segments.len().checked_sub(2).map_or(start, |i| way.segments[i].to());
        if before_last == end && to - self.distances[last].max(from) < NOTHING {
            way.segments.pop();
        }
        way
    }

    /// The same ring begun at `distance`.
    pub(super) fn begun_at(&self, distance: f64) -> Self {
        if distance <= 0.0 || distance >= self.length() {
            return self.clone();
        }
        let mut path = self.between(distance, self.length());
        path.segments.extend(self.between(0.0, distance).segments);
        Self::new(path)
    }

    /// How far `p` is from the ring, and where along it.
    pub(super) fn nearest(&self, p: Point) -> (f64, f64) {
        let measured = self.path.steps().zip(self.distances.windows(2)).map(|((from, segment), ends)| {
            let share = share_of_nearest(from, segment, p);
            (segment.at(from, share).distance(p), ends[0] + (ends[1] - ends[0]) * share)
        });
        measured.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, 0.0))
    }
}

/// How far along a segment, 0 to 1, its place nearest to `p` is.
fn share_of_nearest(from: Point, segment: &Segment, p: Point) -> f64 {
    let Some(arc) = segment.arc(from) else {
        let (way, to) = (segment.to() - from, p - from);
        let [wx, wy, tx, ty] = [way.x, way.y, to.x, to.y].map(Nm::to_f64);
        return ((tx * wx + ty * wy) / (wx * wx + wy * wy).max(1.0)).clamp(0.0, 1.0);
    };
    let sweep = arc.sweep();
    let [a, b] = [arc.start, p].map(|p| p - arc.center).map(|way| (way.x.to_f64(), way.y.to_f64()));
    let turn = libm::atan2(a.0 * b.1 - a.1 * b.0, a.0 * b.0 + a.1 * b.1);
    // The other way round where the arc goes so.
    let share = if turn * sweep < 0.0 { (turn + sweep.signum() * TAU) / sweep } else { turn / sweep };
    if share <= 1.0 {
        return share;
    }
    let is_end = arc.end.distance(p) < arc.start.distance(p);
    if is_end { 1.0 } else { 0.0 }
}

/// The directions in which a segment begins and ends.
fn headings(from: Point, segment: &Segment) -> [(f64, f64); 2] {
    let Some(arc) = segment.arc(from) else {
        let way = segment.to() - from;
        return [(way.x.to_f64(), way.y.to_f64()); 2];
    };
    let sign = arc.sweep().signum();
    [arc.start, arc.end].map(|p| {
        let radial = p - arc.center;
        (-radial.y.to_f64() * sign, radial.x.to_f64() * sign)
    })
}

/// The angle between two directions, 0 to π.
fn angle(a: (f64, f64), b: (f64, f64)) -> f64 {
    libm::atan2(a.0 * b.1 - a.1 * b.0, a.0 * b.0 + a.1 * b.1).abs()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use crate::geometry::Turn;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_mm(x), Nm::from_mm(y))
    }

    /// A square of 10 mm with one corner round.
    fn ring() -> Ring {
        let line = |x, y| Segment::Line { to: at(x, y) };
        let round = Segment::Arc { to: at(8, 10), center: at(8, 8), turn: Turn::CounterClockwise };
        Ring::new(Path {
            start: at(0, 0),
            segments: vec![line(10, 0), line(10, 8), round, line(0, 10), line(0, 0)],
        })
    }

    #[test]
    fn corners_and_arcs_turn_and_straight_ways_do_not() {
        let ring = ring();
        let near =
            |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-6, "{found} instead of {wanted}");
        near(ring.turn_around(5e6, 4e6), 0.0);
        near(ring.turn_around(9e6, 2e6), FRAC_PI_2);
        near(ring.turn_around(18e6 + 0.5e6 * PI, 0.25e6 * PI), FRAC_PI_2 / 2.0);
        near(ring.turn_around(0.0, 1e6), FRAC_PI_2);
        near(ring.turn_around(5e6, ring.length() / 2.0), 2.0 * PI);
    }

    #[test]
    fn a_ring_cut_anywhere_is_the_same_ring() {
        let ring = ring();
        for distance in [1e6, 10e6, 19e6, 30e6, ring.length() - 1.0] {
            let begun = ring.begun_at(distance);
            assert!(begun.path().is_closed(), "begun at {distance}");
            assert!((begun.length() - ring.length()).abs() < 20.0, "as long, begun at {distance}");
            let between = ring.between(distance / 2.0, distance);
            assert!(
                (between.length() - distance / 2.0).abs() < 20.0,
                "{} up to {distance}",
                between.length()
            );
        }
    }

    #[test]
    fn the_nearest_place_is_found() {
        let (off, along) = ring().nearest(at(4, -1));
        assert!((off - 1e6).abs() < 1.0 && (along - 4e6).abs() < 1.0, "{off} at {along}");
        // Beyond the round corner, whose middle is at (8, 8), at 45 degrees.
        let (off, along) = ring().nearest(at(11, 11));
        let (far, quarter) = (3e6 * 2_f64.sqrt() - 2e6, 18e6 + 0.5e6 * PI);
        assert!((off - far).abs() < 2.0 && (along - quarter).abs() < 2.0, "{off} at {along}");
        // From its middle every place is as near; off the arc it is one of its ends.
        let (off, along) = ring().nearest(at(7, 9));
        assert!((off - 1e6).abs() < 2.0 && along > 18e6, "{off} at {along}");
    }
}
