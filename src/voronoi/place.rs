//! Points moved from the pixel raster to where they truly belong (DESIGN: the raster decides
//! topology, analysis decides place).
//!
//! A boundary point near pixels of two sites satisfies one equation, distance to the one = distance
//! to the other (or = the limit); a node satisfies two. Newton's steps solve them on the sites'
//! exact distances, starting at most a pixel away; nothing may move further than a pixel and a
//! half. Where Newton does not settle (the nearest site of a net changes right there), the same
//! equation is bisected along its gradient.
//!
//! The equation begins with the sites seen in the pixels round the point. The nearest may not be
//! among them: where one site of a net takes over from another, its region may begin in a wedge
//! thinner than a pixel. So an index of all sites is asked whether any is nearer at the place
//! found; if so it joins the equation, which is solved again. What comes out is as far from both
//! nets as can be, whatever the pixels showed.

use crate::geometry::Nm;

use super::BACKGROUND;
use super::near::rank;
use super::plane::Spot;
use super::seed::Sites;
use super::site::{Form, Reach, Rings};
use super::span::{LEVEL, Vertex};
use super::vicinity::Vicinity;

/// How close to the true place Newton's steps must come, in nanometres of distance difference.
const SETTLED: f64 = 0.05;
/// What a point may be off at the very most when its steps run out, in nanometres.
const ACCEPTED: f64 = 5.0;
const STEPS: usize = 8;
/// Where curves meet at an angle, pixels show the place off by the inverse of its sine; below this
/// they are followed no further. Chosen: what lies farther away is found as the tip of a wedge.
const SHALLOW: f64 = 0.25;
/// A site must be nearer by more than this to join an equation, in nanometres.
const NEARER: f64 = 1.0;
/// Sites in directions that differ by less, in radians, let a boundary go on as if they were one.
/// Derived: over a tenth of a millimetre, the corner is off by a quarter of a micrometre at most.
const SMOOTH: f64 = 0.02;
/// How often sites may join an equation at one point. Chosen: more than three is not seen.
const ROUNDS: usize = 6;

/// A few labels of sites: those seen in the pixels round a point, and nearer ones found beside
/// them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Candidates {
    labels: [u32; 16],
    len: usize,
}

impl Candidates {
    pub(super) fn add(&mut self, label: u32) {
        if self.len < self.labels.len() && !self.as_slice().contains(&label) {
            self.labels[self.len] = label;
            self.len += 1;
        }
    }

    /// Adds a label that is nearer than the others, in place of the last one where there is no
    /// room.
    fn admit(&mut self, label: u32) {
        self.len = self.len.min(self.labels.len() - 1);
        self.add(label);
    }

    pub(super) fn as_slice(&self) -> &[u32] {
        &self.labels[..self.len]
    }

    pub(super) fn join(mut self, other: &Self) -> Self {
        for &label in other.as_slice() {
            self.add(label);
        }
        self
    }
}

/// The equation that a boundary point satisfies.
#[derive(Clone, Copy, Debug)]
pub(super) enum Target {
    /// Equally far from both.
    Between(Candidates, Candidates),
    /// So many nanometres from the site.
    At(Candidates, f64),
    /// On the border of the board.
    OnBorder,
}

impl Target {
    fn has(&self, label: u32) -> bool {
        match self {
            Self::Between(a, b) => a.as_slice().contains(&label) || b.as_slice().contains(&label),
            Self::At(a, _) => a.as_slice().contains(&label),
            Self::OnBorder => false,
        }
    }

    /// The same equation, with the sites of another point of the same boundary considered too.
    pub(super) fn join(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Between(a, b), Self::Between(c, d)) => Self::Between(a.join(c), b.join(d)),
            (Self::At(a, level), Self::At(b, _)) => Self::At(a.join(b), *level),
            (Self::Between(..) | Self::At(..) | Self::OnBorder, _) => *self,
        }
    }
}

