//! One connected part of a pocket is cleared from its widest place along the medial axis.
//!
//! ```text
//!   ──────────────────────────    From a circle that is cleared to the farthest one along the axis round which the tool nowhere meets
//!    ╭───╮ ╭╮ ╭╮ ╭╮                material along more of its circumference than is asked for. Only where it meets some it is followed:
//!   │  ●──┼─┼┼─┼┼─┼┼──→ axis      an arc, a *cut*; the way to the next one leads through what is cleared. Where the axis branches one
//!    ╰───╯ ╰╯ ╰╯ ╰╯                branch is cleared after the other, and where branches meet again what is left between them.
//!   ──────────────────────────
//! ```

use std::f64::consts::PI;

use crate::geometry::{Point, Segment, Turn, between};
use crate::toolpath::strategy::pocket::course::{Spot, distance};
use crate::voronoi::medial::Place;

use super::axis::{Edge, Graph};
use super::contact::Cleared;
use super::path::{Piece, arc, pulled, tangent_link};
use super::wall::Wall;

/// Material along less of the circumference is none, in radians. Chosen: 2.5°, a burr of a
/// thousandth of the radius.
const MEETS: f64 = 0.044;

/// Along so much of its circumference the tool may touch what is not cleared on ways through what
/// is, in nanometres: a corner of an island that it cuts off is half as deep. Chosen.
const TOUCHES: f64 = 1_000.0;

/// Circles farther apart than this part of the tool's radius leave too much along the wall. Chosen.
const FARTHEST: f64 = 0.4;

/// What reaches beyond the last circle by less than this part of the radius is left to the loop
/// along the wall. Chosen.
const LEFT: f64 = 0.012;

/// How much farther than planned the wall of what is cleared may be, as a part of the tool's
/// radius. Chosen: more than burrs that are left out, and rounding.
const OFF: f64 = 0.006;

/// So much farther the tool goes to where the loop along the wall is as near as the last circle,
/// for each length that it is not: there it need not mill through the stock. Chosen.
const FAR: f64 = 1000.0;

/// No groove is worth its while for what reaches beyond the last circle by less than this part of
/// the radius. Chosen.
const SHORT: f64 = 0.03;

/// Where the tool's middle has less room to either side than this part of the radius a groove takes
/// less time than circles. Chosen: circles as small are fifteen times as long as the axis.
const NARROW: f64 = 0.05;

/// Circles that are smaller are less than machines are precise, in nanometres. Chosen.
const SMALLEST: f64 = 5_000.0;

/// An arc begins so many steps of a twentieth of the radius earlier, at most, where the tool
/// touches less than counts. Chosen: a tool's width.
const MOST_STEPS_BACK: u32 = 40;

/// Circles of one part of a pocket at most. Chosen: a minute of planning.
const MOST_CIRCLES: usize = 200_000;

/// How one connected part is cleared, seen from above.
#[derive(Clone, Debug)]
pub(super) struct Clearing {
    /// Where the tool goes down.
    pub(super) root: Spot,
    /// How wide the helix is.
    pub(super) helix: f64,
    pub(super) pieces: Vec<Piece>,
    /// Where a groove as wide as the tool is milled: the place, the room that the tool's middle has
    /// to either side, and how long the groove is.
    pub(super) grooves: Vec<(Place, f64)>,
}

/// The tool and what it may bear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) radius: f64,
    /// Along how much of its circumference it may meet material, in radians.
    pub(super) contact: f64,
    /// How wide the helix may be.
    pub(super) helix: f64,
    pub(super) is_counter_clockwise: bool,
    pub(super) both_ways: bool,
}

impl Bounds {
    /// Along how much of its circumference the tool may meet material on ways between cuts.
    fn touches(&self) -> f64 {
        (TOUCHES / self.radius).min(MEETS)
    }
}

/// A tool that clears.
pub(super) struct Clearer<'a> {
    graph: &'a Graph,
    bounds: Bounds,
    cleared: Cleared,
    wall: &'a Wall,
    is_done: Vec<bool>,
    is_reached: Vec<bool>,
    clearing: Clearing,
    /// Where the tool is, and the circle that it is on.
    at: Spot,
    circle: Option<Place>,
    /// The way along the axis from that circle to the place that is looked at.
    trail: Vec<Spot>,
    /// From there to the last node.
    back: Vec<Spot>,
    node: usize,
    is_counter_clockwise: bool,
    circles: usize,
}

