//! The resolved board: what [`import`](crate::import) promises and everything after it trusts.
//!
//! Apertures, macros, repeats and polarity are gone: a copper layer is a list of dark [`Feature`]s,
//! exact in nanometres, that may overlap. Where a file erased copper, the pieces left are polygons
//! (see [`polarity`]). Coordinates are the file's own: seen from the front, x to the right, y up,
//! also for the back.

mod boolean;
mod copper;
pub mod diagnostic;
mod excerpt;
mod feature;
mod hole;
mod outline;
pub mod polarity;
mod source;
mod warning;

pub use copper::{Attributes, Copper, Side};
pub use diagnostic::{Diagnostic, Sentence, Severity, Words};
pub use excerpt::{Excerpt, SourceSpan, show};
pub use feature::{Axis, Feature, Shape};
pub use hole::{Hole, Plating};
pub use outline::Outline;
pub use source::{ApertureUse, Source};
pub use warning::Warning;

use crate::geometry::{Nm, Rect};

/// How far a polygon may leave the curve it stands for: flattened arcs of regions, macros and
/// outlines.
///
/// Chosen: a quarter of the 1 µm that the toolpath promises off the true bisector.
pub const FLATTEN: Nm = Nm::new(250);

/// A printed-circuit board, as far as its files tell.
#[derive(Clone, Debug, Default)]
pub struct Board {
    /// The name its output files carry.
    pub name: String,
    /// The copper of the front (component) side.
    pub front: Option<Copper>,
    /// The copper of the back (solder) side, seen from the front.
    pub back: Option<Copper>,
    /// The edge of the board.
    pub outline: Option<Outline>,
    /// Holes and slots, in file order.
    pub holes: Vec<Hole>,
    /// How thick it is, where a file says so.
    pub thickness: Option<Nm>,
    /// What it covered before parts of it were left aside: where its zero lies does not depend on
    /// what is made of it.
    pub whole: Option<Rect>,
}

impl Board {
    /// The copper of `side`.
    #[must_use]
    pub const fn copper(&self, side: Side) -> Option<&Copper> {
        match side {
            Side::Front => self.front.as_ref(),
            Side::Back => self.back.as_ref(),
        }
    }

    /// Leaves aside all but the copper of `side` and the outline.
    pub fn leave_copper(&mut self, side: Side) {
        self.whole = self.bounds();
        self.holes.clear();
        match side {
            Side::Front => self.back = None,
            Side::Back => self.front = None,
        }
    }

    /// A rectangle that holds the outline, or without one the copper of both sides and the holes,
    /// those that were left aside, too.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        self.outline.as_ref().map(Outline::bounds).or(self.whole).or_else(|| {
            let copper = [&self.front, &self.back].into_iter().flatten().filter_map(Copper::bounds);
            copper.chain(self.holes.iter().map(Hole::bounds)).reduce(Rect::union)
        })
    }
}
