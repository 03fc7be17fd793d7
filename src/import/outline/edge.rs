//! A line or arc drawn on the outline layer, and where two of them meet.

use std::collections::BTreeSet;

use rustc_hash::FxHashSet;

use crate::geometry::{Arc, Nm, Point, Rect, Segment, Turn};

/// A line or an arc that is no full circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Edge {
    pub(super) from: Point,
    pub(super) to: Point,
    /// The centre and the way round of an arc.
    pub(super) round: Option<(Point, Turn)>,
    /// Of a line that is a chord: those of its arc.
    pub(super) bow: Option<(Point, Turn)>,
    /// The line of the file that drew it.
    pub(super) line: u32,
    /// Half the width that it is drawn with.
    pub(super) half: Nm,
}

impl Edge {
    pub(super) const fn line(from: Point, to: Point, line: u32) -> Self {
        Self { from, to, round: None, bow: None, line, half: Nm::ZERO }
    }

    pub(super) const fn arc(arc: Arc, line: u32) -> Self {
        let round = Some((arc.center, arc.turn));
        Self { round, ..Self::line(arc.start, arc.end, line) }
    }

    /// The same, drawn with a round aperture.
    pub(super) const fn drawn(self, half: Nm) -> Self {
        Self { half, ..self }
    }

    pub(super) fn segment(&self) -> Segment {
        match self.round {
            None => Segment::Line { to: self.to },
            Some((center, turn)) => Segment::Arc { to: self.to, center, turn },
        }
    }

    /// The same edge walked the other way.
    pub(super) fn reversed(&self) -> Self {
        let [round, bow] =
            [self.round, self.bow].map(|of| of.map(|(center, turn)| (center, turn.reversed())));
        Self { from: self.to, to: self.from, round, bow, ..*self }
    }

    pub(super) fn as_arc(&self) -> Option<Arc> {
        self.segment().arc(self.from)
    }

    pub(super) fn length(&self) -> f64 {
        self.segment().length(self.from)
    }

    pub(super) fn bounds(&self) -> Rect {
        self.as_arc().map_or(Rect::new(self.from, self.to), |arc| arc.bounds())
    }

    /// The line between its ends.
    const fn straight(self) -> Self {
        Self { round: None, ..self }
    }

    /// The two parts on both sides of `at`.
    fn parted(&self, at: Point) -> [Self; 2] {
        [Self { to: at, ..*self }, Self { from: at, ..*self }]
    }

    /// Whether `p` lies on it, within [`ON`], and at neither end.
    fn passes(&self, p: Point) -> bool {
        if p == self.from || p == self.to {
            return false;
        }
        match self.round {
            None => {
                let (way, to_p) = (self.to - self.from, p - self.from);
                let along = way.dot(to_p);
                let length = way.length();
                along > 0 && along < way.length_squared() && (to_float(way.cross(to_p)) / length).abs() <= ON
            }
            Some((center, turn)) => {
                let off = center.distance(p) - center.distance(self.from);
                let reach = Arc { start: self.from, end: p, center, turn };
                off.abs() <= ON && self.as_arc().is_some_and(|arc| reach.sweep().abs() < arc.sweep().abs())
            }
        }
    }

    /// The point of it nearest to `p`, rounded to a nanometre; none where that is one of its ends.
    pub(super) fn foot(&self, p: Point) -> Option<Point> {
        let foot = match self.round {
            None => {
                let way = self.to - self.from;
                along(self, to_float(way.dot(p - self.from)) / to_float(way.length_squared()))?
            }
            Some((center, _)) => {
                let ((x, y), out) = (center.to_f64(), p - center);
                let scale = center.distance(self.from) / out.length();
                Point::from_f64(x + out.x.to_f64() * scale, y + out.y.to_f64() * scale)
            }
        };
        self.passes(foot).then_some(foot)
    }

    /// Where the two cross in the middle of both.
    fn crossings(&self, other: &Self) -> Vec<Point> {
        let places = match (self.round, other.round) {
            (None, None) => line_and_line(self, other),
            (None, Some((center, _))) => line_and_circle(self, center, center.distance(other.from)),
            (Some((center, _)), None) => line_and_circle(other, center, center.distance(self.from)),
            (Some((a, _)), Some((b, _))) => circles(a, a.distance(self.from), b, b.distance(other.from)),
        };
        let inside = |p: &Point| self.passes(*p) && other.passes(*p);
        places.into_iter().filter(inside).collect()
    }
}

