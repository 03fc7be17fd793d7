//! Sites: what distances are measured to, exactly.
//!
//! The picture says which site owns a pixel; where precisely two sites are equally far is asked
//! here, of the features themselves. A site's distance is signed: negative inside the copper, so
//! that a boundary pushed a fraction of a pixel into a net finds its way out.

use crate::geometry::{Arc, Turn};

use super::plane::{Spot, nearest_on_chord};

/// The shape of a site.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// A point.
    Point(Spot),
    /// A line.
    Line(Spot, Spot),
    /// A circular arc: counter-clockwise from `from` to `to` round `center`; the whole circle where
    /// `whole`.
    Arc { center: Spot, radius: f64, from: Spot, to: Spot, whole: bool },
    /// `count` edges of a ring, from vertex `first`: copper lies to the left.
    Chain { ring: u32, first: u32, count: u32 },
    /// The inside of a polygon: the edges of `rings`.
    Inside { first_ring: u32, rings: u32 },
    /// What lies beyond the board's edge; its border is kept elsewhere.
    Outside,
}

/// A site with the width that its feature has round it.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) form: Form,
    /// How far the copper reaches round the form, in nanometres.
    pub(super) radius: f64,
    /// The owner: see [`Sites::OUTSIDE`](super::seed).
    pub(super) owner: u32,
    /// Whether it is a trace's own copper drawn above the cones (the paper's minimum width,
    /// §III-D.2): a boundary that meets it runs along its edge.
    pub(super) flat: bool,
}

/// A signed distance with the direction in which it grows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// In nanometres; negative inside.
    pub(super) distance: f64,
    /// The unit vector away from the nearest point of the site.
    pub(super) away: Spot,
}

impl Form {
    /// An arc of the board as a form.
    pub(super) fn arc(arc: &Arc) -> Self {
        let (from, to) = match arc.turn {
            Turn::CounterClockwise => (arc.start, arc.end),
            Turn::Clockwise => (arc.end, arc.start),
        };
        let radius = f64::midpoint(arc.radius(), arc.center.distance(arc.end));
        Self::Arc { center: arc.center.into(), radius, from: from.into(), to: to.into(), whole: from == to }
    }
}

/// The rings of all polygons, vertex by vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct Rings {
    vertices: Vec<Spot>,
    /// Where each ring begins in `vertices`; one more entry closes the last.
    starts: Vec<u32>,
}

impl Rings {
    pub(super) fn push(&mut self, ring: impl Iterator<Item = Spot>) -> u32 {
        if self.starts.is_empty() {
            self.starts.push(0);
        }
        self.vertices.extend(ring);
        self.starts.push(u32::try_from(self.vertices.len()).expect("below 2³² vertices"));
        u32::try_from(self.starts.len() - 2).expect("below 2³² rings")
    }

    pub(super) fn ring(&self, ring: u32) -> &[Spot] {
        let at = ring as usize;
        &self.vertices[self.starts[at] as usize..self.starts[at + 1] as usize]
    }

    /// The nearest to `p` of `count` edges of `ring` from vertex `first`, going on along the ring
    /// as long as it gets nearer: the picture's edge stands for a run of short true ones, and its
    /// neighbour may be the nearest.
    fn nearest_edge(&self, ring: u32, first: u32, count: u32, p: Spot) -> usize {
        let vertices = self.ring(ring);
        let n = vertices.len();
        let edge = |i: usize| (vertices[i % n], vertices[(i + 1) % n]);
        let squared = |i: usize| {
            let (a, b) = edge(i);
            let way = p - nearest_on_chord(p, a, b);
            way.dot(way)
        };
        let (first, count) = (first as usize, count as usize);
        let mut best = (f64::INFINITY, first);
        for i in first..first + count {
            best = nearer(best, (squared(i), i % n));
        }
        for step in [1, n - 1] {
            loop {
                let next = (best.1 + step) % n;
                let candidate = (squared(next), next);
                if candidate.0 < best.0 {
                    best = candidate;
                } else {
                    break;
                }
            }
        }
        best.1
    }

    /// The signed distance from `p` to edge `i` of `ring`, the nearest one there.
    fn signed(&self, ring: u32, i: usize, p: Spot) -> Reach {
        let vertices = self.ring(ring);
        let n = vertices.len();
        let (a, b) = (vertices[i], vertices[(i + 1) % n]);
        let foot = nearest_on_chord(p, a, b);
        let way = p - foot;
        let distance = way.length();
        // At a corner the side is that of both edges together: the sum of their directions.
        let at_corner = foot == a || foot == b;
        let along = if foot == a {
            unit(a - vertices[(i + n - 1) % n]) + unit(b - a)
        } else if foot == b {
            unit(b - a) + unit(vertices[(i + 2) % n] - b)
        } else {
            b - a
        };
        let outward = unit(Spot::new(along.y, -along.x));
        let inside = way.dot(outward) < 0.0;
        // On the edge itself the way to it has no direction left, but the edge has.
        let away = match (at_corner && distance > 1e-3, inside) {
            (false, _) => outward,
            (true, false) => way * (1.0 / distance),
            (true, true) => way * (-1.0 / distance),
        };
        Reach { distance: if inside { -distance } else { distance }, away }
    }

