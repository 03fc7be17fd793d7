//! Board geometry on tiny-skia's pixmaps: the only file that speaks to the drawing library.

use std::ops::Range;

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path as Outline, PathBuilder, Pixmap, PremultipliedColorU8,
    Stroke, Transform,
};

use crate::board::Shape;
use crate::geometry::{Arc, Nm, Path, Point, Polygon, Rect, Segment};
use crate::grid::Grid;

use super::Rgb;

/// The thinnest line, in pixels. Measured: at one pixel and less the painter draws hairlines, with
/// specks where they end and at the picture's rim.
const THINNEST: f32 = 1.01;

/// A picture being painted, in board coordinates.
pub struct Canvas {
    grid: Grid,
    pixmap: Pixmap,
    /// Whether edges are smoothed.
    smooth: bool,
}

impl Canvas {
    /// A picture of what `grid` covers, all in `ground`.
    #[must_use]
    pub fn new(grid: Grid, ground: Rgb) -> Self {
        let mut pixmap = Pixmap::new(grid.width(), grid.height()).expect("a grid has pixels");
        pixmap.fill(ground.paint(1.0));
        Self { grid, pixmap, smooth: true }
    }

    /// Grey values, one byte a pixel, as a picture.
    #[must_use]
    pub fn grey(grid: Grid, values: &[u8]) -> Self {
        let mut canvas = Self::new(grid, Rgb(0, 0, 0));
        for (pixel, &value) in canvas.pixmap.pixels_mut().iter_mut().zip(values) {
            *pixel = PremultipliedColorU8::from_rgba(value, value, value, u8::MAX).expect("opaque");
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
    pub fn set_row(&mut self, row: u32, columns: Range<u32>, Rgb(r, g, b): Rgb) {
        let colour = PremultipliedColorU8::from_rgba(r, g, b, u8::MAX).expect("opaque");
        let row = &mut self.pixmap.pixels_mut()[row as usize * self.grid.width() as usize..];
        row[columns.start as usize..columns.end as usize].fill(colour);
    }

    /// Fills `shape`: all pixels whose centres it holds, and then smoothly up to its edge.
    ///
    /// Planes are often hatched with strokes that just touch. Smooth edges alone would let the
    /// ground shine through where two of them share a pixel; the whole pixels close those seams.
    pub fn fill(&mut self, shape: &Shape, colour: Rgb) {
        if !self.shows(shape.bounds()) {
            return;
        }
        let Some(area) = self.area(shape) else { return };
        for smooth in [false, true] {
            self.smooth = smooth;
            self.fill_path(&area, colour, 1.0);
        }
    }

    /// Whether a pixel of it may lie within `rect`.
    fn shows(&self, rect: Rect) -> bool {
        rect.inflate(self.grid.pitch()).touches(self.grid.rect())
    }

    /// The outline of a shape.
    fn area(&self, shape: &Shape) -> Option<Outline> {
        match shape {
            Shape::Disc { center, radius } => self.circle(*center, *radius),
            Shape::Stroke { from, to, radius } => {
                let line = Path { start: *from, segments: vec![Segment::Line { to: *to }] };
                self.stroked(std::iter::once(&line), *radius * 2)
            }
            Shape::Arc { arc, radius } => self.stroked(std::iter::once(&path_of(arc)), *radius * 2),
            Shape::Polygon(polygon) => self.rings(polygon),
        }
    }

    /// Fills a disc.
    pub fn disc(&mut self, center: Point, radius: Nm, colour: Rgb, opacity: f32) {
        if let Some(circle) = self.circle(center, radius) {
            self.fill_path(&circle, colour, opacity);
        }
    }

    fn circle(&self, center: Point, radius: Nm) -> Option<Outline> {
        let (x, y) = self.place(center);
        let mut outline = PathBuilder::new();
        outline.push_circle(x, y, self.pixels(radius));
        outline.finish()
    }

    /// Fills a polygon by the non-zero rule.
    pub fn polygon(&mut self, polygon: &Polygon, colour: Rgb, opacity: f32) {
        if let Some(rings) = self.rings(polygon) {
            self.fill_path(&rings, colour, opacity);
        }
    }

    /// The rings of a polygon that the picture shows.
    fn rings(&self, polygon: &Polygon) -> Option<Outline> {
        let mut outline = PathBuilder::new();
        let bounds = |ring: &[Point]| Rect::around(ring.iter().copied());
        let shown = |ring: &&Vec<Point>| bounds(ring).is_some_and(|bounds| self.shows(bounds));
        for ring in polygon.contours().iter().filter(shown) {
            for (i, &point) in ring.iter().enumerate() {
                let (x, y) = self.place(point);
                if i == 0 { outline.move_to(x, y) } else { outline.line_to(x, y) }
            }
            outline.close();
        }
        outline.finish()
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
        if let Some(outline) = self.stroked(paths, width) {
            self.fill_path(&outline, colour, opacity);
        }
    }

    /// The outline of strokes along paths.
    fn stroked<'a>(&self, paths: impl IntoIterator<Item = &'a Path>, width: Nm) -> Option<Outline> {
        let mut line = PathBuilder::new();
        for path in paths {
            self.trace(path, width / 2, &mut line);
        }
        line.finish()?.stroke(&round(self.pixels(width).max(THINNEST)), 1.0)
    }

    /// Adds those parts of a path to a line that come within `reach` of the picture.
    fn trace(&self, path: &Path, reach: Nm, line: &mut PathBuilder) {
        // A twentieth of a pixel cannot be seen, and small circles stay round.
        let tolerance = (self.grid.pitch() / 20).max(Nm::new(1));
        let (mut is_down, mut is_whole) = (false, true);
        for (from, segment) in path.steps() {
            if !self.shows(segment.bounds(from).inflate(reach)) {
                (is_down, is_whole) = (false, false);
                continue;
            }
            if !is_down {
                let (x, y) = self.place(from);
                line.move_to(x, y);
                is_down = true;
            }
            let mut add = |point: Point| {
                let (x, y) = self.place(point);
                line.line_to(x, y);
            };
            match segment.arc(from) {
                Some(arc) => arc.flatten(tolerance).for_each(add),
                None => add(segment.to()),
            }
        }
        if is_whole && path.is_closed() {
            line.close();
        }
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
        paint.anti_alias = self.smooth;
        paint
    }

    fn fill_path(&mut self, outline: &Outline, colour: Rgb, opacity: f32) {
        let paint = self.paint(colour, opacity);
        self.pixmap.fill_path(outline, &paint, FillRule::Winding, Transform::identity(), None);
    }

    #[expect(clippy::cast_possible_truncation, reason = "the drawing library takes f32; this is a picture")]
    pub(super) fn place(&self, point: Point) -> (f32, f32) {
        let from = point - self.grid.corner(0, 0);
        let pitch = self.grid.pitch().to_f64();
        ((from.x.to_f64() / pitch) as f32, (-from.y.to_f64() / pitch) as f32)
    }

    fn pixels(&self, length: Nm) -> f32 {
        self.grid.pixels(length)
    }
}

/// A round pen of a width in pixels.
fn round(width: f32) -> Stroke {
    Stroke { width, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() }
}

fn path_of(arc: &Arc) -> Path {
    let segment = Segment::Arc { to: arc.end, center: arc.center, turn: arc.turn };
    Path { start: arc.start, segments: vec![segment] }
}

impl Rgb {
    fn paint(self, opacity: f32) -> Color {
        let Self(r, g, b) = self;
        let mut color = Color::from_rgba8(r, g, b, u8::MAX);
        color.set_alpha(opacity);
        color
    }
}