pub(super) fn line_and_line(one: &Edge, other: &Edge) -> Vec<Point> {
    let (a, b) = (one.to - one.from, other.to - other.from);
    let share = to_float((other.from - one.from).cross(b)) / to_float(a.cross(b));
    along(one, share).into_iter().collect()
}

/// The point at `share` of the way along a line; none outside it, or where lines are parallel.
fn along(line: &Edge, share: f64) -> Option<Point> {
    (share > 0.0 && share < 1.0).then(|| line.from.toward(line.to, share))
}

/// Solves |from + share · way − center| = radius.
fn line_and_circle(line: &Edge, center: Point, radius: f64) -> Vec<Point> {
    let (way, back) = (line.to - line.from, line.from - center);
    let (a, b) = (to_float(way.length_squared()), to_float(way.dot(back)));
    let discriminant = b * b - a * (to_float(back.length_squared()) - radius * radius);
    if discriminant < 0.0 {
        return Vec::new();
    }
    let root = discriminant.sqrt();
    [(-b - root) / a, (-b + root) / a].into_iter().filter_map(|share| along(line, share)).collect()
}

/// ```text
///       p         a lies x from the line through both places, on the way to b:
///      /|\        x = (r² − s² + d²) / 2d
///   r / | \ s
///    a──x──b
/// ```
fn circles(a: Point, r: f64, b: Point, s: f64) -> Vec<Point> {
    let way = b - a;
    let d = way.length();
    let x = (r * r - s * s + d * d) / (2.0 * d);
    let square = r * r - x * x;
    if a == b || square < 0.0 {
        return Vec::new();
    }
    let (height, (ax, ay)) = (square.sqrt(), a.to_f64());
    let (ux, uy) = (way.x.to_f64() / d, way.y.to_f64() / d);
    let place = |h: f64| Point::from_f64(ax + ux * x - uy * h, ay + uy * x + ux * h);
    vec![place(height), place(-height)]
}

/// How far beside an edge, in nanometres, a point may lie and still be on it: what rounding does to
/// places on slanted lines, with a margin.
const ON: f64 = 1_500.0;

/// The shortest part of an arc, in nanometres, that is an arc. Chosen: both ends may lie beside it
/// by [`ON`], and the direction between them says nothing of the way round where that is much.
const SHORT: f64 = 8.0 * ON;

#[expect(clippy::cast_precision_loss, reason = "compared with tolerances far above the rounding")]
const fn to_float(value: i64) -> f64 {
    value as f64
}

/// The two halves of a full circle.
pub(super) fn halves(circle: &Edge, arc: &Arc) -> [Edge; 2] {
    circle.parted(arc.center + (arc.center - arc.start))
}

/// Leaves out edges of no length and edges drawn twice, either way round.
pub(super) fn drop_doubles(edges: &mut Vec<Edge>) {
    let mut seen = FxHashSet::default();
    edges.retain(|edge| {
        let turned = if edge.from <= edge.to { *edge } else { edge.reversed() };
        let round = turned.round.map(|(center, turn)| (center, turn == Turn::Clockwise));
        (edge.round.is_some() || edge.from != edge.to) && seen.insert((turned.from, turned.to, round))
    });
}

/// The most edges that are looked at for crossings, and the most pairs of them that cross; drawings
/// of more are taken as they are: no outline of a board. Both chosen.
const MOST: usize = 20_000;
pub(super) const MOST_CROSSINGS: usize = 100_000;

/// Parts edges where another one ends on them or crosses them; lines that lie on each other become
/// the same.
pub(super) fn part_where_they_meet(edges: Vec<Edge>) -> Vec<Edge> {
    if edges.len() > MOST {
        return edges;
    }
    let mut places: Vec<Place> = edges.iter().enumerate().map(Place::of).collect();
    places.sort_by_key(|place| (place.bounds.min().x, place.edge));
    let mut cuts: Vec<BTreeSet<Point>> = vec![BTreeSet::new(); edges.len()];
    let mut crossings = 0;
    for (k, place) in places.iter().enumerate() {
        let beside = |other: &&Place| other.bounds.min().x <= place.bounds.max().x;
        for other in places[k + 1..].iter().take_while(beside) {
            if place.bounds.touches(other.bounds) && !place.only_joins(other) {
                crossings += meet(&edges, place.edge, other.edge, &mut cuts);
            }
        }
        if crossings > MOST_CROSSINGS {
            return edges;
        }
    }
    let mut parts: Vec<Edge> =
        edges.into_iter().zip(cuts).flat_map(|(edge, cuts)| cut_up(edge, cuts)).collect();
    drop_doubles(&mut parts);
    parts
}

