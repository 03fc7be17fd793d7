//! Board geometry on tiny-skia's pixmaps: the only file that speaks to the drawing library.
//!
//! Shapes and lines, of which there are thousands, are drawn by our own rasterizer, on all threads;
//! the library holds the pixels and writes letters.

use std::ops::Range;

use tiny_skia::{
    Color, LineCap, LineJoin, Paint, PathBuilder, Pixmap, PremultipliedColorU8, Stroke, Transform,
};

use crate::board::Shape;
use crate::geometry::{Nm, Path, Point};
use crate::grid::Grid;
use crate::raster::Label;

use super::Rgb;
use super::coverage::Coverage;

/// A picture being painted, in board coordinates.
pub struct Canvas {
    grid: Grid,
    pixmap: Pixmap,
}

/// The colours of labels, from the last one down: of what lies in one place the rasterizer shows
/// the least, and a painter what comes last.
#[derive(Default)]
struct Colours(Vec<Rgb>);

impl Colours {
    /// The label of what comes next; the same as the one before it where the colour is.
    fn label(&mut self, colour: Rgb) -> Label {
        if self.0.last() != Some(&colour) {
            self.0.push(colour);
        }
        Label(u32::MAX - u32::try_from(self.0.len()).expect("below 2³² colours"))
    }

    fn of(&self, Label(label): Label) -> Rgb {
        self.0[(u32::MAX - label) as usize - 1]
    }
}

impl Canvas {
    /// A picture of what `grid` covers, all in `ground`.
    #[must_use]
    pub fn new(grid: Grid, ground: Rgb) -> Self {
        let mut pixmap = Pixmap::new(grid.width(), grid.height()).expect("a grid has pixels");
        pixmap.fill(ground.paint(1.0));
        Self { grid, pixmap }
    }

    /// Grey values, one byte a pixel, as a picture.
    #[must_use]
    pub fn grey(grid: Grid, values: &[u8]) -> Self {
        let mut canvas = Self::new(grid, Rgb(0, 0, 0));
        for (pixel, &value) in canvas.pixmap.pixels_mut().iter_mut().zip(values) {
            *pixel = opaque(Rgb(value, value, value));
        }
        canvas
    }

    /// Its width and height in pixels.
    #[expect(clippy::cast_precision_loss, reason = "a picture is less than 2²⁴ pixels wide")]
    pub(super) const fn size(&self) -> (f32, f32) {
        (self.grid.width() as f32, self.grid.height() as f32)
    }

    /// How many of its rows lie above the lower edge of `whole`, of which it is a band.
    #[expect(clippy::cast_precision_loss, reason = "a picture is less than 2²⁴ pixels high")]
    pub(super) fn rows_to(&self, whole: &Grid) -> f32 {
        (whole.height() - self.grid.first_row(whole)) as f32
    }

    /// What it covers.
    #[must_use]
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Sets the pixel at a column and row.
    pub fn set(&mut self, column: u32, row: u32, colour: Rgb) {
        self.set_row(row, column..column + 1, colour);
    }

    /// Sets the pixels of a row in some columns.
    pub fn set_row(&mut self, row: u32, columns: Range<u32>, colour: Rgb) {
        self.row(row, columns).fill(opaque(colour));
    }

    fn row(&mut self, row: u32, columns: Range<u32>) -> &mut [PremultipliedColorU8] {
        let row = &mut self.pixmap.pixels_mut()[row as usize * self.grid.width() as usize..];
        &mut row[columns.start as usize..columns.end as usize]
    }

