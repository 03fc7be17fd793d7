//! Pictures as the bytes of PNG files: 8 bits a channel, no time, no text, the same bytes everywhere.

use std::io::Write as _;

use png::{BitDepth, ColorType, Compression, Encoder, Filter};

use crate::grid::Grid;

use super::Canvas;

/// Rows that are drawn at a time. Chosen: a band of a large picture takes two megabytes, and there are few of them.
const BAND: u32 = 240;

/// A picture of `grid` that `draw` paints band by band: it is given the grid of each, from the top.
///
/// No more than a band is ever held as pixels.
pub fn bands(grid: &Grid, draw: impl Fn(Grid) -> Canvas) -> Vec<u8> {
    encode(grid, ColorType::Rgb, |file| each_band(grid, |band| file(&draw(band).into_rgb())))
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

/// Parts of `grid` as wide as it is, from the top.
pub(super) fn each_band(grid: &Grid, mut take: impl FnMut(Grid)) {
    for top in (0..grid.height()).step_by(BAND as usize) {
        take(grid.rows(top, BAND.min(grid.height() - top)));
    }
}

/// A file into which `paint` puts its pixels from the top.
fn encode(grid: &Grid, colour: ColorType, paint: impl FnOnce(&mut dyn FnMut(&[u8]))) -> Vec<u8> {
    const MEMORY: &str = "memory takes any bytes, and there are as many pixels as the grid has";
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, grid.width(), grid.height());
    encoder.set_color(colour);
    encoder.set_depth(BitDepth::Eight);
    // Pictures of boards are mostly flat: the fast level is nearly as small as the best and ten times as fast.
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Up);
    let mut writer = encoder.write_header().expect(MEMORY);
    let mut stream = writer.stream_writer().expect(MEMORY);
    paint(&mut |pixels| stream.write_all(pixels).expect(MEMORY));
    stream.finish().expect(MEMORY);
    writer.finish().expect(MEMORY);
    bytes
}