    /// The signed distance from `p` to the nearest edge of several rings, all of them asked.
    pub(super) fn border(&self, rings: impl Iterator<Item = u32>, p: Spot) -> Reach {
        let mut best = (f64::INFINITY, 0, 0);
        for ring in rings {
            let vertices = self.ring(ring);
            for (i, (&a, &b)) in vertices.iter().zip(vertices.iter().cycle().skip(1)).enumerate() {
                let way = p - nearest_on_chord(p, a, b);
                if way.dot(way) < best.0 {
                    best = (way.dot(way), ring, i);
                }
            }
        }
        self.signed(best.1, best.2, p)
    }
}

impl Site {
    /// The signed distance from `p` to the site's copper.
    pub(super) fn reach(&self, rings: &Rings, p: Spot) -> Reach {
        let bare = match &self.form {
            Form::Point(center) => from_foot(p, *center),
            Form::Line(a, b) => from_foot(p, nearest_on_chord(p, *a, *b)),
            Form::Arc { center, radius, from, to, whole } => {
                from_foot(p, nearest_on_arc(p, *center, *radius, *from, *to, *whole))
            }
            Form::Chain { ring, first, count } => {
                rings.signed(*ring, rings.nearest_edge(*ring, *first, *count, p), p)
            }
            Form::Inside { first_ring, rings: count } => rings.border(*first_ring..first_ring + count, p),
            Form::Outside => Reach { distance: 0.0, away: Spot::new(0.0, 0.0) },
        };
        Reach { distance: bare.distance - self.radius, away: bare.away }
    }

    /// The part of a ring's run that is nearest to `p`: twice the number of a corner, or of the
    /// corner before an edge and one more. Other sites have one part.
    pub(super) fn part(&self, rings: &Rings, p: Spot) -> usize {
        let Form::Chain { ring, first, count } = self.form else { return 0 };
        let (edge, vertices) = (rings.nearest_edge(ring, first, count, p), rings.ring(ring));
        let next = (edge + 1) % vertices.len();
        let foot = nearest_on_chord(p, vertices[edge], vertices[next]);
        match (foot == vertices[edge], foot == vertices[next]) {
            (true, _) => 2 * edge,
            (false, true) => 2 * next,
            (false, false) => 2 * edge + 1,
        }
    }
}

fn nearer(a: (f64, usize), b: (f64, usize)) -> (f64, usize) {
    if b.0 < a.0 { b } else { a }
}

fn unit(v: Spot) -> Spot {
    let length = v.length();
    if length > 0.0 { v * (1.0 / length) } else { Spot::new(0.0, 0.0) }
}

fn from_foot(p: Spot, foot: Spot) -> Reach {
    let way = p - foot;
    let distance = way.length();
    let away = if distance > 0.0 { way * (1.0 / distance) } else { Spot::new(0.0, 0.0) };
    Reach { distance, away }
}

/// The point of `arc` nearest to `p`.
pub(super) fn foot_on_arc(p: Spot, arc: &Arc) -> Spot {
    let (from, to) = match arc.turn {
        Turn::CounterClockwise => (arc.start, arc.end),
        Turn::Clockwise => (arc.end, arc.start),
    };
    nearest_on_arc(p, arc.center.into(), arc.radius(), from.into(), to.into(), from == to)
}

/// The point of a counter-clockwise arc nearest to `p`.
fn nearest_on_arc(p: Spot, center: Spot, radius: f64, from: Spot, to: Spot, whole: bool) -> Spot {
    let (way, a, b) = (p - center, from - center, to - center);
    let wide = a.cross(b) < 0.0 || (a.cross(b) <= 0.0 && a.dot(b) < 0.0 && a.cross(way) < 0.0);
    let within = if wide {
        !(b.cross(way) > 0.0 && way.cross(a) > 0.0)
    } else {
        a.cross(way) >= 0.0 && way.cross(b) >= 0.0
    };
    if (whole || within) && way.length() > 0.0 {
        return center + way * (radius / way.length());
    }
    let (to_from, to_to) = (p - from, p - to);
    if to_from.dot(to_from) <= to_to.dot(to_to) { from } else { to }
}
