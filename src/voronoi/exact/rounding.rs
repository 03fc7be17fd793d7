//! Arcs in rings: what was flattened is round again.
//!
//! ```text
//!  ▓▓▓▓▓╭──•──╮▓▓▓▓▓▓      A polygon remembers the circles that its curves were flattened from. Where vertices • one after
//!  ▓▓▓▓•       •▓▓▓▓▓      another lie on one of them, their chords are an arc of it.
//!  ▓▓▓▓│       │▓▓▓▓▓
//!  ▓▓▓▓•       •▓▓▓▓▓
//!  ▓▓▓▓▓╰──•──╯▓▓▓▓▓▓
//! ```
//!
//! Booleans know chords alone, so that a round hole in a plane is a hundred generators and as many
//! corners, of which one arc is what the file says. Chords that the file itself has stay chords,
//! however fine they are.

use crate::board::FLATTEN;
use crate::geometry::{BoxTree, Circle, Path, Point, Segment, Turn};
use crate::voronoi::plane::Spot;

/// Chords of an arc are no farther from it, in nanometres: what flattening leaves, and rounding.
const SAGITTA: f64 = FLATTEN.to_f64() + 2.0;

/// Vertices of an arc are no farther from it, in nanometres. Derived: what rounding leaves of them,
/// of the centre and of the radius.
const OFF: f64 = 2.0;

/// An arc has at least so many chords. Chosen: of fewer nothing is gained.
const FEWEST: usize = 3;

/// An arc turns by no more, in radians: of more its ends are too near to each other. Chosen.
const LONGEST: f64 = 6.0;

/// An arc is at least so long, in nanometres: the ends of a shorter one may meet when they are
/// moved. Chosen.
const SHORTEST: f64 = 2_000.0;

/// The circles that a polygon remembers, by place.
pub(super) struct Circles<'a> {
    all: &'a [Circle],
    tree: BoxTree,
}

/// An edge as a chord: of which circle, and whether it runs against the clock.
type Chord = (usize, bool);

impl<'a> Circles<'a> {
    pub(super) fn new(all: &'a [Circle]) -> Self {
        let tree = BoxTree::new(all.iter().map(|circle| {
            let (Spot { x, y }, reach) = (Spot::from(circle.center), circle.radius.to_f64() + OFF);
            [x - reach, y - reach, x + reach, y + reach]
        }));
        Self { all, tree }
    }

    /// The ring as a closed path in which runs of chords are arcs.
    pub(super) fn rounded(&self, mut ring: Vec<Point>) -> Option<Path> {
        let n = ring.len();
        let mut last = None;
        let chord = |i: usize| {
            let found = self.chord((ring[i], ring[(i + 1) % n]), last);
            last = found.or(last);
            found
        };
        let mut chords: Vec<Option<Chord>> = (0..n).map(chord).collect();
        // A run has a beginning that does not depend on where the ring has.
        if let Some(first) = (0..n).find(|&i| chords[i] != chords[(i + n - 1) % n]) {
            ring.rotate_left(first);
            chords.rotate_left(first);
        } else if let Some(&Some((number, is_left))) = chords.first()
            && n > FEWEST
        {
            return Some(self.whole(number, is_left));
        } else {
            chords.fill(None);
        }
        let start = *ring.first()?;
        ring.push(start);
        let mut segments = Vec::new();
        let mut at = 0;
        for run in chords.chunk_by(|a, b| a.is_some() && a == b) {
            self.run(&ring[at..=at + run.len()], run[0], &mut segments);
            at += run.len();
        }
        Some(Path { start, segments })
    }

    /// The circle that an edge is a chord of: the one before it, if it is of that.
    fn chord(&self, (from, to): (Point, Point), last: Option<Chord>) -> Option<Chord> {
        let side = |number: usize| {
            let Circle { center, radius } = self.all[number];
            let radius = radius.to_f64();
            let (a, b) = (Spot::from(from) - Spot::from(center), Spot::from(to) - Spot::from(center));
            let is_on = |p: Spot| (p.length() - radius).abs() <= OFF;
            let is_chord = (b - a).dot(b - a) <= 8.0 * radius * SAGITTA;
            (is_on(a) && is_on(b) && is_chord).then(|| (number, a.cross(b) > 0.0))
        };
        last.and_then(|(number, _)| side(number)).or_else(|| {
            let Spot { x, y } = Spot::from(from);
            self.tree.within([x, y, x, y]).into_iter().find_map(side)
        })
    }