    /// Fills shapes, each in its colour.
    pub fn fill<'a>(&mut self, shapes: impl IntoIterator<Item = (&'a Shape, Rgb)>) {
        let mut colours = Colours::default();
        let labelled = shapes.into_iter().map(|(shape, colour)| (colours.label(colour), shape));
        let coverage = Coverage::of_shapes(self.grid, labelled);
        self.lay(&coverage, &colours, 1.0);
    }

    /// Lays colours on what is covered.
    fn lay(&mut self, coverage: &Coverage, colours: &Colours, opacity: f32) {
        coverage.each(|(row, columns, label, share)| {
            let colour = colours.of(label);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
            let way = (opacity * f32::from(share)) as u8;
            if way == u8::MAX {
                return self.set_row(row, columns, colour);
            }
            for pixel in self.row(row, columns) {
                let under = Rgb(pixel.red(), pixel.green(), pixel.blue());
                *pixel = opaque(under.towards(colour, way));
            }
        });
    }

    /// Strokes `path` with a round cutter of diameter `width`, never thinner than a pixel.
    pub fn stroke(&mut self, path: &Path, width: Nm, colour: Rgb, opacity: f32) {
        self.strokes(std::iter::once(path), width, colour, opacity);
    }

    /// Strokes all `paths` as one: where they cross, a translucent colour is laid on once.
    pub fn strokes<'a>(
        &mut self,
        paths: impl IntoIterator<Item = &'a Path>,
        width: Nm,
        colour: Rgb,
        opacity: f32,
    ) {
        self.coloured(paths.into_iter().map(|path| (path, colour)), width, opacity);
    }

    /// The same, each path in its colour.
    pub fn coloured<'a>(
        &mut self,
        paths: impl IntoIterator<Item = (&'a Path, Rgb)>,
        width: Nm,
        opacity: f32,
    ) {
        let mut colours = Colours::default();
        let labelled = paths.into_iter().map(|(path, colour)| (colours.label(colour), path));
        let coverage = Coverage::of_lines(self.grid, labelled, width);
        self.lay(&coverage, &colours, opacity);
    }

    /// Strokes polylines given in pixels: lettering and rulers.
    pub(super) fn ink(&mut self, lines: &[Vec<(f32, f32)>], width: f32, colour: Rgb) {
        let mut ink = PathBuilder::new();
        for line in lines {
            for (i, &(x, y)) in line.iter().enumerate() {
                if i == 0 { ink.move_to(x, y) } else { ink.line_to(x, y) }
            }
        }
        let Some(ink) = ink.finish() else { return };
        let paint = self.paint(colour, 1.0);
        self.pixmap.stroke_path(&ink, &paint, &round(width), Transform::identity(), None);
    }

    /// Fills an upright rectangle given in pixels: left, top, width, height.
    pub(super) fn block(&mut self, place: [f32; 4], colour: Rgb, opacity: f32) {
        let [x, y, width, height] = place;
        if let Some(block) = tiny_skia::Rect::from_xywh(x, y, width, height) {
            let paint = self.paint(colour, opacity);
            self.pixmap.fill_rect(block, &paint, Transform::identity(), None);
        }
    }

    /// The finished pixels, three bytes each, row 0 on top.
    #[must_use]
    pub fn into_rgb(self) -> Vec<u8> {
        let pixels = self.pixmap.pixels();
        let mut bytes = vec![[0; 3]; pixels.len()];
        for (bytes, pixel) in bytes.iter_mut().zip(pixels) {
            *bytes = [pixel.red(), pixel.green(), pixel.blue()];
        }
        bytes.into_flattened()
    }

    fn paint(&self, colour: Rgb, opacity: f32) -> Paint<'static> {
        let mut paint = Paint::default();
        paint.set_color(colour.paint(opacity));
        paint
    }

    #[expect(clippy::cast_possible_truncation, reason = "the drawing library takes f32; this is a picture")]
    pub(super) fn place(&self, point: Point) -> (f32, f32) {
        let from = point - self.grid.corner(0, 0);
        let pitch = self.grid.pitch().to_f64();
        ((from.x.to_f64() / pitch) as f32, (-from.y.to_f64() / pitch) as f32)
    }
}

/// A round pen of a width in pixels.
fn round(width: f32) -> Stroke {
    Stroke { width, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() }
}

fn opaque(Rgb(r, g, b): Rgb) -> PremultipliedColorU8 {
    PremultipliedColorU8::from_rgba(r, g, b, u8::MAX).expect("opaque")
}

impl Rgb {
    fn paint(self, opacity: f32) -> Color {
        let Self(r, g, b) = self;
        let mut color = Color::from_rgba8(r, g, b, u8::MAX);
        color.set_alpha(opacity);
        color
    }
}