impl<'a> Clearer<'a> {
    /// Clears all that is connected with `root`, a node; none where that is more than is bounded.
    pub(super) fn run(graph: &'a Graph, wall: &'a Wall, root: usize, bounds: Bounds) -> Option<Self> {
        let mut clearer = Self::new(graph, wall, root, bounds);
        clearer.spiral();
        let mut open = vec![root];
        while let Some(&node) = open.last() {
            let Some(number) = clearer.next(node) else {
                open.pop();
                continue;
            };
            clearer.is_done[number] = true;
            clearer.go_back(node);
            let edge = &graph.edges[number];
            let edge = if edge.ends[0] == node { edge.clone() } else { edge.reversed() };
            clearer.follow(&edge);
            if clearer.circles > MOST_CIRCLES {
                return None;
            }
            if !std::mem::replace(&mut clearer.is_reached[edge.ends[1]], true) {
                open.push(edge.ends[1]);
            }
        }
        Some(clearer)
    }

    fn new(graph: &'a Graph, wall: &'a Wall, root: usize, bounds: Bounds) -> Self {
        let Place { at, clearance } = graph.nodes[root];
        let far = |(x, y): Spot, by: f64| [x - by, y - by, x + by, y + by];
        let reached = graph.ways(root, |_| true);
        let places = graph.nodes.iter().zip(&reached).filter(|(_, reached)| reached.far.is_finite());
        let along = graph.edges.iter().filter(|edge| reached[edge.ends[0]].far.is_finite());
        let places = places.map(|(node, _)| node).chain(along.flat_map(|edge| &edge.course));
        let around = places.fold(far(at, 0.0), |[a, b, c, d], place| {
            let [left, bottom, right, top] = far(place.at, place.clearance + 3.0 * bounds.radius);
            [a.min(left), b.min(bottom), c.max(right), d.max(top)]
        });
        let mut is_reached = vec![false; graph.nodes.len()];
        is_reached[root] = true;
        let helix = bounds.helix.min(clearance);
        Self {
            graph,
            bounds,
            cleared: Cleared::new(bounds.radius, around),
            wall,
            is_done: vec![false; graph.edges.len()],
            is_reached,
            clearing: Clearing { root: at, helix, pieces: Vec::new(), grooves: Vec::new() },
            at: (at.0 + helix, at.1),
            circle: Some(graph.nodes[root]),
            trail: vec![at],
            back: Vec::new(),
            node: root,
            is_counter_clockwise: bounds.is_counter_clockwise,
            circles: 0,
        }
    }

    pub(super) fn finish(self) -> Clearing {
        self.clearing
    }