    /// A ring that is a circle.
    fn whole(&self, number: usize, is_left: bool) -> Path {
        let Circle { center, radius } = self.all[number];
        Path::circle(center, radius, turn(is_left))
    }

    /// The segments of edges one after the other that are chords of one circle, or of none.
    fn run(&self, points: &[Point], chord: Option<Chord>, segments: &mut Vec<Segment>) {
        let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        match chord {
            Some((number, is_left)) if points.len() > FEWEST && length >= SHORTEST => {
                let Circle { center, radius } = self.all[number];
                // So that no arc is all but a circle.
                let middle = (length > LONGEST * radius.to_f64()).then(|| points[points.len() / 2]);
                let ends = middle.into_iter().chain(points.last().copied());
                segments.extend(ends.map(|to| Segment::Arc { to, center, turn: turn(is_left) }));
            }
            _ => segments.extend(points[1..].iter().map(|&to| Segment::Line { to })),
        }
    }
}

const fn turn(is_left: bool) -> Turn {
    if is_left { Turn::CounterClockwise } else { Turn::Clockwise }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::polarity::difference;
    use crate::geometry::{Arc, Nm, Polygon, Rect};

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn a_disc_is_one_circle_again() {
        for radius in [Nm::from_um(3), Nm::from_um(25), Nm::from_um(550), Nm::from_mm(20)] {
            let center = at(1234, -777);
            let disc = Polygon::disc(center, radius, FLATTEN).expect("a disc");
            let mut ring = disc.contours()[0].clone();
            let third = ring.len() / 3;
            ring.rotate_left(third);
            ring.reverse();
            let path = Circles::new(disc.circles()).rounded(ring).expect("a ring");
            assert_eq!(path, Path::circle(center, radius, Turn::Clockwise), "radius {radius:?}");
        }
    }

    #[test]
    fn wherever_a_ring_begins_its_arcs_are_the_same() {
        let turn = Turn::CounterClockwise;
        let bend = Arc { start: at(1000, 0), end: at(0, 1000), center: at(0, 0), turn };
        let ring: Vec<Point> = [at(0, 0), at(1000, 0)].into_iter().chain(bend.flatten(FLATTEN)).collect();
        let circles = [Circle { center: at(0, 0), radius: Nm::from_mm(1) }];
        let expected = [
            Segment::Line { to: at(1000, 0) },
            Segment::Arc { to: at(0, 1000), center: at(0, 0), turn },
            Segment::Line { to: at(0, 0) },
        ];
        for first in 0..ring.len() {
            let mut ring = ring.clone();
            ring.rotate_left(first);
            let path = Circles::new(&circles).rounded(ring).expect("a ring");
            assert!(path.is_closed(), "closed");
            let mut segments = path.segments;
            let arc = segments.iter().position(|segment| segment.arc(path.start).is_some()).expect("an arc");
            segments.rotate_left((arc + 2) % 3);
            assert_eq!(segments, expected, "begun at {first}");
        }
    }

    #[test]
    fn a_bite_out_of_a_square_is_an_arc_and_the_rest_is_not() {
        let square = Polygon::rectangle(Rect::new(at(0, 0), at(1000, 1000)));
        let bite = Polygon::disc(at(1000, 500), Nm::from_um(300), FLATTEN).expect("a disc");
        let left = difference(&square, [&bite]);
        let path = Circles::new(left[0].circles()).rounded(left[0].contours()[0].clone()).expect("a ring");
        let arcs = path.segments.iter().filter(|segment| matches!(segment, Segment::Arc { .. })).count();
        assert_eq!((arcs, path.segments.len()), (1, 6), "an arc, and two sides in two parts");
    }

    #[test]
    fn corners_that_a_file_has_stay_corners() {
        let fine = Polygon::disc(at(0, 0), Nm::from_um(500), FLATTEN).expect("a disc").contours()[0].clone();
        let count = fine.len();
        let path = Circles::new(&[]).rounded(fine).expect("a ring");
        assert_eq!(path.segments.len(), count, "nobody said that they are a circle");
    }
}
