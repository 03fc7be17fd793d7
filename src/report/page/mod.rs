//! The page: `NAME.html`, one file with everything in it that a person wants to look at before
//! milling.
//!
//! It asks nothing of the network: style, program and data are within. The data are vectors, whole
//! micrometres written as differences, so a board takes about as much room as its Gerber files; the
//! browser draws them at any scale. What the tool does is read back from the text of the programs,
//! so the page shows what the machine will do, not what was planned.
//!
//! The page's own style and program lie in `src/report/html`, in the order of the array `SCRIPTS`;
//! the drawing's shape is [`Drawing`], and beside it stands the report, [`Document`], as it is in
//! `NAME.json`.

mod boundary;
mod copper;
mod motion;

use serde::Serialize;

use crate::board::{Board, Copper, FLATTEN, Hole, Side};
use crate::gcode::ReadError;
use crate::geometry::{Nm, Rect};
use crate::topology::Nets;
use crate::voronoi::Boundaries;

pub use boundary::Edge;
pub use copper::{CopperPath, NetDrawing};
pub use motion::{Machined, ProgramDrawing, ToolUse};

use super::Document;
use super::ink::{Ink, place, um};
use super::xml::escaped;

/// What a page shows.
#[derive(Clone, Debug, Serialize)]
pub struct Page<'a> {
    /// The report.
    pub report: &'a Document,
    /// The board and what is done to it.
    pub drawing: Drawing,
}

/// A board and what is done to it, in whole micrometres, x to the right and y up, both sides seen
/// from the front.
#[derive(Clone, Debug, Serialize)]
pub struct Drawing {
    /// Left, bottom, right and top.
    pub bounds: [i64; 4],
    /// The board's edge as an SVG path, to be filled by the even-odd rule.
    pub outline: Option<String>,
    /// The holes: diameter, how many, and an SVG path for a pen of that width.
    pub holes: Vec<(i64, usize, String)>,
    /// The sides.
    pub sides: Vec<SideDrawing>,
    /// The programs, in the order in which they are run.
    pub programs: Vec<ProgramDrawing>,
}

/// One side of a board.
#[derive(Clone, Debug, Serialize)]
pub struct SideDrawing {
    /// Which.
    pub side: Side,
    /// How wide the cuts of each tool are at the surface, at least and at most: the widest first.
    pub kerfs: Vec<[i64; 2]>,
    /// Its copper, net by net.
    pub nets: Vec<NetDrawing>,
    /// The lines between the regions of its nets.
    pub edges: Vec<Edge>,
}

impl SideDrawing {
    /// The copper of a side with the boundaries between its nets, cut as wide as `kerfs` say.
    #[must_use]
    pub fn new(copper: &Copper, nets: &Nets, boundaries: &Boundaries, kerfs: &[[Nm; 2]]) -> Self {
        Self {
            side: copper.side,
            kerfs: kerfs.iter().map(|kerf| kerf.map(um)).collect(),
            nets: copper::nets(copper, nets),
            edges: boundary::edges(boundaries),
        }
    }
}

impl Drawing {
    /// A drawing of `board`.
    ///
    /// # Errors
    ///
    /// [`ReadError`] for the first program that cannot be followed.
    pub fn new(board: &Board, sides: Vec<SideDrawing>, programs: &[Machined<'_>]) -> Result<Self, ReadError> {
        let bounds = super::picture::whole(board, Nm::ZERO).map_or([0; 4], corners);
        let outline = board.outline.as_ref().map(|outline| {
            let mut ink = Ink::default();
            ink.rings(outline.polygon(FLATTEN * 4).contours());
            ink.into_text()
        });
        let programs = programs.iter().map(motion::drawing).collect::<Result<_, _>>()?;
        Ok(Self { bounds, outline, holes: holes(&board.holes), sides, programs })
    }
}

fn corners(rect: Rect) -> [i64; 4] {
    let ([left, bottom], [right, top]) = (place(rect.min()), place(rect.max()));
    [left, bottom, right, top]
}

/// The holes by diameter, thin ones first.
fn holes(holes: &[Hole]) -> Vec<(i64, usize, String)> {
    let mut drawn: Vec<(Nm, usize, Ink)> = Vec::new();
    let mut sorted: Vec<&Hole> = holes.iter().collect();
    sorted.sort_by_key(|hole| hole.diameter);
    for hole in sorted {
        if drawn.last().is_none_or(|(diameter, ..)| *diameter != hole.diameter) {
            drawn.push((hole.diameter, 0, Ink::default()));
        }
        let Some((_, count, ink)) = drawn.last_mut() else { continue };
        *count += 1;
        if hole.is_slot() { ink.path(&hole.path) } else { ink.spot(hole.path.start) }
    }
    drawn.into_iter().map(|(diameter, count, ink)| (um(diameter), count, ink.into_text())).collect()
}

/// The page's program, one file an idea, in the order in which they need each other.
const SCRIPTS: [&str; 11] = [
    include_str!("../html/ways.js"),
    include_str!("../html/theme.js"),
    include_str!("../html/side.js"),
    include_str!("../html/program.js"),
    include_str!("../html/stage.js"),
    include_str!("../html/player.js"),
    include_str!("../html/slant.js"),
    include_str!("../html/how.js"),
    include_str!("../html/milled.js"),
    include_str!("../html/panel.js"),
    include_str!("../html/page.js"),
];

impl Page<'_> {
    /// The drawing and the report as JSON text in one line.
    #[must_use]
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("reports have string keys and finite numbers")
    }

    /// The page as an HTML file.
    #[must_use]
    pub fn to_html(&self) -> String {
        // Within a script nothing but its end has a meaning.
        let data = self.to_json().replace('<', "\\u003c");
        let parts = [
            ("{{title}}", escaped(&self.report.board)),
            ("{{generator}}", escaped(&self.report.generator)),
            ("{{style}}", include_str!("../html/page.css").to_owned()),
            ("{{script}}", SCRIPTS.concat()),
            ("{{data}}", data),
        ];
        fill(include_str!("../html/page.html"), &parts)
    }
}

/// Puts each part in its place; a mark that a part happens to hold is no place.
fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut page =
        String::with_capacity(template.len() + parts.iter().map(|(_, text)| text.len()).sum::<usize>());
    let mut rest = template;
    while let Some((at, mark, text)) = parts
        .iter()
        .filter_map(|(mark, text)| Some((rest.find(mark)?, mark, text)))
        .min_by_key(|(at, ..)| *at)
    {
        page.push_str(&rest[..at]);
        page.push_str(text);
        rest = &rest[at + mark.len()..];
    }
    page.push_str(rest);
    page
}
