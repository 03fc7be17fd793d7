//! A side as SVG, for documents: true lines and areas that a drawing program can take apart.
//!
//! A user unit is a hundredth of a micrometre, so that copper read back is the copper that was
//! drawn; the size is in millimetres, y points up within the one group. Each layer is a group with
//! a name. There is no background, so it lies well on paper.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::board::{Board, Copper, FLATTEN, Feature};
use crate::geometry::{Nm, Path, Rect};
use crate::topology::NetId;

use super::ink::{Ink, pen, units};
use super::palette::{Rgb, vivid};
use super::picture::{Shown, Ways};
use super::xml::escaped;

/// What is drawn over the copper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// Nothing.
    Nothing,
    /// The boundaries between regions.
    Boundaries,
    /// Cuts at their true width, and the cutout.
    Cuts,
}

/// A user unit, in nanometres. Chosen: below what programs write.
const UNIT: i64 = 10;

const COPPER: &str = "#d0894a";
const BOARD: &str = "#eef0ec";
const CUT: &str = "#20262e";
const EDGE: &str = "#4a6078";
const HOLE: &str = "#ffffff";

/// The part of a side within `area`: its copper alone.
#[must_use]
pub fn copper(board: &Board, copper: &Copper, area: Rect) -> String {
    let mut svg = Svg::new(area, &board.name);
    svg.ground(board, copper);
    svg.drills(board);
    svg.finish()
}

/// The part of a side within `area`: its copper, with a colour and a group for each net, and its
/// name.
#[must_use]
pub fn nets(shown: &Shown<'_>, area: Rect) -> String {
    let mut svg = Svg::new(area, &shown.board.name);
    svg.board(shown.board);
    svg.group("copper", "fill=\"none\"", |svg| {
        for (number, net) in (0..).zip(shown.nets.nets()) {
            let id = NetId(number);
            let Rgb(r, g, b) = vivid(id);
            let colour = format!("#{r:02x}{g:02x}{b:02x}");
            svg.group(&format!("net-{}", number + 1), &line(&colour, 1.0), |svg| {
                _ = writeln!(svg.text, "<title>{}</title>", escaped(&shown.nets.label(id)));
                let features = net.features.iter().map(|&at| &shown.copper.features[at as usize]);
                svg.features(features, &colour);
            });
        }
    });
    svg.drills(shown.board);
    svg.finish()
}

/// The part of a side within `area`.
#[must_use]
pub fn side(shown: &Shown<'_>, area: Rect, over: Over) -> String {
    let mut svg = Svg::new(area, &shown.board.name);
    svg.ground(shown.board, shown.copper);
    match over {
        Over::Nothing => {}
        Over::Boundaries => {
            let lines = shown.boundaries.edges.iter().filter(|edge| !edge.is_border()).map(|edge| &edge.path);
            svg.group("boundaries", &line(CUT, 1.0), |svg| svg.strokes(Nm::from_um(50), lines));
        }
        Over::Cuts => {
            svg.group("cuts", &line(CUT, 0.9), |svg| {
                for section in &shown.sections {
                    for (depth, paths) in &Ways::of(section, shown.placement).cuts {
                        svg.strokes(section.tool.width_at(*depth), paths);
                    }
                }
            });
            if let Some((section, placement)) = shown.cutout
                && let Some((depth, paths)) = Ways::of(section, placement).cuts.last_key_value()
            {
                let width = section.tool.width_at(*depth);
                svg.group("cutout", &line(EDGE, 0.35), |svg| svg.strokes(width, paths));
            }
        }
    }
    svg.drills(shown.board);
    svg.finish()
}

/// The attributes of lines.
fn line(colour: &str, opacity: f64) -> String {
    format!("stroke=\"{colour}\" stroke-opacity=\"{opacity}\" fill=\"none\"")
}

/// In user units, halves up.
const fn fine(length: Nm) -> i64 {
    units(length, UNIT)
}

struct Svg {
    text: String,
}

impl Svg {
    fn new(area: Rect, name: &str) -> Self {
        let (left, top) = (fine(area.min().x), fine(area.max().y));
        let (width, height) = (fine(area.width()), fine(area.height()));
        let (wide, high) = (area.width(), area.height());
        let name = escaped(name);
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{wide:.3}mm\" height=\"{high:.3}mm\" \
             viewBox=\"{left} {} {width} {height}\">\n<title>{name}</title>\n\
             <g transform=\"scale(1 -1)\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
            -top
        );
        Self { text }
    }

    /// The board and its copper.
    fn ground(&mut self, board: &Board, copper: &Copper) {
        self.board(board);
        self.group("copper", &line(COPPER, 1.0), |svg| svg.features(&copper.features, COPPER));
    }

    fn board(&mut self, board: &Board) {
        if let Some(outline) = &board.outline {
            let mut ink = Ink::of(UNIT);
            ink.rings(outline.polygon(FLATTEN * 4).contours());
            self.group("board", &format!("fill=\"{BOARD}\" fill-rule=\"evenodd\""), |svg| svg.path("", ink));
        }
    }

    /// Features in the colour of their group: areas, then strokes by width.
    fn features<'a>(&mut self, features: impl IntoIterator<Item = &'a Feature>, colour: &str) {
        let mut pens: BTreeMap<Nm, Ink> = BTreeMap::new();
        for feature in features {
            pens.entry(pen(&feature.shape)).or_insert_with(|| Ink::of(UNIT)).shape(&feature.shape);
        }
        for (width, ink) in pens {
            if width == Nm::ZERO {
                self.path(&format!(" fill=\"{colour}\" stroke=\"none\""), ink);
            } else {
                self.path(&format!(" stroke-width=\"{}\"", fine(width)), ink);
            }
        }
    }

    /// The holes by diameter.
    fn drills(&mut self, board: &Board) {
        let mut pens: BTreeMap<Nm, Ink> = BTreeMap::new();
        for hole in &board.holes {
            let ink = pens.entry(hole.diameter).or_insert_with(|| Ink::of(UNIT));
            if hole.is_slot() { ink.path(&hole.path) } else { ink.spot(hole.path.start) }
        }
        self.group("drills", &line(HOLE, 1.0), |svg| {
            for (diameter, ink) in pens {
                svg.path(&format!(" stroke-width=\"{}\"", fine(diameter)), ink);
            }
        });
    }

    /// A layer with a name; the fill of what is written within.
    fn group(&mut self, id: &str, attributes: &str, fill: impl FnOnce(&mut Self)) {
        _ = writeln!(self.text, "<g id=\"{id}\" {attributes}>");
        fill(self);
        self.text.push_str("</g>\n");
    }

    fn path(&mut self, attributes: &str, ink: Ink) {
        _ = writeln!(self.text, "<path{attributes} d=\"{}\"/>", ink.into_text());
    }

    fn strokes<'a>(&mut self, width: Nm, paths: impl IntoIterator<Item = &'a Path>) {
        let mut ink = Ink::of(UNIT);
        paths
            .into_iter()
            .for_each(|path| if path.segments.is_empty() { ink.spot(path.start) } else { ink.path(path) });
        self.path(&format!(" stroke-width=\"{}\"", fine(width)), ink);
    }

    fn finish(mut self) -> String {
        self.text.push_str("</g>\n</svg>\n");
        self.text
    }
}
