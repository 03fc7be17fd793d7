//! Touching the surface of a board before it is cut: as it will lie on the machine, all its tiles
//! at once.

use std::fmt;
use std::str::FromStr;

use crate::board::{Side, Words};
use crate::gcode::{Touching, write_probe};
use crate::geometry::{Nm, Rect};
use crate::import::Loaded;
use crate::toolpath::Feed;

use super::pipeline::header;
use super::quantity::{Length, Tiles};
use super::stock::Stock;
use super::{Error, Settings};

/// How closely the surface is touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProbeGrid {
    /// No two neighbours further apart than this.
    Spacing(Length),
    /// So many columns and rows.
    Count(Tiles),
}

/// A text that is neither a length nor two numbers.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not a grid: expected the greatest distance between two probed points, such as `10mm`, or columns and rows, such as `7x5`"
)]
pub struct ParseProbeGridError(String);

impl FromStr for ProbeGrid {
    type Err = ParseProbeGridError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let count = || text.parse().map(Self::Count).ok();
        text.parse()
            .map(Self::Spacing)
            .ok()
            .or_else(count)
            .ok_or_else(|| ParseProbeGridError(text.to_owned()))
    }
}

impl fmt::Display for ProbeGrid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Spacing(spacing) => write!(f, "{spacing}"),
            Self::Count(count) => write!(f, "{count}"),
        }
    }
}

/// How a board is touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probing {
    /// The side that is up.
    pub side: Side,
    /// How closely.
    pub grid: ProbeGrid,
    /// How far inside the board's edge.
    pub inset: Length,
    /// How far below zero the surface is looked for.
    pub depth: Length,
    /// The height for the way from touch to touch.
    pub clearance: Length,
    /// How fast.
    pub feed: Feed,
}

/// The most touches one way. Chosen: a day of probing.
const MOST: u32 = 1000;

/// The program that touches the surface of a board where its programs will cut.
///
/// # Errors
///
/// [`Error::Value`] for lengths that make no sense and for a dialect that does not probe,
/// [`Error::NoCopper`] for files without extent.
pub fn probe(loaded: &Loaded, settings: &Settings, probing: &Probing) -> Result<String, Error> {
    let bounds = loaded.board.bounds().ok_or_else(|| Error::NoCopper("in these files".to_owned()))?;
    let area = Stock::new(bounds, settings).area(probing.side).inflate(-probing.inset.nm());
    let board = &loaded.board.name;
    let (columns, rows) = probing.size(area, settings)?;
    let touching = Touching {
        title: format!("{board} {} probe", probing.side),
        area,
        columns,
        rows,
        safe: settings.safe,
        clearance: probing.clearance.nm(),
        depth: probing.depth.nm(),
        feed: probing.feed,
        log: format!("{board}-{}-probe.txt", probing.side),
    };
    let mut header = header(&loaded.sources);
    header.settings = settings.options().listed();
    header.settings.retain(|(option, _)| PLACING.contains(&option.as_str()));
    write_probe(&touching, &settings.dialect, &header)
        .map_err(|error| Error::Value { key: "dialect", problem: error.to_string() })
}

/// The options that say where the board lies.
const PLACING: [&str; 7] = ["origin", "rotate", "offset", "mirror-axis", "tile", "tile-spacing", "safe-z"];

impl Probing {
    /// Columns and rows, where everything makes sense.
    fn size(&self, area: Rect, settings: &Settings) -> Result<(u32, u32), Error> {
        let safe = Length(settings.safe);
        if self.depth.nm() <= Nm::ZERO {
            return wrong("probe-depth", self.depth, "it must be more than zero");
        }
        if self.clearance.nm() <= Nm::ZERO || self.clearance.nm() > settings.safe {
            let expected =
                Words::of("it must be above zero and at most the {0} of {safe-z}").with([&safe]).to_string();
            return wrong("probe-clearance", self.clearance, &expected);
        }
        if self.inset.nm() < Nm::ZERO || area.width() <= Nm::ZERO || area.height() <= Nm::ZERO {
            return wrong("probe-inset", self.inset, "it leaves nothing of the board");
        }
        match self.grid {
            ProbeGrid::Count(Tiles { columns, rows }) if columns >= 2 && rows >= 2 => Ok((columns, rows)),
            ProbeGrid::Count(count) => wrong("probe-grid", count, "a surface has at least 2x2 probed points"),
            ProbeGrid::Spacing(spacing) => {
                let sizes = count(area.width(), spacing.nm()).zip(count(area.height(), spacing.nm()));
                let expected = format!("it must be above zero, with at most {MOST} probed points one way");
                sizes.map_or_else(|| wrong("probe-grid", spacing, &expected), Ok)
            }
        }
    }
}

fn wrong<T>(key: &'static str, value: impl fmt::Display, expected: &str) -> Result<T, Error> {
    Err(Error::Value { key, problem: format!("`{value}` is invalid: {expected}") })
}

/// How many touches along `length` are no further apart than `spacing`, if that is a number of
/// touches.
fn count(length: Nm, spacing: Nm) -> Option<u32> {
    let spacing = spacing.get();
    // The rectangle of a rounded corner is rounded outwards.
    let length = length.get() - 1000;
    let gaps = (spacing > 0).then(|| (length + spacing - 1).div_euclid(spacing).max(1))?;
    u32::try_from(gaps + 1).ok().filter(|&count| count <= MOST)
}
