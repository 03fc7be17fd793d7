//! The medial axis of areas: where the largest discs that fit an area have their centres, with
//! their radii.
//!
//! ```text
//!  ┌──────────┐
//!  │╲        ╱│
//!  │ ●──────● │
//!  │╱        ╲│
//!  └──────────┘
//! ```
//!
//! A way leads from node to node. Where it ends in a corner the disc shrinks to nothing; a V-bit
//! that follows it, as deep as the disc is wide, mills the area to its edges and no farther. Curves
//! are chords here, and between each two of them ends an edge of the diagram: what is dropped
//! reaches no farther than what a cut may be off ([`Pruning`]).
//!
//! The ways are those of the certified [diagram](super::exact) of the area's edges. H. Blum, *A
//! Transformation for Extracting New Descriptors of Shape*, 1967; the filter by corners is that of
//! OpenVoronoi (A. Wallin), the one by loss is the object of D. Attali, A. Montanvert, *Computing
//! and simplifying 2D and 3D continuous skeletons*, CVIU 67 (1997): a branch counts as far as the
//! disc at its root does not cover the discs along it.

mod insets;
mod interior;
mod joining;
pub mod nest;
mod pruning;
mod thinning;

use rayon::prelude::*;

use crate::board::FLATTEN;
use crate::geometry::{Point, between};

pub use insets::insets;
pub use interior::Interior;

use joining::join;
use pruning::prune;

/// Which branches are left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pruning {
    /// Those whose discs reach beyond the disc at their root by no more than this, in nanometres.
    pub loss: f64,
    /// Those that end in a corner at which the edge turns by an angle with a larger cosine than
    /// this; 1 keeps all corners, OpenVoronoi's filter is 0.8.
    pub corner: f64,
}

impl Pruning {
    /// The least loss at which a curve has no branch between its chords, in nanometres. Derived: a
    /// corner between two chords reaches so far beyond the disc that touches both as they are off
    /// the curve; 37 nm more is how far rounding, and [another attempt](Interior), move the corner,
    /// and as much the chords.
    pub const CHORDS: f64 = FLATTEN.to_f64() + 2.0 * 37.0;
}

/// A place with the radius of the largest disc round it that fits the area, in nanometres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where.
    pub at: (f64, f64),
    /// How far from the edge.
    pub clearance: f64,
}

/// A part of the axis from node to node.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// The nodes at its ends; none for a loop, of which the last place is the first again.
    pub ends: Option<[u32; 2]>,
    /// Places along it; chords follow the axis and the clearance within a tenth of a micrometre.
    pub course: Vec<Place>,
}

impl Way {
    /// The parts of it where the clearance is at least so many nanometres, in order.
    #[must_use]
    pub fn wide_parts(&self, least: f64) -> Vec<Vec<Place>> {
        let mut parts: Vec<Vec<Place>> = Vec::new();
        let mut before: Option<Place> = None;
        for &place in &self.course {
            let is_wide = place.clearance >= least;
            let was_wide = before.is_some_and(|before| before.clearance >= least);
            let edge = before.filter(|_| is_wide != was_wide).map(|before| before.toward(place, least));
            if is_wide && !was_wide {
                parts.push(edge.into_iter().collect());
            }
            if let Some(part) = parts.last_mut().filter(|_| is_wide || was_wide) {
                part.push(if is_wide { place } else { edge.unwrap_or(place) });
            }
            before = Some(place);
        }
        parts
    }
}

impl Place {
    /// The place on the way to another that has this clearance, between those of both.
    pub(crate) fn toward(self, other: Self, clearance: f64) -> Self {
        let part = (clearance - self.clearance) / (other.clearance - self.clearance);
        Self { at: between(self.at, other.at, part), clearance }
    }
}

/// The medial axis of areas.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MedialAxis {
    /// Where ways end or meet.
    pub nodes: Vec<Place>,
    /// What lies between.
    pub ways: Vec<Way>,
    /// Nodes without a way: the axis of an area that is round.
    pub dots: Vec<u32>,
    /// Places where the diagram has a flaw, and a way may be missing: none, unless the program is
    /// at fault.
    pub faults: Vec<Point>,
}

/// How far chords of the axis may leave it, in nanometres. Chosen: a twentieth of what a cut may be
/// off.
const CHORD: f64 = 100.0;

impl MedialAxis {
    /// The medial axis of areas, each by itself.
    #[must_use]
    pub fn new(areas: &[Interior<'_>], pruning: &Pruning) -> Self {
        let parts: Vec<Self> = areas.par_iter().map(|area| Self::of_area(area, pruning)).collect();
        let mut whole = Self::default();
        for part in parts {
            let offset = u32::try_from(whole.nodes.len()).expect("below 2³² nodes");
            whole.nodes.extend(part.nodes);
            let moved = |way: Way| Way { ends: way.ends.map(|ends| ends.map(|end| end + offset)), ..way };
            whole.ways.extend(part.ways.into_iter().map(moved));
            whole.dots.extend(part.dots.into_iter().map(|dot| dot + offset));
            whole.faults.extend(part.faults);
        }
        whole
    }

    fn of_area(area: &Interior<'_>, pruning: &Pruning) -> Self {
        let diagram = area.diagram();
        join(diagram, &prune(diagram, pruning), CHORD)
    }

    /// The largest clearance; zero for nothing.
    #[must_use]
    pub fn widest(&self) -> f64 {
        let along = self.ways.iter().flat_map(|way| &way.course);
        along.chain(&self.nodes).map(|place| place.clearance).fold(0.0, f64::max)
    }
}
