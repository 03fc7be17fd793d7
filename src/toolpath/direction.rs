//! Which way round a cutter goes.

use serde::{Deserialize, Serialize};

/// On which side of the cutter's way lies what is kept, for a spindle that turns clockwise as all
/// here do (M3).
///
/// ```text
///     climb: ┌──→──┐       conventional: ┌──←──┐
///            │kept ↓                     │kept ↑       seen from above, round a board;
///            └──←──┘                     └──→──┘       in a hole of it the other way round
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// On the right: the edge goes into full chips and leaves them thin.
    Climb,
    /// On the left.
    Conventional,
}

impl Direction {
    /// Whether a way with what is kept on its left must be turned round, on a board that is
    /// `mirrored` after that or not.
    #[must_use]
    pub const fn reverses(self, kept_on_the_left: bool, mirrored: bool) -> bool {
        let left = kept_on_the_left != mirrored;
        match self {
            Self::Climb => left,
            Self::Conventional => !left,
        }
    }
}
