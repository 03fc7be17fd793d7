//! A finished piece of a picture, with the apron around it.

use super::Label;
use super::canvas::Canvas;

/// A piece of the picture.
#[derive(Clone, Copy, Debug)]
pub struct Tile<'a> {
    /// Its leftmost column, without the apron.
    pub column0: u32,
    /// Its topmost row, without the apron.
    pub row0: u32,
    /// Columns, without the apron.
    pub width: u32,
    /// Rows, without the apron.
    pub height: u32,
    /// What it shows.
    pub content: TileContent<'a>,
}

/// What a tile shows.
#[derive(Clone, Copy, Debug)]
pub enum TileContent<'a> {
    /// One label everywhere, known without drawing.
    Uniform(Label),
    /// Its pixels.
    Pixels(TilePixels<'a>),
}

/// The pixels of a tile and of the apron around it.
///
/// Columns and rows count from the tile's own top left pixel, so that the apron's are negative or
/// beyond its size. Beyond the picture lies background, infinitely deep.
#[derive(Clone, Copy, Debug)]
pub struct TilePixels<'a> {
    labels: &'a [u32],
    depths: &'a [f32],
    /// From one row to the next.
    stride: usize,
    /// Columns, apron included.
    width: usize,
    apron: i32,
}

impl<'a> TilePixels<'a> {
    /// What has been drawn on the frame of a canvas.
    pub(super) fn new(canvas: &'a Canvas, apron: u32) -> Self {
        let (depths, labels, stride) = canvas.pixels();
        let width = super::canvas::count(canvas.frame().width);
        Self { labels, depths, stride, width, apron: super::node::signed(apron) }
    }

    /// The label at a column and row.
    ///
    /// # Panics
    ///
    /// Outside the tile and its apron.
    #[must_use]
    pub fn label(&self, column: i32, row: i32) -> Label {
        Label(self.label_row(row)[super::canvas::count(column + self.apron)])
    }

    /// The depth at a column and row.
    ///
    /// # Panics
    ///
    /// Outside the tile and its apron.
    #[must_use]
    pub fn depth(&self, column: i32, row: i32) -> f32 {
        self.depth_row(row)[super::canvas::count(column + self.apron)]
    }

    /// The labels of a row, apron included: the first is that of column −apron.
    ///
    /// # Panics
    ///
    /// Outside the tile and its apron.
    #[must_use]
    pub fn label_row(&self, row: i32) -> &'a [u32] {
        &self.labels[super::canvas::count(row + self.apron) * self.stride..][..self.width]
    }

    /// The depths of a row, apron included: the first is that of column −apron.
    ///
    /// # Panics
    ///
    /// Outside the tile and its apron.
    #[must_use]
    pub fn depth_row(&self, row: i32) -> &'a [f32] {
        &self.depths[super::canvas::count(row + self.apron) * self.stride..][..self.width]
    }
}
