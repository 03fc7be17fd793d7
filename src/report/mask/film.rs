//! A mask as Gerber X2 (Ucamco, revision 2023.08): circles as apertures, arcs as arcs, areas as
//! regions, each object with the name of its net.
//!
//! Holes of areas are cut in (4.10.3): a region has no other way to have one that every reader
//! takes alike.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::board::{Shape, Side, polarity};
use crate::geometry::{Nm, Point, Polygon, Turn, Vector};

use super::cut::cut_in;
use super::sheet::{Sheet, What};

/// The text of a Gerber file.
#[must_use]
pub fn film(sheet: &Sheet) -> String {
    let mut text = format!(
        "%TF.GenerationSoftware,voromill,voromill,{}*%\n%TF.FileFunction,{}*%\n%TF.FilePolarity,{}*%\n\
         %FSLAX46Y46*%\n%MOMM*%\n%LPD*%\nG75*\n",
        env!("CARGO_PKG_VERSION"),
        function(sheet),
        if is_negative(sheet) { "Negative" } else { "Positive" },
    );
    let radii = sheet.shapes().filter_map(radius);
    let codes: BTreeMap<Nm, u32> = {
        let mut radii: Vec<Nm> = radii.collect();
        radii.sort_unstable();
        radii.dedup();
        radii.into_iter().zip(10..).collect()
    };
    for (radius, code) in &codes {
        _ = writeln!(text, "%ADD{code}C,{}*%", *radius * 2);
    }
    let mut pen = Pen { text, codes, aperture: None, at: None, is_begun: false, is_curved: None };
    for net in &sheet.nets {
        match &net.name {
            Some(name) => _ = writeln!(pen.text, "%TO.N,{}*%", field(name)),
            None => pen.text.push_str("%TD.N*%\n"),
        }
        net.shapes.iter().for_each(|shape| pen.shape(shape));
    }
    pen.text.push_str("M02*\n");
    pen.text
}

/// Whether ink is where there is no material (5.6.4): openings of a mask are such.
fn is_negative(sheet: &Sheet) -> bool {
    (sheet.what == What::Openings) != sheet.negative
}

fn function(sheet: &Sheet) -> &'static str {
    match (sheet.what, sheet.side) {
        (What::Copper | What::Regions, Side::Front) => "Copper,L1,Top",
        (What::Copper | What::Regions, Side::Back) => "Copper,L2,Bot",
        (What::Openings, Side::Front) => "Soldermask,Top",
        (What::Openings, Side::Back) => "Soldermask,Bot",
    }
}

/// A field of an attribute (3.4.3): what means something to the reader, or is no ASCII, as its
/// number.
fn field(text: &str) -> String {
    let mut field = String::with_capacity(text.len());
    for c in text.chars() {
        match u32::from(c) {
            code if code > 0xFFFF => _ = write!(field, "\\U{code:08X}"),
            code if !(0x20..0x7F).contains(&code) || "\\%*,".contains(c) => {
                _ = write!(field, "\\u{code:04X}");
            }
            _ => field.push(c),
        }
    }
    field
}

/// Half the width of the aperture that draws a shape.
fn radius(shape: &Shape) -> Option<Nm> {
    match shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => {
            Some(*radius)
        }
        Shape::Polygon(_) => None,
    }
}

/// What writes objects, and leaves out what is in force.
struct Pen {
    text: String,
    codes: BTreeMap<Nm, u32>,
    aperture: Option<u32>,
    at: Option<Point>,
    /// Whether a mode is in force.
    is_begun: bool,
    is_curved: Option<Turn>,
}

impl Pen {
    fn shape(&mut self, shape: &Shape) {
        if let Some(code) = radius(shape).map(|radius| self.codes[&radius])
            && self.aperture.replace(code) != Some(code)
        {
            _ = writeln!(self.text, "D{code}*");
        }
        match shape {
            Shape::Disc { center, .. } => self.operation(*center, "", "D03"),
            Shape::Stroke { from, to, .. } => {
                self.move_to(*from);
                self.line(*to);
            }
            Shape::Arc { arc, .. } => {
                self.move_to(arc.start);
                self.mode(Some(arc.turn));
                let Vector { x, y } = arc.center - arc.start;
                self.operation(arc.end, &format!("I{}J{}", x.get(), y.get()), "D01");
            }
            Shape::Polygon(polygon) => simple(polygon).iter().for_each(|piece| self.region(piece)),
        }
    }

    fn region(&mut self, polygon: &Polygon) {
        let ring = cut_in(polygon);
        self.text.push_str("G36*\n");
        self.at = None;
        self.move_to(ring[0]);
        ring[1..].iter().chain([&ring[0]]).for_each(|&p| self.line(p));
        self.text.push_str("G37*\n");
        self.at = None;
    }

    fn move_to(&mut self, p: Point) {
        if self.at != Some(p) {
            self.operation(p, "", "D02");
        }
    }

    fn line(&mut self, p: Point) {
        self.mode(None);
        self.operation(p, "", "D01");
    }

    /// Linear, or circular with a turn.
    fn mode(&mut self, turn: Option<Turn>) {
        let now = match turn {
            None => "G01*\n",
            Some(Turn::Clockwise) => "G02*\n",
            Some(Turn::CounterClockwise) => "G03*\n",
        };
        if !self.is_begun || self.is_curved != turn {
            self.text.push_str(now);
        }
        (self.is_begun, self.is_curved) = (true, turn);
    }

    fn operation(&mut self, p: Point, offset: &str, code: &str) {
        _ = writeln!(self.text, "X{}Y{}{offset}{code}*", p.x.get(), p.y.get());
        self.at = Some(p);
    }
}

/// A polygon as pieces that each have one outer contour.
fn simple(polygon: &Polygon) -> Vec<Polygon> {
    if polygon.contours().len() == 1 { vec![polygon.clone()] } else { polarity::clean(polygon.contours()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_means_something_in_a_name_is_escaped() {
        assert_eq!(field("A*B,C%D\\"), "A\\u002AB\\u002CC\\u0025D\\u005C", "signs of the format");
        assert_eq!(field("µ\u{1F600} /RST"), "\\u00B5\\U0001F600 /RST", "no ASCII");
    }
}
