//! The walk: a bisector is followed from a certified place to its first event.
//!
//! ```text
//!     a ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓          One step: from p along the bisector to q, no farther than the nearest end of a slab. Whatever
//!      ╭───────────────╮                could enter a circle that is empty at p reaches into the hull of the circles at p and q
//!      │ p ─────────── q │ hull         (see sweep.rs); what is nearest to q is solved for first, and where it enters shortens the
//!      ╰───────────────╯     ●          step, so that most of the others are out of it. The first to enter is the event. Only what
//!     b ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓          *enters* counts: its foot lies ahead of those of a and b.
//! ```
//!
//! Along a bisector the feet on both generators move in one sense only (see
//! [`Form::meet`](super::form::Form::meet)), so the place of the foot on one of them orders all
//! events.

use std::ops::ControlFlow;

use super::apollonius;
use super::form::{Form, Place, clockwise};
use super::pair::Pair;
use super::sweep::Sweep;
use super::tolerances::{FLAT, SLAB, resolution};
use super::{Diagram, Kind, NOBODY};
use crate::voronoi::plane::Spot;

/// A step is so many clearances long, and no shorter than this, in nanometres. Measured: see the
/// module's table.
const STRIDE: f64 = 2.0;
const LEAST: f64 = 20_000.0;

/// Where a step reaches more generators than this, the nearest are looked for first. Chosen: more
/// than a step reaches on most boards.
const MANY: usize = 32;

/// Who cannot step so far has come to where two generators touch, in nanometres. Chosen.
const SHORTEST: f64 = 1e-4;

/// What a flat touch may be seen off its place, in nanometres: the root of a tie times the largest
/// radius. Chosen.
const NEAR: f64 = 2_000.0;

/// Steps in an edge at most, chosen far above need: a fault rather than a hang.
const STEPS: usize = 100_000;

/// How an edge ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum Event {
    /// At a place, where a third generator enters or one of the two ends (then `third` is one of
    /// them).
    Junction { at: Spot, clearance: f64, third: u32, way: Spot },
    /// Where the window ends.
    Window { at: Spot, clearance: f64, way: Spot },
    /// Where the two generators touch each other.
    Contact { at: Spot, way: Spot },
    /// Nowhere that can be explained.
    Fault,
}

/// A place on a bisector.
#[derive(Clone, Copy)]
struct Here {
    at: Spot,
    clearance: f64,
    place: Place,
}

/// What is the same for all that may enter on one step of a walk.
struct Step<'a> {
    pair: &'a Pair,
    /// The generator that orders places, as [`Pair::main`] says, its form, and the sense in which
    /// feet move on it.
    main: usize,
    form: &'a Form,
    sense: f64,
    here: Here,
    /// Where the walk began, and what is tied there, ascending.
    start: Spot,
    tied: &'a [u32],
    /// What is tied leaves the circle within so much of the start.
    near: f64,
}

/// A candidate for the event: how far ahead it is, where, how far from copper, and by whom.
type Hit = (f64, Spot, f64, u32);

impl Pair {
    /// The end of an edge that runs into a notch, if it does: there both distances are zero.
    fn contact(&self, here: &Here, tie: f64) -> Event {
        let [left, right] = &self.forms;
        let mut at = here.at;
        for _ in 0..4 {
            let (u, v) = (left.away(at), right.away(at));
            let volume = u.cross(v);
            let (e, f) = (-left.distance(at), -right.distance(at));
            let step = Spot::new(e * v.y - f * u.y, f * u.x - e * v.x) * (1.0 / volume);
            if volume.abs() < 1e-9 || step.length() > NEAR {
                break;
            }
            at = at + step;
        }
        let touches = self.forms.iter().all(|form| form.distance(at).abs() < tie);
        if touches { Event::Contact { at, way: self.way(here.at) } } else { Event::Fault }
    }
}

