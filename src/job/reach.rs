//! What a job makes, and which of it an option changes.

/// Some of what a job makes, as a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach(u16);

impl Reach {
    /// The program of the holes on whose pins the board is flipped.
    pub const ALIGNMENT: Self = Self(1);
    /// The programs that isolate the front and the back.
    pub const ISOLATION: Self = Self(1 << 1);
    /// The program that drills.
    pub const DRILLING: Self = Self(1 << 2);
    /// The program that cuts the board out.
    pub const CUTOUT: Self = Self(1 << 3);
    /// How far tiles are apart, in all of these.
    pub const TILING: Self = Self(1 << 4);
    /// What files are called.
    pub const NAMES: Self = Self(1 << 5);
    /// Pictures of a board.
    pub const PICTURES: Self = Self(1 << 6);
    /// The program that probes a height map.
    pub const PROBING: Self = Self(1 << 7);
    /// What is told of a board that is not milled.
    pub const INSPECTION: Self = Self(1 << 8);
    /// The programs that carve artwork.
    pub const CARVING: Self = Self(1 << 9);
    /// The programs that mill pockets.
    pub const POCKETS: Self = Self(1 << 10);

    /// The programs that mill a board.
    pub const PROGRAMS: Self = Self::ALIGNMENT.and(Self::ISOLATION).and(Self::DRILLING).and(Self::CUTOUT);
    /// The programs that mill artwork.
    pub const ART: Self = Self::CARVING.and(Self::POCKETS);
    /// Nothing.
    pub const NONE: Self = Self(0);

    /// Both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether the two have something in common.
    #[must_use]
    pub const fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
}
