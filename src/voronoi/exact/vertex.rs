//! A vertex: all generators that are equally far from a place, in the order of the directions of
//! their feet, and what leaves between them.
//!
//! ```text
//!            foot 2
//!       edge   │   edge          One edge leaves between each two neighbours of different owners (or any two, for the medial axis);
//!          ╲   │   ╱             with four or more feet, as on a grid, nothing is special. Generators with the same foot direction
//!           ╲  │  ╱              are one *group*: a line and the disc at its end, or copper that touches from within. For the edges
//!   foot 3 ─────●───── foot 1    on either side the one that is nearest a little ahead stands for the group.
//!           ╱  │
//! ```

use std::iter::successors;

use super::form::{clockwise, is_one_way, turn};
use super::tolerances::{SAME, SLAB, SNAP, resolution};
use super::{Diagram, Kind, apollonius};
use crate::voronoi::plane::Spot;

/// Distances that differ by less are equal, in nanometres: the first of these with which all edges
/// find their ends. Chosen: rounding is a thousandth of the least, whole nanometres rarely come as
/// close as the largest.
pub(super) const TIES: [f64; 3] = [0.002, 0.02, 0.000_2];

/// What is tied at a place that an event led to may differ by so many ties at the place that it
/// defines. Chosen: three of many decide, and what all lie within a tie of may be off by some.
const SPREAD: f64 = 4.0;

/// Feet that move by less for each unit of the way stay where they are. Chosen: rounding is less.
const LEVEL: f64 = 1e-9;

/// A generator tied at a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tied {
    pub(super) generator: u32,
    /// The direction of its foot, a unit vector.
    pub(super) toward: Spot,
    group: usize,
    /// It ends here if its end is so near, in nanometres: more at a joint.
    slab: f64,
}

/// A line or an arc that ends at a place, but for rounding, and the disc round its end, at which
/// another begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Joint {
    generator: u32,
    /// Which of its ends: 0 for the first.
    end: usize,
    group: usize,
    disc: u32,
}

/// What leaves a vertex: an edge between two generators, in a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) way: Spot,
    /// The edge that leaves here.
    pub(super) edge: Option<u32>,
}

/// A place where edges end, solved.
#[derive(Clone, Debug)]
pub(super) struct Junction {
    pub(super) at: Spot,
    pub(super) clearance: f64,
    pub(super) tied: Vec<u32>,
    pub(super) slots: Vec<Slot>,
    /// Whether any number of edges may end here.
    pub(super) is_end: bool,
}

impl Diagram {
    /// The generators that count at `p` and are at most `reach` far, with their distances.
    pub(super) fn within(&self, p: Spot, reach: f64) -> Vec<(u32, f64)> {
        self.about(p, reach, SLAB)
    }

    /// Those, and others whose ends are at most `slab` behind.
    pub(super) fn about(&self, p: Spot, reach: f64, slab: f64) -> Vec<(u32, f64)> {
        // Rarely more: lists that grow make threads wait for each other.
        let mut found = Vec::with_capacity(16);
        self.index.visit_round(p, reach + self.tie, |i| {
            let form = &self.forms()[i as usize];
            let distance = form.distance(p);
            if distance <= reach && form.counts(p, self.tie, slab) {
                found.push((i, distance));
            }
        });
        found.sort_unstable_by_key(|&(i, _)| i);
        found.dedup();
        found
    }

