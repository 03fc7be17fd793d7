//! Pocketing: an end mill clears areas to a flat floor, along nested loops that are linked where
//! material is gone already.
//!
//! ```text
//!   ┌──────────────────────────────┐    Inside out: down in a helix round the summit, along the innermost loop, on a spoke to the
//!   │ ╭────────────╮ ╭───────────╮ │    next one, and so on to the edge. Where two hills of the clearance meet in a saddle each
//!   │ │ ╭────────╮ ╰─╯ ╭───────╮ │ │    has its own way down, and the loops round both come last. Outside in: down along the
//!   │ │ │   ◎────┼──●  │   ◎   │ │ │    outermost loop, and from there inwards, with one plunge for each area.
//!   │ │ ╰────────╯ ╭─╮ ╰───────╯ │ │
//!   │ ╰────────────╯ ╰───────────╯ │
//!   └──────────────────────────────┘
//! ```
//!
//! Loops no farther apart than the mill's radius leave nothing between them: a place between two
//! levels is at most that far from the outer one, on the way straight to the edge. For the same
//! reason the spoke from a loop to the next lies within what is cleared.
//!
//! M. Held, *On the Computational Geometry of Pocket Machining*, LNCS 500, Springer 1991, ch. 6
//! (contour-parallel milling in a tree of loops).

mod course;
mod engagement;
mod links;

use crate::geometry::{Nm, Point, Segment, Turn, Vector};
use crate::toolpath::head::Head;
use crate::toolpath::order::{Order, Stretch, arrange};
use crate::toolpath::{Angle, Direction, Heights, Position, Section, Tool};
use crate::voronoi::fit_points;
use crate::voronoi::medial::nest::{Nest, Region};

use course::Spot;
use links::Links;

pub use engagement::{Clearings, Engagement, Engaging, Groove, ParseEngagementError, Planned};

/// In which order the loops of a pocket are milled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sequence {
    /// From each place that is farthest from the edge outwards.
    #[default]
    InsideOut,
    /// From the edge inwards.
    OutsideIn,
}

/// How far the loops of a pocket are from the edge, in nanometres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels {
    /// That of the loop along the edge.
    pub wall: f64,
    /// How much the loop before it leaves; zero where that is one step more.
    pub stock: f64,
    /// How far the others are apart.
    pub step: f64,
}

impl Levels {
    /// The clearance along the loops of a level, 0 being next to the edge.
    #[must_use]
    pub fn at(&self, level: usize) -> f64 {
        let number = f64::from(u32::try_from(level).unwrap_or(u32::MAX));
        if self.stock > 0.0 && level > 0 {
            self.wall + self.stock + self.step * (number - 1.0)
        } else {
            self.wall + self.step * number
        }
    }
}

/// How pockets are milled.
#[derive(Clone, Copy, Debug)]
pub struct Pocketing<'a> {
    /// The tool, an end mill.
    pub tool: &'a Tool,
    /// How high and deep, and how much a pass takes.
    pub heights: Heights,
    /// How far the loops are from the edge.
    pub levels: Levels,
    /// In which order.
    pub sequence: Sequence,
    /// Which way round: what is kept, and what is yet to be milled, on the right or on the left.
    pub direction: Direction,
    /// How steeply the tool goes down, below 90°.
    pub ramp: Angle,
    /// How far a loop may be off its place.
    pub tolerance: Nm,
    /// Of each loop whether all along it is cleared already, so that it need not be milled; empty
    /// for none.
    pub done: &'a [bool],
    /// How parts are cleared along the medial axis instead of in loops; none for loops alone.
    pub clearings: Option<&'a Clearings>,
}

/// How the tool came down into the material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Entries {
    /// How often, in all passes.
    pub all: usize,
    /// How often straight down, since there is no room for a ramp.
    pub straight: usize,
    /// How often since no way led to a loop through what was milled: never, unless the program is
    /// at fault.
    pub unlinked: usize,
}

/// A helix is as wide as there is room, up to this part of the tool's radius: then nothing stays
/// standing in its middle. Chosen.
const WIDEST: f64 = 0.8;

/// With less room than this part of the radius the tool goes down along the loop. Chosen: more
/// turns than that are slow.
const NARROWEST: f64 = 0.25;

/// Turns of a ramp along a loop that is shorter than the narrowest helix at most; where that is not
/// enough there is no room. Chosen.
const MOST_TURNS: f64 = 40.0;

/// How much farther than twice a step loops across the axis may be apart, in nanometres: rounding.
const SLACK: f64 = 5_000.0;