impl Diagram {
    /// Follows a bisector from `start`, where `tied`, ascending, are tied, to its first event.
    pub(super) fn follow(&self, pair: &Pair, start: Spot, tied: &[u32]) -> Event {
        let main = pair.main(start);
        let (form, sense) = (&pair.forms[main], pair.sense(main));
        let mut here = Here { at: start, clearance: form.distance(start).max(0.0), place: form.place(start) };
        let end = self.nearest_end(pair, main, &here);
        let mut stride = STRIDE;
        for _ in 0..STEPS {
            let Some((mut next, mut is_end)) = self.step(pair, main, &here, end.as_ref(), stride) else {
                return pair.contact(&here, self.tie);
            };
            let mut leaves = false;
            if !self.holds(next.at) {
                (next, leaves, is_end) = (self.leave(pair, main, &here, next), true, false);
            }
            let ahead = form.progress(here.place, next.place, sense);
            let near = resolution(self.tie, here.clearance);
            let step = Step { pair, main, form, sense, here, start, tied, near };
            if let Some((_, at, clearance, third)) = self.first_hit(&step, &next, ahead) {
                return Event::Junction { at, clearance, third, way: pair.way(at) };
            }
            let Here { at, clearance, .. } = next;
            if leaves {
                return Event::Window { at, clearance, way: pair.way(at) };
            }
            if is_end {
                let third = if pair.left == NOBODY { pair.right } else { pair.left };
                return Event::Junction { at, clearance, third, way: pair.way(at) };
            }
            here = next;
            stride = (stride * 1.5).min(8.0);
        }
        Event::Fault
    }

    /// What is nearer to copper ends an edge: what lies beyond does not matter.
    pub(super) fn floor(&self, pair: &Pair) -> f64 {
        match self.kind {
            Kind::Above(floor) | Kind::Between(floor)
                if pair.right != NOBODY && self.owner(pair.left) == self.owner(pair.right) =>
            {
                floor.to_f64()
            }
            Kind::Owners | Kind::MedialAxis | Kind::Above(_) | Kind::Between(_) => 0.0,
        }
    }

    /// The first place ahead where a slab ends, or a disc hands over.
    fn nearest_end(&self, pair: &Pair, main: usize, here: &Here) -> Option<Here> {
        let mut nearest: Option<(f64, Here)> = None;
        for side in 0..2 {
            let (form, sense) = (&pair.forms[side], pair.sense(side));
            let from = form.place(here.at);
            let number = [pair.left, pair.right][side];
            let breaks = if number == NOBODY { &[] } else { self.breaks.of(number as usize) };
            // Of its own two ends the one ahead.
            let own = form.ends().map(|[start, end]| if sense > 0.0 { end } else { start });
            let ends = own.into_iter().chain(breaks.iter().copied());
            for place in ends {
                let ahead = form.progress(from, place, sense);
                // In nanometres where it is small, which alone matters here.
                let out = form.bend(here.at).unwrap_or(1.0);
                let is_behind = matches!(form, Form::Circle { .. }) && (4.0 - ahead) * out <= 2.0 * SLAB;
                if ahead * out <= SLAB || is_behind {
                    continue;
                }
                let Some((at, clearance)) = pair.at(side, place) else { continue };
                let there = Here { at, clearance, place: pair.forms[main].place(at) };
                let mut along = pair.forms[main].progress(here.place, there.place, pair.sense(main));
                if along < -1e-9 {
                    continue;
                }
                along = along.max(0.0);
                if nearest.as_ref().is_none_or(|(least, _)| along < *least) {
                    nearest = Some((along, there));
                }
            }
        }
        let form = &pair.forms[main];
        for at in pair.forms[0].crossings(&pair.forms[1]).into_iter().flatten() {
            let there = Here { at, clearance: 0.0, place: form.place(at) };
            let along = form.progress(here.place, there.place, pair.sense(main));
            if along > 0.0 && nearest.as_ref().is_none_or(|(least, _)| along < *least) {
                nearest = Some((along, there));
            }
        }
        nearest.map(|(_, there)| there)
    }

    /// One step ahead, and whether it reaches the end.
    fn step(
        &self,
        pair: &Pair,
        main: usize,
        here: &Here,
        end: Option<&Here>,
        stride: f64,
    ) -> Option<(Here, bool)> {
        let (form, sense) = (&pair.forms[main], pair.sense(main));
        let out = form.bend(here.at).unwrap_or(1.0);
        let way = pair.way(here.at);
        let across = match here.place {
            Place::Along(_) => way.dot(clockwise(form.away(here.at))).abs(),
            Place::Toward(n) => way.cross(n).abs(),
        };
        // An ellipse may be far narrower than the way to copper is long, and the two ends of a
        // hyperbola far nearer to each other than its way is: no step goes round.
        let turns = |at: Spot| pair.way(at).dot(way) < 0.0;
        let wanted = (here.clearance * stride).max(LEAST);
        let mut length = wanted * across.max(1e-6);
        for _ in 0..60 {
            let place = form.advance(here.place, sense * length, out);
            let ahead = form.progress(here.place, place, sense);
            if let Some(end) = end
                && form.progress(here.place, end.place, sense) <= ahead
                && (end.at - here.at).length() <= 3.0 * wanted
                && !turns(end.at)
            {
                return Some((*end, true));
            }
            if let Some((at, clearance)) = pair.at(main, place)
                && (at - here.at).length() <= 3.0 * wanted
                && !turns(at)
            {
                return Some((Here { at, clearance, place }, false));
            }
            length *= 0.5;
            if length < SHORTEST {
                break;
            }
        }
        None
    }

