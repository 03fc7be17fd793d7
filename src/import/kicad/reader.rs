//! What all things of a board file share: numbers and places, nets, and where what is drawn goes.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::frame::Frame;
use super::layers::{Layers, Names};
use super::letter::Letter;
use super::ring::{Drawing, Ring};
use super::tree::{Node, Tree};
use super::{head, number};
use crate::board::{Attributes, Axis, Feature, Hole, Plating, Shape, Side};
use crate::geometry::{Nm, Path, Point, Rect};
use crate::import::diagnostic;
use crate::import::error::{Error, Warnings};

/// The copper of a side in the making.
#[derive(Debug)]
pub(super) struct Sheet {
    pub(super) features: Vec<Feature>,
    pub(super) attributes: Vec<Attributes>,
    known: FxHashMap<Attributes, u32>,
}

impl Default for Sheet {
    fn default() -> Self {
        let empty = Attributes::default();
        let known = FxHashMap::from_iter([(empty.clone(), 0)]);
        Self { features: Vec::new(), attributes: vec![empty], known }
    }
}

/// Reads a board, thing by thing.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    pub(super) name: &'a str,
    pub(super) bytes: &'a [u8],
    pub(super) warnings: Warnings<'a>,
    /// Where things of the board itself are given.
    pub(super) frame: Frame,
    pub(super) front: Sheet,
    pub(super) back: Sheet,
    /// The lines of the edge.
    pub(super) edge: Sheet,
    pub(super) holes: Vec<Hole>,
    /// How many of each kind of thing there are on copper or the edge.
    pub(super) counts: BTreeMap<&'static str, u64>,
    /// Net names by number.
    nets: BTreeMap<String, String>,
    /// How large the drills of a net's vias are where these do not say it: until version 5.
    pub(super) via_drills: BTreeMap<String, Nm>,
    /// Pads and vias that leave out the rings of layers where nothing meets them.
    pub(super) bare_rings: Vec<Ring>,
    /// Zones on copper without any filled area: where they stand, what they are called, and whether
    /// they were filled.
    pub(super) bare_zones: Vec<(std::ops::Range<usize>, String, bool)>,
    /// The letters of texts.
    pub(super) letters: Vec<Letter>,
    pub(super) filled_zones: u64,
    /// What their areas cost to work out, in vertices of booleans.
    pub(super) effort: u64,
    /// The version of the format, where the file says one.
    pub(super) version: u32,
    /// What the board calls its layers.
    names: Names,
}

impl<'a> Reader<'a> {
    pub(super) fn new(name: &'a str, bytes: &'a [u8]) -> Self {
        Self {
            name,
            bytes,
            warnings: Warnings::new(name, bytes),
            frame: Frame::board((Nm::ZERO, Nm::ZERO)),
            front: Sheet::default(),
            back: Sheet::default(),
            edge: Sheet::default(),
            holes: Vec::new(),
            counts: BTreeMap::new(),
            nets: BTreeMap::new(),
            via_drills: BTreeMap::new(),
            bare_rings: Vec::new(),
            bare_zones: Vec::new(),
            letters: Vec::new(),
            filled_zones: 0,
            effort: 0,
            version: 0,
            names: Names::default(),
        }
    }

    /// Reads all that stands in the board.
    pub(super) fn board(&mut self, tree: &Tree<'_>) -> Result<(), Error> {
        let root = tree.root();
        if root.head() != b"kicad_pcb" {
            return Err(Error::syntax(
                self.name,
                self.bytes,
                root.place().start..root.place().start + 1,
                "this is not a KiCad board",
                "`(kicad_pcb …)`",
                "",
            ));
        }
        self.settings(root)?;
        for node in root.arguments().filter(|node| node.is_list()) {
            self.thing(node)?;
        }
        self.rings();
        self.settle_letters();
        self.judge_zones()
    }

    /// What must be known before anything is drawn: the origin, the nets and their classes.
    fn settings(&mut self, root: Node<'_>) -> Result<(), Error> {
        let version = root.find("version").and_then(|version| version.argument(0));
        self.version = version.and_then(|version| version.text().parse().ok()).unwrap_or(0);
        self.names = Names::of(root, self.version);
        let setup = root.find("setup");
        let uses_auxiliary =
            setup.and_then(|setup| setup.find("pcbplotparams")).is_some_and(|plot| plot.says("useauxorigin"));
        if let Some(origin) = setup.and_then(|setup| setup.find("aux_axis_origin")).filter(|_| uses_auxiliary)
        {
            self.frame = Frame::board((self.length(origin, 0)?, self.length(origin, 1)?));
        }
        for net in root.all("net") {
            if let (Some(number), Some(name)) = (net.argument(0), net.argument(1)) {
                self.nets.insert(number.text().into_owned(), name.text().into_owned());
            }
        }
        for class in root.all("net_class") {
            let Some(drill) = class.find("via_drill") else { continue };
            let drill = self.length(drill, 0)?;
            for net in class.all("add_net").filter_map(|net| net.argument(0)) {
                self.via_drills.insert(net.text().into_owned(), drill);
            }
            if class.argument(0).is_some_and(|name| name.raw() == b"Default") {
                self.via_drills.insert(String::new(), drill);
            }
        }
        Ok(())
    }

