//! Nested loops: level sets of the clearance of areas, one within the other, as a tree of regions.
//!
//! ```text
//!   ┌───────────────────────────┐     A *region* is a connected part of an area that is so far from the edge; its loops are its
//!   │ ╭────────╮   ╭──────────╮ │     outer contour and one round each island. At the next level it holds one region or more (it
//!   │ │ ╭────╮ ╰───╯ ╭──────╮ │ │     falls apart at a saddle of the clearance), or none: then it is round a *summit*, the place
//!   │ │ ╰────╯ ╭───╮ ╰──────╯ │ │     of its largest disc, which is a local maximum of the clearance.
//!   │ ╰────────╯   ╰──────────╯ │
//!   └───────────────────────────┘
//! ```
//!
//! The loops are those of the certified [diagram](crate::voronoi::exact)
//! ([`Diagram::level_set`]), and the summits its vertices. Who goes from a place of a loop straight
//! to the nearest edge comes to a loop of the level below: on such spokes loops are linked. Where
//! the diagram of an area has a flaw, its loops are offsets by exact booleans instead.
//!
//! M. Held, *On the Computational Geometry of Pocket Machining*, LNCS 500, Springer 1991, ch. 4 and
//! 5 (offset loops, their tree, and what links them).

use rayon::prelude::*;

use super::{Interior, Place};
use crate::board::FLATTEN;
use crate::board::polarity::offset;
use crate::geometry::{Nm, Point, Polygon};
use crate::voronoi::exact::{Diagram, LevelCurve};

/// A closed curve along which the clearance is that of a level.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// The index of its level, 0 being next to the edge.
    pub level: usize,
    /// Its corners in nanometres, each once, with the edge on its left; one alone where the area is
    /// round and as wide as the level.
    pub ring: Vec<(f64, f64)>,
}

/// A connected part of an area above a level.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The index of the level.
    pub level: usize,
    /// Its loops, by their numbers: the outer one first.
    pub loops: Vec<usize>,
    /// The regions of the next level within it, by their numbers.
    pub children: Vec<usize>,
    /// Where its clearance is greatest, if it has no children.
    pub summit: Option<Place>,
}

/// The loops of all levels, and how they lie within each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nest {
    /// All loops.
    pub loops: Vec<Loop>,
    /// All regions.
    pub regions: Vec<Region>,
    /// The regions of the first level, by their numbers, in the order of the areas.
    pub roots: Vec<usize>,
    /// How many areas have loops that the diagram did not answer for: none, unless the program is
    /// at fault.
    pub flaws: usize,
}

/// Loops of the second and higher levels that are smaller are none, in nanometres: what they would
/// mill is milled from the level below. Chosen: a loop that small is one place for any machine.
const SMALL: f64 = 4_000.0;

/// Levels at most. Chosen.
const MOST_LEVELS: usize = 100_000;

