//! The lines below a picture: what is what, how long it is, and what it shows.

use crate::geometry::{Nm, Point, Rect};
use crate::grid::{Grid, GridError};

use super::palette::{COPPER, CUT, GROUND, HOLE, INK, REGION};
use super::{Canvas, Lettering, picture};

/// Height of a capital as a part of the picture's width, and its limits in pixels. Chosen: legible
/// on a page and on a screen.
const PART: f32 = 110.0;
const SMALLEST: f32 = 8.0;
const LARGEST: f32 = 18.0;

/// A grid over `area` with room for the legend below, of `pixel`, or as much coarser as keeps the
/// longer side within `most` pixels.
///
/// # Errors
///
/// As [`Grid::covering`].
pub fn grid(area: Rect, pixel: Nm, most: i64) -> Result<Grid, GridError> {
    let bare = picture::fit(area, pixel, most)?;
    let room = bare.pitch() * i64::from(room(bare.width()));
    let lower = Point::new(area.min().x, area.min().y - room);
    picture::fit(area.union(Rect::new(lower, lower)), pixel, most)
}

/// The height of the legend below a picture of this width, in pixels.
fn room(width: u32) -> u32 {
    (width / 14).max(60)
}

/// Draws what `canvas`, a band of a picture of `whole`, holds of it: two lines, on ground.
pub fn draw(canvas: &mut Canvas, whole: &Grid, caption: &str) {
    // Where the whole picture ends, counted from the band's first row.
    let below = canvas.rows_to(whole);
    let (width, height) = (canvas.size().0, below);
    let letters = (width / PART).clamp(SMALLEST, LARGEST);
    let (first, second) = (height - letters * 3.2, height - letters);
    #[expect(clippy::cast_precision_loss, reason = "a part of a picture's width")]
    let top = height - room(canvas.grid().width()) as f32;
    if top > canvas.size().1 {
        return;
    }
    canvas.block([0.0, top, width, height - top], GROUND, 1.0);
    let mut x = letters;
    let region = (REGION, "clad that stays with its net");
    for (colour, what) in [(COPPER, "copper"), region, (CUT, "cut"), (HOLE, "hole")] {
        canvas.block([x - 1.0, first - letters - 1.0, letters + 2.0, letters + 2.0], INK, 0.35);
        canvas.block([x, first - letters, letters, letters], colour, 1.0);
        x += letters * 1.7;
        x += write(canvas, what, letters, x, first) + letters;
    }
    let (length, text) = scale(canvas);
    let bar = canvas.grid().pixels(length);
    canvas.block([x, first - letters * 0.6, bar, (letters * 0.2).max(1.0)], INK, 1.0);
    write(canvas, text, letters, x + bar + letters * 0.6, first);
    write(canvas, caption, letters, letters, second);
}

/// The longest round length that takes at most a quarter of the width.
fn scale(canvas: &Canvas) -> (Nm, &'static str) {
    const LENGTHS: [(i64, &str); 6] =
        [(50, "50 mm"), (20, "20 mm"), (10, "10 mm"), (5, "5 mm"), (2, "2 mm"), (1, "1 mm")];
    let quarter = canvas.size().0 / 4.0;
    let fits = |&&(mm, _): &&(i64, &str)| canvas.grid().pixels(Nm::from_mm(mm)) <= quarter;
    let (mm, text) = LENGTHS.iter().find(fits).unwrap_or(&LENGTHS[5]);
    (Nm::from_mm(*mm), text)
}

fn write(canvas: &mut Canvas, text: &str, height: f32, x: f32, y: f32) -> f32 {
    let line = Lettering { text, height, colour: INK };
    line.draw(canvas, x, y);
    line.width()
}
