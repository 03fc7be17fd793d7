//! Texts that the file does not carry as outlines, drawn with strokes.
//!
//! ```text
//! text ─ lines, justified ─▶ letters ─ strokes with the text's pen ─▶ held until all else is read
//!                                                                     └─▶ those clear of copper
//! ```
//!
//! The letters are our own (`stroke_font`), so none may join copper that KiCad's own would not: a
//! letter that comes too near to anything else on its side is left out, and said.

use super::frame::Frame;
use super::layers::copper_name;
use super::letter::{CLEAR, Letter};
use super::reader::Reader;
use super::stroke_font::{GAP, Glyph, glyph};
use super::tree::Node;
use crate::board::{Attributes, Side};
use crate::geometry::{Nm, Point, Rect, RectIndex};
use crate::import::diagnostic;
use crate::import::error::Error;

/// From one line to the next, in heights of capitals: as KiCad has it since version 6.
const LINES: f64 = 1.62;
/// How high the line over a signal that is active low lies, in heights of capitals.
const OVERBAR: f64 = 1.3;
/// How far above their line letters stand, in heights of capitals: measured in KiCad's plots.
const LIFT: f64 = 0.05;
/// How thick strokes are where the file does not say, as a part of the letters' height.
const PEN: i64 = 8;

/// How a text is set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting {
    /// Where its anchor lies, and which way it runs.
    frame: Frame,
    /// How high capitals are, and how wide letters as a part of what they would be.
    height: f64,
    width: f64,
    pen: Nm,
    /// −1 where the anchor is at the left edge, 1 at the right one.
    across: f64,
    /// −1 where the anchor is at the foot, 1 at the top.
    along: f64,
    mirrored: bool,
}

impl Setting {
    /// How the text `node` is set, whose anchor is given in `frame`.
    pub(super) fn of(reader: &Reader<'_>, node: Node<'_>, frame: &Frame) -> Result<Option<Self>, Error> {
        let Some(at) = node.find("at") else { return Ok(None) };
        let anchor = frame.place((reader.length(at, 0)?, reader.length(at, 1)?));
        // One that may stand on its head is `(at x y unlocked)` in version 6, with an angle or not.
        let free_here = at.argument(2).is_some_and(|word| word.raw() == b"unlocked");
        let is_turned = at.argument(2).is_some() && !free_here;
        let mut degrees = if is_turned { reader.number(at, 2)? } else { 0.0 };
        let is_free = node.head() == b"gr_text"
            || node.says("unlocked")
            || [node, at].iter().any(|list| list.has_word("unlocked"));
        let turned = degrees.rem_euclid(360.0);
        if !is_free && turned > 90.0 && turned <= 270.0 {
            degrees += 180.0;
        }
        let effects = node.find("effects");
        let font = effects.and_then(|effects| effects.find("font"));
        let size = font.and_then(|font| font.find("size"));
        let (height, width) = match size {
            Some(size) => (reader.length(size, 0)?, reader.length(size, 1)?),
            None => (Nm::from_mm(1), Nm::from_mm(1)),
        };
        let pen = match font.and_then(|font| font.find("thickness")) {
            Some(list) => reader.length(list, 0)?,
            None => Nm::ZERO,
        };
        let (height, width) = (height.max(Nm::ZERO), width.max(Nm::ZERO));
        let least = height.min(width);
        let pen = if pen > Nm::ZERO { pen.min(least / 4) } else { least / PEN };
        if pen <= Nm::ZERO {
            return Ok(None);
        }
        let justified = |word| {
            effects.and_then(|effects| effects.find("justify")).is_some_and(|justify| justify.has_word(word))
        };
        let edge = |low, high| f64::from(i8::from(justified(high)) - i8::from(justified(low)));
        Ok(Some(Self {
            frame: Frame::at(anchor, degrees),
            height: height.to_f64(),
            width: width.to_f64(),
            pen,
            across: edge("left", "right"),
            along: edge("bottom", "top"),
            mirrored: justified("mirror"),
        }))
    }

    /// Where a point of a text lies, given in heights of capitals from its anchor.
    fn place(&self, x: f64, y: f64) -> Point {
        let x = if self.mirrored { -x } else { x };
        self.frame.map(x * self.width, y * self.height)
    }

