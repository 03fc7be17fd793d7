//! What a program is for.

use crate::board::Side;

use super::Reach;

/// What a program is for; its file is named after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Drills the holes on whose pins the board is flipped.
    Alignment,
    /// Isolates the front.
    Front,
    /// Isolates the back, the board flipped.
    Back,
    /// Drills.
    Drill,
    /// Cuts the board out.
    Cutout,
}

impl Part {
    /// What isolates a side.
    #[must_use]
    pub const fn of(side: Side) -> Self {
        match side {
            Side::Front => Self::Front,
            Side::Back => Self::Back,
        }
    }

    /// What an option must change so that it changes this program.
    #[must_use]
    pub const fn reach(self) -> Reach {
        match self {
            Self::Alignment => Reach::ALIGNMENT,
            Self::Front | Self::Back => Reach::ISOLATION,
            Self::Drill => Reach::DRILLING,
            Self::Cutout => Reach::CUTOUT,
        }
    }

    /// The program of this [`name`](Self::name).
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        [Self::Alignment, Self::Front, Self::Back, Self::Drill, Self::Cutout]
            .into_iter()
            .find(|part| part.name() == name)
    }

    /// The last part of its file's name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alignment => "alignment",
            Self::Front => "front",
            Self::Back => "back",
            Self::Drill => "drill",
            Self::Cutout => "cutout",
        }
    }
}
