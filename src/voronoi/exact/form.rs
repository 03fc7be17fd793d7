//! Forms: what a generator is near its foot point, a line or a circle, and where along it feet may
//! lie.
//!
//! ```text
//!      ▲ normal (free space)              ╭──╮  full: free space outside       ╲      ╱  hollow: free
//!      │                                 │ ▓▓ │ d = |p − c| − q              ▓▓ ╲____╱ ▓▓ space inside
//!  ────┴────▶ along                       ╰──╯                               d = q − |p − c|
//!  ▓▓▓▓▓▓▓▓▓  d = n · (p − from)
//! ```
//!
//! Every distance has one of these three expressions, and the *slab* (of a line) or the *sector*
//! (of a circle) says which points have their foot on it. A straight bisector, a parabola, a
//! hyperbola and an ellipse are all one closed expression: from the foot on one form along its
//! normal, the place where the other is equally far solves a linear equation ([`Form::meet`]).

use super::tolerances::SLAB;
use crate::voronoi::plane::{self, Spot};

/// Nothing on a board is so far away, in nanometres: bisectors end here that rounding has turned
/// from parallel ones. Chosen.
const FAR: f64 = 1e11;

/// Lines that lie across more of a square of this side are known by pieces, and circles of a larger
/// radius, in nanometres; a line by so many at most. Chosen: boards rarely have such.
const PIECE: f64 = 3_000_000.0;
const PIECES: f64 = 256.0;

/// A line or a circle, one side of which is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    /// A straight edge; copper lies on its left.
    Line { from: Spot, along: Spot, length: f64 },
    /// A circle or an arc of it: counter-clockwise from the first unit vector of `sector` to the
    /// second.
    Circle { center: Spot, radius: f64, hollow: bool, sector: Option<[Spot; 2]> },
}

/// The direction midway between two, in the sense of travel: +1 counter-clockwise, −1 clockwise.
/// Two that are the same but for rounding are one, not all the way round.
pub(super) fn halfway(u: Spot, v: Spot, sense: f64) -> Spot {
    let (u, v) = if sense > 0.0 { (u, v) } else { (v, u) };
    if u.dot(v) < 0.0 {
        // The chord is long: a quarter clockwise of it.
        unit(clockwise(v - u))
    } else {
        let is_short = u.cross(v) >= 0.0 || (u - v).dot(u - v) <= 1e-12;
        unit(u + v) * if is_short { 1.0 } else { -1.0 }
    }
}

/// The place of a foot on a form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// So far along a line, in nanometres.
    Along(f64),
    /// In this direction from the centre of a circle.
    Toward(Spot),
}

impl Place {
    /// The place midway to another of the same form, in the sense of travel.
    pub(super) fn halfway(self, other: Self, sense: f64) -> Option<Self> {
        match (self, other) {
            (Self::Along(a), Self::Along(b)) => Some(Self::Along(f64::midpoint(a, b))),
            (Self::Toward(a), Self::Toward(b)) => Some(Self::Toward(halfway(a, b, sense))),
            (Self::Along(_), Self::Toward(_)) | (Self::Toward(_), Self::Along(_)) => None,
        }
    }
}

/// Turned a quarter clockwise.
pub(super) fn clockwise(v: Spot) -> Spot {
    Spot::new(v.y, -v.x)
}

/// The unit vector along `v`; zero where `v` is.
pub(super) fn unit(v: Spot) -> Spot {
    let length = v.length();
    if length > 0.0 { Spot::new(v.x / length, v.y / length) } else { Spot::default() }
}

/// Whether two directions are one but for an angle of this sine.
pub(super) fn is_one_way(u: Spot, v: Spot, sine: f64) -> bool {
    u.dot(v) > 0.0 && u.cross(v).abs() < sine
}

/// A number in 0..4 that grows with the angle from `from` to `to`, counter-clockwise; exact for
/// small angles.
pub(super) fn turn(from: Spot, to: Spot) -> f64 {
    let (x, y) = (from.dot(to), from.cross(to));
    let t = y / (x.abs() + y.abs());
    match (x >= 0.0, y >= 0.0) {
        (true, true) => t,
        (false, _) => 2.0 - t,
        (true, false) => 4.0 + t,
    }
}

impl Form {
    pub(super) fn line(from: Spot, to: Spot) -> Self {
        let way = to - from;
        Self::Line { from, along: unit(way), length: way.length() }
    }

