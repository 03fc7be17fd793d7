//! Pictures in a terminal: half blocks in 24-bit colour, which most terminals show, sixels, which
//! some do and sharper, or shades, which all do.

use std::fmt::Write as _;

use super::{Canvas, Rgb};

/// A picture as lines of half blocks: a character shows two pixels, the upper as its ink and the
/// lower as its ground.
#[must_use]
pub fn half_blocks(canvas: Canvas) -> String {
    let width = canvas.grid().width() as usize;
    let pixels = pixels(canvas);
    let rows: Vec<&[Rgb]> = pixels.chunks_exact(width).collect();
    let mut text = String::new();
    for pair in rows.chunks(2) {
        let mut before = None;
        for column in 0..width {
            let upper = pair[0][column];
            let lower = pair.get(1).map_or(upper, |row| row[column]);
            if before != Some((upper, lower)) {
                let (Rgb(r, g, b), Rgb(s, t, u)) = (upper, lower);
                _ = write!(text, "\x1b[38;2;{r};{g};{b};48;2;{s};{t};{u}m");
                before = Some((upper, lower));
            }
            text.push('▀');
        }
        text.push_str("\x1b[0m\n");
    }
    text
}

/// The same in characters of five shades, which need no colours.
#[must_use]
pub fn shades(canvas: Canvas) -> String {
    const SHADES: [char; 5] = [' ', '░', '▒', '▓', '█'];
    let width = canvas.grid().width() as usize;
    // As bright as the eye sees it (ITU-R BT.601), of 1000.
    let bright = |Rgb(r, g, b): Rgb| (u32::from(r) * 299 + u32::from(g) * 587 + u32::from(b) * 114) / 255;
    let pixels: Vec<u32> = pixels(canvas).into_iter().map(bright).collect();
    let rows: Vec<&[u32]> = pixels.chunks_exact(width).collect();
    let mut text = String::new();
    for pair in rows.chunks(2) {
        let lower = pair.get(1).unwrap_or(&pair[0]);
        text.extend(pair[0].iter().zip(*lower).map(|(a, b)| SHADES[((a + b) / 2 * 5 / 1001) as usize]));
        text.push('\n');
    }
    text
}

/// A picture as sixels (DEC STD 070, chapter 9) in the 216 colours of a cube of six steps.
#[must_use]
pub fn sixels(canvas: Canvas) -> String {
    let (width, height) = (canvas.grid().width() as usize, canvas.grid().height());
    let colours: Vec<u8> = pixels(canvas).into_iter().map(cube).collect();
    let mut text = format!("\x1bPq\"1;1;{width};{height}");
    let mut named = [false; 216];
    for band in colours.chunks(width * 6) {
        for colour in 0..216_u8 {
            if !band.contains(&colour) {
                continue;
            }
            if !named[usize::from(colour)] {
                named[usize::from(colour)] = true;
                let [r, g, b] = [colour / 36, colour / 6 % 6, colour % 6].map(|step| step * 20);
                _ = write!(text, "#{colour};2;{r};{g};{b}");
            }
            _ = write!(text, "#{colour}");
            sixel_row(&mut text, band, width, colour);
            // Back to the left for the next colour.
            text.push('$');
        }
        text.push('-');
    }
    text.push_str("\x1b\\\n");
    text
}

/// Six rows of one colour: a character for each column, repeats counted.
fn sixel_row(text: &mut String, band: &[u8], width: usize, colour: u8) {
    let bits = |column: usize| {
        let rows = band.chunks(width).zip(0_u8..);
        rows.fold(0, |bits, (row, n)| bits | u8::from(row[column] == colour) << n)
    };
    let mut column = 0;
    while column < width {
        let this = bits(column);
        let run = (column..width).take_while(|&other| bits(other) == this).count();
        let letter = char::from(b'?' + this);
        if run > 3 {
            _ = write!(text, "!{run}{letter}");
        } else {
            (0..run).for_each(|_| text.push(letter));
        }
        column += run;
    }
}

/// The nearest of the 216 colours.
fn cube(Rgb(r, g, b): Rgb) -> u8 {
    let [r, g, b] = [r, g, b].map(|value| u8::try_from((u16::from(value) * 5 + 127) / 255).unwrap_or(5));
    r * 36 + g * 6 + b
}

fn pixels(canvas: Canvas) -> Vec<Rgb> {
    canvas.into_rgb().chunks_exact(3).map(|p| Rgb(p[0], p[1], p[2])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Nm, Point, Rect};
    use crate::grid::Grid;

    /// Two columns and three rows, the lower left pixel red.
    fn picture() -> Canvas {
        let corner = Point::new(Nm::from_um(20), Nm::from_um(30));
        let grid =
            Grid::covering(Rect::new(Point::default(), corner), Nm::from_um(10)).expect("a small grid");
        let mut canvas = Canvas::new(grid, Rgb(0, 0, 0));
        canvas.set(0, 2, Rgb(255, 0, 0));
        canvas
    }

    #[test]
    fn a_half_block_is_two_pixels() {
        let text = half_blocks(picture());
        assert_eq!(text.lines().count(), 2, "three rows are two lines: {text:?}");
        assert_eq!(text.matches('▀').count(), 4, "two columns: {text:?}");
        assert!(text.contains("\x1b[38;2;255;0;0;"), "red: {text:?}");
        assert!(text.ends_with("\x1b[0m\n"), "and then as before: {text:?}");
    }

    #[test]
    fn shades_are_as_bright_as_the_picture() {
        let corner = Point::new(Nm::from_um(50), Nm::from_um(20));
        let grid =
            Grid::covering(Rect::new(Point::default(), corner), Nm::from_um(10)).expect("a small grid");
        let mut canvas = Canvas::new(grid, Rgb(0, 0, 0));
        for (column, grey) in (0..).zip([60, 120, 170, 255]) {
            (0..2).for_each(|row| canvas.set(column, row, Rgb(grey, grey, grey)));
        }
        assert_eq!(shades(canvas), "░▒▓█ \n", "from dark to light, and black");
    }

    #[test]
    fn sixels_name_their_colours_and_rows() {
        let text = sixels(picture());
        assert!(text.starts_with("\x1bPq\"1;1;2;3"), "the size: {text:?}");
        // Row 3 of six is the third bit: 4 above the question mark.
        assert!(text.contains("#180;2;100;0;0#180C?$"), "red, below on the left: {text:?}");
        assert!(text.contains("#0;2;0;0;0#0BF$"), "black everywhere else: {text:?}");
        assert!(text.ends_with("-\x1b\\\n"), "and the end: {text:?}");
    }
}