    /// Reads one thing of the board.
    fn thing(&mut self, node: Node<'_>) -> Result<(), Error> {
        let head = node.head();
        match head {
            b"footprint" | b"module" => return self.footprint(node),
            b"segment" => return self.track(node),
            b"arc" => return self.track_arc(node),
            b"via" => return self.via(node),
            b"zone" => return self.zone(node),
            _ => {}
        }
        let layers = self.layers(node);
        if !layers.is_milled() {
            return Ok(());
        }
        if head::is_graphic(head) {
            return self.draw(node, &self.frame.clone(), layers, None);
        }
        if head::is_text(head) {
            return self.text(node, layers, &self.frame.clone(), None);
        }
        // What is generated stands as tracks beside it, as what is grouped does.
        if head != b"layers" && head != b"generated" {
            self.not_read(node);
        }
        Ok(())
    }

    /// Warns of what lies on a layer that is milled, and is none of what is read.
    pub(super) fn not_read(&mut self, node: Node<'_>) {
        let what = match node.head() {
            b"dimension" => "dimensions",
            b"image" => "pictures",
            b"target" => "targets",
            b"barcode" => "bar codes",
            b"table" => "tables",
            _ => "objects of an unknown type",
        };
        let head = String::from_utf8_lossy(node.head()).into_owned();
        let message = format!("{what} ({head}) on copper or Edge.Cuts are not read");
        self.warnings.add(&diagnostic::KICAD_NOT_READ, node.place(), message);
    }

    /// Draws a line, a circle, … on the layers that it names.
    pub(super) fn draw(
        &mut self,
        node: Node<'_>,
        frame: &Frame,
        layers: Layers,
        component: Option<&str>,
    ) -> Result<(), Error> {
        if layers.edge {
            let drawing = self.graphic(node, frame, true)?;
            self.put_on_edge(node, drawing)?;
        }
        if layers.is_copper() {
            let drawing = self.graphic(node, frame, false)?;
            let function = if component.is_some() { "EtchedComponent" } else { "NonConductor" };
            let attributes = Attributes {
                net: self.net(node),
                component: component.map(str::to_owned),
                pin: None,
                function: Some(function.to_owned()),
            };
            self.count("graphics");
            for side in layers.sides() {
                self.put(side, node, drawing.clone(), &attributes)?;
            }
        }
        Ok(())
    }

    /// The layers that `node` lies on, of those that are milled.
    pub(super) fn layers(&self, node: Node<'_>) -> Layers {
        Layers::of(node, &self.names)
    }

    pub(super) fn count(&mut self, what: &'static str) {
        *self.counts.entry(what).or_default() += 1;
    }

    /// Lays copper on `side`.
    pub(super) fn put(
        &mut self,
        side: Side,
        node: Node<'_>,
        drawing: Drawing,
        attributes: &Attributes,
    ) -> Result<(), Error> {
        self.check(node, &drawing)?;
        let sheet = match side {
            Side::Front => &mut self.front,
            Side::Back => &mut self.back,
        };
        sheet.put(drawing, attributes, node.line());
        Ok(())
    }

    fn put_on_edge(&mut self, node: Node<'_>, drawing: Drawing) -> Result<(), Error> {
        self.check(node, &drawing)?;
        self.edge.put(drawing, &Attributes::default(), node.line());
        Ok(())
    }

    /// Everything must lie where it can be handled exactly.
    pub(super) fn check(&self, node: Node<'_>, drawing: &Drawing) -> Result<(), Error> {
        let within = |rect: Rect| {
            let (low, high) = (rect.min(), rect.max());
            low.x.min(low.y) >= Nm::MIN && high.x.max(high.y) <= Nm::MAX
        };
        let fits = |(shape, axis): &(Shape, Axis)| {
            let center = match axis {
                Axis::Arc(arc) => arc.center,
                Axis::Flash(_) | Axis::Line(..) | Axis::Region => shape.anchor(),
            };
            within(shape.bounds()) && within(Rect::new(center, center))
        };
        if drawing.iter().all(fits) { Ok(()) } else { Err(self.out_of_range(node)) }
    }

