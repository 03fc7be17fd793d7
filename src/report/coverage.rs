//! How much of each pixel shapes cover, all of them taken as one.
//!
//! ```text
//!    whole │ part │ none      What the rasterizer draws of shapes and lines is how far a pixel's centre is from them. Up to
//!   ▒▒▒▒▒▒▒│▒▒░░░·│           half a pixel beyond the edge that is how much of it they cover. Seams between shapes that touch are
//!   ▒▒▒▒▒▒▒│▒▒░░░·│           nearer than that from both sides, and where lines cross nothing is laid on twice.
//! ```

use std::ops::Range;

use crate::board::Shape;
use crate::geometry::{Nm, Path, Point, Rect};
use crate::grid::Grid;
use crate::raster::{self, Label, Scene, Tile, TileContent};
use crate::topology;

/// The thinnest line, in pixels: a thinner one would be paler. Chosen.
const THINNEST: f32 = 1.0;

/// Pixels along a side of a tile. Measured: lines are thin, and most of a larger tile is empty.
const TILE: u32 = 32;

/// So many pixels of a row are looked at together. Chosen: as many as a processor does.
const TOGETHER: usize = 8;

/// What covers pixels of a grid.
pub(super) struct Coverage {
    grid: Grid,
    scene: Scene,
    /// How far from what is covered wholly nothing is any more, in pixels.
    ramp: f32,
}

/// Some pixels of a row that one label covers alike, from 1 to 255.
pub(super) type Run = (u32, Range<u32>, Label, u8);

impl Coverage {
    /// Of nothing yet, fading out over so many pixels.
    fn new(grid: Grid, ramp: f32) -> Self {
        Self { grid, scene: Scene::new(grid.width(), grid.height()), ramp }
    }

