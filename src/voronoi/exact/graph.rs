//! The graph: walks from seeds until every edge of every vertex that was met has been followed.
//!
//! A vertex is known by its place; what arrives there continues in the slot that looks back. So
//! each edge is walked once, and two ends that do not find each other are a fault with a place.

use std::sync::OnceLock;
use std::{iter, mem};

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::form::turn;
use super::pair::Pair;
use super::tolerances::{SNAP, resolution};
use super::vertex::{Junction, Slot};
use super::walk::Event;
use super::{Diagram, Edge, Link, Space, Vertex};
use crate::topology::Groups;
use crate::voronoi::plane::Spot;

/// The graph as it grows.
#[derive(Default)]
pub(super) struct Growth {
    tie: f64,
    /// So many slots are followed at a time, the same for any number of threads.
    at_once: usize,
    pub(super) junctions: Vec<Junction>,
    edges: Vec<Edge>,
    /// The last junction of each cell of the plane, and of each junction the one before it there.
    last: FxHashMap<[i64; 2], u32>,
    before: Vec<Option<u32>>,
    /// Slots that nobody has followed yet.
    open: Vec<(u32, usize)>,
    faults: Vec<Spot>,
}

/// How often an event is corrected that the certificate contradicts. Chosen: more than was ever
/// seen.
const RETRIES: usize = 8;

/// The cosine of the angle of feet on one side of an edge is less off 1 than this. Derived: what
/// bulges by a tie has feet that differ by √(2 · tie / radius), a hundredth for a radius of 400 nm.
const BESIDE: f64 = 1e-4;

/// The side of a cell, in nanometres. Chosen: what one vertex may be off, mostly.
const CELL: f64 = 1_000.0;

#[expect(clippy::cast_possible_truncation, reason = "a board is smaller than 2⁶³ nanometres")]
fn cell(p: Spot) -> [i64; 2] {
    [(p.x / CELL).floor() as i64, (p.y / CELL).floor() as i64]
}

impl Growth {
    /// The junction at the place of another, or where the same generators are tied all the way
    /// there.
    fn known(&self, junction: &Junction) -> Option<u32> {
        let Junction { at, clearance, .. } = *junction;
        let reach = resolution(self.tie, clearance);
        let [low, high] = [cell(at - Spot::new(reach, reach)), cell(at + Spot::new(reach, reach))];
        let cells = (low[0]..=high[0]).flat_map(|x| (low[1]..=high[1]).map(move |y| [x, y]));
        let in_cell = |cell: [i64; 2]| {
            iter::successors(self.last.get(&cell).copied(), |&number| self.before[number as usize])
        };
        let off = |i: u32| (self.junctions[i as usize].at - at).length();
        let is_alike = |i: u32| self.junctions[i as usize].tied == junction.tied;
        let is_one = |&i: &u32| off(i) <= 2.0 * self.tie || (off(i) <= reach && is_alike(i));
        let known = cells.flat_map(in_cell).filter(is_one);
        known.min_by(|&a, &b| off(a).total_cmp(&off(b)).then(a.cmp(&b)))
    }

    /// The number of a junction, which is new or known.
    pub(super) fn place(&mut self, junction: Junction) -> u32 {
        if let Some(known) = self.known(&junction) {
            self.meet(known, junction);
            return known;
        }
        self.add(junction)
    }

    /// The number of a new junction.
    fn add(&mut self, junction: Junction) -> u32 {
        let number = u32::try_from(self.junctions.len()).expect("below 2³² vertices");
        self.before.push(self.last.insert(cell(junction.at), number));
        self.open.extend((0..junction.slots.len()).map(|slot| (number, slot)));
        self.junctions.push(junction);
        number
    }