impl Nest {
    /// The loops of areas where the clearance is `level(0)`, `level(1)` and so on, in nanometres
    /// and rising, as far as any area is wide.
    #[must_use]
    pub fn new(areas: &[Interior<'_>], level: impl Fn(usize) -> f64 + Sync) -> Self {
        let parts: Vec<Self> = areas.par_iter().map(|area| Self::of_area(area, &level)).collect();
        let mut whole = Self::default();
        for part in parts {
            let (loops, regions) = (whole.loops.len(), whole.regions.len());
            whole.loops.extend(part.loops);
            whole.regions.extend(part.regions.into_iter().map(|mut region| {
                region.loops.iter_mut().for_each(|number| *number += loops);
                region.children.iter_mut().for_each(|number| *number += regions);
                region
            }));
            whole.roots.extend(part.roots.into_iter().map(|root| root + regions));
            whole.flaws += part.flaws;
        }
        whole
    }

    /// The place among the roots of the one that holds a place.
    #[must_use]
    pub fn root_at(&self, at: (f64, f64)) -> Option<usize> {
        let region = self.region_at(&self.roots, at)?;
        self.roots.iter().position(|&root| root == region)
    }

    fn of_area(interior: &Interior<'_>, level: &impl Fn(usize) -> f64) -> Self {
        let area = interior.area();
        let least = Nm::from_f64(2.0 * level(0)) - Nm::from_um(1);
        if area.bounds().width().min(area.bounds().height()) < least {
            return Self::default();
        }
        // Of a part of it that narrow places cut off no seed may be known, so all is walked.
        let diagram = interior.diagram();
        let mut nest = Self::default();
        let mut before: Vec<usize> = Vec::new();
        let mut is_flawed = !diagram.faults().is_empty();
        for number in 0..MOST_LEVELS {
            let height = level(number);
            let known = if is_flawed { None } else { diagram.level_set(height) };
            is_flawed |= known.is_none();
            let rings = rings(known, area, height);
            let found = nest.add_level(number, height, rings);
            if found.is_empty() {
                break;
            }
            if number == 0 {
                nest.roots.clone_from(&found);
            } else {
                nest.adopt(&before, &found);
            }
            before = found;
        }
        nest.flaws = usize::from(is_flawed);
        nest.find_summits(diagram, level);
        nest
    }

    /// Adds the regions that rings bound; their numbers.
    fn add_level(&mut self, level: usize, height: f64, rings: Vec<Vec<(f64, f64)>>) -> Vec<usize> {
        let is_large = |ring: &Vec<(f64, f64)>| {
            let [left, bottom, right, top] = bounds(ring);
            level == 0 || (right - left).max(top - bottom) >= SMALL
        };
        let (islands, outer): (Vec<_>, Vec<_>) = rings
            .into_iter()
            .filter(|ring| !ring.is_empty() && is_large(ring))
            // Round an island a loop holds a disc of its level at least.
            .partition(|ring| area(ring) > height * height);
        let first = self.regions.len();
        for ring in outer {
            let loops = vec![self.loops.len()];
            self.loops.push(Loop { level, ring });
            self.regions.push(Region { level, loops, children: Vec::new(), summit: None });
        }
        let found: Vec<usize> = (first..self.regions.len()).collect();
        for ring in islands {
            let Some(within) = self.region_at(&found, ring[0]) else { continue };
            self.regions[within].loops.push(self.loops.len());
            self.loops.push(Loop { level, ring });
        }
        found
    }

    /// The smallest of regions whose outer loop holds a place.
    fn region_at(&self, regions: &[usize], p: (f64, f64)) -> Option<usize> {
        let outer = |region: usize| &self.loops[self.regions[region].loops[0]].ring;
        let holding = regions.iter().copied().filter(|&region| holds(outer(region), p));
        holding.min_by(|&a, &b| area(outer(a)).abs().total_cmp(&area(outer(b)).abs()))
    }

    /// Finds which region of the level before holds each one of the next.
    fn adopt(&mut self, before: &[usize], found: &[usize]) {
        for &child in found {
            let place = self.loops[self.regions[child].loops[0]].ring[0];
            if let Some(parent) = self.region_at(before, place) {
                self.regions[parent].children.push(child);
            }
        }
    }

    /// Finds where the clearance is greatest in regions without children.
    fn find_summits(&mut self, diagram: &Diagram, level: &impl Fn(usize) -> f64) {
        for number in 0..self.regions.len() {
            let Region { level: index, loops, children, .. } = &self.regions[number];
            if !children.is_empty() {
                continue;
            }
            let within = bounds(&self.loops[loops[0]].ring);
            let least = level(*index);
            let is_in = |at: (f64, f64)| {
                let mut rings = loops.iter().map(|&number| &self.loops[number].ring);
                at.0 >= within[0]
                    && at.1 >= within[1]
                    && at.0 <= within[2]
                    && at.1 <= within[3]
                    && rings.next().is_some_and(|outer| holds(outer, at))
                    && !rings.any(|island| holds(island, at))
            };
            let higher =
                diagram.vertices().iter().filter(|vertex| vertex.clearance > least && is_in(vertex.at));
            let summit = higher.max_by(|a, b| a.clearance.total_cmp(&b.clearance));
            self.regions[number].summit =
                summit.map(|vertex| Place { at: vertex.at, clearance: vertex.clearance });
        }
    }
}

/// The loops of a level of an area, with the edge on their left: those that are known, or else by
/// exact booleans.
pub(super) fn rings(known: Option<Vec<LevelCurve>>, area: &Polygon, height: f64) -> Vec<Vec<(f64, f64)>> {
    known.map_or_else(
        || offset_rings(area, height),
        |curves| curves.into_iter().map(|curve| ring(curve.course)).collect(),
    )
}

fn offset_rings(area: &Polygon, height: f64) -> Vec<Vec<(f64, f64)>> {
    let inset = offset(area, -Nm::from_f64(height), FLATTEN);
    let rings = inset.iter().flat_map(Polygon::contours);
    rings.map(|ring| ring.iter().rev().copied().map(Point::to_f64).collect()).collect()
}

/// A course whose last place is its first, without places that are doubled.
fn ring(mut course: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    course.dedup_by(|b, a| (b.0 - a.0).abs().max((b.1 - a.1).abs()) < 1.0);
    while course.len() > 1 && {
        let (first, last) = (course[0], course[course.len() - 1]);
        (last.0 - first.0).abs().max((last.1 - first.1).abs()) < 1.0
    } {
        course.pop();
    }
    course
}

/// Left, bottom, right, top.
fn bounds(ring: &[(f64, f64)]) -> [f64; 4] {
    let none = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    ring.iter().fold(none, |[left, bottom, right, top], &(x, y)| {
        [left.min(x), bottom.min(y), right.max(x), top.max(y)]
    })
}

/// The signed area of a ring, counter-clockwise positive.
fn area(ring: &[(f64, f64)]) -> f64 {
    let Some(&(x, y)) = ring.first() else { return 0.0 };
    let next = ring.iter().cycle().skip(1);
    let twice: f64 = ring.iter().zip(next).map(|(a, b)| (a.0 - x) * (b.1 - y) - (b.0 - x) * (a.1 - y)).sum();
    twice / 2.0
}

/// Whether a ring holds a place.
fn holds(ring: &[(f64, f64)], (x, y): (f64, f64)) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crosses = |&(a, b): &(&(f64, f64), &(f64, f64))| {
        (a.1 > y) != (b.1 > y) && a.0 + (y - a.1) / (b.1 - a.1) * (b.0 - a.0) > x
    };
    ring.iter().zip(next).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::polarity::{difference, union};
    use crate::geometry::Rect;

