//! Pads: their copper and their holes.

use super::frame::Frame;
use super::layers::copper_name;
use super::pad_shape::{Corners, obround, rounded, trapezoid};
use super::reader::{Reader, way};
use super::ring::Drawing;
use super::ring::Ring;
use super::tree::Node;
use crate::board::{Attributes, Axis, Plating, Shape, Side};
use crate::geometry::Nm;
use crate::import::diagnostic;
use crate::import::error::Error;

/// A pad as it is on one side: what a padstack says of the layer counts before what the pad says.
#[derive(Clone, Copy)]
struct Look<'a> {
    pad: Node<'a>,
    layer: Option<Node<'a>>,
}

impl<'a> Look<'a> {
    fn on(pad: Node<'a>, side: Side) -> Self {
        let of_side =
            |layer: &Node<'_>| layer.argument(0).is_some_and(|name| name.text() == copper_name(side));
        let layer = pad.find("padstack").and_then(|stack| stack.all("layer").find(of_side));
        Self { pad, layer }
    }

    fn find(self, name: &'static str) -> Option<Node<'a>> {
        self.layer.and_then(|layer| layer.find(name)).or_else(|| self.pad.find(name))
    }

    fn shape(self) -> Option<Node<'a>> {
        let own = self.layer.and_then(|layer| layer.find("shape")?.argument(0));
        own.or_else(|| self.pad.argument(2))
    }
}

/// The hole of a pad.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
struct Bore {
    width: Nm,
    height: Nm,
    /// How far the pad's middle lies from the hole's, in the pad's own frame.
    offset: (Nm, Nm),
}

