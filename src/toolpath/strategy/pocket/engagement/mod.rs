//! Constant engagement: a pocket is cleared in arcs along its medial axis, so that the tool never
//! meets material along more of its circumference than it is asked to.
//!
//! ```text
//!   ┌───────────────────────────┐    Down in a helix where the pocket is widest, in a spiral to the largest circle there, and in arcs
//!   │╲    ╭──────╮╮╮╮╮╮╮╮    ╱  │    along each branch of the axis to its end. What is cleared is known, so nothing is cut twice where
//!   │  ●  │  ◎   ││││││││─ ●    │    branches meet round an island. Last comes a loop along the wall, which takes what is left between
//!   │╱    ╰──────╯╯╯╯╯╯╯╯    ╲  │    the circles.
//!   └───────────────────────────┘
//! ```
//!
//! Where the pocket is hardly wider than the tool nothing helps: there it mills a groove in its
//! full width, in layers so shallow that it bears no more than elsewhere.
//!
//! G. Elber, E. Cohen, S. Drake, *MATHSM: Medial axis transform toward high speed machining of
//! pockets*, Computer-Aided Design 37 (2005), 241–250. OpenVoronoi (A. Wallin) clears pockets like
//! this, too. The medial axis and the loop are those of M. Held, *On the Computational Geometry of
//! Pocket Machining*, LNCS 500, Springer 1991.

mod axis;
mod clearing;
mod contact;
mod path;
mod target;
mod wall;

use rayon::prelude::*;

use crate::geometry::{Nm, Point, Segment, Turn, Vector};
use crate::toolpath::head::Head;
use crate::toolpath::{Angle, Direction, Position, Tool};
use crate::voronoi::fit_points;
use crate::voronoi::medial::nest::Nest;
use crate::voronoi::medial::{Interior, MedialAxis, Pruning};

use super::course::{Course, Spot};
use super::{Levels, halves};

use axis::Graph;
use clearing::{Bounds, Clearer, Clearing};
use path::Piece;
use wall::Wall;

pub use target::{Engagement, ParseEngagementError};

/// How a pocket is cleared along its medial axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Engaging {
    /// What the tool may bear.
    pub target: Engagement,
    /// Whether every other arc goes the other way round, so that no way back is needed.
    pub both_ways: bool,
}

/// A place that the tool mills in its full width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Groove {
    /// Where it is narrowest.
    pub at: Point,
    /// How wide the pocket is there.
    pub width: Nm,
    /// How long it is.
    pub length: Nm,
}

/// How the parts of pockets are cleared.
#[derive(Clone, Debug)]
pub struct Clearings {
    /// Of each root of the nest; none where there is no room for a helix.
    parts: Vec<Option<Clearing>>,
    layers: i64,
    /// Where the tool mills in its full width.
    pub grooves: Vec<Groove>,
    /// Where a part is wide enough for arcs and is milled in loops, and whether because it would
    /// take too many; else its axis is faulty.
    pub looped: Vec<(Point, bool)>,
}

/// A helix needs this part of the tool's radius as room for its middle. Chosen.
const ROOM: f64 = 0.1;

/// Branches of the axis that matter less are left out, in nanometres. Chosen: half of what a
/// program may be off.
const LOSS: f64 = 1_000.0;

/// How much less than asked for layers load the tool. Chosen.
const LESS: f64 = 0.9;

/// The part of the contact asked for that arcs are planned with. Chosen: burrs of other arcs add to
/// it.
const PLANNED: f64 = 0.95;

/// How much of what the stock would leave of the room is left at most, so that it ends where the
/// axis does: in a corner the tool would meet it all round. Chosen.
const TAPER: f64 = 0.25;

/// What clearings are planned for.
#[derive(Clone, Copy)]
pub struct Planned<'a> {
    /// The pockets, and their loops along the wall.
    pub areas: &'a [Interior<'a>],
    /// The loops; only those of the first level are milled.
    pub nest: &'a Nest,
    /// The tool.
    pub tool: &'a Tool,
    /// How far the loop along the wall is from it, and what is left for it.
    pub levels: Levels,
    /// Which way round.
    pub direction: Direction,
    /// How far the loop may be off its place.
    pub tolerance: Nm,
    /// What the tool may bear.
    pub engaging: Engaging,
}

