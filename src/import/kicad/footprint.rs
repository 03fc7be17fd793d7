//! Footprints: where they lie, what they are called, and all that stands in them.

use super::frame::Frame;
use super::head;
use super::reader::Reader;
use super::tree::Node;
use crate::import::error::Error;

impl Reader<'_> {
    /// A footprint, turned and moved to its place.
    pub(super) fn footprint(&mut self, node: Node<'_>) -> Result<(), Error> {
        let at = node.find("at").ok_or_else(|| self.lacks(node, "`(at x y)`"))?;
        let origin = self.frame.place((self.length(at, 0)?, self.length(at, 1)?));
        let degrees = if at.argument(2).is_some() { self.number(at, 2)? } else { 0.0 };
        let frame = Frame::at(origin, degrees);
        let component = reference(node);
        for part in node.arguments().filter(|part| part.is_list()) {
            match part.head() {
                b"pad" => self.pad(part, &frame, component.as_deref())?,
                b"zone" => self.zone(part)?,
                head => {
                    let layers = self.layers(part);
                    if !layers.is_milled() || head == b"layer" {
                        continue;
                    }
                    if head::is_graphic(head) {
                        self.draw(part, &frame, layers, Some(component.as_deref().unwrap_or_default()))?;
                    } else if head::is_text(head) {
                        self.text(part, layers, &frame, Some(component.as_deref().unwrap_or_default()))?;
                    } else {
                        self.not_read(part);
                    }
                }
            }
        }
        Ok(())
    }
}

/// The reference of a footprint, `R1`: a property since version 8, a text before.
fn reference(node: Node<'_>) -> Option<String> {
    let property = || {
        let named = |list: &Node<'_>| list.argument(0).is_some_and(|name| name.text() == "Reference");
        node.all("property").find(named)
    };
    let text = || {
        let of_reference = |list: &Node<'_>| list.argument(0).is_some_and(|kind| kind.raw() == b"reference");
        node.all("fp_text").find(of_reference)
    };
    let said = property().or_else(text)?.argument(1)?.text().into_owned();
    (!said.is_empty()).then_some(said)
}
