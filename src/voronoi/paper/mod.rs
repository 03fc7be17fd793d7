//! The paper's own way, for its own numbers (§III-B to IV, Table V).
//!
//! voromill cuts along exact boundaries; the paper cut along the staircase of a picture, made
//! simpler. To hold the one against the other on a board, this module does what the authors'
//! program did, as its published logs and behaviour show it:
//!
//! ```text
//!  outline: flat copper, one label a net ─────────────────╮
//!  Voronoi: the same above the meshes of the core axes, ──┼─▶ picture, 500 DPI ─▶ paths ─▶ fewest segments
//!           below a frame round the copper                │   (a pixel beyond the copper all round)
//!  widths:  each without the frame: pixels of a net ÷ the length of its strokes
//! ```
//!
//! Circles have 16 corners, cones and fans 16 sides, so regions lie off the true ones by up to 1.9
//! % of the distance. What cannot be had again are the random depths and colours that decided where
//! two nets tie; the logs of two runs of the same program differ by 0.3 % for that reason. Figures
//! agree with the logs to a few parts in a thousand; `docs/table-v.md` has them side by side.

mod mesh;
mod paths;
mod simplify;

use crate::board::{Axis, Copper};
use crate::geometry::{Nm, Point, Rect, Vector};
use crate::grid::{Grid, GridError};
use crate::raster::{self, Buffers, Scene, Surface};
use crate::topology::{NetId, Nets};

use mesh::Mesh;
use paths::Labels;

/// The side of a pixel: 500 dots an inch.
pub const PITCH: Nm = Nm::new(50_800);

/// The triangles that the paper draws for the core axes of a net, as far as `reach`: roofs along
/// strokes, fans where they turn or end, cones round lone flashes (§III-D). Depths are distances in
/// pixels of `grid`.
#[must_use]
pub fn slopes(copper: &Copper, nets: &Nets, net: NetId, grid: Grid, reach: Nm) -> Vec<Surface> {
    Mesh::new(copper, nets, grid).slopes(net, reach)
}

/// Toolpaths of one kind over the whole board.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Toolpaths {
    /// How many paths there are.
    pub paths: usize,
    /// The length of the staircase between pixels, in nanometres.
    pub raw: f64,
    /// The length of the same with as few straight segments as stay within half a pixel, in
    /// nanometres.
    pub simplified: f64,
    /// How many segments those are.
    pub segments: usize,
}

/// Which of its toolpaths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Round every net.
    Outline,
    /// Between Voronoi regions, and once round the frame.
    Voronoi,
}

/// A layer, to be drawn and measured as the paper did.
///
/// Pictures are held whole while they are measured: 8 bytes a pixel of 50.8 µm.
pub struct Paper<'a> {
    mesh: Mesh<'a>,
    board: Rect,
}

impl<'a> Paper<'a> {
    /// The layer with these traces; none where there is no copper.
    ///
    /// # Errors
    ///
    /// [`GridError`] for a layer beyond the raster's size.
    pub fn new(copper: &'a Copper, nets: &'a Nets) -> Result<Option<Self>, GridError> {
        let Some(board) = copper.bounds() else { return Ok(None) };
        let grid = Grid::covering(picture(board), PITCH)?;
        Ok(Some(Self { mesh: Mesh::new(copper, nets, grid), board }))
    }

    /// The box round the copper: what the paper calls the board.
    #[must_use]
    pub const fn board(&self) -> Rect {
        self.board
    }

    /// The lap round the frame that [`Paper::voronoi`] contains, in nanometres.
    #[must_use]
    pub fn lap(&self) -> f64 {
        2.0 * (self.board.width() + self.board.height()).to_f64()
    }

    /// The paths round every net (Algorithm 3).
    #[must_use]
    pub fn outline(&self) -> Toolpaths {
        toolpaths(&self.draw(&self.scene(Way::Outline)))
    }

    /// The paths between Voronoi regions and once round the frame, as the paper counts them.
    #[must_use]
    pub fn voronoi(&self) -> Toolpaths {
        toolpaths(&self.draw(&self.scene(Way::Voronoi)))
    }

    /// The pixels of the picture whose borders are cut, row by row: 0 for nobody, 1 for the frame,
    /// from 2 on the nets by number.
    #[must_use]
    pub fn labels(&self, way: Way) -> (Grid, Vec<u32>) {
        (self.mesh.grid, self.draw(&self.scene(way)).labels)
    }