    /// The place where the way from one place to another, beyond the window, leaves it.
    fn leave(&self, pair: &Pair, main: usize, here: &Here, beyond: Here) -> Here {
        let form = &pair.forms[main];
        let (mut inside, mut outside) = (*here, beyond);
        for _ in 0..60 {
            let Some(place) = inside.place.halfway(outside.place, pair.sense(main)) else { break };
            let Some((at, clearance)) = pair.at(main, place) else { break };
            let middle = Here { at, clearance, place: form.place(at) };
            if self.holds(at) { inside = middle } else { outside = middle }
        }
        outside
    }

    /// The first generator that enters between two places, if any does.
    fn first_hit(&self, step: &Step<'_>, next: &Here, ahead: f64) -> Option<Hit> {
        let Step { pair, here, .. } = step;
        let mut sweep = Sweep::new(pair, (here.at, here.clearance), (next.at, next.clearance), self.tie);
        let mut first: Option<Hit> = None;
        let mut reached = self.reached(step, &sweep, MANY).unwrap_or_else(|| {
            first = self.nearest_hit(step, &mut sweep, ahead);
            self.reached(step, &sweep, usize::MAX).unwrap_or_default()
        });
        let mut ahead = first.map_or(ahead, |hit| hit.0);
        let mut tried = 0;
        while let Some(&(_, c)) = reached.get(tried) {
            tried += 1;
            let Some(hit) = self.enters(step, &sweep, c, ahead) else { continue };
            let (along, at, clearance, _) = hit;
            (first, ahead) = (Some(hit), along);
            sweep.shorten((at, clearance));
            // What only touches where another one enters is tied there.
            reached.drain(..tried);
            reached.retain(|&(_, c)| !sweep.misses(&self.forms()[c as usize]));
            self.sort_by_distance(&mut reached, sweep.to);
            tried = 0;
        }
        let nearer = |&&(off, c): &&(f64, u32)| {
            off < -self.tie && self.forms()[c as usize].counts(next.at, self.tie, SLAB)
        };
        let missed = || reached.iter().filter(nearer).map(|&(_, c)| c).min();
        first.or_else(|| self.entry(pair, step.main, here, next, missed()?))
    }

    /// Shortens a sweep to where what is nearest to its end enters, again and again, as long as
    /// that takes much of it away; the last of what enters.
    fn nearest_hit(&self, step: &Step<'_>, sweep: &mut Sweep, mut ahead: f64) -> Option<Hit> {
        let mut first = None;
        while let Some(hit) =
            self.nearest_third(step.pair, sweep.to).and_then(|c| self.enters(step, sweep, c, ahead))
        {
            let (along, at, clearance, _) = hit;
            let is_much = along < ahead * 0.75;
            (first, ahead) = (Some(hit), along);
            sweep.shorten((at, clearance));
            if !is_much {
                break;
            }
        }
        first
    }

    /// What is nearest to a place on a bisector, where it is nearer than what that lies between.
    fn nearest_third(&self, pair: &Pair, (at, clearance): (Spot, f64)) -> Option<u32> {
        let (mut least, mut nearest) = (clearance - self.tie, None);
        self.index.visit_nearest(at, clearance, |c| {
            let form = &self.forms()[c as usize];
            let off = form.distance(at);
            if off < least && form.counts(at, self.tie, SLAB) && !self.is_own(pair, c) {
                (least, nearest) = (off, Some(c));
            }
            least
        });
        nearest
    }

