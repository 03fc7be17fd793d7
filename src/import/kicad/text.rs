//! Texts on copper and on the edge.
//!
//! KiCad draws them with a font of its own, which is not ours to carry, and another font would make
//! other copper. So a text is left out with a warning that says what it says and where: it belongs
//! to no net, and what is isolated round it stays isolated. Texts in other fonts carry their
//! outlines (`render_cache`, since version 7), which are read.

use super::layers::Layers;
use super::reader::Reader;
use super::ring::Drawing;
use super::tree::Node;
use crate::board::{Attributes, Axis, Shape, Side, polarity};
use crate::geometry::Polygon;
use crate::import::diagnostic;
use crate::import::error::Error;

impl Reader<'_> {
    /// A text; `outlines` says whether those that it may carry are given in the board's frame.
    pub(super) fn text(&mut self, node: Node<'_>, layers: Layers, outlines: bool) -> Result<(), Error> {
        let effects = node.find("effects");
        let hidden = |node: Node<'_>| node.says("hide") || node.has_word("hide");
        if hidden(node) || effects.is_some_and(hidden) {
            return Ok(());
        }
        let is_board = matches!(node.head(), b"gr_text" | b"gr_text_box");
        let said = node.argument(usize::from(!is_board && node.head() != b"fp_text_box"));
        let said = said.map(|text| text.text().into_owned()).unwrap_or_default();
        if said.trim().is_empty() {
            return Ok(());
        }
        let knocked_out =
            node.says("knockout") || node.find("layer").is_some_and(|layer| layer.has_word("knockout"));
        let cache = node
            .find("render_cache")
            .filter(|_| outlines && !knocked_out && layers.is_copper() && !layers.edge);
        if let Some(cache) = cache {
            return self.outlined(node, cache, layers);
        }
        let place = match node.find("at") {
            Some(at) => {
                Some(self.frame.place((self.length(at, 0)?, self.length(at, 1)?))).filter(|_| outlines)
            }
            None => None,
        };
        let on = match (layers.edge, layers.on(Side::Front)) {
            (true, _) => "Edge.Cuts",
            (false, true) => "F.Cu",
            (false, false) => "B.Cu",
        };
        let at = place.map_or_else(String::new, |p| format!(" at ({:.3}, {:.3})", p.x, p.y));
        let shown: String = said.chars().take(40).map(|c| if c.is_control() { ' ' } else { c }).collect();
        let message = format!("the text `{shown}` on {on}{at} is not read");
        self.warnings.add(&diagnostic::KICAD_TEXT, node.place(), message);
        Ok(())
    }

    /// A text with its outlines: each letter's first contour, less the others.
    fn outlined(&mut self, node: Node<'_>, cache: Node<'_>, layers: Layers) -> Result<(), Error> {
        let mut drawing = Drawing::new();
        let frame = self.frame;
        for letter in cache.all("polygon") {
            let mut contours = Vec::new();
            for points in letter.all("pts") {
                contours.extend(polarity::clean(&[self.points(points, &frame)?]));
            }
            let Some((outer, holes)) = contours.split_first() else { continue };
            let pieces: Vec<Polygon> = polarity::difference(outer, holes);
            drawing.extend(pieces.into_iter().map(|piece| (Shape::Polygon(piece), Axis::Region)));
        }
        let attributes = Attributes { function: Some("NonConductor".to_owned()), ..Attributes::default() };
        self.count("texts");
        for side in layers.sides() {
            self.put(side, node, drawing.clone(), &attributes)?;
        }
        Ok(())
    }
}