    /// The next edge from a node: those that end there first, and shorter ones first.
    fn next(&self, node: usize) -> Option<usize> {
        let open = self.graph.at[node].iter().copied().filter(|&number| !self.is_done[number]);
        let key = |&number: &usize| (!self.is_leaf(number), self.graph.edges[number].length());
        open.min_by(|a, b| {
            let [a, b] = [key(a), key(b)];
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    }

    /// Whether the axis ends with an edge.
    fn is_leaf(&self, number: usize) -> bool {
        self.graph.edges[number].ends.iter().any(|&end| self.graph.at[end].len() == 1)
    }

    /// From the helix to the largest circle round it, in half circles that grow.
    fn spiral(&mut self) {
        let Place { at: root, clearance } = self.graph.nodes[self.node];
        let (tool, turn) = (self.bounds.radius, turn(self.is_counter_clockwise));
        let (mut reached, mut side) = (self.clearing.helix, 1.0);
        let mut path = Vec::new();
        let mut half = |from: f64, to: f64| {
            let center = (root.0 + side * (from - to) / 2.0, root.1);
            side = -side;
            let at = (root.0 + side * to, root.1);
            path.push(Segment::Arc { to: point(at), center: point(center), turn });
            at
        };
        while reached < clearance {
            // A turn that grows by so much meets a little less than it may.
            let cosine = libm::cos(self.bounds.contact * 0.93);
            let inner = (reached * reached + tool * tool + 2.0 * reached * tool * cosine).sqrt();
            let next = (reached + (reached + tool - inner) / 2.0).min(clearance);
            self.at = half(reached, next);
            if next >= clearance {
                half(clearance, clearance);
                self.at = half(clearance, clearance);
            }
            reached = next;
        }
        if !path.is_empty() {
            self.clearing.pieces.push(Piece::Cut(path));
        }
        self.cleared.add(root, clearance);
    }

    /// Clears along an edge from its beginning.
    fn follow(&mut self, edge: &Edge) {
        let is_leaf = self.graph.at[edge.ends[1]].len() == 1;
        let tool = self.bounds.radius;
        let length = edge.length();
        let (mut along, mut guess) = (0.0, tool * 0.1);
        while along < length && self.circles <= MOST_CIRCLES {
            if is_leaf && excess(edge, along) <= LEFT * tool {
                self.back = places(&edge.part(0.0, along));
                self.back.reverse();
                return;
            }
            let next = match self.groove_end(edge, along, is_leaf) {
                Some(end) => {
                    self.groove(edge, along, (end + tool * 0.15).min(length));
                    end
                }
                None => {
                    let found = self.farthest(edge, along, guess);
                    let next = found.unwrap_or_else(|| (along + guess).min(length));
                    self.trail.extend(places(&edge.part(along, next)));
                    self.round(edge.at(next), found.is_none());
                    next
                }
            };
            guess = (next - along).clamp(tool * 0.002, tool * FARTHEST);
            along = next;
        }
        self.back.clear();
        self.node = edge.ends[1];
    }

    /// To where a groove leads that begins here, if one does.
    fn groove_end(&self, edge: &Edge, along: f64, is_leaf: bool) -> Option<f64> {
        let tool = self.bounds.radius;
        let narrow = NARROW * tool;
        if edge.at(along).clearance >= narrow {
            return None;
        }
        let mut end = along;
        while end < edge.length() && edge.at(end).clearance < narrow {
            end += tool * 0.02;
        }
        let end = end.min(edge.length());
        // In a corner that is not sharp a few small circles are less.
        let is_short = is_leaf && end >= edge.length() && excess(edge, along) < SHORT * tool;
        let is_tiny = edge.at(along).clearance < SMALLEST;
        (is_tiny || !is_short).then_some(end)
    }

    /// Mills along the axis in the tool's full width.
    fn groove(&mut self, edge: &Edge, from: f64, to: f64) {
        let tool = self.bounds.radius;
        let way = edge.part(from, to);
        self.go(way[0].at);
        let narrowest = way.iter().copied().min_by(|a, b| a.clearance.total_cmp(&b.clearance));
        if to - from > tool * 0.5 {
            self.clearing.grooves.extend(narrowest.map(|place| (place, to - from)));
        }
        let steps = ((to - from) / (tool * 0.05)).ceil().max(1.0);
        let mut step = 0.0;
        while step <= steps {
            self.cleared.add(edge.at(from + (to - from) * step / steps).at, 0.0);
            step += 1.0;
        }
        let spots = places(&way);
        self.at = spots[spots.len() - 1];
        self.trail = vec![self.at];
        self.circle = None;
        self.clearing.pieces.push(Piece::Groove(spots));
    }

    /// The farthest place along an edge round which the tool bears no more than it may; none if it
    /// bears more however near.
    fn farthest(&mut self, edge: &Edge, along: f64, guess: f64) -> Option<f64> {
        let tool = self.bounds.radius;
        let most = (edge.length() - along).min(tool * FARTHEST);
        let (mut good, mut bad) = (0.0, f64::INFINITY);
        let mut trial = guess.min(most);
        loop {
            if self.bears(edge.at(along + trial)) {
                good = trial;
                if good >= most {
                    return Some(along + most);
                }
                trial = (trial * 1.5).min(most).min(if bad.is_finite() { bad } else { most });
            } else {
                bad = trial;
                trial *= 0.5;
                if trial < tool * 0.0005 {
                    return None;
                }
            }
            if good > 0.0 && bad.is_finite() {
                break;
            }
        }
        while bad - good > good * 0.03 {
            let middle = f64::midpoint(good, bad);
            if self.bears(edge.at(along + middle)) { good = middle } else { bad = middle }
        }
        Some(along + good)
    }

    /// Whether the tool bears no more than it may all round a circle.
    fn bears(&mut self, place: Place) -> bool {
        // On a small circle what a place is off changes the angle most.
        let cosine = libm::cos(self.bounds.contact);
        let less = (OFF * self.bounds.radius / place.clearance.max(1.0)).min((1.0 - cosine) / 2.0);
        let most = libm::acos(cosine + less);
        let count = (2.0 * PI * place.clearance / (self.bounds.radius / 6.0)).clamp(48.0, 720.0).round();
        let mut step = 0.0;
        while step < count {
            let (at, heading) = on(place, 2.0 * PI * step / count, self.is_counter_clockwise);
            if self.cleared.contact(at, heading) > most {
                return false;
            }
            step += 1.0;
        }
        true
    }

    /// Whether a tool at an angle on a circle meets material.
    fn meets(&mut self, place: Place, angle: f64) -> bool {
        let (at, heading) = on(place, angle, self.is_counter_clockwise);
        self.cleared.contact(at, heading) > MEETS
    }

    /// From which angles on, and how far, a tool meets material on a circle, in the order of its
    /// way: each with the angle turned, positive counter-clockwise.
    fn arcs(&mut self, place: Place) -> Vec<(f64, f64)> {
        let way = if self.is_counter_clockwise { 1.0 } else { -1.0 };
        let count = (2.0 * PI * place.clearance / (self.bounds.radius / 10.0)).clamp(64.0, 1440.0).round();
        let step = way * 2.0 * PI / count;
        let mut meets = Vec::new();
        let mut number = 0.0;
        while number < count {
            meets.push(self.meets(place, step * number));
            number += 1.0;
        }
        let n = meets.len();
        let Some(gap) = longest_gap(&meets) else {
            return if n > 0 && meets[0] { vec![(self.angle(place), way * 2.0 * PI)] } else { Vec::new() };
        };
        // Begins after the longest gap; shorter ones than an eighth of a turn are not worth a link.
        let lead = (self.bounds.radius * 0.05 / place.clearance.max(1.0)).min(0.15);
        let mut found: Vec<(f64, f64)> = Vec::new();
        let mut i = 0;
        while i < n {
            if !meets[(gap + i) % n] {
                i += 1;
                continue;
            }
            let first = i;
            while i < n && meets[(gap + i) % n] {
                i += 1;
            }
            let number = |i: usize| step * f64::from(u32::try_from(gap + i).unwrap_or(0));
            let begin = self.edge_of(place, number(first) - step, number(first)) - way * lead;
            let begin = self.untouched(place, begin, way * lead);
            let end = self.edge_of(place, number(i), number(i - 1)) + way * lead;
            match found.last_mut() {
                Some(last) if ((begin - last.1) * way) < PI / 4.0 => last.1 = end,
                _ => found.push((begin, end)),
            }
        }
        found.into_iter().map(|(begin, end)| (begin, end - begin)).collect()
    }

    /// The angle between one at which the tool meets nothing and one at which it does.
    fn edge_of(&mut self, place: Place, mut clear: f64, mut met: f64) -> f64 {
        for _ in 0..6 {
            let middle = f64::midpoint(clear, met);
            if self.meets(place, middle) { met = middle } else { clear = middle }
        }
        clear
    }

    /// The angle, so far back from one in steps, at which a tool touches nothing: of each arc that
    /// begins too late a burr is left, and where many begin side by side they add up.
    fn untouched(&mut self, place: Place, mut angle: f64, step: f64) -> f64 {
        for _ in 0..MOST_STEPS_BACK {
            let (at, heading) = on(place, angle, self.is_counter_clockwise);
            if self.cleared.touch(at, heading) <= 0.0 {
                break;
            }
            angle -= step;
        }
        angle
    }

    /// The direction of the tool from the middle of a circle.
    fn angle(&self, place: Place) -> f64 {
        libm::atan2(self.at.1 - place.at.1, self.at.0 - place.at.0)
    }

    /// Round a circle, where there is material.
    fn round(&mut self, place: Place, in_layers: bool) {
        self.circles += 1;
        let arcs = self.arcs(place);
        for &(from, turned) in &arcs {
            let (start, _) = on(place, from, true);
            self.go_to_circle(place, from, start);
            let path = arc(place.at, place.clearance, from, turned);
            self.at = on(place, from + turned, true).0;
            self.clearing.pieces.push(if in_layers { Piece::Layers(path) } else { Piece::Cut(path) });
            self.trail = vec![place.at];
            self.circle = Some(place);
        }
        if !arcs.is_empty() && self.bounds.both_ways {
            self.is_counter_clockwise = !self.is_counter_clockwise;
        }
        self.cleared.add(place.at, place.clearance);
    }

    /// To where a cut begins: on a curve without corners, if that is clear.
    fn go_to_circle(&mut self, place: Place, angle: f64, start: Spot) {
        if let Some(from) = self.circle.filter(|_| !self.bounds.both_ways) {
            let heads = [self.angle(from), angle];
            let turn = turn(self.is_counter_clockwise);
            if let Some((path, spots)) = tangent_link([from, place], heads, turn)
                && spots.windows(2).all(|pair| self.is_clear(pair[0], pair[1]))
            {
                self.clearing.pieces.push(Piece::Link(path));
                self.at = start;
                return;
            }
        }
        self.trail.push(place.at);
        self.go(start);
    }

    /// Whether the tool meets nothing on a straight way.
    fn is_clear(&mut self, from: Spot, to: Spot) -> bool {
        self.cleared.is_clear(from, to, self.bounds.touches()) && self.wall.is_free(from, to)
    }

    /// To a place through what is cleared: straight, or along the axis, as straight as may be.
    fn go(&mut self, to: Spot) {
        if distance(self.at, to) < 1.0 {
            return;
        }
        if self.is_clear(self.at, to) {
            self.clearing.pieces.push(Piece::Link(vec![Segment::Line { to: point(to) }]));
        } else {
            let way: Vec<Spot> =
                std::iter::once(self.at).chain(self.trail.iter().copied()).chain([to]).collect();
            let way = pulled(&way, |a, b| self.is_clear(a, b));
            let most = self.bounds.contact * 0.7;
            // What is not clear is milled in layers.
            self.clearing.pieces.push(
                if way.windows(2).all(|pair| self.cleared.is_clear(pair[0], pair[1], most)) {
                    Piece::Link(way.iter().skip(1).map(|&spot| Segment::Line { to: point(spot) }).collect())
                } else {
                    Piece::Groove(way)
                },
            );
        }
        self.at = to;
    }

    /// Looks at a node that was cleared before.
    fn go_back(&mut self, node: usize) {
        let back = std::mem::take(&mut self.back);
        self.trail.extend(back);
        if self.node != node {
            let reached = self.graph.ways(self.node, |number| self.is_done[number]);
            self.trail.extend(self.graph.way(&reached, node));
            self.node = node;
        }
    }

    /// To a place on a loop along the wall, from the nearest node that has it within its circle;
    /// `nearest` is where the loop is nearest to a place, and how far off.
    pub(super) fn go_to_wall(&mut self, nearest: impl Fn(Spot) -> (f64, f64, Spot)) -> f64 {
        let reached = self.graph.ways(self.node, |number| self.is_done[number]);
        let near = (0..reached.len()).filter(|&node| reached[node].far.is_finite());
        let key = |node: usize| {
            let (along, off, at) = nearest(self.graph.nodes[node].at);
            let miss = (off - self.graph.nodes[node].clearance).max(0.0);
            (reached[node].far + FAR * miss, node, along, at)
        };
        let best = near.map(key).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some((_, node, along, at)) = best else { return 0.0 };
        self.go_back(node);
        let Place { at: center, clearance } = self.graph.nodes[node];
        let off = distance(center, at);
        if off > clearance + LEFT * self.bounds.radius {
            // Through the stock, in layers.
            let inner = between(center, at, clearance / off);
            self.go(inner);
            self.clearing.pieces.push(Piece::Groove(vec![inner, at]));
            self.at = at;
        } else {
            self.go(at);
        }
        along
    }

    /// Once round a loop that ends where it begins.
    pub(super) fn follow_wall(&mut self, path: Vec<Segment>) {
        self.clearing.pieces.push(Piece::Cut(path));
        self.trail = vec![self.graph.nodes[self.node].at];
        self.circle = None;
    }
}

/// The place on a circle at an angle, and the direction of the way round there.
fn on(place: Place, angle: f64, is_counter_clockwise: bool) -> (Spot, Spot) {
    let (up, right) = libm::sincos(angle);
    let at = (place.at.0 + place.clearance * right, place.at.1 + place.clearance * up);
    (at, if is_counter_clockwise { (-up, right) } else { (up, -right) })
}

/// How far circles along the rest of an edge reach beyond the one at a place of it.
fn excess(edge: &Edge, along: f64) -> f64 {
    let from = edge.at(along);
    let beyond = |place: &Place| distance(place.at, from.at) + place.clearance - from.clearance;
    edge.part(along, edge.length()).iter().map(beyond).fold(0.0, f64::max)
}

/// Where after the longest run of `false` the first `true` is; none without both.
fn longest_gap(meets: &[bool]) -> Option<usize> {
    let n = meets.len();
    let mut best: Option<(usize, usize)> = None;
    for first in (0..n).filter(|&i| meets[i] && !meets[(i + n - 1) % n]) {
        let gap = (1..n).take_while(|&back| !meets[(first + n - back) % n]).count();
        if best.is_none_or(|(longest, _)| gap > longest) {
            best = Some((gap, first));
        }
    }
    best.map(|(_, first)| first)
}

fn places(course: &[Place]) -> Vec<Spot> {
    course.iter().map(|place| place.at).collect()
}

const fn turn(is_counter_clockwise: bool) -> Turn {
    if is_counter_clockwise { Turn::CounterClockwise } else { Turn::Clockwise }
}

fn point((x, y): Spot) -> Point {
    Point::from_f64(x, y)
}
