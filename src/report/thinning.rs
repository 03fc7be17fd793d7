//! The bare board thinned to lines: what a cellular automaton makes of a side, beside the diagram.
//!
//! Cisolate isolates boards so. It shares nothing with the diagram but the pixels: where both are
//! right, lines run between the same pieces of copper. Drill dots are what anchors pads: a bare dot
//! in a pad is left as a single pixel.

use crate::board::{Axis, Copper, Feature, Hole};
use crate::geometry::Nm;
use crate::grid::Grid;
use crate::raster::{Bits, Faces, Node, Thinned, thin};

use super::palette::Rgb;
use super::{Canvas, picture};

/// Where three lines meet, and where four do: Cisolate's colours.
const NODES: [(Node, Rgb); 2] = [(Node::Three, Rgb(0x30, 0x60, 0xff)), (Node::Four, Rgb(0xff, 0x20, 0xff))];

/// What the cutter takes away that makes a hole.
fn drilled(hole: &Hole) -> Vec<Feature> {
    let feature =
        |shape| Feature { shape, axis: Axis::Flash(hole.path.start), attributes: 0, line: hole.line };
    hole.shapes(Nm::ZERO).into_iter().map(feature).collect()
}

/// A side, thinned.
#[derive(Clone, Debug)]
pub struct Thinning {
    thinned: Thinned,
    grid: Grid,
}

/// What a thinned side consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Passes until nothing changed.
    pub generations: u32,
    /// Single pixels: drill dots.
    pub points: usize,
    /// Where three lines meet.
    pub three_way: usize,
    /// Where four lines meet.
    pub four_way: usize,
    /// Ways from one such place to the next, and closed lines.
    pub routes: usize,
}

impl Thinning {
    /// Thins what is bare of the pixels of `grid`, holes included.
    #[must_use]
    pub fn of_side(copper: &Copper, holes: &[Hole], grid: Grid) -> Self {
        let features = holes.iter().flat_map(drilled).collect();
        let drilled = Copper { features, ..copper.clone() };
        let (copper, drilled) = (picture::copper(copper, &grid), picture::copper(&drilled, &grid));
        Self::of_pixels(grid, |at| copper[at] == 0 || drilled[at] != 0)
    }

    /// Thins the pixels of `grid` that `is_bare`, numbered row by row from the top.
    #[must_use]
    pub fn of_pixels(grid: Grid, is_bare: impl Fn(usize) -> bool + Sync) -> Self {
        let (width, height) = (grid.width() as usize, grid.height() as usize);
        let set = Bits::new(width, height, |column, row| is_bare(row * width + column));
        Self { thinned: thin(&set), grid }
    }

    /// What was found.
    #[must_use]
    pub fn counts(&self) -> Counts {
        let left = &self.thinned.left;
        let count = |kind| left.pixels().filter(|&(x, y)| Node::of(left.around(x, y)) == kind).count();
        Counts {
            generations: self.thinned.generations,
            points: count(Node::Point),
            three_way: count(Node::Three),
            four_way: count(Node::Four),
            routes: left.routes(),
        }
    }

    /// The faces between its lines, each with its copper.
    #[must_use]
    pub fn faces(&self) -> Faces {
        Faces::new(&self.thinned.left)
    }

    /// The pixels that are thinned.
    #[must_use]
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Whether a pixel, numbered row by row from the top, is copper and no hole in it.
    #[must_use]
    pub fn is_copper(&self, pixel: usize) -> bool {
        self.thinned.ages[pixel] == 0
    }

    /// How long each pixel took to go, black to white; lines white, the places where they meet blue
    /// and magenta.
    #[must_use]
    pub fn canvas(&self) -> Canvas {
        let grey: Vec<u8> = self.thinned.ages.iter().map(|&age| self.grey(age)).collect();
        let mut canvas = Canvas::grey(self.grid, &grey);
        let (width, height) = (self.grid.width(), self.grid.height());
        let left = &self.thinned.left;
        for (x, y) in left.pixels() {
            let kind = Node::of(left.around(x, y));
            let Some(&(_, colour)) = NODES.iter().find(|known| known.0 == kind) else { continue };
            let [x, y] = [x, y].map(|at| u32::try_from(at).unwrap_or(u32::MAX));
            for row in y.saturating_sub(1)..(y + 2).min(height) {
                canvas.set_row(row, x.saturating_sub(1)..(x + 2).min(width), colour);
            }
        }
        canvas
    }

    /// By the square root, so that narrow gaps show beside wide ones.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    fn grey(&self, age: u16) -> u8 {
        let share = f64::from(age) / f64::from(self.thinned.generations.max(1));
        (share.sqrt() * 255.0).min(255.0) as u8
    }
}

impl std::fmt::Display for Counts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { generations, points, three_way, four_way, routes } = self;
        write!(f, "{generations} generations, {points} drill dots, {three_way} three-way and {four_way} ")?;
        write!(f, "four-way junctions, {routes} routes")
    }
}