    /// Where copper touches, edges end from all sides: those of another part of free space, too.
    fn meet(&mut self, number: u32, other: Junction) {
        let known = &mut self.junctions[number as usize];
        if !(known.is_end && other.is_end) {
            return;
        }
        for slot in other.slots {
            let is_known = |own: &Slot| (own.left, own.right) == (slot.left, slot.right);
            if !known.slots.iter().any(is_known) {
                self.open.push((number, known.slots.len()));
                known.slots.push(slot);
            }
        }
    }

    /// Whether nobody has followed a slot yet.
    fn is_open(&self, junction: u32, slot: usize) -> bool {
        self.junctions[junction as usize].slots[slot].edge.is_none()
    }

    /// The open slots that are followed next.
    fn batch(&mut self) -> Vec<(u32, usize)> {
        let mut batch = Vec::with_capacity(self.at_once);
        while batch.len() < self.at_once
            && let Some((junction, slot)) = self.open.pop()
        {
            if self.is_open(junction, slot) {
                batch.push((junction, slot));
            }
        }
        batch
    }

    pub(super) const fn is_faulty(&self) -> bool {
        !self.faults.is_empty()
    }

    pub(super) fn fault(&mut self, at: Spot) {
        self.faults.push(at);
    }

    /// The slot of a junction that looks back along an edge that arrives in direction `way`.
    fn back(
        &self,
        junction: u32,
        left: u32,
        right: u32,
        way: Spot,
        same: impl Fn(&Slot) -> bool,
    ) -> Option<usize> {
        let slots = self.junctions[junction as usize].slots.iter().enumerate();
        let free = slots.filter(|(_, slot)| slot.edge.is_none());
        let exact = free.clone().find(|(_, slot)| slot.left == right && slot.right == left);
        let alike = || free.filter(|(_, slot)| same(slot) && slot.way.dot(way) < -0.5);
        exact.or_else(|| alike().min_by(|a, b| a.1.way.dot(way).total_cmp(&b.1.way.dot(way)))).map(|(i, _)| i)
    }

    fn connect(&mut self, (from, slot): (u32, usize), to: u32, back: usize) {
        let number = u32::try_from(self.edges.len()).expect("below 2³² edges");
        let Slot { left, right, .. } = self.junctions[from as usize].slots[slot];
        self.edges.push(Edge { from, to, left, right });
        self.junctions[from as usize].slots[slot].edge = Some(number);
        self.junctions[to as usize].slots[back].edge = Some(number);
    }
}

/// How an edge ends.
pub(super) struct Arrival {
    pub(super) junction: Junction,
    /// The place on the edge that was taken for the junction, and its distance from copper.
    at: Spot,
    clearance: f64,
    /// The direction there.
    pub(super) way: Spot,
}

/// The pair that an edge is between, the junction at which it ends, and the direction in which it
/// arrives.
type Reached = (Pair, Junction, Spot);

/// Where one edge ends alone.
fn dead_end(pair: &Pair, at: Spot, clearance: f64, way: Spot) -> Arrival {
    let slot = Slot { left: pair.right, right: pair.left, way: way * -1.0, edge: None };
    let tied = vec![pair.left.min(pair.right), pair.left.max(pair.right)];
    let junction = Junction { at, clearance, tied, slots: vec![slot], is_end: true };
    Arrival { junction, at, clearance, way }
}

impl Diagram {
    /// Finds all vertices and edges, following so many `at_once`.
    pub(super) fn walk_all(&mut self, space: Space, at_once: usize) {
        // Room that nothing is written to takes no memory, and lists that grow are there twice.
        let most = self.generators.len();
        let (junctions, edges) = (Vec::with_capacity(most), Vec::with_capacity(most));
        let mut growth = Growth { tie: self.tie, at_once, junctions, edges, ..Growth::default() };
        // Who comes from another thread than those that follow edges waits once.
        rayon::scope(|_| self.sow(&mut growth, space));
        self.finish(growth);
    }

