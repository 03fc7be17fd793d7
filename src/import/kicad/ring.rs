//! Rings of pads and vias that are there only where something meets them.
//!
//! KiCad can leave out the rings of layers that nothing of the net reaches. Whether something does
//! is known when all tracks and zones of the board are read.

use super::reader::{Drawing, Reader};
use super::tree::Node;
use crate::board::{Attributes, Axis, Feature, Shape, Side};
use crate::geometry::{Nm, Point, Rect};

/// A ring that may be left out.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    side: Side,
    at: Point,
    reach: Nm,
    drawing: Drawing,
    attributes: Attributes,
    line: u32,
    /// Whether a zone was said to meet it.
    kept: bool,
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
    fn meets(&self, feature: &Feature) -> bool {
        let ends = |p: Point| p.distance(self.at) <= self.reach.to_f64();
        match (&feature.axis, &feature.shape) {
            (Axis::Line(from, to), _) => ends(*from) || ends(*to),
            (Axis::Arc(arc), _) => ends(arc.start) || ends(arc.end),
            (_, Shape::Polygon(polygon)) => polygon.contains(self.at),
            _ => false,
        }
    }
}

impl Reader<'_> {
    /// Draws those rings that something meets.
    pub(super) fn rings(&mut self) {
        let mut rings = std::mem::take(&mut self.bare_rings);
        for side in [Side::Front, Side::Back] {
            let sheet = if side == Side::Front { &self.front } else { &self.back };
            for ring in rings.iter_mut().filter(|ring| ring.side == side && !ring.kept) {
                let same = |feature: &&Feature| {
                    sheet.attributes[feature.attributes as usize].net == ring.attributes.net
                };
                let met = ring.attributes.net.is_some()
                    && sheet.features.iter().filter(same).any(|feature| ring.meets(feature));
                ring.kept = met;
            }
        }
        for ring in rings.into_iter().filter(|ring| ring.kept) {
            let sheet = if ring.side == Side::Front { &mut self.front } else { &mut self.back };
            sheet.put(ring.drawing, &ring.attributes, ring.line);
        }
    }
}
