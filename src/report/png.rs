//! Pictures as the bytes of PNG files.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

use crate::grid::Grid;

use super::Canvas;

/// A picture as the bytes of a PNG file: 8 bits a channel, no time, no text, the same bytes everywhere.
pub fn rgb(canvas: Canvas) -> Vec<u8> {
    let (columns, rows) = (canvas.grid().width(), canvas.grid().height());
    encode(&canvas.into_rgb(), columns, rows, ExtendedColorType::Rgb8)
}

/// Grey values, one byte a pixel of `grid`, row 0 on top, as the bytes of a PNG file.
pub fn grey(grid: &Grid, pixels: &[u8]) -> Vec<u8> {
    encode(pixels, grid.width(), grid.height(), ExtendedColorType::L8)
}

fn encode(pixels: &[u8], columns: u32, rows: u32, colour: ExtendedColorType) -> Vec<u8> {
    let mut bytes = Vec::new();
    // Pictures of boards are mostly flat: the fast level is nearly as small as the best and ten times as fast.
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Up)
        .write_image(pixels, columns, rows, colour)
        .expect("memory takes any bytes, and the buffer fits the grid");
    bytes
}
