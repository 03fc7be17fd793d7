//! Areas with the certified [diagrams](crate::voronoi::exact) of their insides: what is asked of an
//! area, its axis, its loops and what is left of it farther in, is asked of one diagram.

use std::sync::OnceLock;

use crate::geometry::Polygon;
use crate::voronoi::exact::{Diagram, Generators, Kind, NEAR, Space};

use super::thinning::thinned;

/// An area and the diagram of its inside, which is worked out when it is first asked for.
pub struct Interior<'a> {
    area: &'a Polygon,
    diagram: OnceLock<Diagram>,
}

/// Within how many nanometres corners of an area are one in each further attempt, where its diagram
/// has a flaw; they are moved by some, too. Chosen: far enough, at last, that none of those that
/// stay pass each other.
const WELDED: [i64; 8] = [NEAR, NEAR, NEAR, NEAR, 100, 100, 100, 100];

impl<'a> Interior<'a> {
    /// Of each of these areas, polygons as a boolean returns them.
    #[must_use]
    pub fn all(areas: &'a [Polygon]) -> Vec<Self> {
        areas.iter().map(|area| Self { area, diagram: OnceLock::new() }).collect()
    }

    /// The area.
    #[must_use]
    pub const fn area(&self) -> &'a Polygon {
        self.area
    }

    /// The diagram with the fewest faults: of the area as it is, but for chords that are finer than
    /// those of [flattened](crate::board::FLATTEN) curves, unless that has any, else of one whose
    /// points that all but meet are one, shaken a little.
    pub(super) fn diagram(&self) -> &Diagram {
        self.diagram.get_or_init(|| {
            let area = thinned(self.area);
            let mut best = inside(&area, 0);
            for attempt in 1..=WELDED.len() {
                if best.faults().is_empty() {
                    break;
                }
                let other = inside(&area, attempt);
                if other.faults().len() < best.faults().len() {
                    best = other;
                }
            }
            best
        })
    }
}

fn inside(area: &Polygon, attempt: usize) -> Diagram {
    let mut generators = Generators::shaken(u32::try_from(attempt).expect("few"));
    if let Some(near) = attempt.checked_sub(1).map(|further| WELDED[further]) {
        generators.weld_within(area.contours().iter().flatten().copied().collect(), near);
    }
    generators.inside(area, |ring| u32::try_from(ring).expect("below 2³² rings"));
    Diagram::new(generators, Kind::MedialAxis, Space::Within)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Nm, Point};
    use crate::topology::random;

    /// A drawing has dents of three nanometres in corners, whose edges are shorter than corners are
    /// moved by where the diagram has a flaw.
    #[test]
    fn dents_of_some_nanometres_leave_no_flaw() {
        const APART: i64 = 500_000;
        let mut below = random();
        let mut hard = 0;
        for _ in 0..40 {
            let mut ring = vec![(-APART, 30_000_000), (-APART, 0)];
            for number in 0..40 {
                let dent = [-20 - below(14), -11 - below(6), 0].map(|x| (x, 5_150 - below(4)));
                let spike =
                    [&[(0, 0), (-1_411, 5_150)], &dent[..], &[(0, 2_571), (2_822, 2_571), (2_822, 0)]];
                ring.extend(spike.concat().into_iter().map(|(x, y)| (x + number * APART, y)));
            }
            ring.extend([(40 * APART, 0), (40 * APART, 30_000_000)]);
            let ring = ring.into_iter().map(|(x, y)| Point::new(Nm::new(x), Nm::new(y))).collect();
            let area = [Polygon::new(vec![ring]).expect("an area")];
            let is_flawed = |attempt| !inside(&area[0], attempt).faults().is_empty();
            hard += usize::from((0..=4).all(is_flawed));
            assert_eq!(Interior::all(&area)[0].diagram().faults(), []);
        }
        assert!(hard > 0, "some are flawed however they are moved, unless the dents go");
    }
}
