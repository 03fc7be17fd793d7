//! The program that probes a surface in a grid, for the dialects that can.

use crate::geometry::{Nm, Point, Rect};
use crate::toolpath::{Feed, Move, Position, Program};

use super::dialect::{ALL, Dialect, ProbesFrom, Touches};
use super::header::Header;
use super::write::{Writer, plain};

/// A surface that is to be touched in a grid of points.
///
/// ```text
///   safe ──╮               ╭──
///          │               │
///   clear  ├─╮  ╭─╮  ╭─╮  ╭┤      row by row, every other from the right
///   0 ═════╪═╧══╧═╧══╧═╧══╧╪══
///   depth  no deeper: there the controller stops with an alarm
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Touching {
    /// What is touched, as the operator reads it.
    pub title: String,
    /// The rectangle; its edges are touched too.
    pub area: Rect,
    /// How many points side by side; at least 2.
    pub columns: u32,
    /// How many one above the other; at least 2.
    pub rows: u32,
    /// The height for the way there and back.
    pub safe: Nm,
    /// The height for the way from point to point, above any place of the surface.
    pub clearance: Nm,
    /// How far below zero it looks for the surface.
    pub depth: Nm,
    /// How fast.
    pub feed: Feed,
    /// The file for the touches, where the controller keeps one.
    pub log: String,
}

/// Why there is no program that probes.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{dialect} does not keep probed points for `voromill level`: {reason}; expected {known}")]
pub struct ProbeError {
    dialect: String,
    reason: String,
    known: String,
}

/// The program that touches a surface with the tool itself, a wire on it and the spindle off.
///
/// # Errors
///
/// [`ProbeError`] for a dialect that is not known to probe.
pub fn write_probe(touching: &Touching, dialect: &Dialect, header: &Header) -> Result<String, ProbeError> {
    let note = match dialect.touches {
        Touches::None => return Err(ProbeError::new(dialect)),
        Touches::Reported => {
            "keep what the controller reports, a status with WCO: and each [PRB:, in a file for voromill level".to_owned()
        }
        Touches::ReportedJson => {
            "keep each line with prb that is reported in a file for voromill level --map-zero".to_owned()
        }
        Touches::Logged => format!("the probed points go into {} for voromill level", touching.log),
    };
    let what = format!(
        "probes {} by {} points with the spindle off, probe wires on tool and copper",
        touching.columns, touching.rows
    );
    let zero = (dialect.probes_from == ProbesFrom::Machine)
        .then(|| "set z to zero by G28.3 Z0 or G92 Z0: G38.2 takes no notice of G54".to_owned());
    let program = Program {
        title: touching.title.clone(),
        notes: [what, note].into_iter().chain(zero).collect(),
        safe: touching.safe,
        sections: Vec::new(),
    };
    let mut writer = Writer::new(dialect);
    writer.begin(&program, header);
    writer.line("M5");
    if dialect.touches == Touches::Logged {
        writer.line(&format!("(PROBEOPEN {})", plain(&touching.log)));
    }
    let mut height = touching.safe;
    for point in touching.points() {
        writer.step(&Move::Rapid { to: Position::over(point, height) });
        if height != touching.clearance {
            height = touching.clearance;
            writer.step(&Move::Rapid { to: Position::over(point, height) });
        }
        let depth = match dialect.probes_from {
            ProbesFrom::Work | ProbesFrom::Machine => touching.depth,
            ProbesFrom::Here => touching.depth + height,
        };
        let (z, feed) = (writer.length(-depth), touching.feed.number());
        writer.line(&format!("G38.2 Z{z} F{feed}"));
        writer.retract(height);
    }
    if dialect.touches == Touches::Logged {
        writer.line("(PROBECLOSE)");
    }
    writer.finish(&program);
    Ok(writer.text)
}

impl Touching {
    /// The points, row by row, there and back.
    fn points(&self) -> impl Iterator<Item = Point> + '_ {
        let place = |least: Nm, length: Nm, index: u32, count: u32| {
            least + Nm::new(length.get() * i64::from(index) / i64::from(count.max(2) - 1))
        };
        (0..self.rows).flat_map(move |row| {
            (0..self.columns).map(move |column| {
                let column = if row % 2 == 0 { column } else { self.columns - 1 - column };
                let x = place(self.area.min().x, self.area.width(), column, self.columns);
                Point::new(x, place(self.area.min().y, self.area.height(), row, self.rows))
            })
        })
    }
}

impl ProbeError {
    fn new(dialect: &Dialect) -> Self {
        let known = ALL.iter().filter(|dialect| dialect.touches != Touches::None);
        let known: Vec<&str> = known.map(|dialect| dialect.name.as_ref()).collect();
        let reason =
            dialect.no_probe.as_deref().unwrap_or("its description declares so (touches = \"none\")");
        Self { dialect: dialect.name.to_string(), reason: reason.to_owned(), known: known.join(" or ") }
    }
}
