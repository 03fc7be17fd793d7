//! Where tabs hold the board in its sheet while it is cut out.

use crate::geometry::{Nm, Point};
use crate::toolpath::strategy::TabPlaces;

use super::Error;
use super::checked::{self, given};
use super::options::Complete;

/// Where tabs hold the board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Holding {
    /// So many on each contour round a board.
    Count(u32),
    /// As many as keep them this near to each other.
    Spacing(Nm),
    /// Next to these points of the board.
    At(Vec<Point>),
}

impl Holding {
    /// How many there are on each contour, where that is what was asked for.
    #[must_use]
    pub const fn count(&self) -> Option<u32> {
        match self {
            Self::Count(count) => Some(*count),
            Self::Spacing(_) | Self::At(_) => None,
        }
    }

    /// As cutting out takes it.
    #[must_use]
    pub fn places(&self) -> TabPlaces<'_> {
        match self {
            Self::Count(count) => TabPlaces::Count(*count),
            Self::Spacing(apart) => TabPlaces::Spacing(*apart),
            Self::At(points) => TabPlaces::At(points),
        }
    }
}

/// What the options say of tabs.
pub(super) fn holding(options: &Complete) -> Result<Holding, Error> {
    if !options.tab_at.is_empty() {
        return Ok(Holding::At(options.tab_at.iter().map(|&place| place.into()).collect()));
    }
    let spacing = given("tab-spacing", options.tab_spacing)?;
    checked::count("tabs", options.tabs, 0..=1000)?;
    Ok(spacing.map_or_else(|| Holding::Count(options.tabs.unwrap_or(0)), Holding::Spacing))
}