    /// Follows all open slots, and what they lead to.
    pub(super) fn grow(&self, growth: &mut Growth) {
        while growth.faults.is_empty() && !growth.open.is_empty() {
            let batch = growth.batch();
            let known = &*growth;
            let follow = |&(from, slot): &(u32, usize)| {
                let Slot { left, right, .. } = known.junctions[from as usize].slots[slot];
                self.next(known, from, self.pair(left, right))
            };
            let found: Vec<Option<Reached>> = batch.par_iter().map(follow).collect();
            for (&(from, slot), reached) in batch.iter().zip(found) {
                // Whoever came along it from its other end was quicker.
                if growth.is_open(from, slot) {
                    match reached {
                        Some(reached) => self.join(growth, (from, slot), reached),
                        None => growth.fault(growth.junctions[from as usize].at),
                    }
                }
            }
        }
    }

    /// Notes an edge that was followed.
    fn join(&self, growth: &mut Growth, (from, slot): (u32, usize), (pair, ending, way): Reached) {
        let Pair { left, right, .. } = pair;
        let leaving = &mut growth.junctions[from as usize].slots[slot];
        (leaving.left, leaving.right) = (left, right);
        // Beyond the window it ends, however near to its beginning that is.
        let is_apart = !self.holds(ending.at) && growth.known(&ending) == Some(from);
        let to = if is_apart { growth.add(ending) } else { growth.place(ending) };
        let owners = |slot: &Slot| (self.owner(slot.left), self.owner(slot.right));
        let same = |slot: &Slot| owners(slot) == (self.owner(right), self.owner(left));
        match growth.back(to, left, right, way, same) {
            Some(back) => growth.connect((from, slot), to, back),
            None if growth.junctions[to as usize].is_end => {
                let slots = &mut growth.junctions[to as usize].slots;
                slots.push(Slot { left: right, right: left, way: way * -1.0, edge: None });
                let back = slots.len() - 1;
                growth.connect((from, slot), to, back);
            }
            None => growth.fault(growth.junctions[to as usize].at),
        }
    }

    /// The pair that an edge from a junction is between, the junction at which it ends, and the
    /// direction in which it arrives.
    fn next(&self, growth: &Growth, from: u32, mut pair: Pair) -> Option<Reached> {
        let home = &growth.junctions[from as usize];
        let near = resolution(self.tie, home.clearance) + SNAP;
        let mut start = home.at;
        for _ in 0..RETRIES {
            let event = self.follow(&pair, start, &home.tied);
            let Arrival { junction, at, clearance, way } = self.ending(&pair, start, event)?;
            // Ends of generators within a nanometre of each other are one vertex: beyond them.
            let is_home = matches!(event, Event::Junction { .. })
                && (at - home.at).length() < near
                && growth.known(&junction) == Some(from);
            if !is_home {
                return Some((pair, junction, way));
            }
            start = at;
            pair = self.ahead_of_pair(&pair, at, clearance);
        }
        None
    }

    /// What is nearest on either side of an edge a little ahead of a place on it.
    fn ahead_of_pair(&self, pair: &Pair, at: Spot, clearance: f64) -> Pair {
        let way = pair.way(at);
        let tied = self.about(at, clearance + self.tie, SNAP);
        let [left, right] = [0, 1].map(|side| {
            let [here, there] = [side, 1 - side].map(|side| pair.forms[side].away(at));
            let is_beside = |&i: &u32| {
                let away = self.forms()[i as usize].away(at);
                away.dot(here) > (1.0 - BESIDE).max(away.dot(there))
            };
            let beside: Vec<u32> = tied.iter().map(|&(i, _)| i).filter(is_beside).collect();
            self.ahead_of(at, clearance, way, &beside).unwrap_or([pair.left, pair.right][side])
        });
        self.pair(left, right)
    }

    pub(super) fn pair(&self, left: u32, right: u32) -> Pair {
        Pair { left, right, forms: [left, right].map(|i| self.forms()[i as usize]) }
    }

