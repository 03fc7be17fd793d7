//! What passes leave between them, cleared.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓    In a gap of one net that is a little too narrow for the next pass, a speck ░ is left in the middle that no cut
//!   ━━━━━━━━━━━━━━━━━━━━━━    clears. Its edge ┄ runs half a kerf beyond a pass, wherever no other cut is as near: so every pass is moved out
//!   ┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄╮          by so much, and what other cuts have cleared is taken out of that, as it is out of passes. A speck is narrower
//!   ░░░░░░░━━━━━━━━░░│         than a kerf, so one cut along its middle clears it: there the way straight away from copper comes nearer to
//!   ┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄╯          some other copper.
//!   ━━━━━━━━━━━━━━━━━━━━━━
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//! ```
//!
//! Beside the last pass copper may stay; but where only a thin strip does between that and another
//! cut, it would come off sooner or later. So it is cut off along the edge, too.

use rayon::prelude::*;
use static_aabb2d_index::StaticAABB2DIndexBuilder;

use crate::geometry::{Nm, Path, Point, Segment, Turn};

use super::edge::Border;
use super::groove::{END, Grooves};
use super::near::Near;
use super::plane::Spot;
use super::seed::Sites;
use super::site::Reach;
use super::span::Vertex;
use super::stitch::Line;
use super::{Boundaries, Boundary, OUTSIDE};

/// What is moved out of a pass lies so much deeper in what the next pass clears than the edge of
/// that, in nanometres. Chosen: more than fitting moves either.
const SURE: f64 = 3_000.0;
/// How far chords may leave what was moved out.
const CHORD: Nm = Nm::new(500);
/// The edge of a speck is looked at in such steps, in nanometres.
const STEP: f64 = 20_000.0;
/// Other copper is nearer only where it is by more than this, in nanometres.
const STRAYS: f64 = 200.0;
/// How often the circle round the middle shrinks at most. Chosen: three times is usual.
const SHRINKINGS: usize = 12;
/// A strip beside the last pass that is thinner than this is cut off, in nanometres, and no less
/// long than that: where it is shorter its ends hold it. Chosen: the first as for what `verify`
/// finds too thin, the second half as long, for that adds up strips.
const THIN: f64 = 50_000.0;
const LONG: f64 = 250_000.0;
/// A speck that is shorter, in nanometres, is a crumb, which takes longer to clear than it is
/// worth. Chosen: on random boards the lifts became two and a half times as many where every crumb
/// was cleared, and an eighth more with this.
const CRUMB: f64 = 50_000.0;
/// The middle seen from both sides is the same within this, in nanometres.
const AGAIN: f64 = 5_000.0;

/// Looks for specks beside passes.
pub(super) struct Specks<'a> {
    pub(super) sites: &'a Sites,
    pub(super) near: &'a Near,
    pub(super) border: &'a Border,
    /// How wide the cutter clears, in nanometres.
    pub(super) kerf: f64,
    /// How far passes lie apart.
    pub(super) step: f64,
    /// How near to copper a cut may come.
    pub(super) nearest: f64,
}

