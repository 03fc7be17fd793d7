//! Where what is drawn goes: the canvas, the attributes its objects carry, and the counts.

use std::collections::BTreeMap;

use crate::board::polarity::Polarity;
use crate::board::{Axis, Feature, Shape};
use crate::geometry::{Point, Vector};

use super::attributes::Attributes;
use super::canvas::{Canvas, Object, Refusal, moved};
use super::linear::Linear;

/// What the objects of one command have in common.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ink {
    pub(super) polarity: Polarity,
    /// The number of the attribute set.
    pub(super) set: u32,
    /// The line on which the command stands.
    pub(super) line: u32,
}

/// What has been drawn, by kind.
#[derive(Debug, Default)]
struct Counts {
    flashes: u64,
    strokes: u64,
    arcs: u64,
    regions: u64,
}

/// Collects what is drawn.
#[derive(Debug)]
pub(super) struct Sink {
    pub(super) canvas: Canvas,
    pub(super) attributes: Attributes,
    counts: Counts,
}

impl Sink {
    pub(super) fn new(canvas: Canvas) -> Self {
        Self { canvas, attributes: Attributes::new(), counts: Counts::default() }
    }

    /// Draws one thing: its pieces, which may be none.
    pub(super) fn draw(&mut self, shapes: Vec<Shape>, axis: Axis, ink: Ink) -> Result<(), Refusal> {
        match axis {
            Axis::Flash(_) => self.counts.flashes += 1,
            Axis::Line(..) => self.counts.strokes += 1,
            Axis::Arc(_) => self.counts.arcs += 1,
            Axis::Region => self.counts.regions += 1,
        }
        for shape in shapes {
            let feature = Feature { shape, axis, attributes: ink.set, line: ink.line };
            self.canvas.push((feature, ink.polarity))?;
        }
        Ok(())
    }

    /// Flashes the objects of a block aperture at `at`.
    pub(super) fn flash_block(
        &mut self,
        objects: &[Object],
        linear: Linear,
        at: Point,
        ink: Ink,
    ) -> Result<(), Refusal> {
        self.counts.flashes += 1;
        let way: Vector = at - Point::default();
        for (feature, polarity) in objects {
            let mut feature = moved(feature, linear, way);
            feature.attributes = self.attributes.merged(feature.attributes, ink.set);
            let polarity = if ink.polarity == Polarity::Clear { polarity.toggled() } else { *polarity };
            self.canvas.push((feature, polarity))?;
        }
        Ok(())
    }

    /// What has been drawn, by kind.
    pub(super) fn counts(&self) -> BTreeMap<String, u64> {
        let Counts { flashes, strokes, arcs, regions } = self.counts;
        let counts = [("flashes", flashes), ("strokes", strokes), ("arcs", arcs), ("regions", regions)];
        counts.into_iter().map(|(kind, count)| (kind.to_owned(), count)).collect()
    }
}