impl Clearings {
    /// Plans how areas are cleared.
    #[must_use]
    pub fn new(planned: &Planned<'_>) -> Self {
        let radius = planned.tool.width_at(Nm::ZERO).to_f64() / 2.0;
        let contact = planned.engaging.target.contact();
        let of_area = |area: &Interior<'_>| parts(area, planned, radius);
        let found: Vec<_> = planned.areas.par_iter().flat_map_iter(of_area).collect();
        let mut made = Self {
            parts: vec![None; planned.nest.roots.len()],
            layers: Nm::from_f64((std::f64::consts::PI / (contact * LESS)).ceil()).get(),
            grooves: Vec::new(),
            looped: Vec::new(),
        };
        let mut is_large = vec![false; planned.nest.roots.len()];
        for (root, clearing) in found {
            is_large[root] = clearing.is_none();
            made.parts[root] = clearing;
        }
        let width = |room: f64| Nm::from_f64(2.0 * (room + planned.levels.wall));
        for ((part, is_large), &root) in made.parts.iter().zip(is_large).zip(&planned.nest.roots) {
            let Some(clearing) = part else {
                let region = &planned.nest.regions[root];
                let ring = &planned.nest.loops[region.loops[0]].ring;
                let at = Point::from_f64(ring[0].0, ring[0].1);
                if !region.children.is_empty() {
                    made.looped.push((at, is_large));
                    continue;
                }
                let length = Nm::from_f64(Course::new(ring.clone()).length() / 2.0);
                made.grooves.push(Groove { at, width: width(0.0), length });
                continue;
            };
            made.grooves.extend(clearing.grooves.iter().map(|&(place, length)| Groove {
                at: Point::from_f64(place.at.0, place.at.1),
                width: width(place.clearance),
                length: Nm::from_f64(length),
            }));
        }
        made
    }

    /// In how many layers what the tool mills in its full width is milled in each pass.
    #[must_use]
    pub const fn layers(&self) -> i64 {
        self.layers
    }

    /// Whether a root of the nest, by its place among them, is cleared along the axis.
    #[must_use]
    pub fn has(&self, root: usize) -> bool {
        self.parts.get(root).is_some_and(Option::is_some)
    }

    /// Mills a root of the nest from a depth to another; false where it is not cleared along the
    /// axis.
    pub(super) fn mill(
        &self,
        root: usize,
        head: &mut Head,
        depths: [Nm; 2],
        tool: &Tool,
        (ramp, direction): (Angle, Direction),
    ) -> bool {
        let Some(clearing) = self.parts.get(root).and_then(Option::as_ref) else { return false };
        let turn = match direction {
            Direction::Climb => Turn::CounterClockwise,
            Direction::Conventional => Turn::Clockwise,
        };
        let mut down = Down { head, depths, layers: self.layers, tool };
        down.helix(clearing, ramp, turn);
        for piece in &clearing.pieces {
            down.piece(piece);
        }
        true
    }
}

/// The parts of an area, each with the number of its root among those of the nest; none of one that
/// takes too many circles.
fn parts(area: &Interior<'_>, planned: &Planned<'_>, radius: f64) -> Vec<(usize, Option<Clearing>)> {
    let axis = MedialAxis::new(std::slice::from_ref(area), &Pruning { loss: LOSS, corner: 1.0 });
    if !axis.faults.is_empty() {
        return Vec::new();
    }
    let graph = Graph::new(&axis, planned.levels.wall, planned.levels.stock, TAPER);
    let is_wide = |root: &usize| graph.nodes[*root].clearance >= ROOM * radius;
    let bounds = Bounds {
        radius,
        contact: planned.engaging.target.contact() * PLANNED,
        helix: radius * super::WIDEST,
        is_counter_clockwise: planned.direction == Direction::Climb,
        both_ways: planned.engaging.both_ways,
    };
    let wall = Wall::new(area.area(), planned.levels.wall);
    let part = |node: usize| {
        let root = planned.nest.root_at(graph.nodes[node].at)?;
        let clearer = Clearer::run(&graph, &wall, node, bounds);
        Some((root, clearer.map(|clearer| walls(clearer, root, planned))))
    };
    graph.roots().into_iter().filter(is_wide).filter_map(part).collect()
}

