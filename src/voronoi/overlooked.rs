//! What no pixel showed.
//!
//! ```text
//!            ╭──○──╮              A site beside a stretch of boundary shorter than a pixel may be nearest to no pixel's centre, and
//!   ●┄┄┄┄┄┄┄┄╯┄┄┄┄┄╰┄┄┄┄┄┄┄┄●     vertices on either side ask for what is near to them alone: the curve ┄ between them passes it
//!             ▁▁▁▁▁               nearer than it knows.
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//! ```
//!
//! So once all is placed every curve asks the index for sites of its own two regions that come nearer to it than its clearance. Where one
//! does, the boundary is followed anew from there to both sides. Then what is cut depends on pixels no more, but for which regions meet.

use rayon::prelude::*;

use super::near::rank;
use super::site::Site;
use super::span::{Span, Vertex};
use super::stitch::Line;
use super::tip::{HALVINGS, Tips};
use super::{BACKGROUND, OUTSIDE};

/// A site must be nearer than a curve knows by more than this, in nanometres. Chosen: half of it is what the curve may be off.
const NEARER: f64 = 400.0;
/// A curve that is off by less is left as it is, in nanometres. As for probes.
const OFF: f64 = 200.0;
/// The foot on a site and that on a curve are sought by turns so often. Chosen: for sites as short as are overlooked, one is nearly enough.
const TURNS: usize = 3;
/// What is found beside one site may pass another: so often at most. Chosen: more than two is not seen.
const ROUNDS: u32 = 4;

impl Tips<'_> {
    /// Leads lines off sites that come nearer to them than they know.
    pub(super) fn look_again(&self, lines: &mut [Line]) {
        // Lines are outside of copper already, and asking of insides costs all their edges.
        let outside = Tips { insides: None, ..*self };
        let is_border = |line: &Line| line.left == OUTSIDE || line.right == OUTSIDE;
        lines.par_iter_mut().filter(|line| !is_border(line)).for_each(|line| {
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

    /// A true place of the boundary that the curve between two vertices misses: beside the site that comes nearest against what the curve knows, or
    /// half way, where its two regions are not equally far.
    fn overlooked(&self, pair: (u32, u32), from: Vertex, to: Vertex) -> Option<Vertex> {
        let span = Span::new(from, to);
        let (middle, room) = (span.place(0.5), from.clearance().max(to.clearance()));
        let reached = room + (to.at - from.at).length();
        let level = |owner: u32| if owner == BACKGROUND { self.level } else { f64::INFINITY };
        let mut far = [level(pair.0), level(pair.1)];
        let mut most = (NEARER, None);
        self.near.visit_along(from.at, to.at, room + NEARER, &mut |label| {
            let site = &self.sites.sites[label as usize];
            if site.owner != pair.0 && site.owner != pair.1 {
                return;
            }
            let distance = rank(site, site.reach(&self.sites.rings, middle));
            let far = &mut far[usize::from(site.owner == pair.1)];
            *far = far.min(distance);
            if distance < reached {
                let (t, distance) = self.closest(&span, site);
                let excess = span.clearance(t) - distance;
                if excess > most.0 {
                    most = (excess, Some(span.place(t)));
                }
            }
        });
        // Copper that is not in reach is beyond the level; of two nets, one that is not has been lost sight of.
        let is_told = pair.0 != BACKGROUND && pair.1 != BACKGROUND || far[0].max(far[1]).is_finite();
        let strays = is_told && (far[0] - far[1]).abs() > NEARER;
        let place = most.1.or_else(|| strays.then_some(middle))?;
        let found = self.project(pair, place)?;
        (found.is_between(from, to) && (found.at - place).length() > OFF).then_some(found)
    }

    /// Where on a curve a site is nearest, and how far it is there.
    fn closest(&self, span: &Span, site: &Site) -> (f64, f64) {
        let mut t = 0.5;
        for _ in 0..TURNS {
            let p = span.place(t);
            let reach = site.reach(&self.sites.rings, p);
            t = span.foot(p - reach.away * (reach.distance + site.radius));
        }
        (t, rank(site, site.reach(&self.sites.rings, span.place(t))))
    }
}