    /// What may enter between two places, in the order of how much farther than copper it is at the
    /// second; none if that is more than so many.
    fn reached(&self, step: &Step<'_>, sweep: &Sweep, most: usize) -> Option<Vec<(f64, u32)>> {
        // Rarely more: lists that grow make threads wait for each other.
        let mut reached = Vec::with_capacity(MANY + 1);
        let (chord, reach) = sweep.swath(step.form);
        let shown = self.index.visit_along(chord, reach, |c| {
            if !sweep.misses(&self.forms()[c as usize]) && !self.is_own(step.pair, c) {
                reached.push((0.0, c));
            }
            if reached.len() > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        if shown.is_break() {
            return None;
        }
        self.sort_by_distance(&mut reached, sweep.to);
        reached.dedup();
        Some(reached)
    }

    /// Sorts generators by how much farther than copper they are from a place, which they are given
    /// with then.
    fn sort_by_distance(&self, generators: &mut [(f64, u32)], (at, clearance): (Spot, f64)) {
        for (off, c) in &mut *generators {
            *off = self.forms()[*c as usize].distance(at) - clearance;
        }
        generators.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    }

    /// Where a generator enters on the way to a place, no farther along than `limit`.
    fn enters(&self, step: &Step<'_>, sweep: &Sweep, c: u32, limit: f64) -> Option<Hit> {
        let Step { pair, form, sense, here, start, tied, near, .. } = *step;
        // The way strays from its chord by no more than half of it.
        let next = sweep.to.0;
        let around = (here.at.midpoint(next), (next - here.at).length());
        let other = &self.forms()[c as usize];
        let was_tied = tied.binary_search(&c).is_ok();
        let mut first: Option<Hit> = None;
        for (at, s) in
            apollonius::solve_within([&pair.forms[0], &pair.forms[1], other], around).into_iter().flatten()
        {
            let along = form.progress(here.place, form.place(at), sense);
            let limit = first.map_or(limit, |hit| hit.0);
            if !(along > 0.0 && along <= limit) || other.slack(at) < -SLAB || s < -self.tie {
                continue;
            }
            let off = (at - start).length();
            let is_near = off < 2.0 * self.tie || (was_tied && off < near);
            let entering = (other.away(at) - form.away(at)).dot(pair.way(at));
            if (is_near && entering > -0.1) || entering >= -FLAT {
                continue;
            }
            first = Some((along, at, s, c));
        }
        first
    }

    /// Where a generator comes nearer that touches too flatly for an equation: by halving.
    fn entry(&self, pair: &Pair, main: usize, here: &Here, next: &Here, c: u32) -> Option<Hit> {
        let (form, other) = (&pair.forms[main], &self.forms()[c as usize]);
        let (mut clear, mut hit) = (*here, *next);
        for _ in 0..80 {
            let Some(place) = clear.place.halfway(hit.place, pair.sense(main)) else { break };
            let Some((at, clearance)) = pair.at(main, place) else { break };
            let middle = Here { at, clearance, place };
            let nearer = other.distance(at) < clearance - self.tie / 4.0 && other.counts(at, self.tie, SLAB);
            if nearer { hit = middle } else { clear = middle }
        }
        let along = form.progress(here.place, hit.place, pair.sense(main));
        let (at, clearance) = touch(pair, other, hit.at, self.tie).unwrap_or((hit.at, hit.clearance));
        Some((along, at, clearance, c))
    }

    /// The place at which a generator that is nearer at the end of a way along a bisector entered.
    pub(super) fn entered(
        &self,
        pair: &Pair,
        start: Spot,
        (at, clearance): (Spot, f64),
        c: u32,
    ) -> Option<(Spot, f64)> {
        let main = pair.main(start);
        let form = &pair.forms[main];
        let here = Here { at: start, clearance: form.distance(start).max(0.0), place: form.place(start) };
        let next = Here { at, clearance, place: form.place(at) };
        self.entry(pair, main, &here, &next, c).map(|(_, at, clearance, _)| (at, clearance))
    }

    /// Whether a generator is one of two or joined to one of them.
    fn is_own(&self, pair: &Pair, c: u32) -> bool {
        let is_one = |i| i == c || (i != NOBODY && self.generators.are_joined(i, c));
        is_one(pair.left) || is_one(pair.right)
    }
}

/// The place near `p` where an end of a line or an arc begins to touch one of two generators from
/// within.
fn touch(pair: &Pair, other: &Form, p: Spot, tie: f64) -> Option<(Spot, f64)> {
    let slacks = other.slacks(p);
    let end = usize::from(slacks[1].abs() < slacks[0].abs());
    let (foot, normal) = other.foot(other.ends()?[end]);
    let meetings = pair.forms.iter().filter_map(|form| form.meet(foot, normal));
    let mut places = meetings.map(|s| (foot + normal * s, s));
    places.find(|&(at, s)| {
        (at - p).length() < NEAR && pair.forms.iter().all(|form| (form.distance(at) - s).abs() < tie)
    })
}
