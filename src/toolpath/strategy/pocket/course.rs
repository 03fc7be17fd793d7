//! A loop by the distance along it.

use crate::geometry::{between, part_nearest};

/// A place in nanometres.
pub(super) type Spot = (f64, f64);

/// A closed polyline with the edge of the area on its left.
#[derive(Clone, Debug)]
pub(super) struct Course {
    points: Vec<Spot>,
    /// The distance at which each corner lies, and at last the whole length.
    starts: Vec<f64>,
}

/// Shorter ways are none, in nanometres: less than programs write. Chosen.
const NOTHING: f64 = 10.0;

impl Course {
    pub(super) fn new(points: Vec<Spot>) -> Self {
        let mut starts = vec![0.0];
        let mut sum = 0.0;
        let next = points.iter().cycle().skip(1);
        for (&a, &b) in points.iter().zip(next) {
            sum += distance(a, b);
            starts.push(sum);
        }
        Self { points, starts }
    }

    pub(super) fn length(&self) -> f64 {
        self.starts[self.points.len()]
    }

    /// How many segments it has.
    pub(super) const fn len(&self) -> usize {
        self.points.len()
    }

    /// The ends of a segment.
    pub(super) fn segment(&self, i: usize) -> [Spot; 2] {
        [self.points[i], self.points[(i + 1) % self.points.len()]]
    }

    /// The distance along it of a part of a segment.
    pub(super) fn along(&self, i: usize, part: f64) -> f64 {
        self.starts[i] + (self.starts[i + 1] - self.starts[i]) * part
    }

    /// The segment at a distance, and how much of it lies before.
    fn place(&self, along: f64) -> (usize, f64) {
        let i = self.starts.partition_point(|&start| start <= along).clamp(1, self.points.len()) - 1;
        let length = self.starts[i + 1] - self.starts[i];
        (i, if length > 0.0 { ((along - self.starts[i]) / length).clamp(0.0, 1.0) } else { 0.0 })
    }

    pub(super) fn at(&self, along: f64) -> Spot {
        let (i, part) = self.place(along);
        let [a, b] = self.segment(i);
        between(a, b, part)
    }

    /// The direction straight to the edge at a place of a segment; none for a loop that is a place.
    pub(super) fn toward_edge(&self, along: f64) -> Option<Spot> {
        let [a, b] = self.segment(self.place(along).0);
        let length = distance(a, b);
        (length > 0.0).then(|| ((a.1 - b.1) / length, (b.0 - a.0) / length))
    }

    /// How far along it the place nearest to `p` is, and how far off.
    pub(super) fn nearest(&self, p: Spot) -> (f64, f64) {
        let found = (0..self.points.len()).map(|i| {
            let [a, b] = self.segment(i);
            let part = part_nearest(p, a, b);
            (self.along(i, part), distance(p, between(a, b, part)))
        });
        found.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0.0, f64::INFINITY))
    }

    /// How long the shorter of the two ways between two places is, and whether that leads forward.
    pub(super) fn shorter(&self, from: f64, to: f64) -> (f64, bool) {
        let ahead = (to - from).rem_euclid(self.length().max(NOTHING));
        let back = self.length() - ahead;
        if ahead <= back { (ahead, true) } else { (back.max(0.0), false) }
    }

    /// The places on the way from one distance on, so long, forward or back; the first is where it
    /// begins.
    pub(super) fn way(&self, from: f64, length: f64, forward: bool) -> Vec<Spot> {
        let whole = self.length();
        let mut found = vec![self.at(from)];
        if whole < NOTHING || length < NOTHING {
            return found;
        }
        let n = self.points.len();
        let (mut i, _) = self.place(from);
        let mut gone = if forward { self.starts[i + 1] - from } else { from - self.starts[i] };
        while gone < length {
            let corner = if forward { (i + 1) % n } else { i };
            if distance(found[found.len() - 1], self.points[corner]) > NOTHING {
                found.push(self.points[corner]);
            }
            i = if forward { (i + 1) % n } else { (i + n - 1) % n };
            gone += self.starts[i + 1] - self.starts[i];
        }
        let rest = if forward { from + length } else { from - length };
        let last = self.at(rest.rem_euclid(whole));
        // A whole turn ends where it began, to the bit.
        let last = if (length - whole).abs() < 1e-6 { found[0] } else { last };
        if distance(found[found.len() - 1], last) > NOTHING || found.len() == 1 {
            found.push(last);
        } else if let Some(end) = found.last_mut() {
            *end = last;
        }
        found
    }
}

pub(super) fn distance(a: Spot, b: Spot) -> f64 {
    let (x, y) = (a.0 - b.0, a.1 - b.1);
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 1 µm, clockwise: its inside is on the right.
    fn square() -> Course {
        Course::new(vec![(0.0, 0.0), (0.0, 1000.0), (1000.0, 1000.0), (1000.0, 0.0)])
    }

    #[test]
    fn ways_lead_round_corners_and_whole_turns_close() {
        let square = square();
        assert_eq!(square.way(500.0, 1000.0, true), [(0.0, 500.0), (0.0, 1000.0), (500.0, 1000.0)]);
        assert_eq!(square.way(500.0, 1000.0, false), [(0.0, 500.0), (0.0, 0.0), (500.0, 0.0)]);
        let round = square.way(500.0, 4000.0, true);
        assert_eq!((round.len(), round[0], round[5]), (6, (0.0, 500.0), (0.0, 500.0)), "{round:?}");
        assert_eq!(square.way(500.0, 4000.0, false).len(), 6, "and back");
    }

    #[test]
    fn the_edge_is_on_the_left() {
        assert_eq!(square().toward_edge(500.0), Some((-1.0, 0.0)), "the first side goes up");
        assert_eq!(square().nearest((-300.0, 400.0)), (400.0, 300.0));
        assert_eq!(square().shorter(3900.0, 100.0), (200.0, true));
    }
}
