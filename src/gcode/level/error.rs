//! Why a text is no height map, and why a program cannot be levelled by one.

use crate::geometry::Nm;
use crate::geometry::Point;

use crate::gcode::read::ReadError;

/// Why a text is not a map of heights.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// A line that does not say what it should.
    #[error("line {line}: `{text}`: {expected}")]
    Line {
        /// From 1.
        line: usize,
        /// What stands there.
        text: String,
        /// What was expected.
        expected: &'static str,
    },
    /// Not the form of any program that probes.
    #[error(
        "this is not a height map: expected bCNC's .probe, OpenCNCPilot's .hmap, Candle's .map, lines of x y z as LinuxCNC logs them, Grbl's [PRB:x,y,z:1] or TinyG's {{\"prb\":...}} lines"
    )]
    Unknown,
    /// XML that is broken.
    #[error("{0}")]
    Xml(String),
    /// A place or a height that no machine reaches.
    #[error("line {0}: a position or a height above one metre: expected a map in the given unit")]
    Range(usize),
    /// Fewer or more points than the file says.
    #[error("the map declares {declared} points, but has {found}")]
    Count {
        /// So many it should have.
        declared: usize,
        /// So many it has.
        found: usize,
    },
    /// Too little to have a surface.
    #[error("the probed points make {columns} columns and {rows} rows: expected at least two of each")]
    Few {
        /// Different x.
        columns: usize,
        /// Different y.
        rows: usize,
    },
    /// A grid with holes.
    #[error(
        "{count} points of the {columns} by {rows} grid were not probed, the first at x = {x:.3} mm, y = {y:.3} mm"
    )]
    Missing {
        /// How many.
        count: usize,
        /// Columns of the grid.
        columns: usize,
        /// Its rows.
        rows: usize,
        /// Where the first is.
        x: Nm,
        /// Where the first is.
        y: Nm,
    },
    /// A touch beside a grid that all others fill.
    #[error(
        "line {line}: the touch at x = {x:.3} mm, y = {y:.3} mm lies beside the {columns} by {rows} grid of all others"
    )]
    Beside {
        /// From 1.
        line: usize,
        /// Where.
        x: Nm,
        /// Where.
        y: Nm,
        /// Columns of the grid without it.
        columns: usize,
        /// Its rows.
        rows: usize,
    },
    /// Two heights of one place.
    #[error(
        "line {line}: the surface is at {second:.3} mm at x = {x:.3} mm, y = {y:.3} mm, and line {other} has it at {first:.3} mm: expected the same height at the same place"
    )]
    Contradicting {
        /// From 1.
        line: usize,
        /// The line of the other touch.
        other: usize,
        /// Where.
        x: Nm,
        /// Where.
        y: Nm,
        /// What the other says.
        first: Nm,
        /// What this one says.
        second: Nm,
    },
    /// Steeper than any sheet: the unit is wrong, or a touch was.
    #[error(
        "the surface rises by {rise:.3} mm within {run:.3} mm near x = {x:.3} mm, y = {y:.3} mm: expected the heights of a flat board, in the unit of x and y"
    )]
    Steep {
        /// How much higher.
        rise: Nm,
        /// How far apart.
        run: Nm,
        /// Where.
        x: Nm,
        /// Where.
        y: Nm,
    },
    /// Places that count from the machine's zero.
    #[error(
        "line {line}: the controller reports probed points in machine coordinates, and the work zero is unknown"
    )]
    Zero {
        /// From 1.
        line: usize,
    },
}

/// Why a program cannot be levelled to a map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LevelError {
    /// The program cannot be followed.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A text without motions.
    #[error("no motion in it")]
    NoMotion,
    /// It follows a surface already, and would do so twice.
    #[error("line {line}: the program is levelled already, and would follow the surface twice")]
    Levelled {
        /// From 1.
        line: usize,
    },
    /// Its lines cannot be changed one by one.
    #[error("line {line}: {what}: such a program cannot be levelled line by line")]
    Indirect {
        /// From 1.
        line: u32,
        /// What stands there.
        what: &'static str,
    },
    /// It cuts where nobody has touched.
    #[error(
        "line {line}: it cuts at x = {x:.3} mm, y = {y:.3} mm, outside what was probed, x {left:.3} to {right:.3} mm and y {bottom:.3} to {top:.3} mm, by more than {margin:.3} mm"
    )]
    Outside {
        /// From 1.
        line: u32,
        /// Where.
        x: Nm,
        /// Where.
        y: Nm,
        /// The probed area.
        left: Nm,
        /// The probed area.
        right: Nm,
        /// The probed area.
        bottom: Nm,
        /// The probed area.
        top: Nm,
        /// How far outside it may go.
        margin: Nm,
    },
    /// It goes down before it says where.
    #[error("line {line}: it goes below {safe:.3} mm before x and y are given")]
    Nowhere {
        /// From 1.
        line: u32,
        /// The height for travel.
        safe: Nm,
    },
    /// Travel would hit the surface.
    #[error(
        "the surface rises to {height:.3} mm at x = {x:.3} mm, y = {y:.3} mm, and the program travels at {safe:.3} mm"
    )]
    High {
        /// The highest place of the map.
        height: Nm,
        /// Where it is.
        x: Nm,
        /// Where it is.
        y: Nm,
        /// The height for travel.
        safe: Nm,
    },
}

impl LevelError {
    /// The place that lies `outside` the rectangle with these corners.
    pub(super) fn outside(line: u32, p: Point, area: crate::geometry::Rect, margin: Nm) -> Self {
        let (min, max) = (area.min(), area.max());
        Self::Outside { line, x: p.x, y: p.y, left: min.x, right: max.x, bottom: min.y, top: max.y, margin }
    }
}