/// Mills the areas whose loops `nest` has, at these `levels`, on the machine.
#[must_use]
pub fn pocket(label: impl Into<String>, nest: &Nest, settings: &Pocketing<'_>) -> (Section, Entries) {
    let mut region_of = vec![0; nest.loops.len()];
    for (number, region) in nest.regions.iter().enumerate() {
        region.loops.iter().for_each(|&one| region_of[one] = number);
    }
    let mut miller = Miller {
        head: Head::new(settings.heights, settings.tool.plunge),
        nest,
        links: Links::new(nest, |level| settings.levels.at(level)),
        region_of,
        cut: vec![0; nest.loops.len()],
        pass: 0,
        at: None,
        depths: [Nm::ZERO; 2],
        entries: Entries::default(),
        settings,
    };
    for root in ordered(nest) {
        let mut before = Nm::ZERO;
        for depth in settings.heights.passes() {
            miller.pass(root, [before, depth]);
            before = depth;
        }
    }
    let Miller { head, entries, .. } = miller;
    (Section { tool: settings.tool.clone(), label: label.into(), moves: head.finish() }, entries)
}

/// The areas in an order of short travel.
fn ordered(nest: &Nest) -> Vec<usize> {
    let place = |&root: &usize| {
        let (x, y) = nest.loops[nest.regions[root].loops[0]].ring[0];
        Point::from_f64(x, y)
    };
    let stretches: Vec<Stretch> = nest.roots.iter().map(place).map(|at| Stretch::open(at, at)).collect();
    let legs = arrange(&stretches, Point::default(), Order::Improved, 0.0);
    legs.into_iter().map(|leg| nest.roots[leg.stretch]).collect()
}

/// The tool in a pass.
struct Miller<'a> {
    head: Head,
    nest: &'a Nest,
    links: Links,
    /// The region of each loop.
    region_of: Vec<usize>,
    /// The last pass in which each loop was milled.
    cut: Vec<u32>,
    pass: u32,
    /// The loop that the tool is on, and how far along it.
    at: Option<(usize, f64)>,
    /// How deep the pass before was, and how deep this one is.
    depths: [Nm; 2],
    entries: Entries,
    settings: &'a Pocketing<'a>,
}

