//! Sites: what a picture draws, and who owns it.

use crate::geometry::{Arc, Turn};

use super::plane::Spot;

/// The shape of a site.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// A point.
    Point(Spot),
    /// A line.
    Line(Spot, Spot),
    /// A circular arc: counter-clockwise from `from` to `to` round `center`, or the whole circle.
    Arc { center: Spot, from: Spot, to: Spot },
    /// The edge of a ring that begins at vertex `first`: copper lies to the left.
    Edge { ring: u32, first: u32 },
    /// The inside of a polygon: the edges of `rings`.
    Inside { first_ring: u32, rings: u32 },
    /// What lies beyond the board's edge; its border is kept elsewhere.
    Outside,
}

/// A site with the width that its feature has round it.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) form: Form,
    /// How far the copper reaches round the form, in nanometres.
    pub(super) radius: f64,
    /// The owner: see [`Sites::OUTSIDE`](super::seed).
    pub(super) owner: u32,
    /// Whether it is a trace's own copper drawn above the cones (the paper's minimum width,
    /// §III-D.2): a boundary that meets it runs along its edge.
    pub(super) flat: bool,
}

impl Form {
    /// An arc of the board as a form.
    pub(super) fn arc(arc: &Arc) -> Self {
        let (from, to) = match arc.turn {
            Turn::CounterClockwise => (arc.start, arc.end),
            Turn::Clockwise => (arc.end, arc.start),
        };
        Self::Arc { center: arc.center.into(), from: from.into(), to: to.into() }
    }
}