/// Where an edge lies.
struct Place {
    /// It lies within, and so does what is [`ON`] it.
    bounds: Rect,
    /// The ends of a line.
    ends: Option<[Point; 2]>,
    /// Its number.
    edge: usize,
}

impl Place {
    fn of((number, edge): (usize, &Edge)) -> Self {
        let ends = edge.round.is_none().then_some([edge.from, edge.to]);
        Self { bounds: edge.bounds().inflate(Nm::new(2_000)), ends, edge: number }
    }

    /// Whether both are lines that have an end in common, and each has its other far from the other
    /// line, so that they meet nowhere else: drawings have thousands of lines through one point.
    fn only_joins(&self, other: &Self) -> bool {
        let (Some(some), Some(others)) = (self.ends, other.ends) else { return false };
        some.iter().any(|p| others.contains(p))
            && !others.iter().any(|&p| !some.contains(&p) && self.bounds.contains(p))
            && !some.iter().any(|&p| !others.contains(&p) && other.bounds.contains(p))
    }
}

/// Notes where two edges meet; how often they cross.
fn meet(edges: &[Edge], i: usize, j: usize, cuts: &mut [BTreeSet<Point>]) -> usize {
    let (a, b) = (&edges[i], &edges[j]);
    cuts[i].extend([b.from, b.to].into_iter().filter(|&p| a.passes(p)));
    cuts[j].extend([a.from, a.to].into_iter().filter(|&p| b.passes(p)));
    let crossings = a.crossings(b);
    cuts[i].extend(&crossings);
    cuts[j].extend(&crossings);
    crossings.len()
}

/// `edge` in parts, from one cut to the next.
fn cut_up(edge: Edge, cuts: BTreeSet<Point>) -> Vec<Edge> {
    let along = |p: Point| match edge.round {
        None => (p - edge.from).length(),
        Some((center, turn)) => Arc { start: edge.from, end: p, center, turn }.length(),
    };
    let mut cuts: Vec<(f64, Point)> = cuts.into_iter().map(|p| (along(p), p)).collect();
    cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut parts = Vec::with_capacity(cuts.len() + 1);
    let (mut rest, mut from) = (edge, 0.0);
    for (to, at) in cuts {
        let [part, left] = rest.parted(at);
        parts.push(if to - from < SHORT { part.straight() } else { part });
        (rest, from) = (left, to);
    }
    parts.push(if edge.length() - from < SHORT { rest.straight() } else { rest });
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_whose_lines_cross_too_often_is_taken_as_it_is() {
        let grid = |count: i64| {
            let at = |x: i64, y: i64| Point::new(Nm::from_um(500 * x), Nm::from_um(500 * y));
            let across = |i: i64| {
                [Edge::line(at(0, i), at(count + 1, i), 1), Edge::line(at(i, 0), at(i, count + 1), 1)]
            };
            part_where_they_meet((1..=count).flat_map(across).collect()).len()
        };
        assert_eq!(grid(20), 2 * 20 * 21, "each in as many parts as there are crossings, and one");
        assert_eq!(grid(400), 2 * 400, "none");
    }

    #[test]
    fn lines_that_only_have_an_end_in_common_are_told_from_such_as_meet_elsewhere_too() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let line = |from: Point, to: Point| Place::of((0, &Edge::line(from, to, 1)));
        let one = line(at(0, 0), at(500, 100));
        assert!(one.only_joins(&line(at(0, 0), at(-500, 100))), "to the other side");
        assert!(one.only_joins(&line(at(100, 500), at(0, 0))), "steeper");
        assert!(!one.only_joins(&line(at(0, 0), at(250, 50))), "on it");
        assert!(!one.only_joins(&line(at(0, 0), at(1_000, 200))), "it lies on that");
        assert!(!one.only_joins(&line(at(1, 0), at(-500, 100))), "beside its end");
        let arc = Arc { start: at(0, 0), end: at(10, 10), center: at(0, 10), turn: Turn::CounterClockwise };
        assert!(!one.only_joins(&Place::of((1, &Edge::arc(arc, 1)))), "an arc may cross it again");
    }
}
