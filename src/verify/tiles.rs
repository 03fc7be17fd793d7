//! The copies of a board in a tiled program, for the judge.

use crate::board::{Board, Copper, Feature, Hole, Outline};
use crate::geometry::{Nm, Rect, Vector};

use super::placement::turned;

/// The same board several times in one piece of stock, as programs for several tiles cut it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiles {
    /// How many side by side.
    pub columns: u32,
    /// How many one above the other.
    pub rows: u32,
    /// How far they are apart, as they lie on the machine.
    pub spacing: Nm,
}

impl Tiles {
    /// How far each tile is from the first, which is the first of them.
    pub(super) fn ways(self, board: &Board, degrees: f64) -> Vec<Vector> {
        let Some(bounds) = board.bounds() else { return vec![Vector::default()] };
        let corners = bounds.corners().map(|corner| turned(corner, degrees));
        let tile = Rect::around(corners).unwrap_or(bounds);
        let (width, height) = (tile.width() + self.spacing, tile.height() + self.spacing);
        (0..i64::from(self.columns))
            .flat_map(|column| (0..i64::from(self.rows)).map(move |row| (column, row)))
            .map(|(column, row)| turned_way(Vector::new(width * column, height * row), -degrees))
            .collect()
    }

    /// All tiles of `board`, which lies on the machine turned by so many degrees, as one board: the
    /// first where it was.
    pub(super) fn lay(self, board: &Board, degrees: f64) -> Board {
        let ways = self.ways(board, degrees);
        let copper = |copper: &Copper| Copper {
            features: ways
                .iter()
                .flat_map(|&way| copper.features.iter().map(move |f| moved(f, way)))
                .collect(),
            ..copper.clone()
        };
        let contours = board.outline.iter().flat_map(Outline::contours);
        let contours = ways.iter().flat_map(|&way| contours.clone().map(move |path| path.translated(way)));
        let hole = |hole: &Hole, way: Vector| Hole { path: hole.path.translated(way), ..hole.clone() };
        Board {
            name: board.name.clone(),
            front: board.front.as_ref().map(copper),
            back: board.back.as_ref().map(copper),
            outline: Outline::new(contours.collect()),
            holes: ways.iter().flat_map(|&way| board.holes.iter().map(move |h| hole(h, way))).collect(),
            thickness: board.thickness,
            whole: None,
        }
    }
}

fn moved(feature: &Feature, way: Vector) -> Feature {
    Feature { shape: feature.shape.translated(way), ..feature.clone() }
}

fn turned_way(way: Vector, degrees: f64) -> Vector {
    let zero = crate::geometry::Point::default();
    turned(zero + way, degrees) - zero
}