    /// Of shapes: whole pixels where their centres are within, less beyond the edge. Planes are
    /// often hatched with strokes that just touch, and nothing shines through.
    pub(super) fn of_shapes<'a>(grid: Grid, shapes: impl IntoIterator<Item = (Label, &'a Shape)>) -> Self {
        let mut coverage = Self::new(grid, 0.5);
        for (label, shape) in shapes {
            if coverage.shows(shape.bounds(), Nm::ZERO) {
                coverage.shape(label, shape);
            }
        }
        coverage
    }

    fn shape(&mut self, label: Label, shape: &Shape) {
        self.scene.add(label, topology::surface(shape, &self.grid, Some(self.ramp)));
        let Shape::Polygon(polygon) = shape else { return };
        let near = (self.grid.pitch() / 4).to_f64();
        for ring in polygon.contours() {
            let mut from = ring[0];
            for &to in ring[1..].iter().chain(&ring[..1]) {
                // What fades need not bend with edges shorter than can be seen.
                if to != ring[0] && from.distance(to) < near {
                    continue;
                }
                if self.shows(Rect::new(from, to), Nm::ZERO) {
                    self.line(label, [from, to], 0.0);
                }
                from = to;
            }
        }
    }

    /// Of lines along paths, as wide as the middle of their fading edges says.
    pub(super) fn of_lines<'a>(
        grid: Grid,
        paths: impl IntoIterator<Item = (Label, &'a Path)>,
        width: Nm,
    ) -> Self {
        let mut coverage = Self::new(grid, 1.0);
        let offset = (grid.pixels(width).max(THINNEST) - coverage.ramp) / 2.0;
        // A twentieth of a pixel cannot be seen, and small circles stay round.
        let tolerance = (grid.pitch() / 20).max(Nm::new(1));
        for (label, path) in paths {
            for (from, segment) in path.steps() {
                if !coverage.shows(segment.bounds(from), width) {
                    continue;
                }
                match segment.arc(from) {
                    None => coverage.line(label, [from, segment.to()], offset),
                    Some(arc) => {
                        let mut at = from;
                        for to in arc.flatten(tolerance) {
                            coverage.line(label, [at, to], offset);
                            at = to;
                        }
                    }
                }
            }
        }
        coverage
    }

    fn line(&mut self, label: Label, [from, to]: [Point; 2], offset: f32) {
        let line = Shape::Stroke { from, to, radius: Nm::ZERO };
        self.scene.add(label, topology::grown(&line, &self.grid, offset, Some(self.ramp)));
    }

    /// Whether what lies within a rectangle, grown by `reach`, may cover a pixel.
    fn shows(&self, rect: Rect, reach: Nm) -> bool {
        rect.inflate(reach + self.grid.pitch()).touches(self.grid.rect())
    }

    /// Shows `lay` what is covered, row by row of each tile.
    pub(super) fn each(&self, mut lay: impl FnMut(Run)) {
        // Within a shape the depth is 0 everywhere.
        let levels = vec![f32::MIN_POSITIVE];
        let options = raster::Options { tile: TILE, levels, ..raster::Options::default() };
        raster::stream(
            &self.scene,
            &options,
            |tile| self.runs(&tile),
            |runs| {
                runs.into_iter().for_each(&mut lay);
            },
        );
    }

    fn runs(&self, tile: &Tile<'_>) -> Vec<Run> {
        let all = tile.column0..tile.column0 + tile.width;
        let rows = tile.row0..tile.row0 + tile.height;
        let pixels = match &tile.content {
            TileContent::Uniform(Label::BACKGROUND) => return Vec::new(),
            TileContent::Uniform(label) => {
                return rows.map(|row| (row, all.clone(), *label, u8::MAX)).collect();
            }
            TileContent::Pixels(pixels) => pixels,
        };
        let mut runs: Vec<Run> = Vec::new();
        for (row, number) in rows.zip(0..) {
            let (labels, depths) = (pixels.label_row(number), pixels.depth_row(number));
            let first = runs.len();
            let mut add = |columns: Range<u32>, label: u32, share: u8| match runs[first..].last_mut() {
                Some((_, before, known, same))
                    if before.end == columns.start && known.0 == label && *same == share =>
                {
                    before.end = columns.end;
                }
                _ => runs.push((row, columns, Label(label), share)),
            };
            // Most pixels are beside others that are as they are.
            let (label_lanes, last_labels) = labels.as_chunks::<TOGETHER>();
            let (depth_lanes, last_depths) = depths.as_chunks::<TOGETHER>();
            let mut column = all.start;
            for (labels, depths) in label_lanes.iter().zip(depth_lanes) {
                let end = column + u32::try_from(TOGETHER).expect("few");
                let beyond = depths.iter().fold(true, |all, &depth| all & (depth >= self.ramp));
                if !beyond {
                    let within = depths.iter().fold(true, |all, &depth| all & (depth <= 0.0));
                    if within && labels.iter().fold(true, |all, &label| all & (label == labels[0])) {
                        add(column..end, labels[0], u8::MAX);
                    } else {
                        self.each_of(column, labels, depths, &mut add);
                    }
                }
                column = end;
            }
            self.each_of(column, last_labels, last_depths, &mut add);
        }
        runs
    }

    /// Gives `add` those of some pixels in a row that are covered.
    fn each_of(
        &self,
        column: u32,
        labels: &[u32],
        depths: &[f32],
        add: &mut impl FnMut(Range<u32>, u32, u8),
    ) {
        for (column, (&label, &depth)) in (column..).zip(labels.iter().zip(depths)) {
            let share = self.share(depth);
            if share > 0 {
                add(column..column + 1, label, share);
            }
        }
    }

    /// How much of a pixel at some depth is covered.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    fn share(&self, depth: f32) -> u8 {
        if depth > 0.0 { ((self.ramp - depth).max(0.0) * 255.0) as u8 } else { u8::MAX }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Arc, Polygon, Segment, Turn, Vector, off_segment};
    use crate::topology::random;

    const PITCH: i64 = 10_000;

    fn grid() -> Grid {
        let corner = Point::new(Nm::new(150 * PITCH), Nm::new(90 * PITCH));
        Grid::covering(Rect::new(Point::default(), corner), Nm::new(PITCH)).expect("a small grid")
    }

    /// How much of each pixel is covered, row by row.
    fn shares(coverage: &Coverage) -> Vec<u8> {
        let width = coverage.grid.width() as usize;
        let mut shares = vec![0; width * coverage.grid.height() as usize];
        coverage.each(|(row, columns, _, share)| {
            for column in columns {
                let place = &mut shares[row as usize * width + column as usize];
                assert_eq!(*place, 0, "a pixel is shown once");
                *place = share;
            }
        });
        shares
    }

    /// How far a place is from a shape that is no arc, in pixels; less than zero within.
    fn distance(shape: &Shape, at: Point) -> f64 {
        let to_line = |from: Point, to: Point| {
            let off = off_segment(at.to_f64(), from.to_f64(), to.to_f64());
            (off.0 * off.0 + off.1 * off.1).sqrt()
        };
        let away = match shape {
            Shape::Disc { center, radius } => center.distance(at) - radius.to_f64(),
            Shape::Stroke { from, to, radius } => to_line(*from, *to) - radius.to_f64(),
            Shape::Polygon(polygon) if polygon.contains(at) => -1.0,
            Shape::Polygon(polygon) => polygon.edges().map(|(a, b)| to_line(a, b)).fold(f64::MAX, f64::min),
            Shape::Arc { .. } => unreachable!("none is asked for"),
        };
        away / Nm::new(PITCH).to_f64()
    }

    #[test]
    fn pixels_are_covered_by_how_far_they_are_from_shapes() {
        let mut random = random();
        let mut at = || Point::new(Nm::new(random(160 * PITCH)), Nm::new(random(100 * PITCH)));
        for scene in 0..20 {
            let shapes: Vec<Shape> = (0..8)
                .filter_map(|number| {
                    let (from, to) = (at(), at());
                    let radius = Nm::new((from.x.get() + to.y.get()) % (6 * PITCH) + 1);
                    match number % 3 {
                        0 => Some(Shape::Disc { center: from, radius }),
                        1 => Some(Shape::Stroke { from, to, radius }),
                        _ => Polygon::new(vec![vec![from, to, at()]]).map(Shape::Polygon),
                    }
                })
                .collect();
            let coverage = Coverage::of_shapes(grid(), shapes.iter().map(|shape| (Label(1), shape)));
            let (grid, shares) = (grid(), shares(&coverage));
            for (number, &share) in shares.iter().enumerate() {
                let (row, column) = (number / grid.width() as usize, number % grid.width() as usize);
                let [column, row] = [column, row].map(|at| i64::try_from(at).expect("few"));
                let center = grid.center(column, row);
                let nearest = shapes.iter().map(|shape| distance(shape, center)).fold(f64::MAX, f64::min);
                let most = if nearest < 0.01 { 255.0 } else { (0.5 - nearest + 0.01).max(0.0) * 255.0 };
                let least =
                    if nearest < -0.01 { 255.0 } else { (0.5 - nearest - 0.02).max(0.0) * 255.0 - 1.0 };
                let share = f64::from(share);
                assert!((least..=most).contains(&share), "scene {scene}: {share} at {nearest} pixels");
            }
        }
    }

    #[test]
    fn nothing_shines_through_between_shapes_that_touch() {
        let stroke = |row: i64| {
            let y = Nm::new(row * 3 * PITCH + PITCH / 2);
            let [from, to] = [20, 130].map(|column| Point::new(Nm::new(column * PITCH), y));
            Shape::Stroke { from, to, radius: Nm::new(3 * PITCH / 2) }
        };
        let shapes: Vec<Shape> = (5..20).map(stroke).collect();
        let shares = shares(&Coverage::of_shapes(grid(), shapes.iter().map(|shape| (Label(1), shape))));
        let width = grid().width() as usize;
        let within =
            |row: usize| shares[row * width + 30..row * width + 120].iter().all(|&share| share == 255);
        assert!((40..70).all(within), "all of it is covered");
    }

    /// The rasterizer has arcs by their ends, rounded: an arc of some nanometres became a circle,
    /// and a circle but for some nanometres nothing.
    #[test]
    fn arcs_that_hardly_go_round_are_no_circles() {
        let mut random = random();
        for _ in 0..60 {
            let center = Point::new(Nm::new(75 * PITCH + random(PITCH)), Nm::new(45 * PITCH + random(PITCH)));
            let place = |angle: f64| {
                let (up, right) = libm::sincos(angle);
                let reach = Nm::new(30 * PITCH).to_f64();
                center + Vector::new(Nm::from_f64(right * reach), Nm::from_f64(up * reach))
            };
            let angle = Nm::new(random(1_000_000)).to_f64() * 1e-5;
            let [start, next] = [0, 5 + random(300)].map(|off| place(angle + Nm::new(off).to_f64() / 3e5));
            let covered = |from: Point, to: Point| {
                let arc = Arc { start: from, end: to, center, turn: Turn::CounterClockwise };
                let shape = Shape::Arc { arc, radius: Nm::new(2 * PITCH) };
                let shares = shares(&Coverage::of_shapes(grid(), [(Label(1), &shape)]));
                shares.iter().filter(|&&share| share == 255).count()
            };
            let disc = covered(start, next);
            assert!((8..20).contains(&disc), "{disc} pixels of a disc");
            let ring = covered(next, start);
            assert!((700..800).contains(&ring), "{ring} pixels of a ring");
        }
    }

    #[test]
    fn lines_are_as_wide_as_they_should_be() {
        let start = Point::new(Nm::new(20 * PITCH), Nm::new(45 * PITCH));
        let to = start + Vector::new(Nm::new(100 * PITCH), Nm::new(3 * PITCH));
        let path = Path { start, segments: vec![Segment::Line { to }] };
        for (width, expected) in [(0.0, 1.0), (0.4, 1.0), (2.3, 2.3), (7.0, 7.0)] {
            let width = Nm::from_f64(width * Nm::new(PITCH).to_f64());
            let shares = shares(&Coverage::of_lines(grid(), [(Label(1), &path)], width));
            let columns = grid().width() as usize;
            // What columns in the middle of the line have of it.
            let sum: f64 = (40..100)
                .flat_map(|column| shares.iter().skip(column).step_by(columns))
                .map(|&share| f64::from(share) / 255.0)
                .sum();
            let slant = (1.0_f64 + 0.03 * 0.03).sqrt();
            assert!((sum / 60.0 - expected * slant).abs() < 0.02, "{width:?}: {} pixels", sum / 60.0);
        }
    }
}
