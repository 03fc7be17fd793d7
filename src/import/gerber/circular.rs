//! Circular interpolation (G02, G03 with G74 or G75; specification §4.7 and §8.1.10).

use std::ops::Range;

use crate::geometry::{Arc, Nm, Point, Turn, Vector};
use crate::import::flaw;

use super::super::error::Error;
use super::reader::{Quadrants, Reader, Words};

/// How far the two radii of an arc may differ before it is mentioned. Chosen: twice the step of the coarsest usual
/// format, 2.3 inches.
const RADII: f64 = 50_800.0;

impl<'a> Reader<'a> {
    /// The arc from `from` to `to`; none where it is no longer than a point or has no radius, and so is a line.
    pub(super) fn arc(
        &mut self,
        from: Point,
        to: Point,
        turn: Turn,
        words: Words,
        place: &Range<usize>,
    ) -> Result<Option<Arc>, Error> {
        let format = self.format(place)?;
        let mut offset = Vector::default();
        if let Some(i) = words.i {
            offset.x = self.coordinate(i, format.x, place)?;
        }
        if let Some(j) = words.j {
            offset.y = self.coordinate(j, format.y, place)?;
        }
        let signed = offset.x < Nm::ZERO || offset.y < Nm::ZERO;
        let quadrants = match self.quadrants {
            Some(Quadrants::Single) if !signed => Quadrants::Single,
            Some(Quadrants::Multi) => Quadrants::Multi,
            other => {
                let message = match other {
                    Some(_) => "this arc has a negative offset, so it is read as G75, several quadrants",
                    None => {
                        "neither G74 nor G75 says how arcs are meant; they are read as G75, several quadrants"
                    }
                };
                self.warnings.add(&flaw::QUADRANT_MODE, place.clone(), message);
                Quadrants::Multi
            }
        };
        if offset == Vector::default() {
            if from != to {
                let message = "an arc without a centre (I and J) is read as a line";
                self.warnings.add(&flaw::ARC_WITHOUT_CENTRE, place.clone(), message);
            }
            return Ok(None);
        }
        let center = match quadrants {
            Quadrants::Multi => from + offset,
            Quadrants::Single if from == to => return Ok(None),
            Quadrants::Single => single_quadrant(from, to, offset, turn),
        };
        let mismatch = center.distance(from) - center.distance(to);
        if mismatch.abs() > RADII {
            let message = "the start and the end of an arc lie at different distances from its centre; the radius is \
                           changed evenly from one to the other";
            self.warnings.add(&flaw::ARC_RADIUS_MISMATCH, place.clone(), message);
        }
        let turn = if self.placement.mirrors() { turn.reversed() } else { turn };
        let (start, end) = (self.place(from, place)?, self.place(to, place)?);
        let center = start + self.placement.vector(center - from);
        Ok(Some(Arc { start, end, center, turn }))
    }
}

/// The centre of an arc of at most a quarter whose offsets carry no sign: of the four places it may be at, the one that
/// both ends are equally far from (specification §8.1.10, G74).
fn single_quadrant(from: Point, to: Point, offset: Vector, turn: Turn) -> Point {
    /// A quarter, and a little for rounded coordinates.
    const QUARTER: f64 = std::f64::consts::FRAC_PI_2 * 1.02;
    let signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
    let candidates = signs.map(|(x, y)| from + Vector::new(offset.x * x, offset.y * y));
    let score = |&center: &Point| {
        let arc = Arc { start: from, end: to, center, turn };
        let mismatch = (center.distance(from) - center.distance(to)).abs();
        (arc.sweep().abs() > QUARTER, mismatch)
    };
    candidates
        .into_iter()
        .min_by(|a, b| {
            let (a, b) = (score(a), score(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
        .unwrap_or(from)
}
