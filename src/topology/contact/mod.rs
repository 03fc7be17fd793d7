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

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::board::{Copper, FLATTEN, Shape};

use super::sets::DisjointSets;
use crate::geometry::{Nm, RectIndex};

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
            || sets.clone(),
            |mut sets, feature| {
                self.join_one(feature, &mut sets);
                sets
            },
        );
        joined.reduce_with(DisjointSets::merged).unwrap_or_else(|| sets.clone())
    }

    /// Joins a feature to all that come after it and touch it.
    fn join_one(&self, feature: usize, sets: &mut DisjointSets) {
        let body = &self.bodies[feature];
        let number = |index: usize| u32::try_from(index).expect("fewer than 2³² features");
        let own = number(feature);
        let _ = self.index.visit(body.bounds().inflate(JOINED), |other| {
            if other > feature
                && sets.find(own) != sets.find(number(other))
                && body.is_within(&self.bodies[other], JOINED)
            {
                sets.union(own, number(other));
            }
            ControlFlow::Continue(())
        });
    }
}