impl Miller<'_> {
    /// Mills a root of the nest from a depth to another.
    fn pass(&mut self, root: usize, [before, depth]: [Nm; 2]) {
        let Pocketing { tool, direction, ramp, clearings, .. } = *self.settings;
        let place = self.nest.roots.iter().position(|&other| other == root);
        if let (Some(clearings), Some(place)) = (clearings, place)
            && clearings.mill(place, &mut self.head, [before, depth], tool, (ramp, direction))
        {
            self.entries.all += 1;
            return;
        }
        let layers = clearings.map_or(1, Clearings::layers);
        for layer in 1..=layers {
            self.pass += 1;
            self.at = None;
            self.depths = [layer - 1, layer].map(|number| before + (depth - before) * number / layers);
            match self.settings.sequence {
                Sequence::InsideOut => self.outwards(root),
                Sequence::OutsideIn => self.inwards(root),
            }
        }
    }

    /// Mills a region from its summits outwards.
    fn outwards(&mut self, region: usize) {
        for &child in &self.nest.regions[region].children {
            self.outwards(child);
        }
        let Region { loops, children, .. } = &self.nest.regions[region];
        if children.is_empty() && !loops.iter().any(|&one| self.is_done(one)) {
            self.enter_region(region);
        }
        self.finish(loops, &[]);
    }

    /// Mills a region from its outer loop inwards.
    fn inwards(&mut self, root: usize) {
        let mut all = self.within(root);
        all.sort_unstable();
        let is_finish = |one: usize| self.settings.levels.stock > 0.0 && self.nest.loops[one].level == 0;
        let (finish, rough): (Vec<usize>, Vec<usize>) = all.into_iter().partition(|&one| is_finish(one));
        let outer =
            |loops: &[usize]| loops.iter().copied().min_by_key(|&one| (self.nest.loops[one].level, one));
        if let Some(first) = outer(&rough).or_else(|| outer(&finish)).filter(|&first| !self.is_cut(first)) {
            self.enter_along(first, 0.0, true);
        }
        self.finish(&rough, &finish);
    }

    /// Mills what is not milled yet of loops, and then of others.
    fn finish(&mut self, loops: &[usize], last: &[usize]) {
        let outwards = self.settings.sequence == Sequence::InsideOut;
        while let Some(&next) = loops.iter().chain(last).find(|&&one| !self.is_cut(one)) {
            if self.advance(loops, outwards) || self.advance(last, true) {
                continue;
            }
            // Beside what was cleared before there may be no loop yet.
            self.entries.unlinked += usize::from(self.at.is_some() && self.settings.done.is_empty());
            self.enter_along(next, 0.0, true);
        }
    }

    /// All loops of a region and of those within it.
    fn within(&self, region: usize) -> Vec<usize> {
        let (mut found, mut open) = (Vec::new(), vec![region]);
        while let Some(next) = open.pop() {
            found.extend(&self.nest.regions[next].loops);
            open.extend(&self.nest.regions[next].children);
        }
        found
    }

    fn is_cut(&self, one: usize) -> bool {
        self.cut[one] == self.pass || self.is_done(one)
    }

    /// Whether all along a loop was cleared before.
    fn is_done(&self, one: usize) -> bool {
        self.settings.done.get(one).is_some_and(|&is_done| is_done)
    }

    /// Goes to the nearest of `loops` that is not milled yet, through what is, and mills it; false
    /// where no way leads there.
    fn advance(&mut self, loops: &[usize], outwards: bool) -> bool {
        let open: Vec<usize> = loops.iter().copied().filter(|&one| !self.is_cut(one)).collect();
        let (Some(at), false) = (self.at, open.is_empty()) else { return false };
        let is_open = |one: usize| open.binary_search(&one).is_ok() || open.contains(&one);
        for inwards in [!outwards, outwards] {
            let level = self.nest.loops[at.0].level;
            let found = self.links.spoke(at.0, level, at.1, inwards);
            if let Some((next, along)) = found.filter(|found| is_open(found.0)) {
                self.go_straight(next, along);
                self.mill(next, along, !inwards);
                return true;
            }
        }
        let mut route = self.links.route(at, |one| self.is_cut(one), is_open);
        if route.is_none() && self.join(&open) {
            route = self.links.route(at, |one| self.is_cut(one), is_open);
        }
        let Some((legs, (next, along))) = route else { return false };
        let last = legs.last().map_or(0, |leg| self.nest.loops[leg.0].level);
        for (number, from, to) in legs {
            self.go_straight(number, from);
            let course = &self.links.courses[number];
            let (length, forward) = course.shorter(from, to);
            let way = course.way(from, length, forward);
            self.follow(&way);
            self.at = Some((number, to));
        }
        self.go_straight(next, along);
        self.mill(next, along, last >= self.nest.loops[next].level);
        true
    }

    /// Joins loops across the axis: one that is milled and an open one of the same region.
    fn join(&mut self, open: &[usize]) -> bool {
        let mut regions: Vec<usize> = open.iter().map(|&one| self.region_of[one]).collect();
        regions.sort_unstable();
        regions.dedup();
        let mut is_joined = false;
        for region in regions {
            let level = self.nest.regions[region].level;
            let reach = 2.0 * (self.settings.levels.at(level + 1) - self.settings.levels.at(level)) + SLACK;
            let ours: Vec<usize> =
                open.iter().copied().filter(|&one| self.region_of[one] == region).collect();
            let is_cut: Vec<bool> = (0..self.cut.len()).map(|one| self.is_cut(one)).collect();
            let region_of = &self.region_of;
            let is_cut = |one: usize| is_cut[one] && region_of[one] == region;
            is_joined |= self.links.join(level, reach, is_cut, &ours);
        }
        is_joined
    }

    /// Once round a loop from a place of it, what is yet to be milled lying toward the wall or away
    /// from it.
    fn mill(&mut self, number: usize, along: f64, toward_wall: bool) {
        let course = &self.links.courses[number];
        let way = course.way(along, course.length(), self.is_forward(toward_wall));
        self.follow(&way);
        self.cut[number] = self.pass;
        self.at = Some((number, along));
    }

    /// Half of how wide the tool cuts, in nanometres.
    fn radius(&self) -> f64 {
        self.settings.tool.width_at(self.settings.heights.cut).to_f64() / 2.0
    }

    /// Whether loops are followed as they are, the edge on the left.
    const fn is_forward(&self, toward_wall: bool) -> bool {
        !self.settings.direction.reverses(toward_wall, false)
    }

    /// Straight to a place of a loop.
    fn go_straight(&mut self, number: usize, along: f64) {
        let (x, y) = self.links.courses[number].at(along);
        let to = Position::over(Point::from_f64(x, y), -self.depths[1]);
        self.head.feed_to(to, self.settings.tool.feed);
    }

    /// Along places from where the tool is, as few lines and arcs.
    fn follow(&mut self, places: &[Spot]) {
        let points = places.iter().map(|&(x, y)| Point::from_f64(x, y));
        if let Some(path) = fit_points(points, self.settings.tolerance) {
            self.head.follow(&path, self.settings.tool.feed);
        }
    }

    /// Down in a region without children, and round the loop nearest to its summit.
    fn enter_region(&mut self, region: usize) {
        let region = &self.nest.regions[region];
        let Some(summit) = region.summit else { return self.enter_along(region.loops[0], 0.0, true) };
        let courses = &self.links.courses;
        let near = |&one: &usize| {
            let (along, far) = courses[one].nearest(summit.at);
            (one, along, far)
        };
        let nearest = region.loops.iter().map(near).min_by(|a, b| a.2.total_cmp(&b.2));
        let Some((number, along, far)) = nearest else { return };
        let radius = self.radius();
        let room = (summit.clearance - self.settings.levels.wall).min(radius * WIDEST);
        if room < radius * NARROWEST {
            return self.enter_along(number, along, true);
        }
        let to = courses[number].at(along);
        let way =
            if far > 0.0 { ((to.0 - summit.at.0) / far, (to.1 - summit.at.1) / far) } else { (1.0, 0.0) };
        self.helix(summit.at, (way.0 * room, way.1 * room));
        self.go_straight(number, along);
        self.mill(number, along, true);
    }

    /// Down round a centre, from the place that is so far off it.
    fn helix(&mut self, (x, y): Spot, (right, up): Spot) {
        let center = Point::from_f64(x, y);
        let off = Vector::new(Nm::from_f64(right), Nm::from_f64(up));
        let [before, depth] = self.depths;
        self.head.over(center + off);
        self.head.plunge(before);
        let half = std::f64::consts::PI * off.length() * libm::tan(self.settings.ramp.radians());
        let halves = halves((depth - before).to_f64() / half.max(1.0));
        let turn = match self.settings.direction {
            Direction::Climb => Turn::CounterClockwise,
            Direction::Conventional => Turn::Clockwise,
        };
        // Two more, level, take what the last turn left standing.
        for number in 1..=halves + 2 {
            let to = if number % 2 == 1 { center + -off } else { center + off };
            let reached = before + (depth - before) * number.min(halves) / halves;
            self.head.cut(&Segment::Arc { to, center, turn }, reached, self.settings.tool.feed);
        }
        self.entries.all += 1;
    }

    /// Down along a loop from a place of it, and once round it.
    fn enter_along(&mut self, number: usize, along: f64, toward_wall: bool) {
        let [before, depth] = self.depths;
        let forward = self.is_forward(toward_wall);
        let course = &self.links.courses[number];
        let whole = course.length();
        let needed = (depth - before).to_f64() / libm::tan(self.settings.ramp.radians());
        let (x, y) = course.at(along);
        self.head.over(Point::from_f64(x, y));
        self.entries.all += 1;
        let mut from = along;
        let radius = self.radius();
        let narrowest = std::f64::consts::TAU * radius * NARROWEST;
        if whole < narrowest && needed > whole * MOST_TURNS {
            self.entries.straight += 1;
            self.head.plunge(depth);
        } else {
            self.head.plunge(before);
            let mut gone = 0.0;
            while gone < needed {
                let length = (needed - gone).min(whole);
                gone += length;
                let way = course.way(from, length, forward);
                let reached = before + Nm::from_f64((depth - before).to_f64() * (gone / needed).min(1.0));
                descend(&mut self.head, &way, reached, self.settings);
                from = if forward { from + length } else { from - length }.rem_euclid(whole);
            }
        }
        self.go_straight(number, from);
        self.mill(number, from, toward_wall);
    }
}

/// Evenly down along places from where the tool is.
fn descend(head: &mut Head, places: &[Spot], depth: Nm, settings: &Pocketing<'_>) {
    let points = places.iter().map(|&(x, y)| Point::from_f64(x, y));
    if let Some(path) = fit_points(points, settings.tolerance) {
        head.descend(&path, depth, settings.tool.feed);
    }
}

/// So many half turns, an even number.
#[expect(clippy::cast_possible_truncation, reason = "`as` saturates")]
fn halves(number: f64) -> i64 {
    ((number / 2.0).ceil() as i64).max(1) * 2
}