impl Specks<'_> {
    /// Whether there can be specks between passes: there is nothing between them where the next
    /// begins to clear before one ends.
    pub(super) fn are_possible(&self) -> bool {
        self.step > self.way()
    }

    /// What clears the specks beside `inner` passes and the strips beside the `last` ones, where
    /// `cuts` are what may have cleared there, and wider tools have cut `before`.
    pub(super) fn lines<'b>(
        &self,
        inner: Vec<&Boundary>,
        last: &[Boundary],
        cuts: impl Iterator<Item = &'b Boundary>,
        before: &[(Nm, Boundaries)],
    ) -> Vec<Line> {
        let reach = |kerf: f64| Nm::from_f64((kerf - self.shared()) / 2.0);
        let wider =
            before.iter().filter_map(|(kerf, cuts)| Grooves::new(cuts.edges.iter(), reach(kerf.to_f64())));
        let cleared: Vec<Grooves> = Grooves::new(cuts, reach(self.kerf)).into_iter().chain(wider).collect();
        let middles = |pass: &Boundary| {
            self.edges(pass, &cleared).iter().flat_map(|edge| self.middles(edge)).collect::<Vec<_>>()
        };
        let strips =
            |pass: &Boundary| self.moved_out(pass).map_or(Vec::new(), |edge| self.strips(&edge, &cleared));
        let mut lines: Vec<Line> = inner.into_par_iter().flat_map_iter(middles).collect();
        lines.par_extend(last.par_iter().flat_map_iter(strips));
        let mut lines = once(lines);
        lines.retain(|line| length(&line.vertices) >= CRUMB);
        lines
    }

    /// How much of the kerf neighbouring passes share, as far as it matters.
    fn shared(&self) -> f64 {
        (self.kerf - self.step).clamp(0.0, 4.0 * SURE)
    }

    /// How far specks begin from the pass that they lie beside.
    fn way(&self) -> f64 {
        f64::midpoint(self.kerf, -self.shared()) + SURE
    }

    /// The edges of what is not cleared beside a pass.
    fn edges(&self, pass: &Boundary, cleared: &[Grooves]) -> Vec<Line> {
        let mut edges: Vec<Line> = self.moved_out(pass).into_iter().collect();
        for grooves in cleared {
            edges = edges.into_iter().flat_map(|edge| grooves.take_out(edge)).collect();
        }
        edges
    }

    /// A pass moved away from its copper, to where it no longer clears.
    fn moved_out(&self, pass: &Boundary) -> Option<Line> {
        let right = if is_on_left(pass.left.number()) { self.way() } else { -self.way() };
        let clearance = pass.clearance[0].to_f64() + self.way();
        let points = beside(&pass.path, right)?.flatten(CHORD);
        let vertices: Vec<Vertex> =
            points.iter().map(|&point| Vertex::new(point.into(), clearance)).collect();
        let ends = (points.first() != points.last()).then_some((END, END));
        let line = Line { vertices, left: pass.left.number(), right: pass.right.number(), ends };
        (line.vertices.len() > 1).then_some(line)
    }

    /// The middles of the specks of which this is an edge; the edge itself where the middle is but
    /// a point.
    fn middles(&self, edge: &Line) -> Vec<Line> {
        let places: Vec<Option<[Vertex; 2]>> = steps(edge, STEP).map(|(at, _)| self.middle(at)).collect();
        let vertices = |places: &[Option<[Vertex; 2]>]| {
            let of = |which: usize| places.iter().flatten().map(|place| place[which]).collect::<Vec<_>>();
            let middle = of(1);
            if length(&middle) < STEP { of(0) } else { middle }
        };
        runs(&places).map(|run| part(edge, vertices(run))).collect()
    }

    /// The parts of what a pass was moved out to where a thin strip lies beside it.
    fn strips(&self, edge: &Line, cleared: &[Grooves]) -> Vec<Line> {
        let wide = THIN.min(self.kerf / 2.0 - 2.0 * SURE);
        let right = if is_on_left(edge.left) { wide } else { -wide };
        let is_cleared = |at: Spot| cleared.iter().any(|grooves| grooves.holds(at));
        let beside_strip = |(at, along): (Spot, Spot)| {
            let beyond = at + Spot::new(along.y, -along.x) * right;
            let is_thin = is_cleared(beyond) && !is_cleared(at);
            is_thin.then(|| self.room(at)).flatten().map(|reach| Vertex::new(at, reach.distance))
        };
        let places: Vec<Option<Vertex>> = steps(edge, THIN / 2.0).map(beside_strip).collect();
        let vertices = runs(&places).map(|run| run.iter().copied().flatten().collect::<Vec<_>>());
        vertices.filter(|vertices| length(vertices) >= LONG).map(|vertices| part(edge, vertices)).collect()
    }

    /// How far copper is from a place; none where nothing is to be cut: off the board, or near
    /// copper.
    fn room(&self, at: Spot) -> Option<Reach> {
        let reach = self.near.reach(self.sites, at, |_| true);
        (reach.distance >= self.nearest && self.border.distance(at) <= 0.0).then_some(reach)
    }

    /// A place on the edge of a speck, and the middle beside it: as far straight away from the
    /// nearest copper as no other comes nearer, and no farther than where the next pass would run.
    /// There a circle that touches the nearest copper touches another; one that is too large
    /// shrinks until it goes through the place on that other copper that lies deepest in it.
    fn middle(&self, at: Spot) -> Option<[Vertex; 2]> {
        let Reach { distance, away } = self.room(at)?;
        let mut way = (self.step - self.way()).max(0.0);
        for _ in 0..SHRINKINGS {
            let center = at + away * way;
            let other = self.near.reach(self.sites, center, |_| true);
            if other.distance > distance + way - STRAYS {
                break;
            }
            let from_other = at - (center - other.away * other.distance);
            let slope = distance - away.dot(from_other);
            way = ((from_other.dot(from_other) - distance * distance) / (2.0 * slope)).clamp(0.0, way);
        }
        Some([0.0, way].map(|way| Vertex::new(at + away * way, distance + way)))
    }
}

/// Places along a line, in steps of at most so many nanometres, each with the direction in which
/// one comes there.
fn steps(line: &Line, step: f64) -> impl Iterator<Item = (Spot, Spot)> {
    let ends = line.vertices.windows(2).map(|ends| (ends[0].at, ends[1].at - ends[0].at));
    let ways = ends.filter(|(_, way)| way.length() > 0.0);
    let first = ways.clone().next().map(|(from, way)| (from, way * (1.0 / way.length())));
    let along = ways.flat_map(move |(from, way)| {
        let count = (way.length() / step).ceil();
        let parts = std::iter::successors(Some(1.0), move |i| (i + 1.0 <= count).then_some(i + 1.0));
        parts.map(move |i: f64| (from + way * (i / count), way * (1.0 / way.length())))
    });
    first.into_iter().chain(along)
}