    pub(super) const fn disc(center: Spot, radius: f64) -> Self {
        Self::Circle { center, radius, hollow: false, sector: None }
    }

    /// Whether it is a circle whose inside is free.
    pub(super) const fn is_hollow(&self) -> bool {
        matches!(self, Self::Circle { hollow: true, .. })
    }

    /// The signed distance, wherever the foot lies.
    pub(super) fn distance(&self, p: Spot) -> f64 {
        match *self {
            Self::Line { from, along, .. } => clockwise(along).dot(p - from),
            Self::Circle { center, radius, hollow, .. } => {
                let out = (p - center).length() - radius;
                if hollow { -out } else { out }
            }
        }
    }

    /// How far `p` is from the nearest place of it, its ends included, from whichever side.
    pub(super) fn off(&self, p: Spot) -> f64 {
        if self.slack(p) >= 0.0 {
            return self.distance(p).abs();
        }
        let ends = self.ends().into_iter().flatten();
        ends.map(|end| (self.foot(end).0 - p).length()).fold(f64::INFINITY, f64::min)
    }

    /// The direction in which the distance grows.
    pub(super) fn away(&self, p: Spot) -> Spot {
        match *self {
            Self::Line { along, .. } => clockwise(along),
            Self::Circle { center, hollow, .. } => unit(p - center) * if hollow { -1.0 } else { 1.0 },
        }
    }

    /// How far the foot of `p` lies within the slab, in nanometres; negative beyond its ends.
    pub(super) fn slack(&self, p: Spot) -> f64 {
        let [start, end] = self.slacks(p);
        match *self {
            Self::Line { .. } | Self::Circle { sector: None, .. } => start.min(end),
            Self::Circle { center, sector: Some([from, to]), .. } => {
                let n = p - center;
                let least = start.abs().min(end.abs());
                if self.around(p).is_some() {
                    return least;
                }
                if turn(from, n) <= turn(from, to) { least } else { -least }
            }
        }
    }

    /// How far the foot of `p` lies from the start and from the end, inwards; the radius of an arc
    /// where it is not near them.
    pub(super) fn slacks(&self, p: Spot) -> [f64; 2] {
        match *self {
            Self::Line { from, along, length } => {
                let t = along.dot(p - from);
                [t, length - t]
            }
            Self::Circle { sector: None, .. } => [f64::INFINITY; 2],
            Self::Circle { center, radius, sector: Some([from, to]), .. } => {
                let n = unit(p - center);
                let near = |end: Spot, across: f64| if end.dot(n) > 0.0 { across * radius } else { radius };
                [near(from, from.cross(n)), near(to, n.cross(to))]
            }
        }
    }

    /// Whether `p` has a foot on it but for `slab` nanometres, and lies on the free side but for
    /// `tie`.
    pub(super) fn counts(&self, p: Spot, tie: f64, slab: f64) -> bool {
        self.distance(p) >= -tie && self.slack(p) >= -slab
    }

    /// Whether `p` is the centre of a hollow circle, from which every place of it is equally far;
    /// then the directions of its ends, if it has any.
    pub(super) fn around(&self, p: Spot) -> Option<Option<[Spot; 2]>> {
        match *self {
            Self::Circle { center, hollow: true, sector, .. } => {
                ((p - center).length() < 1.0).then_some(sector)
            }
            Self::Line { .. } | Self::Circle { .. } => None,
        }
    }

    /// How far `p` is from the centre of a circle: the radius of what is as far from it as `p`.
    pub(super) fn bend(&self, p: Spot) -> Option<f64> {
        match *self {
            Self::Circle { center, .. } => Some((p - center).length()),
            Self::Line { .. } => None,
        }
    }

    /// The place of the foot of `p`.
    pub(super) fn place(&self, p: Spot) -> Place {
        match *self {
            Self::Line { from, along, .. } => Place::Along(along.dot(p - from)),
            Self::Circle { center, .. } => Place::Toward(unit(p - center)),
        }
    }

    /// The foot at a place, and the normal there.
    pub(super) fn foot(&self, place: Place) -> (Spot, Spot) {
        match (*self, place) {
            (Self::Line { from, along, .. }, Place::Along(t)) => (from + along * t, clockwise(along)),
            (Self::Circle { center, radius, hollow, .. }, Place::Toward(n)) => {
                (center + n * radius, if hollow { n * -1.0 } else { n })
            }
            (Self::Line { from, along, .. }, Place::Toward(_)) => (from, clockwise(along)),
            (Self::Circle { center, .. }, Place::Along(_)) => (center, Spot::default()),
        }
    }

