//! The crack between two pixels: the step of a traced boundary.

/// The four ways from a corner, in the order in which they are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Heading {
    East,
    South,
    West,
    North,
}

pub(super) const HEADINGS: [Heading; 4] = [Heading::East, Heading::South, Heading::West, Heading::North];

/// A crack as walked: from a corner, in a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Crack {
    pub(super) x: i32,
    pub(super) y: i32,
    pub(super) heading: Heading,
}

impl Crack {
    pub(super) const fn end(self) -> (i32, i32) {
        match self.heading {
            Heading::East => (self.x + 1, self.y),
            Heading::South => (self.x, self.y + 1),
            Heading::West => (self.x - 1, self.y),
            Heading::North => (self.x, self.y - 1),
        }
    }

    /// The same crack from its other end.
    pub(super) const fn reversed(self) -> Self {
        let (x, y) = self.end();
        let heading = match self.heading {
            Heading::East => Heading::West,
            Heading::South => Heading::North,
            Heading::West => Heading::East,
            Heading::North => Heading::South,
        };
        Self { x, y, heading }
    }

    /// The pixels on its left and right.
    pub(super) const fn sides(self) -> ((i32, i32), (i32, i32)) {
        let (x, y) = (self.x, self.y);
        match self.heading {
            Heading::East => ((x, y - 1), (x, y)),
            Heading::South => ((x, y), (x - 1, y)),
            Heading::West => ((x - 1, y), (x - 1, y - 1)),
            Heading::North => ((x - 1, y - 1), (x, y - 1)),
        }
    }

    /// The pixel that owns it, and whether it is that pixel's left (else upper) crack.
    pub(super) const fn home(self) -> ((i32, i32), bool) {
        let (x, y) = (self.x, self.y);
        match self.heading {
            Heading::East => ((x, y), false),
            Heading::South => ((x, y), true),
            Heading::West => ((x - 1, y), false),
            Heading::North => ((x, y - 1), true),
        }
    }
}