/// Points that are not where they belong: how many, and where the first of them is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Unplaced {
    pub(super) count: u32,
    pub(super) first: Option<Spot>,
}

impl Unplaced {
    pub(super) fn add(&mut self, at: Spot) {
        self.count += 1;
        self.first.get_or_insert(at);
    }

    /// These, and others that were found after them.
    pub(super) fn join(self, other: Self) -> Self {
        Self { count: self.count + other.count, first: self.first.or(other.first) }
    }
}

/// How far a point is off its target, and which way that grows; with its clearance, and which way
/// that grows.
struct Miss {
    value: f64,
    slope: Spot,
    clearance: f64,
    away: Spot,
}

impl Miss {
    /// The point, on the course of those that satisfy the target, too.
    fn vertex(&self, at: Spot) -> Vertex {
        Vertex::across(at, self.clearance, self.slope, self.away)
    }
}

/// The curve on which a boundary runs at a point: what the nearest sites on either side make it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Curve {
    /// The bisector of two sites, that of the lower owner first.
    Between(u32, u32),
    /// At a distance from one.
    At(u32),
    /// The border of the board.
    Border,
}

/// A vertex with the curve it lies on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) vertex: Vertex,
    pub(super) curve: Curve,
}

/// The sites of a layer and how far points may move among them.
pub(super) struct Placer<'a> {
    pub(super) sites: &'a Sites,
    /// The owner of each of them: a table of its own, because every sample asks.
    pub(super) owners: &'a [u32],
    /// All of them by place; none where regions are not those of the nearest site alone.
    pub(super) near: Option<Vicinity<'a>>,
    /// The rings of the board's border.
    pub(super) border: &'a Rings,
    pub(super) border_rings: u32,
    /// The furthest that a point may move, in nanometres: a pixel and a half.
    pub(super) leash: f64,
}

