//! What no pixel showed.
//!
//! ```text
//!            ╭──○──╮              A site beside a stretch of boundary shorter than a pixel may be nearest to no pixel's centre, and
//!   ●┄┄┄┄┄┄┄┄╯┄┄┄┄┄╰┄┄┄┄┄┄┄┄●     vertices on either side ask for what is near to them alone: the curve ┄ between them passes it
//!             ▁▁▁▁▁               nearer than it knows.
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//! ```
//!
//! So once all is placed every curve asks the index for sites of its own two regions that come
//! nearer to it than its clearance. Where one does, the boundary is followed anew from there to
//! both sides. Then what is cut depends on pixels no more, but for which regions meet.

use rayon::prelude::*;

use super::BACKGROUND;
use super::near::{comes_within, rank};
use super::plane::Spot;
use super::site::Site;
use super::span::{Span, Vertex};
use super::stitch::Line;
use super::tip::{HALVINGS, Tips};

/// A site must be nearer than a curve knows by more than this, in nanometres. Chosen: half of it is
/// what the curve may be off.
const NEARER: f64 = 400.0;
/// A curve that is off by less is left as it is, in nanometres. As for probes.
const OFF: f64 = 200.0;
/// The foot on a site and that on a curve are sought by turns so often. Chosen: for sites as short
/// as are overlooked, one is nearly enough.
const TURNS: usize = 3;
/// A turn that leads on by less is none, in nanometres along the curve. Chosen: at a clearance of
/// 0.1 mm the distance is then right within a fifth of [`NEARER`].
const STEP: f64 = 4_000.0;
/// What is found beside one site may pass another: so often at most. Chosen: more than two is not
/// seen.
const ROUNDS: u32 = 4;

impl Tips<'_> {
    /// Leads lines off sites that come nearer to them than they know.
    pub(super) fn look_again(&self, lines: &mut [Line]) {
        // Lines are outside of copper already, and asking of insides costs all their edges.
        let outside = Tips { insides: None, ..*self };
        lines.par_iter_mut().filter(|line| !line.is_border()).for_each(|line| {
            let pair = (line.left, line.right);
            let ways: Vec<(usize, Vec<Vertex>)> = (1..)
                .zip(line.vertices.windows(2))
                .filter_map(|(i, ends)| Some((i, outside.way(pair, ends[0], ends[1], ROUNDS)?)))
                .collect();
            // From the end on, so that the places of the others stay.
            for (i, way) in ways.into_iter().rev() {
                line.vertices.splice(i..i, way);
            }
        });
    }

    /// The vertices that the curve between two others lacks; none where it lacks none.
    fn way(&self, pair: (u32, u32), from: Vertex, to: Vertex, rounds: u32) -> Option<Vec<Vertex>> {
        if rounds == 0 || from.at == to.at {
            return None;
        }
        let found = self.overlooked(pair, from, to)?;
        let mut way = vec![from];
        let before = self.halve(pair, from, found, HALVINGS, &mut way);
        way.push(found);
        let after = self.halve(pair, found, to, HALVINGS, &mut way);
        way.push(to);
        if !before || !after {
            return None;
        }
        let mut whole = Vec::with_capacity(way.len());
        for ends in way.windows(2) {
            whole.extend(self.way(pair, ends[0], ends[1], rounds - 1).into_iter().flatten());
            whole.push(ends[1]);
        }
        whole.pop();
        Some(whole)
    }

    /// A true place of the boundary that the curve between two vertices misses: beside the site
    /// that comes nearest against what the curve knows, or half way, where its two regions are not
    /// equally far.
    fn overlooked(&self, pair: (u32, u32), from: Vertex, to: Vertex) -> Option<Vertex> {
        let span = Span::new(from, to);
        if span.is_known_within(NEARER) {
            return None;
        }
        let (middle, room) = (span.place(0.5), from.clearance().max(to.clearance()));
        let strip = Strip::new(from.at, to.at, room - NEARER + span.bulge());
        // Beside the middle either region begins where the curve says; one that does not is seen no
        // farther than to tell.
        let known = span.clearance(0.5) + 2.0 * NEARER;
        let level = |owner: u32| if owner == BACKGROUND { self.level } else { known };
        let mut far = [level(pair.0), level(pair.1)];
        let mut most = (NEARER, None);
        self.near.visit_along(from.at, to.at, room + NEARER, &mut |label, bounds| {
            let site = &self.sites.sites[label as usize];
            if site.owner != pair.0 && site.owner != pair.1 {
                return;
            }
            let far = &mut far[usize::from(site.owner == pair.1)];
            if comes_within(bounds, middle, *far) {
                *far = far.min(rank(site, site.reach(&self.sites.rings, middle)));
            }
            if strip.meets(bounds) {
                let (t, distance) = self.closest(&span, site, bounds);
                let excess = span.clearance(t) - distance;
                if excess > most.0 {
                    most = (excess, Some(span.place(t)));
                }
            }
        });
        let [is_lost, is_other_lost] = far.map(|far| far >= known);
        let is_level = pair.0 == BACKGROUND || pair.1 == BACKGROUND;
        // Copper that is not in reach is beyond the level; of two nets, one that is not has been
        // lost sight of.
        let strays = if is_level {
            (far[0] - far[1]).abs() > NEARER && !is_lost && !is_other_lost
        } else {
            (far[0] - far[1]).abs() > NEARER || (is_lost && is_other_lost)
        };
        let place = most.1.or_else(|| strays.then_some(middle))?;
        let found = self.project(pair, place)?;
        (found.is_between(from, to) && (found.at - place).length() > OFF).then_some(found)
    }

    /// Where on a curve a site with these bounds is nearest, and how far it is there.
    fn closest(&self, span: &Span, site: &Site, [left, bottom, right, top]: [f64; 4]) -> (f64, f64) {
        let mut t = span.foot(Spot::new(f64::midpoint(left, right), f64::midpoint(bottom, top)));
        let mut turns = 0;
        loop {
            let p = span.place(t);
            let reach = site.reach(&self.sites.rings, p);
            let next = span.foot(p - reach.away * (reach.distance + site.radius));
            if turns == TURNS || (next - t).abs() * span.length() < STEP {
                return (t, rank(site, reach));
            }
            (t, turns) = (next, turns + 1);
        }
    }
}

/// The places nearer than so much to the chord of a curve: what has no part in it is as far from
/// the curve as that knows.
struct Strip {
    from: Spot,
    /// The unit vector along.
    along: Spot,
    length: f64,
    reach: f64,
}

impl Strip {
    fn new(from: Spot, to: Spot, reach: f64) -> Self {
        let length = (to - from).length();
        Self { from, along: (to - from) * (1.0 / length), length, reach: reach.max(0.0) }
    }

    /// Whether a box, left, bottom, right, top, may have a part in it.
    fn meets(&self, [left, bottom, right, top]: [f64; 4]) -> bool {
        let center = Spot::new(f64::midpoint(left, right), f64::midpoint(bottom, top)) - self.from;
        let (x, y) = (self.along.x.abs(), self.along.y.abs());
        let (width, height) = ((right - left) / 2.0, (top - bottom) / 2.0);
        let beside = (center.cross(self.along).abs() - (y * width + x * height)).max(0.0);
        let beyond = (center.dot(self.along) - self.length / 2.0).abs() - self.length / 2.0;
        let beyond = (beyond - (x * width + y * height)).max(0.0);
        beside * beside + beyond * beyond < self.reach * self.reach
    }
}