fn length(vertices: &[Vertex]) -> f64 {
    vertices.windows(2).map(|ends| (ends[1].at - ends[0].at).length()).sum()
}

/// Whether the net of a pass is on its left, where this owner is.
const fn is_on_left(left: u32) -> bool {
    left > OUTSIDE
}

/// Those stretches of places in a row that are some.
fn runs<T>(places: &[Option<T>]) -> impl Iterator<Item = &[Option<T>]> {
    places.chunk_by(|a, b| a.is_some() == b.is_some()).filter(|run| run[0].is_some() && run.len() > 1)
}

/// A part of a line, on these vertices.
const fn part(line: &Line, vertices: Vec<Vertex>) -> Line {
    Line { vertices, left: line.left, right: line.right, ends: Some((END, END)) }
}

/// What is left of `lines` when none goes where one has been.
fn once(lines: Vec<Line>) -> Vec<Line> {
    // How far each vertex is along all lines, with a gap between two of them.
    let mut along = 0.0;
    let mut chords: Vec<(f64, Spot, Spot)> = Vec::new();
    let mut walk = |line: Line| {
        along += 3.0 * AGAIN;
        let mut from = line.vertices[0].at;
        let mut step = |vertex: &Vertex| {
            chords.push((along, from, vertex.at));
            along += (vertex.at - from).length();
            from = vertex.at;
            (along, *vertex)
        };
        let vertices: Vec<(f64, Vertex)> = line.vertices.iter().map(&mut step).collect();
        (line, vertices)
    };
    let walked: Vec<(Line, Vec<(f64, Vertex)>)> = lines.into_iter().map(&mut walk).collect();
    let mut builder = StaticAABB2DIndexBuilder::new(chords.len());
    for (_, a, b) in &chords {
        builder.add(a.x.min(b.x), a.y.min(b.y), a.x.max(b.x), a.y.max(b.y));
    }
    let Ok(index) = builder.build() else { return Vec::new() };
    let is_new = |&(along, vertex): &(f64, Vertex)| {
        let Spot { x, y } = vertex.at;
        let mut is_new = true;
        index.visit_query(x - AGAIN, y - AGAIN, x + AGAIN, y + AGAIN, &mut |i: usize| {
            let (before, a, b) = chords[i];
            is_new &=
                before + (b - a).length() > along - 3.0 * AGAIN || vertex.at.distance_to_chord(a, b) > AGAIN;
        });
        is_new
    };
    let parts = |(line, vertices): (Line, Vec<(f64, Vertex)>)| {
        let new: Vec<Option<Vertex>> =
            vertices.iter().map(|place| is_new(place).then_some(place.1)).collect();
        runs(&new).map(|run| part(&line, run.iter().copied().flatten().collect())).collect::<Vec<_>>()
    };
    walked.into_iter().flat_map(parts).collect()
}

/// The path `right` nanometres to the right of another: corners are joined straight, and arcs that
/// shrink to nothing left out.
fn beside(path: &Path, right: f64) -> Option<Path> {
    let mut moved: Option<Path> = None;
    for (start, step) in path.steps().filter_map(|(from, segment)| step_beside(from, segment, right)) {
        let moved = moved.get_or_insert(Path { start, segments: Vec::new() });
        if moved.end() != start {
            moved.segments.push(Segment::Line { to: start });
        }
        moved.segments.push(step);
    }
    let mut moved = moved?;
    if path.is_closed() && moved.end() != moved.start {
        moved.segments.push(Segment::Line { to: moved.start });
    }
    Some(moved)
}

/// The same of one step of it, with where that begins.
fn step_beside(from: Point, segment: &Segment, right: f64) -> Option<(Point, Segment)> {
    let (begin, end) = (Spot::from(from), Spot::from(segment.to()));
    let Segment::Arc { center, turn, .. } = *segment else {
        let way = end - begin;
        let across = Spot::new(way.y, -way.x) * (right / way.length());
        let [start, to] = [begin, end].map(|spot| (spot + across).rounded());
        return (from != segment.to()).then_some((start, Segment::Line { to }));
    };
    let middle = Spot::from(center);
    let radius = (begin - middle).length();
    let outward = if turn == Turn::CounterClockwise { right } else { -right };
    let grown = (radius + outward) / radius;
    let [start, to] = [begin, end].map(|spot| (middle + (spot - middle) * grown).rounded());
    // A short arc may not become a full circle.
    let is_whole = (start == to) == (from == segment.to());
    (grown > 0.0 && is_whole).then_some((start, Segment::Arc { to, center, turn }))
}