    fn rectangle([left, bottom, right, top]: [i64; 4]) -> Polygon {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        Polygon::rectangle(Rect::new(at(left, bottom), at(right, top)))
    }

    /// Two squares of 4 mm and a passage of 1.2 mm between them.
    fn dumbbell() -> Vec<Polygon> {
        union(&[
            rectangle([0, 0, 4000, 4000]),
            rectangle([6000, 0, 10_000, 4000]),
            rectangle([3900, 1400, 6100, 2600]),
        ])
    }

    fn leaves(nest: &Nest) -> Vec<&Region> {
        nest.regions.iter().filter(|region| region.children.is_empty()).collect()
    }

    #[test]
    fn a_region_falls_apart_where_it_is_narrow() {
        let nest = Nest::new(&Interior::all(&dumbbell()), |i| {
            [500_000.0, 900_000.0, 1_300_000.0, 1_700_000.0, 2_100_000.0][i]
        });
        assert_eq!((nest.roots.len(), nest.flaws), (1, 0), "one area");
        assert_eq!(nest.regions[nest.roots[0]].children.len(), 2, "two squares above the passage");
        let leaves = leaves(&nest);
        assert_eq!(leaves.len(), 2, "one summit each");
        let mut summits: Vec<Place> = leaves.iter().filter_map(|leaf| leaf.summit).collect();
        summits.sort_by(|a, b| a.at.0.total_cmp(&b.at.0));
        for (summit, x) in summits.iter().zip([2e6, 8e6]) {
            assert!((summit.at.0 - x).abs() < 1e5 && (summit.clearance - 2e6).abs() < 1e5, "{summit:?}");
        }
        assert!(leaves.iter().all(|leaf| leaf.level == 3), "{leaves:?}");
    }

    #[test]
    fn an_island_has_a_loop_of_its_own() {
        let ring = difference(&rectangle([0, 0, 9000, 9000]), &[rectangle([4000, 4000, 5000, 5000])]);
        let nest = Nest::new(&Interior::all(&ring), |i| {
            if i < 4 { [500_000.0, 1e6, 1.5e6, 1.9e6][i] } else { f64::MAX }
        });
        assert!(nest.regions.iter().take(1).all(|region| region.loops.len() == 2), "{:?}", nest.regions);
        let [outer, island] = [0, 1].map(|i| area(&nest.loops[nest.regions[0].loops[i]].ring));
        assert!(outer < 0.0 && island > 0.0, "the edge on the left of both: {outer} and {island}");
    }

    #[test]
    fn what_is_as_wide_as_the_first_level_has_a_loop_still() {
        let slot = rectangle([0, 0, 5000, 1000]);
        let nest = Nest::new(&Interior::all(&[slot]), |i| if i == 0 { 499_500.0 } else { f64::MAX });
        assert_eq!((nest.loops.len(), nest.roots.len()), (1, 1), "{nest:?}");
    }
}
