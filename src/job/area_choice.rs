//! Where copper is cleared or kept: a rectangle, or what a file draws.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use crate::board::polarity::clean;
use crate::board::{FLATTEN, Side};
use crate::geometry::{Point, Polygon, Rect};
use crate::import::load_copper;

use super::quantity::{Area, ParsePlaceError};

/// An area of the board, in the coordinates of its files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AreaChoice {
    /// A rectangle.
    Rectangle(Area),
    /// What a layer or a drawing covers.
    Drawn {
        /// Its file.
        file: String,
        /// Simple polygons, one for each connected piece; at least one.
        areas: Vec<Polygon>,
    },
}

/// A text that says no area.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseAreaChoiceError {
    /// A rectangle that is none.
    #[error(transparent)]
    Rectangle(#[from] ParsePlaceError),
    /// A file that cannot be read, and why.
    #[error("{0}")]
    File(String),
    /// A file that covers nothing.
    #[error("{0} covers no area: expected a Gerber layer or a drawing that fills some")]
    Empty(String),
}

impl AreaChoice {
    /// What it covers.
    pub(super) fn polygons(&self) -> Vec<Polygon> {
        match self {
            Self::Rectangle(area) => vec![Polygon::rectangle((*area).into())],
            Self::Drawn { areas, .. } => areas.clone(),
        }
    }

    /// The rectangle that holds it.
    pub(super) fn bounds(&self) -> Rect {
        match self {
            Self::Rectangle(area) => (*area).into(),
            Self::Drawn { areas, .. } => {
                let bounds = areas.iter().map(Polygon::bounds).reduce(Rect::union);
                bounds.unwrap_or(Rect::new(Point::default(), Point::default()))
            }
        }
    }

    /// What the file at `path` covers.
    fn drawn(path: &str) -> Result<Self, ParseAreaChoiceError> {
        let loaded = load_copper(Path::new(path), Side::Front);
        let loaded = loaded.map_err(|error| ParseAreaChoiceError::File(error.to_string()))?;
        let features = loaded.board.front.iter().flat_map(|copper| &copper.features);
        let polygons = features.filter_map(|feature| feature.shape.polygon(FLATTEN));
        let areas = clean(&polygons.flat_map(|polygon| polygon.contours().to_vec()).collect::<Vec<_>>());
        let name = Path::new(path).file_name().map_or(path.into(), |name| name.to_string_lossy());
        match areas.is_empty() {
            true => Err(ParseAreaChoiceError::Empty(path.to_owned())),
            false => Ok(Self::Drawn { file: name.into_owned(), areas }),
        }
    }
}

/// `X,Y,W,H`, or the path of a file as seen from the working directory.
impl FromStr for AreaChoice {
    type Err = ParseAreaChoiceError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        // Names of files may have commas, but hardly three.
        if Path::new(text).is_file() || text.split(',').count() != 4 && text.contains('.') {
            return Self::drawn(text);
        }
        Ok(Self::Rectangle(text.parse()?))
    }
}

/// The name of a file without its folder: where it lies says nothing to who reads a program.
impl fmt::Display for AreaChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rectangle(area) => area.fmt(f),
            Self::Drawn { file, .. } => f.write_str(file),
        }
    }
}