    /// The letters of `text`, each its strokes, and those characters that the font lacks.
    fn letters(&self, text: &str) -> (Vec<Vec<Vec<Point>>>, String) {
        let rows: Vec<(Vec<(Glyph, bool)>, String)> = text.lines().map(row).collect();
        let below = f64::from(u32::try_from(rows.len().saturating_sub(1)).unwrap_or(u32::MAX)) * LINES;
        // The first line's foot, with the anchor at the top, in the middle or at the foot of all.
        let mut y = LIFT + f64::midpoint(below, -1.0) - self.along * f64::midpoint(below, 1.0);
        let (mut letters, mut lacking) = (Vec::new(), String::new());
        for (glyphs, unknown) in rows {
            let wide = glyphs.iter().map(|(glyph, _)| glyph.advance).sum::<f64>() - GAP;
            let mut x = -wide * f64::midpoint(1.0, self.across);
            for (glyph, barred) in glyphs {
                let bar = barred.then(|| vec![(-GAP / 2.0, OVERBAR), (glyph.advance - GAP / 2.0, OVERBAR)]);
                let strokes = glyph.strokes.iter().chain(&bar);
                let drawn =
                    strokes.map(|stroke| stroke.iter().map(|p| self.place(x + p.0, y + p.1)).collect());
                letters.push(drawn.collect::<Vec<_>>());
                x += glyph.advance;
            }
            lacking += &unknown;
            y -= LINES;
        }
        letters.retain(|letter| !letter.is_empty());
        (letters, lacking)
    }
}

/// The glyphs of a line, each with whether a bar lies over it, and those characters that have none.
/// `~{RESET}` has a bar; what `_{…}` and `^{…}` lower and raise stays on the line.
fn row(line: &str) -> (Vec<(Glyph, bool)>, String) {
    let (mut glyphs, mut lacking) = (Vec::new(), String::new());
    let mut open: Vec<bool> = Vec::new();
    let mut rest = line.chars().peekable();
    while let Some(letter) = rest.next() {
        if matches!(letter, '~' | '_' | '^') && rest.peek() == Some(&'{') {
            rest.next();
            open.push(letter == '~');
        } else if letter == '}' && !open.is_empty() {
            open.pop();
        } else if let Some(glyph) = glyph(letter) {
            glyphs.push((glyph, open.contains(&true)));
        } else {
            lacking.push(letter);
        }
    }
    (glyphs, lacking)
}

impl Reader<'_> {
    /// Draws the text `said`, set as `setting`, once all else is read.
    pub(super) fn letter(
        &mut self,
        node: Node<'_>,
        said: &str,
        setting: &Setting,
        side: Side,
    ) -> Result<(), Error> {
        let (letters, lacking) = setting.letters(said);
        if !lacking.is_empty() {
            let message =
                format!("the text {} on {} is drawn without `{lacking}`", shown(said), copper_name(side));
            self.warnings.add(&diagnostic::KICAD_TEXT, node.place(), message);
        }
        for strokes in letters {
            let Some(bounds) = Rect::around(strokes.iter().flatten().copied()) else { continue };
            let (pen, line, place) = (setting.pen, node.line(), node.place());
            let letter = Letter {
                side,
                strokes,
                pen,
                bounds: bounds.inflate(pen / 2),
                line,
                place,
                of: said.to_owned(),
            };
            self.check(node, &letter.drawing())?;
            self.letters.push(letter);
        }
        Ok(())
    }

    /// Draws the letters that are clear of all other copper.
    pub(super) fn settle_letters(&mut self) {
        let attributes = Attributes { function: Some("NonConductor".to_owned()), ..Attributes::default() };
        let letters = std::mem::take(&mut self.letters);
        for side in [Side::Front, Side::Back] {
            let sheet = if side == Side::Front { &mut self.front } else { &mut self.back };
            let copper = RectIndex::new(sheet.features.iter().map(|feature| feature.shape.bounds()));
            let on_side = letters.iter().filter(|letter| letter.side == side);
            for text in on_side.collect::<Vec<_>>().chunk_by(|a, b| a.place == b.place) {
                let is_clear = |letter: &&Letter| {
                    let beside = copper.touching(letter.bounds.inflate(CLEAR));
                    !beside.into_iter().any(|number| letter.is_near(&sheet.features[number]))
                };
                let (clear, near): (Vec<&Letter>, Vec<&Letter>) = text.iter().copied().partition(is_clear);
                for letter in &clear {
                    sheet.put(letter.drawing(), &attributes, letter.line);
                }
                if !near.is_empty() {
                    let (count, said, on) = (near.len(), shown(&text[0].of), copper_name(side));
                    let plural = if count == 1 { " is" } else { "s are" };
                    let message = format!(
                        "{count} letter{plural} left out of the text {said} on {on}: within {:.1} mm of other copper",
                        CLEAR.to_mm()
                    );
                    self.warnings.add(&diagnostic::KICAD_TEXT, text[0].place.clone(), message);
                }
            }
        }
    }
}

/// A text as messages quote it.
pub(super) fn shown(said: &str) -> String {
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    format!("`{}`", said.chars().take(40).map(plain).collect::<String>())
}