impl Reader<'_> {
    /// A pad of a footprint that lies in `frame`.
    pub(super) fn pad(
        &mut self,
        node: Node<'_>,
        frame: &Frame,
        component: Option<&str>,
    ) -> Result<(), Error> {
        let at = node.find("at").ok_or_else(|| self.lacks(node, "`(at x y)`"))?;
        let place = frame.place((self.length(at, 0)?, self.length(at, 1)?));
        // The angle is that on the board, the footprint's included.
        let degrees = if at.argument(2).is_some() { self.number(at, 2)? } else { 0.0 };
        let own = Frame::at(place, degrees);
        let bore = self.bore(node)?;
        let kind = node.argument(1).map(Node::raw).unwrap_or_default();
        let plated = kind != b"np_thru_hole";
        let attributes = Attributes {
            net: self.net(node),
            component: component.map(str::to_owned),
            pin: node.argument(0).map(|pin| pin.text().into_owned()).filter(|pin| !pin.is_empty()),
            function: Some(function(kind).to_owned()),
        };
        self.count("pads");
        let (w, h) = (bore.width, bore.height);
        let (x, y) = (((w - h) / 2).max(Nm::ZERO), ((h - w) / 2).max(Nm::ZERO));
        let (from, to, diameter) = (own.place((-x, -y)), own.place((x, y)), w.min(h));
        for side in self.layers(node).sides() {
            let look = Look::on(node, side);
            let Some(drawing) = self.look(look, &own, bore, plated)? else { continue };
            if leaves_rings_out(node) {
                self.check(node, &drawing)?;
                let hole = match diameter / 2 {
                    radius if from == to => Shape::Disc { center: from, radius },
                    radius => Shape::Stroke { from, to, radius },
                };
                self.bare_rings.push(Ring::new(side, hole, drawing, attributes.clone(), node));
            } else {
                self.put(side, node, drawing, &attributes)?;
            }
        }
        self.drill(node, way(from, to), diameter, if plated { Plating::Plated } else { Plating::NonPlated })
    }

    fn bore(&self, node: Node<'_>) -> Result<Bore, Error> {
        let Some(drill) = node.find("drill") else { return Ok(Bore::default()) };
        let oval = usize::from(drill.has_word("oval"));
        let width = self.length_or_zero(drill, oval)?;
        let height = if oval == 1 { self.length_or_zero(drill, 2)? } else { width };
        let height = if height == Nm::ZERO { width } else { height };
        let offset = match drill.find("offset") {
            Some(offset) => (self.length(offset, 0)?, self.length(offset, 1)?),
            None => (Nm::ZERO, Nm::ZERO),
        };
        Ok(Bore { width, height, offset })
    }

    /// What a pad leaves of copper on one side; nothing where its hole takes it all.
    fn look(
        &mut self,
        look: Look<'_>,
        own: &Frame,
        bore: Bore,
        plated: bool,
    ) -> Result<Option<Drawing>, Error> {
        let Some(size) = look.find("size") else { return Err(self.lacks(look.pad, "`(size x y)`")) };
        let (width, height) = (self.length(size, 0)?, self.length(size, 1)?);
        let shape = look.shape().map(Node::raw).unwrap_or_default();
        let is_round = matches!(shape, b"circle" | b"oval");
        if !plated && is_round && (width, height) == (bore.width, bore.height) {
            return Ok(None);
        }
        let offset = match look.layer.and_then(|layer| layer.find("offset")) {
            Some(offset) => (self.length(offset, 0)?, self.length(offset, 1)?),
            None => bore.offset,
        };
        let middle = own.place(offset);
        let frame = own.moved_to(middle);
        let axis = Axis::Flash(middle);
        if shape == b"custom" {
            return self.custom(look, &frame, (width, height), axis).map(Some);
        }
        if width <= Nm::ZERO || height <= Nm::ZERO {
            return Ok(None);
        }
        let shape = match shape {
            b"circle" => Some(Shape::Disc { center: middle, radius: width / 2 }),
            b"oval" => Some(obround(&frame, width, height)),
            b"rect" => trapezoid(&frame, width, height, (Nm::ZERO, Nm::ZERO)),
            b"trapezoid" => {
                let delta = match look.find("rect_delta") {
                    Some(delta) => (self.length(delta, 0)?, self.length(delta, 1)?),
                    None => (Nm::ZERO, Nm::ZERO),
                };
                trapezoid(&frame, width, height, delta)
            }
            b"roundrect" => rounded(&frame, width, height, self.corners(look, width.min(height))?),
            _ => {
                let place = look.shape().unwrap_or(look.pad).place();
                let what = "a pad of an unknown shape";
                let expected = "circle, oval, rect, roundrect, trapezoid or custom";
                return Err(Error::syntax(self.name, self.bytes, place, what, expected, PLOT));
            }
        };
        Ok(shape.map(|shape| vec![(shape, axis)]))
    }

    fn corners(&self, look: Look<'_>, shorter: Nm) -> Result<Corners, Error> {
        let share = |name: &'static str| match look.find(name) {
            Some(list) => self.number(list, 0).map(|ratio| ratio * shorter.to_f64()),
            None => Ok(0.0),
        };
        let cut = look.find("chamfer").filter(|_| look.find("chamfer_ratio").is_some());
        let chosen = ["top_left", "top_right", "bottom_right", "bottom_left"]
            .map(|corner| cut.is_some_and(|list| list.has_word(corner)));
        Ok(Corners { radius: share("roundrect_rratio")?, cut: share("chamfer_ratio")?, chosen })
    }

    /// An anchor, and what is drawn around it.
    fn custom(
        &mut self,
        look: Look<'_>,
        frame: &Frame,
        (width, height): (Nm, Nm),
        axis: Axis,
    ) -> Result<Drawing, Error> {
        let anchor = look.find("options").and_then(|options| options.find("anchor")?.argument(0));
        let anchor = match anchor.map(Node::raw) {
            _ if width <= Nm::ZERO || height <= Nm::ZERO => None,
            Some(b"rect") => trapezoid(frame, width, height, (Nm::ZERO, Nm::ZERO)),
            _ => Some(obround(frame, width, width)),
        };
        let mut drawing: Drawing = anchor.into_iter().map(|shape| (shape, axis)).collect();
        let pieces = look.find("primitives");
        for piece in pieces.iter().flat_map(|list| list.arguments()).filter(|piece| piece.is_list()) {
            if super::head::is_graphic(piece.head()) {
                drawing.extend(self.graphic(piece, frame, false)?);
            } else if !matches!(piece.head(), b"gr_vector" | b"gr_bbox") {
                self.warnings.add(
                    &diagnostic::KICAD_NOT_READ,
                    piece.place(),
                    "a primitive of a custom pad has an unknown type and is not read",
                );
            }
        }
        Ok(drawing)
    }
}

/// What to do about a board with something that is not read.
pub(super) const PLOT: &str =
    "plot the board as Gerber in KiCad (File, Fabrication Outputs) and give those files";

/// Whether the rings on layers where nothing meets them are left out, also on the outer layers.
pub(super) fn leaves_rings_out(node: Node<'_>) -> bool {
    node.says("remove_unused_layers") && !node.says("keep_end_layers")
}

/// What KiCad calls a kind of pad in its plots (`.AperFunction`).
fn function(kind: &[u8]) -> &'static str {
    match kind {
        b"thru_hole" => "ComponentPad",
        b"np_thru_hole" => "WasherPad",
        b"connect" => "ConnectorPad",
        _ => "SMDPad,CuDef",
    }
}