/// Adds the loops along the wall.
fn walls(mut clearer: Clearer<'_>, root: usize, planned: &Planned<'_>) -> Clearing {
    let nest = planned.nest;
    for &number in &nest.regions[nest.roots[root]].loops {
        let course = Course::new(nest.loops[number].ring.clone());
        let nearest = |at: Spot| {
            let (along, off) = course.nearest(at);
            (along, off, course.at(along))
        };
        let along = clearer.go_to_wall(nearest);
        let way = course.way(along, course.length(), !planned.direction.reverses(true, false));
        let points = way.iter().map(|&(x, y)| Point::from_f64(x, y));
        if let Some(path) = fit_points(points, planned.tolerance) {
            clearer.follow_wall(path.segments);
        }
    }
    clearer.finish()
}

/// The tool in a pass.
struct Down<'a> {
    head: &'a mut Head,
    /// How deep the pass before was, and how deep this one is.
    depths: [Nm; 2],
    layers: i64,
    tool: &'a Tool,
}

impl Down<'_> {
    /// Down in a helix no steeper than `ramp`, so that a turn takes no more than a layer.
    fn helix(&mut self, clearing: &Clearing, ramp: Angle, turn: Turn) {
        let [before, depth] = self.depths;
        let center = Point::from_f64(clearing.root.0, clearing.root.1);
        let off = Vector::new(Nm::from_f64(clearing.helix), Nm::ZERO);
        self.head.over(center + off);
        self.head.plunge(before);
        let half = (std::f64::consts::PI * clearing.helix * libm::tan(ramp.radians()))
            .min((depth - before).to_f64() / (2.0 * Nm::new(self.layers).to_f64()));
        let halves = halves((depth - before).to_f64() / half.max(1.0));
        // Two more, level, take what the last turn left standing.
        for number in 1..=halves + 2 {
            let to = if number % 2 == 1 { center + -off } else { center + off };
            let reached = before + (depth - before) * number.min(halves) / halves;
            self.head.cut(&Segment::Arc { to, center, turn }, reached, self.tool.feed);
        }
    }

    fn piece(&mut self, piece: &Piece) {
        let [before, depth] = self.depths;
        let feed = self.tool.feed;
        match piece {
            Piece::Cut(path) => self.follow(path, depth),
            Piece::Link(path) => self.link(path),
            Piece::Groove(spots) => {
                let points: Vec<Point> = spots.iter().map(|&(x, y)| Point::from_f64(x, y)).collect();
                for layer in 1..=self.layers {
                    let reached = before + (depth - before) * layer / self.layers;
                    self.head.feed_to(Position::over(points[0], -reached), feed);
                    for &point in &points[1..] {
                        self.head.feed_to(Position::over(point, -reached), feed);
                    }
                    let back = points.iter().rev().skip(1).filter(|_| layer < self.layers);
                    for &point in back {
                        self.head.feed_to(Position::over(point, -reached), feed);
                    }
                }
            }
            Piece::Layers(path) => {
                let Some(start) = self.head.at() else { return };
                for layer in 1..=self.layers {
                    let reached = before + (depth - before) * layer / self.layers;
                    if let Some(at) = self.head.at() {
                        self.head.feed_to(Position { z: at.z, ..start }, feed);
                    }
                    self.head.feed_to(Position::over(start.point(), -reached), feed);
                    self.follow(path, reached);
                }
            }
        }
    }

    /// Through what is cleared, lifted off the floor unless it is a short way.
    fn link(&mut self, path: &[Segment]) {
        let [before, depth] = self.depths;
        let feed = self.tool.feed;
        let lifted = depth - LIFT.min((depth - before) / 4);
        let Some(mut at) = self.head.at() else { return };
        let mut length = 0.0;
        for segment in path {
            length += segment.length(at.point());
            at = Position::over(segment.to(), at.z);
        }
        let is_bent = path.len() > 2;
        if !is_bent && length <= self.tool.width_at(Nm::ZERO).to_f64() {
            return self.follow(path, depth);
        }
        if !is_bent && let Some(at) = self.head.at() {
            self.head.feed_to(Position { z: -lifted, ..at }, feed);
        }
        for (segment, number) in path.iter().zip(1..) {
            self.head.cut(segment, if is_bent && number == path.len() { depth } else { lifted }, feed);
        }
        if let Some(at) = self.head.at() {
            self.head.feed_to(Position { z: -depth, ..at }, feed);
        }
    }

    fn follow(&mut self, path: &[Segment], depth: Nm) {
        for segment in path {
            self.head.cut(segment, depth, self.tool.feed);
        }
    }
}

/// How far above the floor ways through what is cleared lead. Chosen: enough for the tool not to
/// rub on it.
const LIFT: Nm = Nm::from_um(200);
