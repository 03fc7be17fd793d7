//! A mask as SVG: filled outlines of lines and arcs in millimetres, a group for each net.
//!
//! There are no strokes and no transformations, because programs for lasers follow the middle of a
//! stroke whatever its width. Coordinates are the page's own, to the nanometre.

use std::fmt::Write as _;

use crate::geometry::{Arc, Nm, Path, Point, Rect, Segment, Turn};
use crate::report::xml::escaped;

use super::outline::outline;
use super::sheet::Sheet;

/// The text of an SVG file.
#[must_use]
pub fn drawing(sheet: &Sheet) -> String {
    let (width, height) = (millimetres(sheet.area.width()), millimetres(sheet.area.height()));
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"0 0 {width} {height}\">\n<title>{} {}</title>\n<g id=\"ink\" fill=\"#000000\" \
         stroke=\"none\" fill-rule=\"nonzero\">\n",
        escaped(&sheet.name),
        sheet.describe(),
    );
    for (number, net) in (1..).zip(&sheet.nets) {
        _ = writeln!(text, "<g id=\"net-{number}\">\n<title>{}</title>", escaped(&net.label));
        for shape in &net.shapes {
            let mut pen = Pen { text: String::new(), page: sheet.area };
            outline(shape).iter().for_each(|path| pen.path(path));
            _ = writeln!(text, "<path d=\"{}\"/>", pen.text);
        }
        text.push_str("</g>\n");
    }
    text.push_str("</g>\n</svg>\n");
    text
}

/// As short as it is exact.
fn millimetres(length: Nm) -> String {
    let text = format!("{length}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Path data on a page whose y points down.
struct Pen {
    text: String,
    page: Rect,
}

impl Pen {
    fn path(&mut self, path: &Path) {
        self.go('M', path.start);
        for (from, segment) in path.steps() {
            match (segment, segment.arc(from)) {
                (_, Some(arc)) => self.arc(&arc),
                (Segment::Line { to } | Segment::Arc { to, .. }, None) => self.go('L', *to),
            }
        }
        self.text.push('Z');
    }

    fn go(&mut self, letter: char, p: Point) {
        let (x, y) = (p.x - self.page.min().x, self.page.max().y - p.y);
        _ = write!(self.text, "{letter}{} {}", millimetres(x), millimetres(y));
    }

    /// In halves where it is as much as a half circle, so that its ends and radius tell which it
    /// is.
    fn arc(&mut self, arc: &Arc) {
        let radius = millimetres(Nm::from_f64(arc.radius()));
        // A turn is seen with y up, the page's y points down: both look the same.
        let sweep = u8::from(arc.turn == Turn::Clockwise);
        let halves = if arc.sweep().abs() > 3.0 { 2 } else { 1 };
        for end in arc.parts(halves) {
            _ = write!(self.text, "A{radius} {radius} 0 0 {sweep} ");
            let (x, y) = (end.x - self.page.min().x, self.page.max().y - end.y);
            _ = write!(self.text, "{} {}", millimetres(x), millimetres(y));
        }
    }
}
