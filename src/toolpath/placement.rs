//! From board to machine coordinates: turned, moved, and mirrored for the back.

use crate::geometry::{Nm, Path, Point, Rect, Segment, Turn, Vector};

use super::angle::Angle;

/// From board to machine coordinates: turned about the board's origin, moved, and for the back
/// mirrored.
///
/// Front, back, drills and outline of one board share the first two steps, so they register; the
/// back is what the machine sees when the board has been flipped left to right about the axis:
///
/// ```text
///        front            │            back
///    ┌──────────┐         │        ┌──────────┐
///    │ A        │       axis       │        A │      x ↦ 2 axis − x
///    └──────────┘         │        └──────────┘
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Placement {
    /// First: counter-clockwise about the board's origin.
    pub rotation: Angle,
    /// Then: moved.
    pub shift: Vector,
    /// Last: mirrored about the vertical line at this x of the machine.
    pub mirror: Option<Nm>,
}

/// What becomes the machine's zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Origin {
    /// The lower left corner of the board's bounding rectangle.
    #[default]
    LowerLeft,
    /// The board's own zero, as in its files.
    Keep,
    /// The middle of the board's bounding rectangle.
    Center,
}

impl Placement {
    /// The placement of a board within `bounds`, seen from the front.
    #[must_use]
    pub fn front(origin: Origin, bounds: Rect, rotation: Angle, offset: Vector) -> Self {
        let turned = Self { rotation, ..Self::default() };
        let around = Rect::around(bounds.corners().map(|corner| turned.point(corner))).unwrap_or(bounds);
        let zero = match origin {
            Origin::LowerLeft => around.min(),
            Origin::Keep => Point::default(),
            Origin::Center => around.min().midpoint(around.max()),
        };
        Self { shift: Vector::new(-zero.x, -zero.y) + offset, ..turned }
    }

    /// The same board mirrored left to right about the vertical line at `axis`, in machine
    /// coordinates.
    #[must_use]
    pub const fn turned_over(self, axis: Nm) -> Self {
        Self { mirror: Some(axis), ..self }
    }

    /// The vertical middle line of a board within `bounds`, in machine coordinates, to the
    /// micrometre: mirrored about it, the board lies where it lay before.
    #[must_use]
    pub fn middle(&self, bounds: Rect) -> Nm {
        let around = Rect::around(bounds.corners().map(|corner| self.point(corner))).unwrap_or(bounds);
        let middle = around.min().midpoint(around.max()).x;
        Nm::from_um((middle.get() + 500).div_euclid(1000))
    }

    /// A point of the board on the machine.
    #[must_use]
    pub fn point(&self, p: Point) -> Point {
        let turned = match self.rotation.quarter_turns() {
            Some(0) => p,
            Some(1) => Point::new(-p.y, p.x),
            Some(2) => Point::new(-p.x, -p.y),
            Some(_) => Point::new(p.y, -p.x),
            None => {
                let (sin, cos) = libm::sincos(self.rotation.radians());
                let (x, y) = p.to_f64();
                Point::from_f64(x * cos - y * sin, x * sin + y * cos)
            }
        };
        let moved = turned + self.shift;
        self.mirror.map_or(moved, |axis| Point::new(axis * 2 - moved.x, moved.y))
    }

    /// The point of the board that lies at `p` on the machine; to the nanometre where the turn is
    /// no quarter turn.
    #[must_use]
    pub fn undo(&self, p: Point) -> Point {
        let unturned = self.mirror.map_or(p, |axis| Point::new(axis * 2 - p.x, p.y)) - self.shift;
        let back = Self { rotation: self.rotation.reversed(), ..Self::default() };
        back.point(unturned)
    }

    /// Which way round an arc of the board runs on the machine.
    #[must_use]
    pub const fn turn(&self, turn: Turn) -> Turn {
        if self.mirror.is_some() { turn.reversed() } else { turn }
    }

    /// A path of the board on the machine.
    #[must_use]
    pub fn path(&self, path: &Path) -> Path {
        let placed = |segment: &Segment| match *segment {
            Segment::Line { to } => Segment::Line { to: self.point(to) },
            Segment::Arc { to, center, turn } => {
                Segment::Arc { to: self.point(to), center: self.point(center), turn: self.turn(turn) }
            }
        };
        Path { start: self.point(path.start), segments: path.segments.iter().map(placed).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn the_back_registers_with_the_front() {
        let bounds = Rect::new(at(10_000, 20_000), at(60_000, 50_000));
        let front = Placement::front(Origin::LowerLeft, bounds, Angle::ZERO, Vector::default());
        assert_eq!(front.point(at(10_000, 20_000)), at(0, 0), "the lower left corner is zero");
        let back = front.turned_over(front.middle(bounds));
        assert_eq!(back.point(at(60_000, 20_000)), at(0, 0), "mirrored, the right one is");
        assert_eq!(back.point(at(10_000, 50_000)), at(50_000, 30_000), "top and bottom stay");
        assert_eq!(back.turn(Turn::Clockwise), Turn::CounterClockwise, "arcs run the other way");
    }

    #[test]
    fn a_quarter_turn_is_exact_and_others_keep_lengths() {
        let quarter = Placement { rotation: Angle::from_degrees(90), ..Placement::default() };
        assert_eq!(quarter.point(at(3, 1)), at(-1, 3), "counter-clockwise");
        let odd = Placement { rotation: Angle::from_degrees(33), ..Placement::default() };
        let length = odd.point(at(0, 0)).distance(odd.point(at(30_000, 40_000)));
        assert!((length - 50e6).abs() <= 1.0, "a nanometre at most is lost, not {}", length - 50e6);
    }
}