    /// What is tied near `p`, which `led` generators at about `clearance` have led to; none where
    /// something is nearer, or all is farther.
    pub(super) fn junction(&self, p: Spot, clearance: f64, led: [u32; 3]) -> Option<Junction> {
        let near = self.about(p, clearance + 8.0 * self.tie, SNAP);
        let counts = |&&(i, _): &&(u32, f64)| self.forms()[i as usize].counts(p, self.tie, SLAB);
        let least = near.iter().filter(counts).map(|&(_, d)| d).fold(f64::INFINITY, f64::min);
        if least.is_infinite() || least < clearance - 4.0 * self.tie {
            return None;
        }
        let numbers = || near.iter().map(|&(i, _)| i);
        let at_first = self.tied(p, clearance, numbers(), SLAB, self.tie, &[]);
        if at_first.is_empty() {
            return None;
        }
        let handed = self.hand_over(p, clearance, &self.tied(p, clearance, numbers(), SNAP, self.tie, &[]));
        let (mut at, mut joints) = handed.unwrap_or_else(|| (self.settled(p, &at_first, led), Vec::new()));
        // The least and the largest distance of what is tied.
        let away = |at: Spot| {
            let all = at_first.iter().map(|tied| self.forms()[tied.generator as usize].distance(at));
            all.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), d| (least.min(d), most.max(d)))
        };
        // Where that lies beyond another vertex, within a nanometre, the place is the one found; so
        // it is where what is tied parts there.
        let is_moved = (at - p).length() > self.tie;
        let (least, most) = away(at);
        let parts = most - least > SPREAD * self.tie;
        if parts || is_moved && !self.within(at, least - 4.0 * self.tie).is_empty() {
            (at, joints) = (p, Vec::new());
        }
        let (least, most) = away(at);
        let clearance = least.max(0.0);
        let tie = (most - clearance).clamp(self.tie, SPREAD * self.tie);
        let tied = self.tied(at, clearance, numbers(), SLAB, tie, &joints);
        let slots = self.slots(at, clearance, &tied);
        let mut generators: Vec<u32> = tied.iter().map(|tied| tied.generator).collect();
        generators.sort_unstable();
        generators.dedup();
        let is_end = slots.is_empty() && (generators.len() > 1 || clearance < self.tie);
        Some(Junction { at, clearance, tied: generators, slots, is_end })
    }

    /// The generators among some that are `clearance` far from `p`, within `tie`, by the direction
    /// of their feet, in groups of one direction. Those with a joint there have the direction of
    /// its disc.
    fn tied(
        &self,
        p: Spot,
        clearance: f64,
        among: impl Iterator<Item = u32>,
        slab: f64,
        tie: f64,
        joints: &[Joint],
    ) -> Vec<Tied> {
        let mut tied: Vec<Tied> = Vec::new();
        let mut around: Vec<(u32, Option<[Spot; 2]>)> = Vec::new();
        for generator in among {
            let form = &self.forms()[generator as usize];
            let joint = joints.iter().find(|joint| joint.generator == generator);
            let slab = if joint.is_some() { SNAP } else { slab };
            if (form.distance(p) - clearance).abs() > tie
                || form.slack(p) < -slab
                || form.distance(p) < -self.tie
            {
                continue;
            }
            let mut add = |toward| tied.push(Tied { generator, toward, group: 0, slab });
            match form.around(p) {
                // From its centre an arc is everywhere: its two ends stand for it.
                Some(Some(ends)) => ends.into_iter().for_each(add),
                Some(None) => add(Spot::new(1.0, 0.0)),
                None => {
                    let of = joint.map_or(generator, |joint| joint.disc);
                    add(self.forms()[of as usize].away(p) * -1.0);
                }
            }
            around.extend(form.around(p).map(|sector| (generator, sector)));
        }
        // What touches an arc from behind is nowhere nearer than the arc.
        let is_behind = |entry: &Tied, (arc, sector): &(u32, Option<[Spot; 2]>)| {
            let within = |[from, to]: [Spot; 2]| {
                let along = turn(from, entry.toward);
                along > SAME && along < turn(from, to) - SAME
            };
            *arc != entry.generator && sector.is_none_or(within)
        };
        tied.retain(|entry| !around.iter().any(|arc| is_behind(entry, arc)));
        let from = Spot::new(1.0, 0.0);
        tied.sort_by(|a, b| {
            turn(from, a.toward).total_cmp(&turn(from, b.toward)).then(a.generator.cmp(&b.generator))
        });
        let turned = 2.0 * self.tie / clearance.max(self.tie);
        let is_same = |a: &Tied, b: &Tied| is_one_way(a.toward, b.toward, turned + SAME);
        // Begin after a gap between two directions, so that no group is cut in two.
        let n = tied.len();
        if let Some(gap) = (0..n).find(|&i| !is_same(&tied[(i + n - 1) % n], &tied[i])) {
            tied.rotate_left(gap);
        }
        for i in 1..n {
            let step = usize::from(!is_same(&tied[i - 1], &tied[i]));
            tied[i].group = tied[i - 1].group + step;
        }
        tied
    }

    /// The place that the tied generators define, the same from wherever it was reached.
    fn settled(&self, p: Spot, tied: &[Tied], led: [u32; 3]) -> Spot {
        let near = |solution: [Option<apollonius::Solution>; 2]| {
            let found = solution.into_iter().flatten().map(|(at, _)| at);
            let nearest = found.min_by(|a, b| (*a - p).length().total_cmp(&(*b - p).length()))?;
            ((nearest - p).length() <= 1.0 + 1e-3 * (nearest - p).length()).then_some(nearest)
        };
        let solve = |three: [u32; 3]| near(apollonius::solve(three.map(|i| &self.forms()[i as usize])));
        // One of each group, the first by number, well apart.
        let mut firsts: Vec<(usize, u32, Spot)> = Vec::new();
        for entry in tied {
            match firsts.iter_mut().find(|(group, ..)| *group == entry.group) {
                Some(first) if entry.generator < first.1 => {
                    *first = (entry.group, entry.generator, entry.toward)
                }
                Some(_) => {}
                None => firsts.push((entry.group, entry.generator, entry.toward)),
            }
        }
        firsts.sort_unstable_by_key(|first| first.1);
        firsts.truncate(12);
        let area = |a: Spot, b: Spot, c: Spot| (b - a).cross(c - a).abs();
        let mut best: Option<(f64, [u32; 3])> = None;
        for (i, a) in firsts.iter().enumerate() {
            for (j, b) in firsts.iter().enumerate().skip(i + 1) {
                for c in firsts.iter().skip(j + 1) {
                    let area = area(a.2, b.2, c.2);
                    if a.1 != b.1 && b.1 != c.1 && best.is_none_or(|best| area > 1.5 * best.0) {
                        best = Some((area, [a.1, b.1, c.1]));
                    }
                }
            }
        }
        let mut led = led;
        led.sort_unstable();
        best.and_then(|(_, three)| solve(three)).or_else(|| solve(led)).unwrap_or(p)
    }

    /// The place where a line or an arc hands over to the disc at its end, if two tied ones do, and
    /// all lines and arcs that end at a tied disc there, or less than a nanometre beside. Where
    /// copper is near, feet no farther apart than a slab reaches beyond its end may have two
    /// directions.
    fn hand_over(&self, p: Spot, clearance: f64, tied: &[Tied]) -> Option<(Spot, Vec<Joint>)> {
        let mut joints: Vec<Joint> = Vec::new();
        for entry in tied {
            let slacks = self.forms()[entry.generator as usize].slacks(p);
            for (end, disc) in self.generators.ends_of(entry.generator).into_iter().enumerate() {
                let off = slacks[end].abs();
                let beside = SAME + off / clearance.max(self.tie);
                let is_there = |other: &Tied| {
                    other.group == entry.group
                        || (off <= SLAB && is_one_way(other.toward, entry.toward, beside))
                };
                let is_tied = |disc: u32| tied.iter().any(|other| other.generator == disc && is_there(other));
                if off <= SNAP
                    && let Some(disc) = disc.filter(|&disc| is_tied(disc))
                {
                    joints.push(Joint { generator: entry.generator, end, group: entry.group, disc });
                }
            }
        }
        let &Joint { generator, end, disc, .. } = joints.iter().min()?;
        let form = &self.forms()[generator as usize];
        let (foot, normal) = form.foot(form.ends()?[end]);
        // What meets at that disc may have several directions.
        let is_there = |group: usize| {
            joints.iter().any(|joint| joint.disc == disc && joint.group == group)
                || tied.iter().any(|other| other.generator == disc && other.group == group)
        };
        let elsewhere = tied.iter().filter(|other| !is_there(other.group));
        let other = elsewhere.map(|other| other.generator).min()?;
        let s = self.forms()[other as usize].meet(foot, normal)?;
        let at = foot + normal * s;
        let stays =
            |other: &Tied| (self.forms()[other.generator as usize].distance(at) - s).abs() <= self.tie;
        let is_near = (at - p).length() < 2.0 * SNAP;
        (is_near && tied.iter().all(stays)).then_some((at, joints))
    }

    /// What leaves between neighbouring groups.
    fn slots(&self, at: Spot, clearance: f64, tied: &[Tied]) -> Vec<Slot> {
        let groups = tied.last().map_or(0, |last| last.group + 1);
        if groups < 2 || clearance < self.tie {
            return Vec::new();
        }
        let group = |g: usize| tied.iter().filter(move |entry| entry.group == g % groups);
        // Most are joints.
        let mut slots = Vec::with_capacity(2);
        for g in 0..groups {
            let (Some(last), Some(first)) = (group(g).next_back(), group(g + 1).next()) else { continue };
            let way = super::form::unit(clockwise(first.toward - last.toward));
            let [right, left] = [g, g + 1].map(|g| self.ahead(at, clearance, way, group(g)));
            if left != right && self.parts(left, right) && !self.generators.are_joined(left, right) {
                slots.push(Slot { left, right, way, edge: None });
            }
        }
        slots
    }

    /// Whether edges between two generators are wanted.
    pub(super) fn parts(&self, a: u32, b: u32) -> bool {
        match self.kind {
            Kind::Owners => self.owner(a) != self.owner(b),
            Kind::MedialAxis | Kind::Above(_) | Kind::Between(_) => true,
        }
    }

    /// The one of some tied generators that is nearest a little ahead.
    pub(super) fn ahead_of(&self, at: Spot, clearance: f64, way: Spot, tied: &[u32]) -> Option<u32> {
        let (toward, group, slab) = (Spot::default(), 0, SLAB);
        let tied: Vec<Tied> = tied.iter().map(|&generator| Tied { generator, toward, group, slab }).collect();
        (!tied.is_empty()).then(|| self.ahead(at, clearance, way, tied.iter()))
    }

    /// The one of a group that is nearest a little ahead. How far ahead that shows goes by the
    /// nearest centre of a circle: a contact of copper may be far from it, and the middle of a
    /// hollow arc next to it, where a little farther on other ends are nearer.
    fn ahead<'a>(
        &self,
        at: Spot,
        clearance: f64,
        way: Spot,
        group: impl Iterator<Item = &'a Tied> + Clone,
    ) -> u32 {
        let form = |tied: &Tied| &self.forms()[tied.generator as usize];
        let mut members = group.clone();
        if let (Some(one), None) = (members.next(), members.next()) {
            return one.generator;
        }
        let bend = group.clone().filter_map(|tied| form(tied).bend(at)).reduce(f64::min);
        // Off the centre of a hollow circle, too, about which all directions are one.
        let farthest = resolution(self.tie, bend.unwrap_or(clearance)).max(4.0 * SNAP);
        let probe = at + way * farthest;
        let going = group.clone().filter_map(|tied| Some((tied, self.goes_on(tied, at, way, probe)?)));
        let going: Vec<(&Tied, bool)> = going.collect();
        let hides = |&(tied, begins): &(&Tied, bool), disc: u32| {
            begins && self.generators.ends_of(tied.generator).contains(&Some(disc))
        };
        let is_seen = |tied: &&Tied| !going.iter().any(|other| hides(other, tied.generator));
        let going: Vec<&Tied> = going.iter().map(|&(tied, _)| tied).filter(is_seen).collect();
        let is_there = |tied: &Tied, probe: Spot| form(tied).slack(probe) >= -tied.slab;
        // No farther than what is shorter than that goes on.
        let halves = successors(Some(farthest), |far| Some(0.5 * far)).take_while(|&far| far >= 4.0 * SNAP);
        let mut probes = halves.map(|far| at + way * far);
        let probe = probes.find(|&probe| going.iter().all(|tied| is_there(tied, probe))).unwrap_or(probe);
        let rank = |i: u32| (self.forms()[i as usize].distance(probe), self.owner(i), i);
        let nearer = |a: (f64, u32, u32), b: (f64, u32, u32)| {
            let is_tie = (a.0 - b.0).abs() < 1e-6;
            let a_first = if is_tie { (a.1, a.2) < (b.1, b.2) } else { a.0 < b.0 };
            if a_first { a } else { b }
        };
        let ranked = |tied: &Tied| rank(tied.generator);
        let there = going.iter().filter(|tied| is_there(tied, probe)).map(|tied| ranked(tied)).reduce(nearer);
        let going = there.or_else(|| going.iter().map(|tied| ranked(tied)).reduce(nearer));
        going.or_else(|| group.map(ranked).reduce(nearer)).map_or(u32::MAX, |found| found.2)
    }

    /// Whether a tied generator is there a little ahead in a direction, too, and if so, whether it
    /// begins here: then it is nearer than the disc at its end. From the centre of a hollow arc
    /// `probe` shows it.
    fn goes_on(&self, tied: &Tied, at: Spot, way: Spot, probe: Spot) -> Option<bool> {
        let form = &self.forms()[tied.generator as usize];
        let Some(ends) = form.ends() else { return Some(false) };
        if form.around(at).is_some() {
            return (form.slack(probe) >= 0.0).then_some(false);
        }
        let slacks = form.slacks(at);
        let mut begins = false;
        for end in (0..2).filter(|&end| slacks[end].abs() <= tied.slab) {
            let (_, normal) = form.foot(ends[end]);
            // The direction in which feet move inwards from this end.
            let onward = clockwise(normal) * if form.is_hollow() { 1.0 } else { -1.0 };
            let inward = way.dot(if end == 0 { onward } else { onward * -1.0 });
            if inward < -LEVEL {
                return None;
            }
            begins |= inward > LEVEL;
        }
        Some(begins)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Generators, Space, breaks::breaks};
    use super::*;
    use crate::geometry::{Nm, Point, Polygon};

    /// From a place 3.3 mm away, as far from another corner, an edge of half a micrometre comes
    /// before the corner at its other end. A larger tie does not resolve the edge.
    #[test]
    fn a_short_edge_seen_from_afar_comes_before_the_corner_at_its_end() {
        let ring = |corners: &[(i64, i64)]| {
            corners.iter().map(|&(x, y)| Point::new(Nm::new(x), Nm::new(y))).collect::<Vec<_>>()
        };
        let (left, right, low, high) = (35_000_000, 52_000_000, 48_000_000, 62_000_000);
        let contours = vec![
            ring(&[(left, low), (right, low), (right, high), (left, high)]),
            ring(&[(41_697_900, 53_297_667), (41_698_333, 53_297_493), (41_690_000, 53_200_000)]),
            ring(&[(46_272_519, 56_261_000), (46_400_000, 56_300_000), (46_400_000, 56_200_000)]),
        ];
        let area = Polygon::new(contours).expect("a rectangle with two holes");
        let mut generators = Generators::new();
        generators.inside(&area, |ring| u32::try_from(ring).expect("three"));
        let mut diagram = Diagram::unwalked(generators, Kind::MedialAxis, Space::Within);
        diagram.breaks = breaks(&diagram.generators, &diagram.index, TIES[0]);
        diagram.walk_all(Space::Within, 1);
        assert_eq!(diagram.faults(), []);
    }
}
