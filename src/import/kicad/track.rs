//! Tracks and vias.

use super::curve::Curve;
use super::layers::copper_name;
use super::pad::leaves_rings_out;
use super::reader::{Reader, way};
use super::ring::Ring;
use super::tree::Node;
use crate::board::{Attributes, Axis, Plating, Shape, Side};
use crate::geometry::{Nm, Point};
use crate::import::diagnostic;
use crate::import::error::Error;

impl Reader<'_> {
    /// A straight track.
    pub(super) fn track(&mut self, node: Node<'_>) -> Result<(), Error> {
        let (from, to) = (self.point(node, "start")?, self.point(node, "end")?);
        let curve = Curve::Line(self.frame.place(from), self.frame.place(to));
        self.along(node, &curve)
    }

    /// A track along an arc.
    pub(super) fn track_arc(&mut self, node: Node<'_>) -> Result<(), Error> {
        let curve = self.arc(node, &self.frame.clone())?;
        self.along(node, &curve)
    }

    fn along(&mut self, node: Node<'_>, curve: &Curve) -> Result<(), Error> {
        let Some(width) = node.find("width") else { return Err(self.lacks(node, "`(width …)`")) };
        let width = self.length(width, 0)?;
        let attributes = self.conductor(node, "Conductor");
        for side in self.layers(node).sides() {
            self.count("tracks");
            self.put(side, node, curve.drawn(width), &attributes)?;
        }
        Ok(())
    }

    /// A via: a ring on both sides and a hole.
    pub(super) fn via(&mut self, node: Node<'_>) -> Result<(), Error> {
        let place = self.point(node, "at")?;
        let at = self.frame.place(place);
        let Some(size) = node.find("size") else { return Err(self.lacks(node, "`(size …)`")) };
        let size = self.length(size, 0)?;
        let attributes = self.conductor(node, "ViaPad");
        let layers = self.layers(node);
        let drill = self.via_drill(node, attributes.net.as_deref())?;
        self.count("vias");
        for side in layers.sides() {
            let layer = node.find("padstack").and_then(|stack| {
                stack
                    .all("layer")
                    .find(|layer| layer.argument(0).is_some_and(|name| name.text() == copper_name(side)))
            });
            let size = match layer.and_then(|layer| layer.find("size")) {
                Some(own) => self.length(own, 0)?,
                None => size,
            };
            let drawing = vec![(Shape::Disc { center: at, radius: size / 2 }, Axis::Flash(at))];
            if leaves_rings_out(node) {
                self.check(node, &drawing)?;
                let hole = Shape::Disc { center: at, radius: drill / 2 };
                self.bare_rings.push(Ring::new(side, hole, drawing, attributes.clone(), node));
            } else {
                self.put(side, node, drawing, &attributes)?;
            }
        }
        if layers.on(Side::Front) && layers.on(Side::Back) {
            return self.via_hole(node, at, drill);
        }
        let message = "a via that ends on an inner layer gets no hole, since inner layers are not milled";
        self.warnings.add(&diagnostic::KICAD_BLIND_VIA, node.place(), message);
        Ok(())
    }

    /// The size of a via's hole; zero where none is given.
    fn via_drill(&self, node: Node<'_>, net: Option<&str>) -> Result<Nm, Error> {
        if let Some(drill) = node.find("drill") {
            return self.length(drill, 0);
        }
        let of_class = self.via_drills.get(net.unwrap_or_default());
        Ok(of_class.or_else(|| self.via_drills.get("")).copied().unwrap_or(Nm::ZERO))
    }

    fn via_hole(&mut self, node: Node<'_>, at: Point, drill: Nm) -> Result<(), Error> {
        if drill <= Nm::ZERO {
            let message = "a via without a drill size gets no hole";
            self.warnings.add(&diagnostic::KICAD_VIA_WITHOUT_DRILL, node.place(), message);
        }
        self.drill(node, way(at, at), drill, Plating::Plated)
    }

    /// What is known of copper that conducts for a net.
    pub(super) fn conductor(&self, node: Node<'_>, function: &str) -> Attributes {
        Attributes { net: self.net(node), function: Some(function.to_owned()), ..Attributes::default() }
    }
}
