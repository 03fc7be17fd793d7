//! The exact method: features whose copper touches conduct, decided in integers.
//!
//! Candidates come from an R-tree over the features' rectangles, so the time is near-linear; a pair
//! that is joined already, by coincidence or through others, is not looked at.
//!
//! What is no farther apart than [`JOINED`] touches: what was drawn side by side is parted by so
//! much where corners of a slanted pad were rounded, or a curve became chords.

mod area;
mod body;
mod near;
mod nearest;
mod sector;

use rayon::prelude::*;

use crate::board::{Copper, FLATTEN, Shape};

use super::sets::DisjointSets;
use crate::geometry::{Met, Nm, RectIndex};

pub(super) use body::{Body, Narrowest};

/// Copper so near to other copper is one with it. Derived: curves are flattened within so much, and
/// less cannot be told from nothing; the narrowest gap that is etched is a hundred times wider.
pub(crate) const JOINED: Nm = FLATTEN;

/// How many features one worker takes at least.
///
/// Chosen: they take about a millisecond, against which handing them out and merging the sets is
/// little.
const SHARE: usize = 2048;

/// All features prepared and by place.
#[derive(Debug)]
pub(super) struct Bodies {
    pub(super) bodies: Vec<Body>,
    pub(super) index: RectIndex,
}

impl Bodies {
    pub(super) fn new(copper: &Copper) -> Self {
        Self::of(copper.features.par_iter().map(|feature| &feature.shape))
    }

    pub(super) fn of<'a>(shapes: impl IndexedParallelIterator<Item = &'a Shape>) -> Self {
        let bodies: Vec<Body> = shapes.with_min_len(SHARE).map(Body::new).collect();
        let index = RectIndex::new(bodies.iter().map(Body::bounds));
        Self { bodies, index }
    }

    /// `sets` with every two features joined that touch.
    ///
    /// Each worker joins on its own and the partitions are merged; how the work is shared cannot
    /// change the result, which is the finest partition that has all touching pairs together.
    pub(super) fn join(&self, sets: &DisjointSets) -> DisjointSets {
        let shares = self.index.order().into_par_iter().with_min_len(SHARE);
        let joined = shares.fold(
            || Joining::new(self, sets),
            |mut joining, feature| {
                joining.join(feature);
                joining
            },
        );
        let joined = joined.map(|joining| joining.sets);
        joined.reduce_with(DisjointSets::merged).unwrap_or_else(|| sets.clone())
    }
}

/// A partition that features are added to, one after another.
struct Joining<'a> {
    bodies: &'a Bodies,
    sets: DisjointSets,
    /// Of each node of the index a member of the one set that all below it are in, if it is known.
    one: Vec<Option<u32>>,
    /// The nodes that the feature at hand was looked for in, each before those below it.
    entered: Vec<usize>,
}

/// If so many features are met that are joined already it is worth finding out which nodes need
/// never be entered again. Chosen: more than meet each other on boards.
const MANY: usize = 64;

impl<'a> Joining<'a> {
    fn new(bodies: &'a Bodies, sets: &DisjointSets) -> Self {
        let one = vec![None; bodies.index.tree().nodes()];
        Self { bodies, sets: sets.clone(), one, entered: Vec::new() }
    }

    /// Joins a feature to all that come after it and touch it.
    fn join(&mut self, feature: usize) {
        let Self { bodies: Bodies { bodies, index }, sets, one, entered } = self;
        let body = &bodies[feature];
        let own = number(feature);
        let mut joined = 0;
        entered.clear();
        index.visit_entered(body.bounds().inflate(JOINED), |met| match met {
            Met::Node(node) => {
                let is_new = one[node].is_none_or(|member| sets.find(member) != sets.find(own));
                if is_new {
                    entered.push(node);
                }
                is_new
            }
            Met::Box(other) => {
                if sets.find(own) == sets.find(number(other)) {
                    joined += 1;
                } else if other > feature && body.is_within(&bodies[other], JOINED) {
                    sets.union(own, number(other));
                }
                true
            }
        });
        if joined > MANY {
            self.mark();
        }
    }

    /// Finds out which of the nodes that were entered have one set below them.
    fn mark(&mut self) {
        let Self { bodies: Bodies { index, .. }, sets, one, entered } = self;
        for &node in entered.iter().rev() {
            let mut members = index.tree().below(node).map(|met| match met {
                Met::Box(feature) => Some(number(feature)),
                Met::Node(below) => one[below],
            });
            let first = members.next().flatten();
            let is_one = first.is_some_and(|first| {
                members.all(|member| member.is_some_and(|member| sets.find(member) == sets.find(first)))
            });
            one[node] = first.filter(|_| is_one);
        }
    }
}

fn number(index: usize) -> u32 {
    u32::try_from(index).expect("fewer than 2³² features")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::topology::random;

    /// Heaps of discs of which most lie on each other, and some that reach from one to the next.
    #[test]
    fn heaps_are_joined_as_each_pair_would_be() {
        let mut random = random();
        let shapes: Vec<Shape> = (0..3_000)
            .map(|i| {
                let heap = Nm::from_um(1_000 * (i % 7));
                let center = Point::new(heap + Nm::from_um(random(700)), Nm::from_um(random(300)));
                Shape::Disc { center, radius: Nm::from_um(20 + random(140)) }
            })
            .collect();
        let bodies = Bodies::of(shapes.par_iter());
        let mut pairs = DisjointSets::new(shapes.len());
        for (i, one) in bodies.bodies.iter().enumerate() {
            for (j, other) in bodies.bodies.iter().enumerate().skip(i + 1) {
                if one.is_within(other, JOINED) {
                    pairs.union(number(i), number(j));
                }
            }
        }
        let (joined, pairs) = (bodies.join(&DisjointSets::new(shapes.len())), pairs.representatives());
        assert_eq!(joined.representatives(), pairs);
        let nets = pairs.iter().zip(0..).filter(|&(&first, member)| first == member).count();
        assert!(nets > 1, "not all are one: {nets}");
    }
}
