//! The shortest order of a few stretches: all are tried, but for those that begin with a way
//! already too long.

use crate::geometry::Point;

use super::Leg;

/// So many stretches at most are worth trying all orders of. Chosen: 6 have 46 080, of which few
/// are followed to their end.
pub(super) const FEW: usize = 6;

/// The shortest order.
pub(super) fn shortest(ends: &[[Point; 2]], start: Point) -> Vec<Leg> {
    let mut trial =
        Trial { ends, way: Vec::with_capacity(ends.len()), best: Vec::new(), least: f64::INFINITY };
    trial.go_on(start, 0.0);
    trial.best
}

struct Trial<'a> {
    ends: &'a [[Point; 2]],
    /// The order that is being tried.
    way: Vec<Leg>,
    /// The shortest so far, and its length.
    best: Vec<Leg>,
    least: f64,
}

impl Trial<'_> {
    fn go_on(&mut self, at: Point, length: f64) {
        if length >= self.least {
            return;
        }
        if self.way.len() == self.ends.len() {
            (self.best, self.least) = (self.way.clone(), length);
            return;
        }
        for (stretch, ends) in self.ends.iter().enumerate() {
            if self.way.iter().any(|leg| leg.stretch == stretch) {
                continue;
            }
            for reversed in [false, true] {
                let (first, last) = if reversed { (ends[1], ends[0]) } else { (ends[0], ends[1]) };
                self.way.push(Leg { stretch, reversed, entry: None });
                self.go_on(last, length + at.distance(first));
                self.way.pop();
            }
        }
    }
}
