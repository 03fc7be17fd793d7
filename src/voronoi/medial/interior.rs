//! Areas with the certified [diagrams](crate::voronoi::exact) of their insides: what is asked of an
//! area, its axis, its loops and what is left of it farther in, is asked of one diagram.

use std::sync::OnceLock;

use crate::geometry::Polygon;
use crate::voronoi::exact::{Diagram, Generators, Kind, Space};

/// An area and the diagram of its inside, which is worked out when it is first asked for.
pub struct Interior<'a> {
    area: &'a Polygon,
    diagram: OnceLock<Diagram>,
}

/// How often the corners of an area are moved by a nanometre or two where its diagram has a flaw.
/// Chosen.
const ATTEMPTS: u32 = 4;

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

    /// The diagram with the fewest faults: of the area as it is, unless that has any, else of one
    /// whose points that all but meet are one, shaken a little.
    pub(super) fn diagram(&self) -> &Diagram {
        self.diagram.get_or_init(|| {
            let mut best = inside(self.area, 0);
            for attempt in 1..=ATTEMPTS {
                if best.faults().is_empty() {
                    break;
                }
                let other = inside(self.area, attempt);
                if other.faults().len() < best.faults().len() {
                    best = other;
                }
            }
            best
        })
    }
}

fn inside(area: &Polygon, attempt: u32) -> Diagram {
    let mut generators = Generators::shaken(attempt);
    if attempt > 0 {
        generators.weld(area.contours().iter().flatten().copied().collect());
    }
    generators.inside(area, |ring| u32::try_from(ring).expect("below 2³² rings"));
    Diagram::new(generators, Kind::MedialAxis, Space::Within)
}