    fn out_of_range(&self, node: Node<'_>) -> Error {
        let (what, expected) = ("this coordinate is out of range", "a coordinate within ±1073.741823 mm");
        Error::syntax(
            self.name,
            self.bytes,
            node.place(),
            what,
            expected,
            "move the board nearer to the page",
        )
    }

    /// Drills a hole along `path`.
    pub(super) fn drill(
        &mut self,
        node: Node<'_>,
        path: Path,
        diameter: Nm,
        plating: Plating,
    ) -> Result<(), Error> {
        if diameter <= Nm::ZERO {
            return Ok(());
        }
        let hole = Hole { path, diameter, plating, tool: 0, line: node.line() };
        let bounds = hole.bounds();
        let reach = [bounds.min().x, bounds.min().y, bounds.max().x, bounds.max().y];
        if reach.iter().any(|&value| value < Nm::MIN || value > Nm::MAX) {
            return Err(self.out_of_range(node));
        }
        self.holes.push(hole);
        Ok(())
    }

    /// The name of the net that `node` belongs to.
    pub(super) fn net(&self, node: Node<'_>) -> Option<String> {
        let list = node.find("net")?;
        let first = list.argument(0)?.text();
        let by_number = || self.nets.get(first.as_ref()).cloned();
        // Since version 10 the name alone; before, the number, of pads with the name.
        let name = list.argument(1).map(|name| name.text().into_owned()).or_else(by_number);
        let name = name.unwrap_or_else(|| if first == "0" { String::new() } else { first.into_owned() });
        (!name.is_empty()).then_some(name)
    }

    /// The length at place `argument` of `list`.
    pub(super) fn length(&self, list: Node<'_>, argument: usize) -> Result<Nm, Error> {
        let word = list.argument(argument);
        let value = word.and_then(|word| number::length(word.raw()));
        value.ok_or_else(|| self.no_number(list, argument, "a length in millimetres within ±1073.741823"))
    }

    /// The length at place `argument` of `list`; nothing where there is none.
    pub(super) fn length_or_zero(&self, list: Node<'_>, argument: usize) -> Result<Nm, Error> {
        if list.argument(argument).is_some() { self.length(list, argument) } else { Ok(Nm::ZERO) }
    }

    /// The number at place `argument` of `list`.
    pub(super) fn number(&self, list: Node<'_>, argument: usize) -> Result<f64, Error> {
        let word = list.argument(argument);
        let value = word.and_then(|word| number::number(word.raw()));
        value.ok_or_else(|| self.no_number(list, argument, "a number"))
    }

    fn no_number(&self, list: Node<'_>, argument: usize, expected: &str) -> Error {
        let place = list.argument(argument).map_or_else(|| list.place(), Node::place);
        let head = String::from_utf8_lossy(list.head()).into_owned();
        let what = format!("`({head} …)` has no number here");
        Error::syntax(self.name, self.bytes, place, what, expected, "save the board again in KiCad")
    }

    /// The two lengths of the list `name` in `node`, as the file has them.
    pub(super) fn point(&self, node: Node<'_>, name: &'static str) -> Result<(Nm, Nm), Error> {
        let Some(list) = node.find(name) else { return Err(self.lacks(node, &format!("`({name} x y)`"))) };
        Ok((self.length(list, 0)?, self.length(list, 1)?))
    }

    /// An error for what `node` does not have.
    pub(super) fn lacks(&self, node: Node<'_>, expected: &str) -> Error {
        let head = String::from_utf8_lossy(node.head()).into_owned();
        let what = format!("`({head} …)` is incomplete");
        Error::syntax(self.name, self.bytes, node.place(), what, expected, "save the board again in KiCad")
    }
}

impl Sheet {
    pub(super) fn put(&mut self, drawing: Drawing, attributes: &Attributes, line: u32) {
        let next = u32::try_from(self.attributes.len()).unwrap_or(u32::MAX);
        let number = match self.known.get(attributes) {
            Some(&number) => number,
            None => {
                self.known.insert(attributes.clone(), next);
                self.attributes.push(attributes.clone());
                next
            }
        };
        let feature = |(shape, axis)| Feature { shape, axis, attributes: number, line };
        self.features.extend(drawing.into_iter().map(feature));
    }
}

/// A path that is one point, or a line.
pub(super) fn way(from: Point, to: Point) -> Path {
    let segments = if from == to { vec![] } else { vec![crate::geometry::Segment::Line { to }] };
    Path { start: from, segments }
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
