//! Text → areas: the outlines of a font's glyphs, one beside the other.
//!
//! A TrueType or OpenType file is what ttf-parser reads; curves become chords within the same
//! tolerance as all other curves do. Kerning is that of the `kern` table; scripts whose letters
//! change beside each other are not shaped.

use ttf_parser::{Face, GlyphId, OutlineBuilder};

use crate::board::FLATTEN;
use crate::board::polarity::clean;
use crate::geometry::{Nm, Point, Polygon};

/// Why a text has no outlines.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextError {
    /// The file is no font.
    #[error("this is not a font: expected a TrueType or OpenType file ({0})")]
    Font(String),
    /// A character without a glyph.
    #[error("the font has no glyph for `{0}`")]
    Glyph(char),
    /// Nothing but space.
    #[error("the text `{0}` draws nothing")]
    Empty(String),
    /// So large that it leaves the range of lengths, or so small that nothing is left.
    #[error("a text height of {0:.3} mm is out of range: expected from 0.1 mm to 500 mm")]
    Height(Nm),
}

/// The heights of capitals that make sense.
const HEIGHTS: std::ops::RangeInclusive<Nm> = Nm::from_um(100)..=Nm::from_mm(500);

/// The areas of `text` in a font, capitals `height` high, the first line on y = 0 from x = 0 on.
///
/// # Errors
///
/// [`TextError`] for bytes that are no font, characters that it does not have, and heights that
/// make no sense.
pub fn text(font: &[u8], text: &str, height: Nm) -> Result<Vec<Polygon>, TextError> {
    if !HEIGHTS.contains(&height) {
        return Err(TextError::Height(height));
    }
    let face = Face::parse(font, 0).map_err(|error| TextError::Font(error.to_string()))?;
    let scale = height.to_f64() / f64::from(capital(&face).max(1));
    let mut pen = Pen { scale, ..Pen::default() };
    for (line, row) in text.lines().zip(0_i32..) {
        pen.x = 0.0;
        pen.y = -f64::from(row) * f64::from(line_height(&face));
        let mut before: Option<GlyphId> = None;
        for character in line.chars() {
            let glyph = face.glyph_index(character).ok_or(TextError::Glyph(character))?;
            pen.x += before.map_or(0.0, |before| f64::from(kerning(&face, before, glyph)));
            face.outline_glyph(glyph, &mut pen);
            pen.x += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
            before = Some(glyph);
        }
    }
    let areas = clean(&pen.rings);
    if areas.is_empty() { Err(TextError::Empty(text.to_owned())) } else { Ok(areas) }
}

/// How high capitals are, in units of the font: as an H is, or else as the font says.
fn capital(face: &Face<'_>) -> i16 {
    let of_h =
        face.glyph_index('H').and_then(|glyph| face.glyph_bounding_box(glyph)).map(|bounds| bounds.y_max);
    of_h.or_else(|| face.capital_height()).filter(|&height| height > 0).unwrap_or_else(|| face.ascender())
}

fn line_height(face: &Face<'_>) -> i32 {
    i32::from(face.ascender()) - i32::from(face.descender()) + i32::from(face.line_gap())
}

/// How far the second of two glyphs is moved.
fn kerning(face: &Face<'_>, before: GlyphId, glyph: GlyphId) -> i16 {
    let Some(table) = face.tables().kern else { return 0 };
    let level = table.subtables.into_iter().filter(|part| part.horizontal && !part.has_cross_stream);
    level.filter_map(|part| part.glyphs_kerning(before, glyph)).next().unwrap_or(0)
}

/// Follows outlines in units of the font.
#[derive(Default)]
struct Pen {
    scale: f64,
    /// Where the glyph is.
    x: f64,
    y: f64,
    /// Where the pen is, in nanometres.
    at: [f64; 2],
    rings: Vec<Vec<Point>>,
}

impl Pen {
    fn place(&self, x: f32, y: f32) -> [f64; 2] {
        [(self.x + f64::from(x)) * self.scale, (self.y + f64::from(y)) * self.scale]
    }

    fn reach(&mut self, at: [f64; 2]) {
        self.at = at;
        if let Some(ring) = self.rings.last_mut() {
            ring.push(Point::from_f64(at[0], at[1]));
        }
    }

    /// Chords within [`FLATTEN`] of a curve whose second derivative is `bend` at most.
    fn curve(&mut self, bend: f64, at: impl Fn(f64) -> [f64; 2]) {
        // A chord over a part h of the curve leaves it by bend h² / 8.
        let count = (bend / (8.0 * FLATTEN.to_f64())).sqrt().ceil().clamp(1.0, MOST_CHORDS);
        let mut step = 1.0;
        while step <= count {
            self.reach(at(step / count));
            step += 1.0;
        }
    }
}

/// A curve is cut into so many chords at most. Chosen.
const MOST_CHORDS: f64 = 4096.0;

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.rings.push(Vec::new());
        self.reach(self.place(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.reach(self.place(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (a, b, c) = (self.at, self.place(x1, y1), self.place(x, y));
        let bend = 2.0 * length([a[0] - 2.0 * b[0] + c[0], a[1] - 2.0 * b[1] + c[1]]);
        self.curve(bend, |t| {
            let u = 1.0 - t;
            [0, 1].map(|i| a[i] * u * u + 2.0 * b[i] * u * t + c[i] * t * t)
        });
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (a, b, c, d) = (self.at, self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        let second = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            6.0 * length([p[0] - 2.0 * q[0] + r[0], p[1] - 2.0 * q[1] + r[1]])
        };
        self.curve(second(a, b, c).max(second(b, c, d)), |t| {
            let u = 1.0 - t;
            [0, 1].map(|i| {
                a[i] * u * u * u + 3.0 * b[i] * u * u * t + 3.0 * c[i] * u * t * t + d[i] * t * t * t
            })
        });
    }

    fn close(&mut self) {}
}
