//! A plain stroke font, drawn for this program, so that pictures need no font file.
//!
//! A glyph is polylines on a grid 4 wide and 6 high, each point two digits, x then y from the base
//! line:
//!
//! ```text
//!   6 ┌──┐      F = "0006 0646 0333"
//!   3 ├─          up the stem, along the top, along the middle
//!   0 │
//!     0  4
//! ```
//!
//! Small letters are drawn as capitals; what has no glyph is drawn as a box.

use super::{Canvas, Rgb};

/// Grid units from one glyph to the next. Chosen: glyphs are four units wide.
const ADVANCE: f32 = 5.6;

/// The glyphs: character, polylines.
const GLYPHS: &[(char, &str)] = &[
    (' ', ""),
    ('A', "002640 0232"),
    ('B', "00063645443303 3342413000"),
    ('C', "4536160501103041"),
    ('D', "00062644422000"),
    ('E', "46060040 0333"),
    ('F', "000646 0333"),
    ('G', "45361605011030414323"),
    ('H', "0006 4046 0343"),
    ('I', "1030 2026 1636"),
    ('J', "4641301001"),
    ('K', "0006 4602 1340"),
    ('L', "060040"),
    ('M', "0006234640"),
    ('N', "00064046"),
    ('O', "103041453616050110"),
    ('P', "00063645443303"),
    ('Q', "103041453616050110 2240"),
    ('R', "00063645443303 2340"),
    ('S', "453616050413334241301001"),
    ('T', "2026 0646"),
    ('U', "060110304146"),
    ('V', "062046"),
    ('W', "0610233046"),
    ('X', "0046 0640"),
    ('Y', "062346 2320"),
    ('Z', "06460040"),
    ('0', "103041453616050110 0145"),
    ('1', "052620 1030"),
    ('2', "05163645440040"),
    ('3', "05163645443323 334241301001"),
    ('4', "30360242"),
    ('5', "460604334241301001"),
    ('6', "4536160501103041423303"),
    ('7', "064610"),
    ('8', "13334445361605041302011030414233"),
    ('9', "0110304145361605041343"),
    ('.', "2021"),
    (',', "2110"),
    (':', "2122 2425"),
    ('-', "1333"),
    ('_', "0040"),
    ('+', "0343 2125"),
    ('/', "0046"),
    ('\\', "0640"),
    ('(', "36242230"),
    (')', "16242210"),
    ('[', "36161030"),
    (']', "16363010"),
    ('#', "1115 3135 0242 0444"),
    ('*', "2125 0442 0244"),
    ('=', "0242 0444"),
    ('<', "450341"),
    ('>', "054301"),
    ('~', "02143244"),
    ('\'', "2624"),
    ('"', "1614 3634"),
    ('!', "2622 2020"),
    ('?', "05163645442322 2020"),
    ('%', "0046 0605 4140"),
    ('&', "4005162635 0201103042"),
    ('$', "453605041343413001 2026"),
    ('@', "3323143442454616050110"),
    ('^', "042644"),
    ('|', "2026"),
    ('×', "0145 0541"),
    ('µ', "0004 0110304044"),
    ('·', "2323"),
];

/// A line of text on a picture.
pub struct Lettering<'a> {
    /// What it says.
    pub text: &'a str,
    /// The height of a capital, in pixels.
    pub height: f32,
    /// Its colour.
    pub colour: Rgb,
}

impl Lettering<'_> {
    /// How wide it runs, in pixels.
    #[must_use]
    pub fn width(&self) -> f32 {
        self.text.chars().map(|_| ADVANCE).sum::<f32>() * self.unit()
    }

    /// Draws it with its base line beginning at `x`, `y`, in pixels from the upper left corner.
    pub fn draw(&self, canvas: &mut Canvas, x: f32, y: f32) {
        let mut pen = x;
        let mut lines = Vec::new();
        for character in self.text.chars() {
            for line in glyph(character) {
                lines.push(
                    line.iter().map(|&(gx, gy)| (pen + gx * self.unit(), y - gy * self.unit())).collect(),
                );
            }
            pen += ADVANCE * self.unit();
        }
        canvas.ink(&lines, (self.height / 8.0).max(1.0), self.colour);
    }

    fn unit(&self) -> f32 {
        self.height / 6.0
    }
}

/// The polylines of a character.
fn glyph(character: char) -> Vec<Vec<(f32, f32)>> {
    let capital = character.to_ascii_uppercase();
    let strokes = GLYPHS.iter().find(|(c, _)| *c == capital).map_or("0006464000", |(_, strokes)| strokes);
    strokes.split(' ').map(points).filter(|line| !line.is_empty()).collect()
}

fn points(stroke: &str) -> Vec<(f32, f32)> {
    let digit = |byte: u8| f32::from(byte - b'0');
    stroke.as_bytes().chunks_exact(2).map(|pair| (digit(pair[0]), digit(pair[1]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glyph_lies_on_the_grid() {
        for (character, strokes) in GLYPHS {
            for stroke in strokes.split(' ') {
                assert_eq!(stroke.len() % 2, 0, "a point of `{character}` lacks a digit");
            }
            for (x, y) in strokes.split(' ').flat_map(points) {
                assert!(x <= 4.0 && y <= 6.0, "`{character}` leaves the grid at {x}, {y}");
            }
        }
    }
}
