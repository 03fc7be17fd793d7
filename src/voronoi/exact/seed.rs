//! Seeds: certified places from which every piece of the graph is reached.
//!
//! ```text
//!   ╔══════════════ window ═══════════╗     *Rays.* Beyond the rightmost point of a net, straight on, no copper farther left comes
//!   ║   ▓▓▓▓                          ║     nearer. Of all nets within a loop of boundary take the rightmost: its ray leaves its cell
//!   ║   ▓▓▓▓●─────×                   ║     across that loop. So one ray for each net finds every loop.
//!   ║           ▓▓▓▓▓●─────────────   ║     *Window.* All other pieces leave the window. So its sides are walked: a side is the
//!   ╚═════════════════════════════════╝     bisector of the nearest generator and its mirror image, and what enters there is met.
//! ```
//!
//! The medial axis of one connected part of the free space is connected; what one owner encloses
//! has a part of its own, to which the normals of edges that lie open lead (`exposed`).

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::exposed::Bodies;
use super::form::{Form, Place};
use super::graph::Growth;
use super::pair::Pair;
use super::tolerances::SLAB;
use super::vertex::Junction;
use super::walk::Event;
use super::{Diagram, Kind, NOBODY, Space};
use crate::voronoi::plane::Spot;

/// Where a search begins, in nanometres, if the window is so large; it doubles. Chosen.
const FIRST_REACH: f64 = 100_000.0;

/// Events along one side of the window at most. Chosen.
const EVENTS: usize = 1_000_000;

impl Diagram {
    /// Sows all seeds, and grows what comes of them.
    pub(super) fn sow(&self, growth: &mut Growth, space: Space) {
        // Of what lies outside all else the rightmost point may be at the end of free space, and a
        // piece of what is loose lies in another.
        let is_covered = space == Space::Within || self.generators.is_loose;
        let bodies = is_covered.then(|| Bodies::new(self));
        let right = Spot::new(1.0, 0.0);
        let seed = |&(generator, foot): &(u32, Spot)| {
            let is_open = bodies.as_ref().is_none_or(|bodies| !bodies.cover(foot, right));
            is_open.then(|| self.shoot((generator, foot, right), bodies.as_ref())).flatten()
        };
        let seeds: Vec<Option<Junction>> = self.rightmost().par_iter().map(seed).collect();
        for seed in seeds.into_iter().flatten() {
            growth.place(seed);
        }
        self.grow(growth);
        if space != Space::Within {
            self.sow_window(growth);
            self.grow(growth);
        }
        if matches!(self.kind, Kind::MedialAxis | Kind::Above(_)) {
            self.sow_exposed(growth);
        }
    }

    /// The rightmost point of each owner, with the generator that has it; of each disc, where what
    /// an owner has may lie in pieces.
    fn rightmost(&self) -> Vec<(u32, Spot)> {
        let right = Spot::new(1.0, 0.0);
        let is_loose = self.generators.is_loose;
        let key = |i: u32| (self.owner(i), if is_loose { i } else { 0 });
        let mut found: BTreeMap<(u32, u32), (f64, u32, Spot)> = BTreeMap::new();
        for (i, form) in (0_u32..).zip(self.forms()) {
            let Form::Circle { hollow: false, .. } = form else { continue };
            let (foot, _) = form.foot(Place::Toward(right));
            if form.slack(foot) < 0.0 {
                continue;
            }
            let best = found.entry(key(i)).or_insert((f64::NEG_INFINITY, i, foot));
            if foot.x > best.0 {
                *best = (foot.x, i, foot);
            }
        }
        found.into_values().map(|(_, i, foot)| (i, foot)).collect()
    }

    /// What begins where the normal of a generator leads to a place that is as near to another,
    /// unless `bodies` hold it.
    pub(super) fn shoot(
        &self,
        (generator, foot, normal): (u32, Spot, Spot),
        bodies: Option<&Bodies<'_>>,
    ) -> Option<Junction> {
        let farthest = self.farthest();
        let mut reach = FIRST_REACH.min(farthest);
        let mut nearest: Option<(f64, u32)> = None;
        while reach < 2.0 * farthest {
            self.index.visit_round(foot + normal * reach, reach, |c| {
                let form = &self.forms()[c as usize];
                if c == generator || !self.parts(generator, c) || self.generators.are_joined(generator, c) {
                    return;
                }
                let Some(s) = form.meet(foot, normal).filter(|&s| s > self.tie) else { return };
                let nearer = nearest.is_none_or(|known| (s, c) < known);
                if nearer && form.counts(foot + normal * s, self.tie, SLAB) {
                    nearest = Some((s, c));
                }
            });
            match nearest {
                Some((s, _)) if s <= reach => break,
                Some((s, _)) => reach = s.min(2.0 * reach),
                None => reach *= 2.0,
            }
        }
        // From its centre on a hollow circle is nearer elsewhere: there its own ends meet.
        let own = match self.forms()[generator as usize] {
            Form::Circle { radius, hollow: true, .. } => Some((radius, generator)),
            Form::Circle { .. } | Form::Line { .. } => None,
        };
        let (s, other) = nearest.into_iter().chain(own).min_by(|a, b| a.0.total_cmp(&b.0))?;
        let at = foot + normal * s;
        // A ray from what is not the rightmost of its owner, or one along an edge, may lead through
        // copper.
        if bodies.is_some_and(|bodies| bodies.hold(at, true)) {
            return None;
        }
        let is_low = match self.kind {
            Kind::Above(floor) | Kind::Between(floor) => {
                s < floor.to_f64() && self.owner(generator) == self.owner(other)
            }
            Kind::Owners | Kind::MedialAxis => false,
        };
        if self.holds(at) && !is_low { self.seed(at, s, [generator, other]) } else { None }
    }

