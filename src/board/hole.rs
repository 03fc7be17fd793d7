//! Holes of a board: drilled, slotted or routed, plated or not.
//!
//! All three are one thing, a round cutter moved along a path, so that no later stage tells them
//! apart by format.

use crate::geometry::{Nm, Path, Point, Rect, Segment, distance_to_segment};

use super::{FLATTEN, Shape};

/// Whether a hole's wall is plated, and so joins the two sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Plating {
    /// Through-plated.
    Plated,
    /// Not plated.
    NonPlated,
    /// The file does not say.
    Unknown,
}

/// A drilled hole, a slot, or a routed contour: a round cutter of `diameter` moved along `path`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hole {
    /// Where the middle of the cutter goes: a path without segments is a plain hole.
    pub path: Path,
    /// The cutter's diameter.
    pub diameter: Nm,
    /// Whether the wall is plated.
    pub plating: Plating,
    /// The tool's number in its file.
    pub tool: u32,
    /// The line of the file that drilled it, from 1.
    pub line: u32,
}

impl Hole {
    /// Whether it is more than one plunge.
    #[must_use]
    pub fn is_slot(&self) -> bool {
        !self.path.segments.is_empty()
    }

    /// What the cutter takes away, grown by `by` all round: a disc where it only plunges, else a
    /// stroke or an arc for each move.
    #[must_use]
    pub fn shapes(&self, by: Nm) -> Vec<Shape> {
        let radius = self.diameter / 2 + by;
        if !self.is_slot() {
            return vec![Shape::Disc { center: self.path.start, radius }];
        }
        let shape = |(from, segment): (_, &Segment)| match segment.arc(from) {
            Some(arc) => Shape::Arc { arc, radius },
            None => Shape::Stroke { from, to: segment.to(), radius },
        };
        self.path.steps().map(shape).collect()
    }

    /// Whether the cutter, were it wider by `beyond` all round, would reach all of these points.
    #[must_use]
    pub(crate) fn reaches_all(&self, points: &[Point], beyond: Nm) -> bool {
        let way = self.path.flatten(FLATTEN);
        let steps = || way.windows(2).map(|pair| (pair[0], pair[1]));
        let reach = (self.diameter / 2 + beyond).to_f64();
        points.iter().all(|&p| {
            p.distance(self.path.start) <= reach || steps().any(|step| distance_to_segment(p, step) <= reach)
        })
    }

    /// A rectangle that holds it.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.path.bounds().inflate(self.diameter / 2)
    }
}