    /// The distance from `foot` along `normal` at which this form is equally far; none where it
    /// never is.
    ///
    /// A distance grows by at most 1 a unit of way and the distance to the foot by exactly 1, so
    /// there is one such place at most.
    pub(super) fn meet(&self, foot: Spot, normal: Spot) -> Option<f64> {
        let (gap, closing) = match *self {
            Self::Line { from, along, .. } => {
                let n = clockwise(along);
                (n.dot(foot - from), 1.0 - n.dot(normal))
            }
            Self::Circle { center, radius, hollow, .. } => {
                let w = foot - center;
                let sign = if hollow { -1.0 } else { 1.0 };
                let length = w.length();
                ((length - radius) * (length + radius) * sign, 2.0 * (radius - sign * w.dot(normal)))
            }
        };
        if closing <= 0.0 {
            return None;
        }
        let s = gap / closing;
        if !(-SLAB..FAR).contains(&s) {
            return None;
        }
        let s = s.max(0.0);
        let reaches = match *self {
            Self::Circle { radius, hollow: true, .. } => s <= radius,
            Self::Line { .. } | Self::Circle { .. } => true,
        };
        reaches.then_some(s)
    }

    /// What is so many nanometres away from it on the free side, wherever the foot lies.
    pub(super) fn parallel(&self, level: f64) -> Option<Self> {
        match *self {
            Self::Line { from, along, length } => {
                Some(Self::Line { from: from + clockwise(along) * level, along, length })
            }
            Self::Circle { radius, hollow: true, .. } if radius <= level => None,
            Self::Circle { center, radius, hollow, sector } => {
                let radius = if hollow { radius - level } else { radius + level };
                Some(Self::Circle { center, radius, hollow, sector })
            }
        }
    }

    /// Where the whole line or circle crosses that of another form: there the bisector of both
    /// ends, and another branch of it may begin.
    pub(super) fn crossings(&self, other: &Self) -> [Option<Spot>; 2] {
        let of_circle = |from: Spot, along: Spot, center: Spot, radius: f64| {
            let foot = from + along * along.dot(center - from);
            let out = foot - center;
            let squared = radius * radius - out.dot(out);
            let half = (squared >= 0.0).then(|| squared.sqrt());
            [half.map(|half| foot + along * half), half.map(|half| foot - along * half)]
        };
        match (*self, *other) {
            (Self::Line { from, along, .. }, Self::Line { from: start, along: way, .. }) => {
                let turn = along.cross(way);
                let meets = turn.abs() > 1e-12;
                [meets.then(|| from + along * ((start - from).cross(way) / turn)), None]
            }
            (Self::Line { from, along, .. }, Self::Circle { center, radius, .. })
            | (Self::Circle { center, radius, .. }, Self::Line { from, along, .. }) => {
                of_circle(from, along, center, radius)
            }
            (Self::Circle { center, radius, .. }, Self::Circle { center: c, radius: r, .. }) => {
                let (way, length) = (unit(c - center), (c - center).length());
                if length <= 0.0 {
                    return [None; 2];
                }
                // Both lie on their radical line.
                let out = (length * length + (radius - r) * (radius + r)) / (2.0 * length);
                of_circle(center + way * out, clockwise(way), center, radius)
            }
        }
    }

    /// Moves a place by so many nanometres, seen at the distance `out` from the centre of a circle;
    /// there by an eighth of a turn at most.
    pub(super) fn advance(&self, place: Place, way: f64, out: f64) -> Place {
        match place {
            Place::Along(t) => Place::Along(t + way),
            Place::Toward(n) => {
                // The rational rotation: tan(φ/2) = h.
                let h = (way / (2.0 * out.max(1.0))).clamp(-0.25, 0.25);
                let (cos, sin) = ((1.0 - h * h) / (1.0 + h * h), 2.0 * h / (1.0 + h * h));
                Place::Toward(unit(Spot::new(n.x * cos - n.y * sin, n.x * sin + n.y * cos)))
            }
        }
    }