impl Placer<'_> {
    /// How far from a trace's own copper its region reaches at least, in nanometres.
    pub(super) fn band(&self) -> f64 {
        self.sites.band.to_f64()
    }

    /// The nearest of several sites. An edge of a ring that shows its back, across a thin piece of
    /// copper, is no nearer for that.
    fn reach(&self, candidates: &Candidates, p: Spot) -> Reach {
        self.nearest(candidates, p).1
    }

    /// The nearest of several sites, and its distance.
    fn nearest(&self, candidates: &Candidates, p: Spot) -> (u32, Reach) {
        let mut nearest = (BACKGROUND, Reach { distance: f64::INFINITY, away: Spot::default() });
        let mut least = f64::INFINITY;
        for &label in candidates.as_slice() {
            let reach = self.site(label, p);
            let rank = rank(&self.sites.sites[label as usize], reach);
            if rank < least {
                (least, nearest) = (rank, (label, reach));
            }
        }
        nearest
    }

    fn site(&self, label: u32, p: Spot) -> Reach {
        self.sites.sites[label as usize].reach(&self.sites.rings, p)
    }

    /// The curve of `target` at a point of it.
    fn curve(&self, target: &Target, p: Spot) -> Curve {
        let nearest = |candidates: &Candidates| match candidates.as_slice() {
            [only] => *only,
            _ => self.nearest(candidates, p).0,
        };
        match target {
            Target::Between(a, b) => {
                let (a, b) = (nearest(a), nearest(b));
                if self.owners[a as usize] < self.owners[b as usize] {
                    Curve::Between(a, b)
                } else {
                    Curve::Between(b, a)
                }
            }
            Target::At(a, _) => Curve::At(nearest(a)),
            Target::OnBorder => Curve::Border,
        }
    }

    /// The vertex with its curve.
    pub(super) fn on_curve(&self, target: &Target, vertex: Vertex) -> Placed {
        Placed { vertex, curve: self.curve(target, vertex.at) }
    }

    /// Whether one curve goes over into another without a corner worth the name, as seen from a
    /// point near both.
    pub(super) fn is_smooth(&self, one: Curve, other: Curve, p: Spot) -> bool {
        let alike = |a: u32, b: u32| {
            let (one, other) = (self.site(a, p), self.site(b, p));
            let apart = (one.distance - other.distance).abs();
            a == b
                || ((one.away - other.away).length() < SMOOTH && apart < SMOOTH * SMOOTH * one.distance.abs())
        };
        match (one, other) {
            (Curve::Between(a, b), Curve::Between(c, d)) => alike(a, c) && alike(b, d),
            (Curve::At(a), Curve::At(b)) => alike(a, b),
            (Curve::Border, Curve::Border) => true,
            (Curve::Between(..) | Curve::At(_) | Curve::Border, _) => false,
        }
    }

    fn miss(&self, target: &Target, p: Spot) -> Miss {
        match target {
            Target::Between(a, b) => {
                let (a, b) = (self.reach(a, p), self.reach(b, p));
                Miss {
                    value: a.distance - b.distance,
                    slope: a.away - b.away,
                    clearance: a.distance.min(b.distance),
                    away: a.away,
                }
            }
            Target::At(a, level) => {
                let a = self.reach(a, p);
                Miss { value: a.distance - level, slope: a.away, clearance: a.distance, away: a.away }
            }
            Target::OnBorder => {
                let border = self.border.border(0..self.border_rings, p);
                // The least of a node's clearances counts, and that is its nets'; finite so that it
                // can be interpolated.
                let (clearance, away) = (Nm::MAX.to_f64(), Spot::default());
                Miss { value: border.distance, slope: border.away, clearance, away }
            }
        }
    }

    /// Who is nearest to `p`, if anybody within `level`; none where only the picture can tell.
    pub(super) fn owner(&self, p: Spot, level: f64) -> Option<u32> {
        let (owner, reach) = self.near.as_ref()?.near.nearest(self.sites, p, |_| true);
        Some(if reach.distance > level { BACKGROUND } else { owner })
    }

    /// The distance from `p` to the copper that the target speaks of, in nanometres.
    pub(super) fn clearance(&self, target: &Target, p: Spot) -> f64 {
        self.miss(target, p).clearance
    }

    /// The point near `from` that satisfies `target`, with its course; none where there is none
    /// within the leash. Sites that prove nearer join the target.
    pub(super) fn project(&self, target: &mut Target, from: Spot) -> Option<Vertex> {
        for _ in 0..ROUNDS {
            let found = self.solve(target, from).or_else(|| self.corner(target, from))?;
            if !self.admit(target, found) {
                return Some(found);
            }
        }
        None
    }

    /// The point near `from` at which two sites are as far as a level line is from either: its
    /// corner in the wedge between them, where steps away from the one lead too near to the other.
    fn corner(&self, target: &Target, from: Spot) -> Option<Vertex> {
        let Target::At(sites, level) = target else { return None };
        let (first, _) = self.nearest(sites, from);
        let mut one = self.target_of(Curve::At(first), *level);
        let beside = self.solve(&one, from)?;
        let (second, _) = self.nearest(sites, beside.at);
        let mut other = self.target_of(Curve::At(second), *level);
        if second == first { Some(beside) } else { self.meet(&mut one, &mut other, from) }
    }

    /// A node as a vertex of the curve that `target` has there: on its course, if it satisfies
    /// that. Sites that prove nearer join the target.
    pub(super) fn join_node(&self, target: &mut Target, node: Vertex) -> Placed {
        for _ in 0..ROUNDS {
            if !self.admit(target, node) {
                break;
            }
        }
        let miss = self.miss(target, node.at);
        let fits = miss.value.abs() <= ACCEPTED && (miss.clearance - node.clearance()).abs() <= ACCEPTED;
        self.on_curve(target, if fits { miss.vertex(node.at) } else { node })
    }

    /// Whether a curve may have corners of its own: beside the edges of a ring, which a site hands
    /// on to the next one.
    pub(super) fn is_angular(&self, curve: Curve) -> bool {
        let is_ring = |label: u32| matches!(self.sites.sites[label as usize].form, Form::Chain { .. });
        match curve {
            Curve::Between(a, b) => is_ring(a) || is_ring(b),
            Curve::At(a) => is_ring(a),
            Curve::Border => true,
        }
    }

    /// Whether the same edge or corner of either side is nearest at all of these places on one
    /// curve.
    pub(super) fn is_one_part(&self, places: [Placed; 3]) -> bool {
        let is_one = |label: u32| {
            let parts = places
                .map(|placed| self.sites.sites[label as usize].part(&self.sites.rings, placed.vertex.at));
            parts[0] == parts[1] && parts[1] == parts[2]
        };
        let curve = places[0].curve;
        places.iter().all(|placed| placed.curve == curve)
            && match curve {
                Curve::Between(a, b) => is_one(a) && is_one(b),
                Curve::At(a) => is_one(a),
                Curve::Border => false,
            }
    }

    /// Where one curve ends and another begins, near `from`: on the course of either; none where
    /// there is no such corner within the leash, or where on both sides another site takes over,
    /// which must be at two places.
    pub(super) fn kink(&self, one: Curve, other: Curve, level: f64, from: Spot) -> Option<[Placed; 2]> {
        let in_common = match (one, other) {
            (Curve::Between(a, b), Curve::Between(c, d)) => a == c || b == d,
            (Curve::At(_), Curve::At(_)) => true,
            (Curve::Between(..) | Curve::At(_) | Curve::Border, _) => false,
        };
        if !in_common {
            return None;
        }
        let mut targets = [one, other].map(|curve| self.target_of(curve, level));
        let [first, second] = &mut targets;
        let met = self.meet(first, second, from)?;
        let placed = targets.map(|target| self.on_curve(&target, self.miss(&target, met.at).vertex(met.at)));
        (placed[0].curve == one && placed[1].curve == other).then_some(placed)
    }

    /// The equation of a curve; `level` is the distance that bounds regions against the background.
    fn target_of(&self, curve: Curve, level: f64) -> Target {
        let only = |label: u32| {
            let mut candidates = Candidates::default();
            candidates.add(label);
            candidates
        };
        match curve {
            Curve::Between(a, b) => Target::Between(only(a), only(b)),
            Curve::At(a) if self.sites.sites[a as usize].flat => Target::At(only(a), self.band()),
            Curve::At(a) => Target::At(only(a), level),
            Curve::Border => Target::OnBorder,
        }
    }

    /// The equation that holds on either of two curves.
    pub(super) fn either(&self, one: Curve, other: Curve, level: f64) -> Target {
        let [one, other] = [one, other].map(|curve| self.target_of(curve, level));
        one.join(&other)
    }

    /// Takes the site into `target` that is nearer to a place than those it has; false if there is
    /// none.
    fn admit(&self, target: &mut Target, place: Vertex) -> bool {
        let owner = |candidates: &Candidates| {
            candidates.as_slice().first().map_or(BACKGROUND, |&label| self.owners[label as usize])
        };
        let owners = match target {
            Target::Between(a, b) => [owner(a), owner(b)],
            Target::At(a, _) => [owner(a); 2],
            Target::OnBorder => return false,
        };
        let bound = place.clearance() - NEARER;
        let is_new = |label: u32| !target.has(label);
        let label =
            self.near.as_ref().and_then(|near| near.nearer(self.sites, place.at, bound, owners, is_new));
        match (label, target) {
            (Some(label), Target::Between(a, _) | Target::At(a, _))
                if self.owners[label as usize] == owners[0] =>
            {
                a.admit(label);
            }
            (Some(label), Target::Between(_, b)) => b.admit(label),
            (Some(_), Target::At(..) | Target::OnBorder) | (None, _) => return false,
        }
        true
    }

    /// The point near `from` that satisfies `target` as it stands.
    fn solve(&self, target: &Target, from: Spot) -> Option<Vertex> {
        let mut p = from;
        let mut miss = self.miss(target, p);
        for _ in 0..STEPS {
            if miss.value.abs() <= SETTLED {
                break;
            }
            let steepness = miss.slope.dot(miss.slope);
            if steepness < LEVEL * LEVEL {
                // Beside a slit of a few nanometres one place is as good as another.
                return (miss.value.abs() <= ACCEPTED).then(|| miss.vertex(p));
            }
            p = p - miss.slope * (miss.value / steepness);
            if (p - from).length() > self.leash {
                return self.bisect(target, from);
            }
            miss = self.miss(target, p);
        }
        if miss.value.abs() > ACCEPTED {
            return self.bisect(target, from);
        }
        Some(miss.vertex(p))
    }

    /// The same by halving the interval of one leash on either side along the gradient.
    fn bisect(&self, target: &Target, from: Spot) -> Option<Vertex> {
        let slope = self.miss(target, from).slope;
        let length = slope.length();
        if length < LEVEL {
            return None;
        }
        let way = slope * (self.leash / length);
        let (mut low, mut high) = (from - way, from + way);
        if self.miss(target, low).value > 0.0 || self.miss(target, high).value < 0.0 {
            return None;
        }
        for _ in 0..40 {
            let middle = low.midpoint(high);
            if self.miss(target, middle).value < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let miss = self.miss(target, low);
        (miss.value.abs() <= ACCEPTED).then(|| miss.vertex(low))
    }

    /// The point near `from` that satisfies both targets; none where there is none within the
    /// leash.
    pub(super) fn meet(&self, first: &mut Target, second: &mut Target, from: Spot) -> Option<Vertex> {
        for _ in 0..ROUNDS {
            let found = self.solve_both(first, second, from)?;
            if !self.admit(first, found) && !self.admit(second, found) {
                return Some(found);
            }
        }
        None
    }

    /// The same where one of the targets leads nowhere, as beside a slit of a few nanometres: a
    /// point that satisfies the other satisfies it too.
    fn solve_level(&self, first: &Target, second: &Target, from: Spot) -> Option<Vertex> {
        [(first, second), (second, first)].into_iter().find_map(|(level, other)| {
            let found = self.solve(other, from)?;
            let miss = self.miss(level, found.at);
            let is_level = miss.slope.length() < LEVEL && miss.value.abs() <= ACCEPTED;
            is_level.then(|| Vertex::new(found.at, miss.clearance.min(found.clearance())))
        })
    }

    fn solve_both(&self, first: &Target, second: &Target, from: Spot) -> Option<Vertex> {
        let mut p = from;
        for _ in 0..STEPS * 2 {
            let (a, b) = (self.miss(first, p), self.miss(second, p));
            if a.value.abs() <= SETTLED && b.value.abs() <= SETTLED {
                return Some(Vertex::new(p, a.clearance.min(b.clearance)));
            }
            let determinant = a.slope.cross(b.slope);
            if determinant.abs() < 1e-4 {
                return self.solve_level(first, second, from);
            }
            let step = Spot::new(
                a.value * b.slope.y - b.value * a.slope.y,
                b.value * a.slope.x - a.value * b.slope.x,
            ) * (1.0 / determinant);
            p = p - step;
            let sine = determinant.abs() / (a.slope.length() * b.slope.length());
            if (p - from).length() * sine.max(SHALLOW) > self.leash {
                return None;
            }
        }
        let (a, b) = (self.miss(first, p), self.miss(second, p));
        (a.value.abs().max(b.value.abs()) <= ACCEPTED).then_some(Vertex::new(p, a.clearance.min(b.clearance)))
    }
}