    /// How an edge from `start` ends.
    pub(super) fn ending(&self, pair: &Pair, start: Spot, event: Event) -> Option<Arrival> {
        match event {
            Event::Junction { at, clearance, way, .. } if clearance < self.tie => {
                Some(dead_end(pair, at, 0.0, way))
            }
            Event::Junction { mut at, mut clearance, mut third, .. } => {
                for _ in 0..RETRIES {
                    if clearance < self.floor(pair) {
                        let way = pair.way(at);
                        return Some(dead_end(pair, at, clearance, way));
                    }
                    if let Some(junction) = self.junction(at, clearance, [pair.left, pair.right, third]) {
                        return Some(Arrival { junction, at, clearance, way: pair.way(at) });
                    }
                    // The certificate names what was overlooked.
                    let nearer = self.within(at, clearance - self.tie);
                    third = nearer.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))?.0;
                    (at, clearance) = self.entered(pair, start, (at, clearance), third)?;
                }
                None
            }
            Event::Window { at, clearance, way } => Some(dead_end(pair, at, clearance, way)),
            Event::Contact { at, way } => Some(dead_end(pair, at, 0.0, way)),
            Event::Fault => None,
        }
    }

    /// Puts everything in an order of its own.
    fn finish(&mut self, growth: Growth) {
        let Growth { mut junctions, edges: grown, faults, .. } = growth;
        let place = |junction: &Junction| (junction.at.x, junction.at.y);
        let mut order: Vec<usize> = (0..junctions.len()).collect();
        order.sort_by(|&a, &b| {
            let ((ax, ay), (bx, by)) = (place(&junctions[a]), place(&junctions[b]));
            ax.total_cmp(&bx).then(ay.total_cmp(&by))
        });
        let mut numbers = vec![0_u32; order.len()];
        (0_u32..).zip(&order).for_each(|(number, &old)| numbers[old] = number);
        let turned = |edge: &Edge| {
            let [from, to] = [edge.from, edge.to].map(|old| numbers[old as usize]);
            let edge = Edge { from, to, ..*edge };
            let turned = Edge { from: to, to: from, left: edge.right, right: edge.left };
            (edge.min(turned), turned < edge)
        };
        let edges: Vec<(Edge, bool)> = grown.iter().map(turned).collect();
        let mut by_number: Vec<usize> = (0..edges.len()).collect();
        by_number.sort_by_key(|&old| edges[old]);
        let mut new_numbers = vec![0_u32; edges.len()];
        (0_u32..).zip(&by_number).for_each(|(number, &old)| new_numbers[old] = number);
        self.edges = by_number.iter().map(|&old| edges[old].0).collect();
        let leaving = |&old: &usize| {
            let junction = &mut junctions[old];
            let mut slots = mem::take(&mut junction.slots);
            slots.retain(|slot| slot.edge.is_some());
            if junction.is_end {
                let angle = |slot: &Slot| turn(Spot::new(1.0, 0.0), slot.way);
                slots.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
            }
            let link = |slot: Slot| {
                let number = slot.edge.map_or(0, |edge| edge as usize);
                let edge = &grown[number];
                let begins = if edge.from == edge.to {
                    (slot.left, slot.right) == (edge.left, edge.right)
                } else {
                    edge.from as usize == old
                };
                (new_numbers[number], edges[number].1 == begins)
            };
            slots.into_iter().map(link).collect::<Vec<Link>>()
        };
        self.leaving = Groups::of_each(order.iter().map(leaving));
        self.stretches = OnceLock::new();
        let vertex = |&old: &usize| {
            let Junction { at, clearance, ref mut tied, .. } = junctions[old];
            Vertex { at: (at.x, at.y), clearance, tied: mem::take(tied) }
        };
        self.vertices = order.iter().map(vertex).collect();
        self.faults = faults.iter().map(|at| at.rounded()).collect();
        self.faults.sort_unstable();
        self.faults.dedup();
    }
}
