//! Pictures as the bytes of PNG files: 8 bits a channel, no time, no text, the same bytes
//! everywhere.

use std::io::Write as _;

use png::{BitDepth, ColorType, Compression, Encoder, Filter};

use crate::grid::Grid;

use super::Canvas;

/// Why writing does not fail.
const MEMORY: &str = "memory takes any bytes, and there are as many pixels as the grid has";

/// Rows that are drawn at a time. Chosen: a band of a large picture takes two megabytes, and there
/// are few of them.
const BAND: u32 = 240;

/// Rows above a band that are drawn and thrown away: of what ends right above a picture, the
/// drawing library lays the last row onto the picture's first. Chosen.
const APRON: u32 = 2;

/// A picture of `grid` that `draw` paints band by band: it is given the grid of each, from the top.
///
/// No more than a band is ever held as pixels.
pub fn bands(grid: &Grid, draw: impl Fn(Grid) -> Canvas) -> Vec<u8> {
    encode(grid, ColorType::Rgb, |file| painted(grid, draw, file))
}

/// Gives `take` the pixels of a picture band by band.
fn painted(grid: &Grid, draw: impl Fn(Grid) -> Canvas, take: &mut dyn FnMut(&[u8])) {
    for top in (0..grid.height()).step_by(BAND as usize) {
        let apron = APRON.min(top);
        let band = grid.rows(top - apron, apron + BAND.min(grid.height() - top));
        let pixels = draw(band).into_rgb();
        take(&pixels[(apron * grid.width() * 3) as usize..]);
    }
}

/// The same in grey values, one byte a pixel of each band, row 0 on top.
pub fn grey_bands(grid: &Grid, draw: impl Fn(Grid) -> Vec<u8>) -> Vec<u8> {
    encode(grid, ColorType::Grayscale, |file| each_band(grid, |band| file(&draw(band))))
}

/// A picture as the bytes of a PNG file.
pub fn rgb(canvas: Canvas) -> Vec<u8> {
    let grid = *canvas.grid();
    encode(&grid, ColorType::Rgb, |file| file(&canvas.into_rgb()))
}

/// Pixels of three bytes, `width` to a row and row 0 on top, as the bytes of a PNG file as small as
/// it can be.
pub fn pixels(width: u32, pixels: &[[u8; 3]]) -> Vec<u8> {
    let height = u32::try_from(pixels.len()).unwrap_or(u32::MAX) / width.max(1);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    let mut writer = encoder.write_header().expect(MEMORY);
    writer.write_image_data(pixels.as_flattened()).expect(MEMORY);
    writer.finish().expect(MEMORY);
    bytes
}

/// Parts of `grid` as wide as it is, from the top.
pub(super) fn each_band(grid: &Grid, mut take: impl FnMut(Grid)) {
    for top in (0..grid.height()).step_by(BAND as usize) {
        take(grid.rows(top, BAND.min(grid.height() - top)));
    }
}

/// A file into which `paint` puts its pixels from the top.
fn encode(grid: &Grid, colour: ColorType, paint: impl FnOnce(&mut dyn FnMut(&[u8]))) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, grid.width(), grid.height());
    encoder.set_color(colour);
    encoder.set_depth(BitDepth::Eight);
    // Pictures of boards are mostly flat: the fast level is nearly as small as the best and ten
    // times as fast.
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Up);
    let mut writer = encoder.write_header().expect(MEMORY);
    let mut stream = writer.stream_writer().expect(MEMORY);
    paint(&mut |pixels| stream.write_all(pixels).expect(MEMORY));
    stream.finish().expect(MEMORY);
    writer.finish().expect(MEMORY);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Nm, Path, Point, Rect, Turn};
    use crate::report::Rgb;

    #[test]
    fn bands_show_no_seams() {
        let um = Nm::from_um;
        let corner = Point::new(um(600), um(3_000));
        let grid = Grid::covering(Rect::new(Point::default(), corner), um(10)).expect("a small grid");
        // Rings that end near the first seam, each a tenth of a pixel lower than the one before.
        let ring = |offset: i64| {
            let center = Point::new(um(100 + offset * 20), um(3_000 - 2_340 - offset));
            Path::circle(center, um(50), Turn::CounterClockwise)
        };
        let rings: Vec<Path> = (0..20).map(ring).collect();
        let draw = |grid: Grid| {
            let mut canvas = Canvas::new(grid, Rgb(0, 0, 0));
            rings.iter().for_each(|ring| canvas.stroke(ring, Nm::ZERO, Rgb(255, 255, 255), 1.0));
            canvas
        };
        let mut pixels = Vec::new();
        painted(&grid, draw, &mut |band| pixels.extend_from_slice(band));
        let whole = draw(grid).into_rgb();
        assert_eq!(pixels.len(), whole.len(), "all rows");
        let off = pixels.iter().zip(&whole).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(off <= Some(2), "as drawn at once, but for roundings: {off:?}");
    }
}
