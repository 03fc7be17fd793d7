//! How a board lies in its stock: placed, tiled, mirrored.
//!
//! ```text
//!        ○ ← alignment hole, on the axis about which the stock is flipped
//!   ┌────┼────┐ spacing ┌─────────┐
//!   │    ┊    │ ←─────→ │         │      3 × 1 tiles: the axis is the middle of all of them
//!   └────┼────┘         └─────────┘
//! ```

use crate::board::{Board, Hole, Plating, Side, Warning};
use crate::geometry::{Nm, Path, Point, Rect, Vector};
use crate::toolpath::strategy::{Drilling, drill};
use crate::toolpath::{Heights, Origin, Placement, Program, Tiling, alignment_holes};

use super::{Settings, Tiles};

/// A board in its stock.
pub(super) struct Stock {
    /// How the first tile lies, seen from the front.
    pub(super) front: Placement,
    /// The line about which the stock is flipped.
    pub(super) axis: Nm,
    /// The first tile, seen from the front.
    pub(super) tile: Rect,
    /// All tiles, seen from the front.
    pub(super) bounds: Rect,
    tiling: Option<Tiling>,
}

impl Stock {
    /// A board within `bounds`.
    pub(super) fn new(bounds: Rect, settings: &Settings) -> Self {
        let front = Placement::front(settings.origin, bounds, settings.asked.rotate, settings.offset);
        let tile = Rect::around(bounds.corners().map(|corner| front.point(corner))).unwrap_or(bounds);
        let tiling = settings.tiles.map(|(Tiles { columns, rows }, spacing)| Tiling {
            columns,
            rows,
            pitch: Vector::new(tile.width() + spacing, tile.height() + spacing),
        });
        let bounds = over_all_tiles(tile, tiling);
        // To the micrometre, so that the header says it exactly.
        let middle = bounds.min().midpoint(bounds.max()).x;
        let middle = Nm::from_um((middle.get() + 500).div_euclid(1000));
        Self { front, axis: settings.mirror_axis.unwrap_or(middle), tile, bounds, tiling }
    }

    /// How the first tile lies when `side` is up.
    pub(super) const fn placement(&self, side: Side) -> Placement {
        match side {
            Side::Front => self.front,
            Side::Back => self.front.turned_over(self.axis),
        }
    }

    /// All tiles when `side` is up.
    pub(super) fn area(&self, side: Side) -> Rect {
        self.turned(side, self.bounds)
    }

    /// What lies in `rect` with `side` up, seen from the front; or with that side up what lies so
    /// seen from the front.
    pub(super) fn turned(&self, side: Side, rect: Rect) -> Rect {
        let over = |p: Point| Point::new(self.axis * 2 - p.x, p.y);
        match side {
            Side::Front => rect,
            Side::Back => Rect::new(over(rect.min()), over(rect.max())),
        }
    }

    /// What holds `rect` of every tile, that of the first being given.
    pub(super) fn over_all_tiles(&self, rect: Rect) -> Rect {
        over_all_tiles(rect, self.tiling)
    }

    /// The tiles when `side` is up: seen from behind they follow each other to the left.
    pub(super) fn tiling(&self, side: Side) -> Option<Tiling> {
        self.tiling.map(|tiling| match side {
            Side::Front => tiling,
            Side::Back => Tiling { pitch: Vector::new(-tiling.pitch.x, tiling.pitch.y), ..tiling },
        })
    }

    /// The program for the holes on whose pins the stock is flipped; none where none are asked
    /// for, or nothing is turned.
    pub(super) fn alignment(&self, board: &Board, settings: &Settings) -> Option<(Program, Vec<Warning>)> {
        let (diameter, margin) = settings.alignment.filter(|_| is_flipped(board, settings))?;
        let holes = alignment_holes(self.bounds, self.axis, margin).map(|start| Hole {
            path: Path { start, segments: Vec::new() },
            diameter,
            plating: Plating::NonPlated,
            tool: 1,
            line: 1,
        });
        let placement = Placement::default();
        let drilling = Drilling {
            mill: Some(&settings.drill_bore_tool),
            bored_from: None,
            heights: Heights { cut: settings.alignment_depth, ..settings.drilling },
            tips: true,
            one: false,
            dwell: 0,
            ..settings.drilling_at(&placement)
        };
        let (sections, warnings) = drill(&holes, &drilling);
        let note =
            format!("pins in these holes hold the stock when it is flipped about x = {:.3} mm", self.axis);
        let below = settings.alignment_depth - settings.thickness;
        let depth = format!("the holes go {below:.1} mm into what lies below the board");
        let program = Program {
            title: format!("{} alignment", board.name),
            notes: vec![zero(settings, "copper"), note, depth],
            safe: settings.drilling.safe,
            sections,
        };
        Some((program, warnings))
    }
}

/// What holds `rect` of every tile, that of the first being given.
fn over_all_tiles(rect: Rect, tiling: Option<Tiling>) -> Rect {
    let Some(Tiling { columns, rows, pitch }) = tiling else { return rect };
    let last = Vector::new(pitch.x * i64::from(columns - 1), pitch.y * i64::from(rows - 1));
    rect.union(Rect::new(rect.min() + last, rect.max() + last))
}

/// Where zero is, for whoever sets it.
pub(super) fn zero(settings: &Settings, top_of: &str) -> String {
    let place = match settings.origin {
        Origin::LowerLeft => "the lower left corner of the board",
        Origin::Keep => "where the files have it",
        Origin::Center if settings.tiles.is_some() => "the middle of the lower left board",
        Origin::Center => "the middle of the board",
    };
    let (x, y) = (settings.offset.x, settings.offset.y);
    let moved = if (x, y) == (Nm::ZERO, Nm::ZERO) {
        String::new()
    } else {
        format!(", less {x:.3} mm and {y:.3} mm")
    };
    format!("zero: x y {place}{moved}, z the top of the {top_of}")
}

/// Whether anything of a board is milled with its back up.
pub(super) fn is_flipped(board: &Board, settings: &Settings) -> bool {
    let drills_back = !board.holes.is_empty() && settings.drill_side == Side::Back;
    let cuts_back = board.outline.is_some() && settings.cutout_side == Side::Back;
    board.back.is_some() || drills_back || cuts_back
}