    /// How far it is from one place to another in the sense of travel; on a circle in 0..4
    /// quarters, nearly.
    pub(super) fn progress(&self, from: Place, to: Place, sense: f64) -> f64 {
        match (from, to) {
            (Place::Along(a), Place::Along(b)) => (b - a) * sense,
            (Place::Toward(a), Place::Toward(b)) => {
                let forward = if sense > 0.0 { turn(a, b) } else { turn(b, a) };
                // What lies behind by rounding is not all the way round.
                if forward > 4.0 - 1e-9 { forward - 4.0 } else { forward }
            }
            (Place::Along(_), Place::Toward(_)) | (Place::Toward(_), Place::Along(_)) => 0.0,
        }
    }

    /// The ends of the slab or sector as places.
    pub(super) fn ends(&self) -> Option<[Place; 2]> {
        match *self {
            Self::Line { length, .. } => Some([Place::Along(0.0), Place::Along(length)]),
            Self::Circle { sector, .. } => sector.map(|ends| ends.map(Place::Toward)),
        }
    }

    /// The sense in which the foot moves along it, +1 or −1, for who travels with it on the left.
    pub(super) const fn sense_on_left(&self) -> f64 {
        if self.is_hollow() { -1.0 } else { 1.0 }
    }

    /// The mirror image in the line through `p` along the unit vector `axis`.
    pub(super) fn mirrored(&self, p: Spot, axis: Spot) -> Self {
        let direction = |v: Spot| axis * (2.0 * v.dot(axis)) - v;
        let spot = |q: Spot| p + direction(q - p);
        match *self {
            Self::Line { from, along, length } => {
                // The other way round, so that copper stays on its left.
                let to = spot(from + along * length);
                Self::Line { from: to, along: direction(along) * -1.0, length }
            }
            Self::Circle { center, radius, hollow, sector } => {
                let sector = sector.map(|[from, to]| [direction(to), direction(from)]);
                Self::Circle { center: spot(center), radius, hollow, sector }
            }
        }
    }

    /// Adds the box round it, or those round pieces of it that are far smaller: left, bottom,
    /// right, top.
    pub(super) fn add_bounds(&self, boxes: &mut Vec<[f64; 4]>) {
        match *self {
            Self::Line { from, along, length } => {
                let slant = (along.x.abs().min(along.y.abs()) * length / PIECE).ceil();
                let count = slant.clamp(1.0, PIECES);
                let step = length / count;
                let starts = std::iter::successors(Some(0.0), |i| Some(i + 1.0)).take_while(|&i| i < count);
                let pieces =
                    starts.map(|i| Self::Line { from: from + along * (step * i), along, length: step });
                boxes.extend(pieces.map(|piece| piece.bounds()));
            }
            Self::Circle { center, radius, hollow, sector } if radius > PIECE => {
                let east = Spot::new(1.0, 0.0);
                let [first, last] = sector.unwrap_or([east; 2]);
                let mut ends = vec![first];
                let diagonal = unit(Spot::new(1.0, 1.0));
                let mut eighth = [first, clockwise(first) * -1.0];
                eighth[1] = first * diagonal.x + eighth[1] * diagonal.y;
                while ends.len() < 8 && (sector.is_none() || turn(first, eighth[1]) < turn(first, last)) {
                    ends.push(eighth[1]);
                    let [from, to] = eighth;
                    eighth = [to, to * (2.0 * to.dot(from)) - from];
                }
                ends.push(last);
                let sectors = ends.windows(2).map(|pair| Some([pair[0], pair[1]]));
                let pieces = sectors.map(|sector| Self::Circle { center, radius, hollow, sector });
                boxes.extend(pieces.map(|piece| piece.bounds()));
            }
            Self::Circle { .. } => boxes.push(self.bounds()),
        }
    }

    /// The box round it: left, bottom, right, top.
    pub(super) fn bounds(&self) -> [f64; 4] {
        match *self {
            Self::Line { from, along, length } => plane::spanned(from, from + along * length),
            Self::Circle { center, radius, sector: None, .. } => {
                [center.x - radius, center.y - radius, center.x + radius, center.y + radius]
            }
            Self::Circle { center, radius, sector: Some(ends), .. } => {
                let [from, to] = ends.map(|n| center + n * radius);
                let axes = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| Spot::new(x, y));
                let far = axes.map(|n| center + n * radius).into_iter().filter(|&p| self.slack(p) >= -SLAB);
                far.fold(plane::spanned(from, to), |[left, bottom, right, top], p| {
                    [left.min(p.x), bottom.min(p.y), right.max(p.x), top.max(p.y)]
                })
            }
        }
    }
}
