//! Corners of polylines, and places too far away.

use crate::import::drawing::Place;

/// A corner of a polyline, and how it goes on from there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Vertex {
    pub(super) at: Place,
    pub(super) bulge: f64,
    /// How wide it is at the start and at the end of the step.
    pub(super) widths: (f64, f64),
}

/// A place that lies beyond the range of coordinates.
#[derive(Debug)]
pub(super) struct Beyond;