    /// The simplified paths of [`Paper::outline`] or [`Paper::voronoi`] on the board, in the order
    /// in which they are found.
    #[must_use]
    pub fn paths(&self, way: Way) -> Vec<Vec<Point>> {
        let grid = &self.mesh.grid;
        let place = |(column, row): (i32, i32)| grid.corner(i64::from(column), i64::from(row));
        let on_board = |path: &Vec<(i32, i32)>| simplify::simplify(path).into_iter().map(place).collect();
        paths::paths(&self.draw(&self.scene(way))).iter().map(on_board).collect()
    }

    fn scene(&self, way: Way) -> Scene {
        match way {
            Way::Outline => self.mesh.outline(),
            Way::Voronoi => self.mesh.voronoi(Some(self.board)),
        }
    }

    /// The area of each net's copper in square nanometres, by net: its pixels.
    #[must_use]
    pub fn copper_areas(&self) -> Vec<f64> {
        self.areas(&self.mesh.outline())
    }

    /// The area of each net's Voronoi region in square nanometres, by net: its pixels, to the edge
    /// of the picture.
    #[must_use]
    pub fn region_areas(&self) -> Vec<f64> {
        self.areas(&self.mesh.voronoi(None))
    }

    /// The length of each net's strokes in nanometres, by net; zero where it has none. What clear
    /// polarity cut into pieces counts once.
    #[must_use]
    pub fn stroke_lengths(&self) -> Vec<f64> {
        let Mesh { copper, nets, .. } = &self.mesh;
        let mut lengths = vec![0.0; nets.nets().len()];
        let mut last = None;
        for (index, feature) in copper.features.iter().enumerate() {
            let drawn = Some((feature.axis, feature.line));
            if drawn != last {
                lengths[nets.of(index).index()] += match feature.axis {
                    Axis::Line(from, to) => from.distance(to),
                    Axis::Arc(arc) => arc.length(),
                    Axis::Flash(_) | Axis::Region => 0.0,
                };
            }
            last = drawn;
        }
        lengths
    }

    fn draw(&self, scene: &Scene) -> Labels {
        let mut buffers = Buffers::new();
        raster::render(scene, &mut buffers);
        Labels { labels: buffers.labels().to_vec(), width: scene.width(), height: scene.height() }
    }

    fn areas(&self, scene: &Scene) -> Vec<f64> {
        let pixel = PITCH.to_f64() * PITCH.to_f64();
        let mut areas = vec![0.0; self.mesh.nets.nets().len()];
        for label in self.draw(scene).labels {
            if let Some(net) = label.checked_sub(mesh::FIRST) {
                areas[net as usize] += pixel;
            }
        }
        areas
    }
}

/// What the picture shows: whole pixels, one more all round than the copper needs. The copper lies
/// in the middle of its columns and just below its first row: then both upright sides of the frame
/// that dataset 1 has for a stroke, half a pixel wide, are seen, and neither of the level ones, as
/// in the log.
fn picture(board: Rect) -> Rect {
    let beyond = |extent: Nm| {
        let pixels = extent.get().div_euclid(PITCH.get()) + i64::from(extent.get() % PITCH.get() != 0) + 2;
        PITCH * pixels - extent
    };
    let (x, y) = (beyond(board.width()), beyond(board.height()));
    let max = board.max() + Vector::new(x / 2, PITCH);
    Rect::new(max - Vector::new(board.width() + x, board.height() + y), max)
}

/// The mean over nets of area by stroke length, both by net, where both are more than zero (the
/// paper's footnote 12).
#[must_use]
pub fn mean_width(areas: &[f64], stroke_lengths: &[f64]) -> f64 {
    let (sum, count) = areas
        .iter()
        .zip(stroke_lengths)
        .filter(|(area, length)| **area > 0.0 && **length > 0.0)
        .fold((0.0, 0.0), |(sum, count), (area, length)| (sum + area / length, count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

fn toolpaths(labels: &Labels) -> Toolpaths {
    let pitch = PITCH.to_f64();
    paths::paths(labels).iter().fold(Toolpaths::default(), |sum, path| {
        let simple = simplify::simplify(path);
        let length = |pair: &[(i32, i32)]| {
            let (x, y) = (f64::from(pair[1].0 - pair[0].0), f64::from(pair[1].1 - pair[0].1));
            (x * x + y * y).sqrt() * pitch
        };
        let total = |points: &[(i32, i32)]| points.windows(2).map(length).sum::<f64>();
        Toolpaths {
            paths: sum.paths + 1,
            raw: sum.raw + total(path),
            simplified: sum.simplified + total(&simple),
            segments: sum.segments + simple.len() - 1,
        }
    })
}
