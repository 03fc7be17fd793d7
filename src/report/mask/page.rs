//! A mask as PDF (ISO 32000-1): one page of the true size, for printers.
//!
//! The content is in micrometres under one matrix (8.3). Round shapes are strokes with round ends
//! (8.4.3.3), arcs are Bézier curves (8.5.2) of at most an eighth of a turn, which leave a circle
//! by less than 5 parts in a million of its radius. Nothing is compressed.

use std::fmt::Write as _;

use crate::board::Shape;
use crate::geometry::{Arc, Nm, Point, Rect};

use super::sheet::Sheet;

/// Points, of which an inch has 72, in a micrometre.
const POINT: f64 = 72.0 / 25_400.0;

/// The bytes of a PDF file.
#[must_use]
pub fn page(sheet: &Sheet) -> Vec<u8> {
    let content = content(sheet);
    let size = |length: Nm| length.to_f64() / 1000.0 * POINT;
    let (width, height) = (size(sheet.area.width()), size(sheet.area.height()));
    let title = text(&format!("{} {}", sheet.name, sheet.describe()));
    let objects = [
        "<< /Type /Catalog /Pages 2 0 R >>".to_owned(),
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_owned(),
        format!(
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width:.6} {height:.6}] /Resources << >> /Contents 4 0 R >>"
        ),
        format!("<< /Length {} >>\nstream\n{content}endstream", content.len()),
        // Printers are told not to fit the page to their paper.
        format!("<< /Title {title} /Producer (voromill {}) >>", env!("CARGO_PKG_VERSION")),
    ];
    let mut file = String::from("%PDF-1.4\n");
    let mut places = Vec::new();
    for (number, object) in (1..).zip(&objects) {
        places.push(file.len());
        _ = write!(file, "{number} 0 obj\n{object}\nendobj\n");
    }
    let table = file.len();
    _ = write!(file, "xref\n0 {}\n0000000000 65535 f \n", places.len() + 1);
    for place in &places {
        _ = writeln!(file, "{place:010} 00000 n ");
    }
    let count = places.len() + 1;
    _ = write!(file, "trailer\n<< /Size {count} /Root 1 0 R /Info 5 0 R >>\nstartxref\n{table}\n%%EOF\n");
    file.into_bytes()
}

/// A text string (7.9.2.2), in UTF-16 as hexadecimal.
fn text(text: &str) -> String {
    let units: String = text.encode_utf16().map(|unit| format!("{unit:04X}")).collect();
    format!("<FEFF{units}>")
}

fn content(sheet: &Sheet) -> String {
    let mut pen = Pen { text: String::new(), page: sheet.area, width: None };
    // Black, one micrometre a unit, round ends and corners.
    _ = writeln!(pen.text, "0 g 0 G {POINT:.16} 0 0 {POINT:.16} 0 0 cm 1 J 1 j");
    sheet.shapes().for_each(|shape| pen.shape(shape));
    pen.text
}

/// What draws on the page, whose lower left corner is zero.
struct Pen {
    text: String,
    page: Rect,
    /// The width of the stroke.
    width: Option<Nm>,
}

impl Pen {
    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Disc { center, radius } => self.stroke(*radius, *center, |pen| pen.go(*center, "l")),
            Shape::Stroke { from, to, radius } => self.stroke(*radius, *from, |pen| pen.go(*to, "l")),
            Shape::Arc { arc, radius } => self.stroke(*radius, arc.start, |pen| pen.arc(arc)),
            Shape::Polygon(polygon) => {
                for ring in polygon.contours() {
                    self.go(ring[0], "m");
                    ring[1..].iter().for_each(|&p| self.go(p, "l"));
                    self.text.push_str("h\n");
                }
                self.text.push_str("f\n");
            }
        }
    }

    fn stroke(&mut self, radius: Nm, from: Point, draw: impl FnOnce(&mut Self)) {
        let width = radius * 2;
        // A line of no width would be as thin as the printer can.
        if width <= Nm::ZERO {
            return;
        }
        if self.width != Some(width) {
            self.width = Some(width);
            _ = writeln!(self.text, "{} w", um(width.to_f64()));
        }
        self.go(from, "m");
        draw(self);
        self.text.push_str("S\n");
    }

    fn go(&mut self, p: Point, operator: &str) {
        self.put(p.to_f64());
        _ = writeln!(self.text, "{operator}");
    }

    fn put(&mut self, (x, y): (f64, f64)) {
        let (left, bottom) = self.page.min().to_f64();
        _ = write!(self.text, "{} {} ", um(x - left), um(y - bottom));
    }

    /// Bézier curves whose middles lie on the arc.
    fn arc(&mut self, arc: &Arc) {
        /// The longest piece of an arc. Chosen: such a curve leaves the circle by 4 parts in a
        /// million of the radius.
        const EIGHTH: f64 = std::f64::consts::FRAC_PI_4;
        let mut pieces = 1_u32;
        while arc.sweep().abs() > EIGHTH * f64::from(pieces) {
            pieces += 1;
        }
        let step = arc.sweep() / f64::from(pieces);
        let reach = 4.0 / 3.0 * libm::tan(step / 4.0);
        let (cx, cy) = arc.center.to_f64();
        // Beside a place of the arc, along its tangent.
        let beside = |(x, y): (f64, f64), way: f64| (x - (y - cy) * way, y + (x - cx) * way);
        for piece in 0..pieces {
            let from = arc.at(f64::from(piece) / f64::from(pieces));
            let to = if piece + 1 == pieces {
                arc.end.to_f64()
            } else {
                arc.at(f64::from(piece + 1) / f64::from(pieces))
            };
            [beside(from, reach), beside(to, -reach), to].into_iter().for_each(|p| self.put(p));
            self.text.push_str("c\n");
        }
    }
}

/// Nanometres as micrometres, as short as they are exact to the nanometre.
fn um(nanometres: f64) -> String {
    let nm = Nm::from_f64(nanometres);
    let text = format!(
        "{}{}.{:03}",
        if nm < Nm::ZERO { "-" } else { "" },
        nm.abs().get() / 1000,
        nm.abs().get() % 1000
    );
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
