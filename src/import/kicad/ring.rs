//! Rings of pads and vias that are there only where something meets them.
//!
//! KiCad can leave out the rings of layers that nothing of the net reaches. Whether something does
//! is known when all tracks and zones of the board are read.

use super::tree::Node;
use crate::board::{Attributes, Axis, Feature, Shape, Side};
use crate::geometry::{Nm, Point, Rect};

/// What a thing draws, each piece with its axis.
pub(super) type Drawing = Vec<(Shape, Axis)>;

/// A ring that may be left out.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    pub(super) side: Side,
    pub(super) at: Point,
    pub(super) reach: Nm,
    pub(super) drawing: Drawing,
    pub(super) attributes: Attributes,
    pub(super) line: u32,
    /// Whether a zone was said to meet it.
    pub(super) kept: bool,
}

impl Ring {
    pub(super) fn new(
        side: Side,
        at: Point,
        drawing: Drawing,
        attributes: Attributes,
        node: Node<'_>,
    ) -> Self {
        let bounds = drawing.iter().map(|(shape, _)| shape.bounds()).reduce(Rect::union);
        let reach = bounds.map_or(Nm::ZERO, |bounds| bounds.width().max(bounds.height()) / 2);
        let name = super::layers::copper_name(side);
        let said = node
            .find("zone_layer_connections")
            .is_some_and(|list| list.arguments().any(|layer| layer.text() == name));
        Self { side, at, reach, drawing, attributes, line: node.line(), kept: said }
    }

    /// Whether `feature`, of the same net, reaches it: a track that ends in it, a plane around it.
    pub(super) fn meets(&self, feature: &Feature) -> bool {
        let ends = |p: Point| p.distance(self.at) <= self.reach.to_f64();
        match (&feature.axis, &feature.shape) {
            (Axis::Line(from, to), _) => ends(*from) || ends(*to),
            (Axis::Arc(arc), _) => ends(arc.start) || ends(arc.end),
            (_, Shape::Polygon(polygon)) => polygon.contains(self.at),
            _ => false,
        }
    }
}