    /// What begins at a place where two generators are equally near: there, if it is a vertex, else
    /// at the next one.
    fn seed(&self, at: Spot, clearance: f64, [a, b]: [u32; 2]) -> Option<Junction> {
        let junction = self.junction(at, clearance, [a, b, b])?;
        let passing = match junction.slots[..] {
            // A boundary passes here, also where others touch the circle and do not enter: whether
            // it is a vertex shows who comes along it.
            [one, other]
                if self.owner(one.left) == self.owner(other.right)
                    && self.owner(one.right) == self.owner(other.left) =>
            {
                self.end_of(&self.pair(one.left, one.right), at)
            }
            _ => None,
        };
        Some(passing.unwrap_or(junction))
    }

    fn plant_pair(&self, growth: &mut Growth, pair: &Pair, at: Spot) {
        match self.end_of(pair, at) {
            Some(junction) => {
                growth.place(junction);
            }
            None => growth.fault(at),
        }
    }

    /// Where an edge ends that passes a place.
    fn end_of(&self, pair: &Pair, at: Spot) -> Option<Junction> {
        let tied = [pair.left.min(pair.right), pair.left.max(pair.right)];
        self.ending(pair, at, self.follow(pair, at, &tied)).map(|arrival| arrival.junction)
    }

    /// No two places of the window are so far apart, in nanometres.
    fn farthest(&self) -> f64 {
        let [left, bottom, right, top] = self.window;
        (right - left) + (top - bottom)
    }

    /// The generator nearest to a place outside all copper.
    fn nearest(&self, p: Spot) -> Option<(u32, f64)> {
        let farthest = self.farthest();
        let mut reach = FIRST_REACH.min(farthest);
        while reach < 4.0 * farthest {
            let near = self.within(p, reach);
            if let Some(&found) = near.iter().min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0))) {
                return Some(found);
            }
            reach *= 2.0;
        }
        None
    }

    /// Walks the sides of the window, and plants what crosses them.
    fn sow_window(&self, growth: &mut Growth) {
        let [left, bottom, right, top] = self.window;
        let corners =
            [(left, bottom), (right, bottom), (right, top), (left, top)].map(|(x, y)| Spot::new(x, y));
        for (i, &corner) in corners.iter().enumerate() {
            let axis = super::form::unit(corners[(i + 1) % 4] - corner);
            self.sow_side(growth, corner, axis);
        }
    }

    /// Walks one side, the window on its left.
    fn sow_side(&self, growth: &mut Growth, corner: Spot, axis: Spot) {
        let Some((nearest, distance)) = self.nearest(corner) else { return };
        let mut at = corner;
        let mut tied: Vec<u32> =
            self.within(corner, distance + self.tie).into_iter().map(|(i, _)| i).collect();
        let mut current = self.ahead_of(corner, distance, axis, &tied).unwrap_or(nearest);
        for _ in 0..EVENTS {
            let form = self.forms()[current as usize];
            let image = form.mirrored(corner, axis);
            let pair = Pair { left: current, right: NOBODY, forms: [form, image] };
            let Event::Junction { at: next, clearance, third, .. } = self.follow(&pair, at, &tied) else {
                return;
            };
            // The bisector of an image strays from the side by rounding only.
            let next = corner + axis * (next - corner).dot(axis);
            let Some(junction) = self.junction(next, clearance, [current, third, third]) else {
                growth.fault(next);
                return;
            };
            tied = self.within(next, clearance + self.tie).into_iter().map(|(i, _)| i).collect();
            for slot in junction.slots.iter().filter(|slot| axis.cross(slot.way) > 0.0) {
                self.plant_pair(growth, &self.pair(slot.left, slot.right), next);
            }
            let Some(ahead) = self.ahead_of(next, clearance, axis, &tied) else { return };
            (current, at) = (ahead, next);
        }
        growth.fault(at);
    }
}
