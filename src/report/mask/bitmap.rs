//! A mask as pixels: black ink on white, one bit a pixel, with the resolution in the file.
//!
//! A pixel is inked exactly where its centre is. Tiles are drawn, packed into bits and compressed
//! row by row, so memory does not grow with the picture's height.

use std::io::Write as _;

use png::{BitDepth, ColorType, Compression, Encoder, Filter, PixelDimensions, Unit};

use crate::geometry::{Nm, Rect, Vector};
use crate::grid::{self, Grid, GridError};
use crate::raster::{self, Label, Scene, Tile, TileContent};
use crate::topology;

use super::placing::Placing;
use super::sheet::Sheet;

/// Nanometres in an inch.
const INCH: u32 = 25_400_000;

/// Pixels of a tile: a row of them is a word.
const TILE: u32 = 64;

/// A sheet in a plane where a pixel is a whole number of units, and its pixels.
///
/// A pixel of 2400 DPI is 10583⅓ nm. On a grid of whole nanometres a page of A4 would end 9 µm off.
struct Plane {
    sheet: Sheet,
    grid: Grid,
}

impl Plane {
    fn new(sheet: Sheet, dpi: u32) -> Result<Self, GridError> {
        let (scale, pitch) = plane(dpi)?;
        let placing = Placing { mirrored: false, scale: (scale, scale) };
        let area = sheet.area;
        let sheet = placing.place(sheet);
        let grid = Grid::covering(aside(sheet.area, pitch), pitch);
        let grid = grid.map_err(|error| sized(error, area, dpi))?;
        Ok(Self { sheet, grid })
    }
}

/// How many units of the plane are a nanometre, and how many a pixel.
fn plane(dpi: u32) -> Result<(f64, Nm), GridError> {
    let pitch = Nm::new(i64::from(INCH / dpi.max(1)));
    if pitch < grid::FINEST {
        return Err(GridError::TooFine(pitch));
    }
    Ok((pitch.to_f64() * f64::from(dpi) / f64::from(INCH), pitch))
}

/// A picture that is too large, in pixels of the true size.
fn sized(error: GridError, area: Rect, dpi: u32) -> GridError {
    let count = |length: Nm| length.get() * i64::from(dpi) / i64::from(INCH) + 1;
    match error {
        GridError::TooLarge { .. } => {
            GridError::TooLarge { columns: count(area.width()), rows: count(area.height()) }
        }
        GridError::TooFine(_) => error,
    }
}

/// The area a hair to the right and down, so that ink that ends exactly in the middle of a pixel
/// covers that at its left and upper end and not that at its right and lower one.
fn aside(area: Rect, pitch: Nm) -> Rect {
    let hair = pitch / 512 + Nm::new(1);
    let way = Vector::new(hair, -hair);
    Rect::new(area.min() + way, area.max() + way)
}

/// How many pixels wide and high the picture of a page of `area` is.
///
/// # Errors
///
/// As [`bitmap`].
pub fn size(sheet: &Sheet, dpi: u32) -> Result<(u32, u32), GridError> {
    let bare = Sheet { nets: Vec::new(), ..sheet.clone() };
    Plane::new(bare, dpi).map(|plane| (plane.grid.width(), plane.grid.height()))
}

/// The bytes of a PNG file of so many pixels an inch.
///
/// # Errors
///
/// [`GridError`] for pixels that are too small, or too many of them.
pub fn bitmap(sheet: Sheet, dpi: u32) -> Result<Vec<u8>, GridError> {
    const MEMORY: &str = "memory takes any bytes, and there are as many pixels as the grid has";
    let Plane { sheet, grid } = Plane::new(sheet, dpi)?;
    let mut scene = Scene::new(grid.width(), grid.height());
    for shape in sheet.shapes() {
        scene.add(Label(1), topology::surface(shape, &grid, Some(0.0)));
    }
    drop(sheet);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, grid.width(), grid.height());
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::One);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Up);
    let per_metre = (u64::from(dpi) * 10_000 + 127) / 254;
    let per_metre = u32::try_from(per_metre).expect("at most a million to the metre");
    encoder.set_pixel_dims(Some(PixelDimensions { xppu: per_metre, yppu: per_metre, unit: Unit::Meter }));
    let mut writer = encoder.write_header().expect(MEMORY);
    let mut stream = writer.stream_writer().expect(MEMORY);
    let mut band = Band::new(&grid);
    let options = raster::Options { tile: TILE, ..raster::Options::default() };
    raster::stream(&scene, &options, Packed::new, |tile| {
        if let Some(rows) = band.lay(&tile) {
            stream.write_all(rows).expect(MEMORY);
        }
    });
    stream.finish().expect(MEMORY);
    writer.finish().expect(MEMORY);
    Ok(bytes)
}

/// A tile as bits: a word for each row, the left pixel in the highest bit; 1 is bare.
struct Packed {
    column0: u32,
    end: u32,
    height: u32,
    rows: Rows,
}

enum Rows {
    Alike(u64),
    Each(Vec<u64>),
}

impl Packed {
    fn new(tile: Tile<'_>) -> Self {
        let rows = match &tile.content {
            TileContent::Uniform(Label::BACKGROUND) => Rows::Alike(u64::MAX),
            TileContent::Uniform(_) => Rows::Alike(0),
            TileContent::Pixels(pixels) => {
                let rows = (0_i32..).take(tile.height as usize);
                Rows::Each(rows.map(|row| word(pixels.label_row(row))).collect())
            }
        };
        Self { column0: tile.column0, end: tile.column0 + tile.width, height: tile.height, rows }
    }
}

/// At most 64 labels as bits from the highest down; 1 where there is none.
fn word(labels: &[u32]) -> u64 {
    let bits = labels.iter().fold(0, |bits, &label| bits << 1 | u64::from(label == 0));
    bits << (u64::BITS as usize - labels.len())
}

/// A row of tiles on its way into the file.
struct Band {
    width: u32,
    /// Bytes of a row as the file has it.
    length: usize,
    /// Words of a row.
    words: usize,
    bits: Vec<u64>,
    bytes: Vec<u8>,
}

impl Band {
    fn new(grid: &Grid) -> Self {
        let words = grid.width().div_ceil(TILE) as usize;
        let (width, length) = (grid.width(), grid.width().div_ceil(8) as usize);
        Self { width, length, words, bits: vec![0; words * TILE as usize], bytes: Vec::new() }
    }

    /// Lays a tile; with the last of its row, the bytes of the rows.
    fn lay(&mut self, tile: &Packed) -> Option<&[u8]> {
        let column = (tile.column0 / TILE) as usize;
        let places = self.bits.iter_mut().skip(column).step_by(self.words);
        match &tile.rows {
            Rows::Alike(word) => places.for_each(|place| *place = *word),
            Rows::Each(words) => places.zip(words).for_each(|(place, word)| *place = *word),
        }
        if tile.end < self.width {
            return None;
        }
        self.bytes.clear();
        for row in self.bits.chunks_exact(self.words).take(tile.height as usize) {
            let end = self.bytes.len() + self.length;
            row.iter().for_each(|word| self.bytes.extend_from_slice(&word.to_be_bytes()));
            self.bytes.truncate(end);
        }
        Some(&self.bytes)
    }
}
