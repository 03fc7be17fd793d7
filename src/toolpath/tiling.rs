//! The same board several times in one piece of stock, and the pins that register it.

use crate::board::Warning;
use crate::board::diagnostic::planning;
use crate::geometry::{Nm, Point, Rect, Vector};

use super::machine::Machine;
use super::program::{Move, Position, Program, Section};
use super::tool::Tool;

/// The same board several times in one piece of stock, column by column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiling {
    /// How many side by side.
    pub columns: u32,
    /// How many one above the other.
    pub rows: u32,
    /// From one to the next, in x and in y: the board's size and the room for the cutter.
    pub pitch: Vector,
}

impl Tiling {
    /// Where each tile lies, in the order in which they are worked: up one column and down the
    /// next, so that the way between is short.
    fn shifts(self) -> impl Iterator<Item = Vector> {
        (0..self.columns).flat_map(move |column| {
            (0..self.rows).map(move |row| {
                let row = if column % 2 == 0 { row } else { self.rows - 1 - row };
                Vector::new(self.pitch.x * i64::from(column), self.pitch.y * i64::from(row))
            })
        })
    }
}

impl Program {
    /// The program with every section done on every tile before the next tool is fitted.
    #[must_use]
    pub fn tiled(mut self, tiling: Tiling) -> Self {
        for section in &mut self.sections {
            let moves = std::mem::take(&mut section.moves);
            let tile = |shift: Vector| moves.iter().map(move |step| shifted(step, shift)).collect::<Vec<_>>();
            section.moves = tiling.shifts().flat_map(tile).collect();
        }
        self
    }

    /// What `look` finds in the program with the tool going up to a height, or the safe height if
    /// that is higher, and over a place if there is one: to `change` wherever another tool is
    /// fitted, to `end` in the end. Afterwards the program is as before: a copy would take as much
    /// memory.
    pub fn while_parking<T>(
        &mut self,
        change: (Option<Point>, Nm),
        end: (Option<Point>, Nm),
        look: impl FnOnce(&Self) -> T,
    ) -> T {
        let lengths: Vec<usize> = self.sections.iter().map(|section| section.moves.len()).collect();
        self.park(change, end);
        let found = look(self);
        for (section, length) in self.sections.iter_mut().zip(lengths) {
            section.moves.truncate(length);
        }
        found
    }

    fn park(&mut self, change: (Option<Point>, Nm), end: (Option<Point>, Nm)) {
        let tools: Vec<Tool> = self.sections.iter().map(|section| section.tool.clone()).collect();
        for (index, section) in self.sections.iter_mut().enumerate() {
            let (place, z) = match tools.get(index + 1) {
                None => end,
                Some(next) if *next != tools[index] => change,
                Some(_) => continue,
            };
            let z = z.max(self.safe);
            if let Some(last) = section.moves.iter().rev().find_map(Move::to) {
                section.moves.reserve_exact(2);
                section.moves.push(Move::Rapid { to: Position { z, ..last } });
                section.moves.extend(place.map(|place| Move::Rapid { to: Position::over(place, z) }));
            }
        }
    }

    /// The rectangle that holds the ends of all moves; none for a program without any.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        let moves = self.sections.iter().flat_map(|section: &Section| &section.moves);
        Rect::around(moves.filter_map(Move::to).map(Position::point))
    }

    /// A warning where the program goes farther than the machine: `beyond-the-machine`.
    #[must_use]
    pub fn check_travel(&self, machine: &Machine) -> Option<Warning> {
        let [x, y, z] = machine.travel?;
        let bounds = self.bounds()?;
        let ends = self.sections.iter().flat_map(|section| &section.moves).filter_map(Move::to);
        let (lowest, highest) =
            ends.map(|to| to.z).fold((self.safe, self.safe), |(low, high), z| (low.min(z), high.max(z)));
        let height = highest - lowest;
        if bounds.width() <= x && bounds.height() <= y && height <= z {
            return None;
        }
        let message = format!(
            "the program is {:.1} × {:.1} × {:.1} mm, more than the machine's {x:.1} × {y:.1} × {z:.1} mm",
            bounds.width(),
            bounds.height(),
            height,
        );
        Some(planning::BEYOND_THE_MACHINE.warning(message))
    }
}

fn shifted(step: &Move, by: Vector) -> Move {
    let moved = |to: Position| Position::over(to.point() + by, to.z);
    match *step {
        Move::Rapid { to } => Move::Rapid { to: moved(to) },
        Move::Feed { to, feed } => Move::Feed { to: moved(to), feed },
        Move::Arc { to, center, turn, feed } => Move::Arc { to: moved(to), center: center + by, turn, feed },
        Move::Dwell { milliseconds } => Move::Dwell { milliseconds },
    }
}

/// Two holes that register a board mirrored left to right about the vertical line at `axis`: on
/// that line, `margin` above and below `bounds`, so that pins in them hold either side in the same
/// place.
#[must_use]
pub fn alignment_holes(bounds: Rect, axis: Nm, margin: Nm) -> [Point; 2] {
    [Point::new(axis, bounds.min().y - margin), Point::new(axis, bounds.max().y + margin)]
}
