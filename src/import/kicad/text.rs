//! Texts on copper and on the edge.
//!
//! KiCad draws them with a font of strokes of its own, which is not ours to carry: `lettering`
//! draws them with another. They belong to no net. Texts in other fonts carry their outlines
//! (`render_cache`, since version 7), which are read. Those that are knocked out of an area, those
//! in boxes, those on the edge and those with variables are left out with a warning.

use super::frame::Frame;
use super::layers::Layers;
use super::lettering::{Setting, shown};
use super::reader::Reader;
use super::ring::Drawing;
use super::tree::Node;
use crate::board::{Attributes, Axis, Shape, Side, polarity};
use crate::geometry::Polygon;
use crate::import::diagnostic;
use crate::import::error::Error;

impl Reader<'_> {
    /// A text of the board, or that of the footprint `component` that lies in `frame`; the outlines
    /// that it may carry are read of the board's own alone.
    pub(super) fn text(
        &mut self,
        node: Node<'_>,
        layers: Layers,
        frame: &Frame,
        component: Option<&str>,
    ) -> Result<(), Error> {
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
            .filter(|_| component.is_none() && !knocked_out && layers.is_copper() && !layers.edge);
        if let Some(cache) = cache {
            return self.outlined(node, cache, layers);
        }
        let said = component
            .map_or_else(|| said.clone(), |name| said.replace("${REFERENCE}", name).replace("%R", name));
        let drawn = (!knocked_out && !layers.edge && !said.contains("${")).then_some(frame);
        if let Some(setting) = drawn.map(|frame| Setting::of(self, node, frame)).transpose()?.flatten() {
            self.count("texts");
            let said = said.replace("\\n", "\n");
            return layers.sides().try_for_each(|side| self.letter(node, &said, &setting, side));
        }
        let on = match (layers.edge, layers.on(Side::Front)) {
            (true, _) => "Edge.Cuts",
            (false, true) => "F.Cu",
            (false, false) => "B.Cu",
        };
        let message = format!("the text {} on {on} is not read", shown(&said));
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
