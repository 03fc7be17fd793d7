//! Rings of pads and vias that are there only where something meets them.
//!
//! KiCad can leave out the rings of layers that nothing of the net reaches. Whether something does
//! is known when all tracks and zones of the board are read.

use super::tree::Node;
use crate::board::{Attributes, Axis, FLATTEN, Feature, Shape, Side};

/// What a thing draws, each piece with its axis.
pub(super) type Drawing = Vec<(Shape, Axis)>;

/// A ring that may be left out.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    pub(super) side: Side,
    /// What is drilled in it; a point where nothing is.
    hole: Shape,
    pub(super) drawing: Drawing,
    pub(super) attributes: Attributes,
    pub(super) line: u32,
    /// Whether the board lists the layers where a zone meets it.
    told: bool,
    /// Whether a zone was said to meet it.
    pub(super) kept: bool,
}

impl Ring {
    pub(super) fn new(
        side: Side,
        hole: Shape,
        drawing: Drawing,
        attributes: Attributes,
        node: Node<'_>,
    ) -> Self {
        let name = super::layers::copper_name(side);
        let list = node.find("zone_layer_connections");
        let kept = list.is_some_and(|list| list.arguments().any(|layer| layer.text() == name));
        Self { side, hole, drawing, attributes, line: node.line(), told: list.is_some(), kept }
    }

    /// Whether `feature`, of the same net, reaches it, as KiCad asks: a track or pad the hole, a
    /// zone the ring, unless the board says which zones do.
    pub(super) fn meets(&self, feature: &Feature) -> bool {
        let is_zone = feature.axis == Axis::Region;
        let ring = self.drawing.iter().map(|(shape, _)| shape).filter(|_| is_zone && !self.told);
        let reached = |own: &Shape| {
            own.bounds().touches(feature.shape.bounds())
                && match (&feature.shape, own.polygon(FLATTEN)) {
                    // A zone may be far larger than what is looked for in it.
                    (Shape::Polygon(area), _) => own.lies_in(area),
                    (shape, Some(own)) => shape.lies_in(&own),
                    (shape, None) => shape.polygon(FLATTEN).is_some_and(|area| own.lies_in(&area)),
                }
        };
        ring.chain([&self.hole]).any(reached)
    }
}
