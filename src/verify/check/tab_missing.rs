//! # What it checks
//!
//! What is cut out is held until the last: with the deepest pass done, every board hangs together with the stock round it through
//! at least one tab. Where the program says how many tabs it was asked for, fewer are told too.
//!
//! # Why
//!
//! A board that comes loose under a turning cutter is thrown or spoilt.
//!
//! # What it can miss
//!
//! Whether the tabs are strong enough; boards held by tape, which need none (ask for `--tabs 0`).

use super::{Check, Run, Severity};
use crate::board::{Board, FLATTEN, Shape};
use crate::geometry::{Nm, Point, Polygon, Rect};
use crate::grid::Grid;
use crate::verify::Settings;
use crate::verify::machining::{Machining, Swept};
use crate::verify::pieces::{Joiner, Part};
use crate::verify::report::Finding;
use crate::verify::spans::{Spans, filled, less};

pub(super) const CHECK: Check =
    Check { name: NAME, about: "a board cut out with nothing to hold it", run: Run::Cutout(check) };

const NAME: &str = "tab-missing";

/// The stock round the board.
const STOCK: u32 = 0;
/// Cut, but not in the deepest pass: a tab.
const TAB: u32 = 1;
/// The board.
const BOARD: u32 = 2;

/// How much the depth of the deepest pass may vary. Chosen: less than any tab is thick.
const PASS: Nm = Nm::from_um(20);

fn check(programs: &[&Machining], board: &Board, settings: &Settings) -> Vec<Finding> {
    if settings.tabs == Some(0) {
        return Vec::new();
    }
    let Some(outline) = board.outline.as_ref().map(|outline| outline.polygon(FLATTEN)) else {
        return Vec::new();
    };
    programs.iter().flat_map(|program| missing(program, &outline, settings)).collect()
}

fn missing(program: &Machining, outline: &Polygon, settings: &Settings) -> Vec<Finding> {
    let Some(half) = program.swept.iter().map(Swept::half).min() else { return Vec::new() };
    // An eighth of the groove: no way through it is missed, and a tab is many pixels long.
    let pitch = (half / 4).max(Nm::from_um(10));
    let rim = half * 4;
    let Ok(grid) = Grid::covering(outline.bounds().inflate(rim), pitch) else { return Vec::new() };
    let Left { all, tabs } = left(program, outline, &grid);
    let finding = |place: Rect, message: String| Finding {
        at: Some(place.min().midpoint(place.max())),
        program: Some(program.file.clone()),
        line: program.swept.last().map(|swept| swept.line),
        ..Finding::new(NAME, Severity::Warning, message)
    };
    let mm2 = |part: &Part| super::area(usize::try_from(part.pixels).unwrap_or(usize::MAX), pitch);
    let place = |part: &Part| {
        let corner = |column: u32, row: u32| grid.corner(i64::from(column), i64::from(row));
        let extent = part.extent;
        Rect::new(corner(extent.left, extent.top), corner(extent.right + 1, extent.bottom + 1))
    };
    let held = |parts: &[Part]| parts.iter().any(|part| part.extent.left == 0 || part.extent.top == 0);
    let mut findings: Vec<Finding> = all
        .chunk_by(|a, b| a.piece == b.piece)
        .filter(|parts| !held(parts))
        .filter_map(|parts| parts.iter().find(|part| part.label == BOARD && mm2(part) >= LEAST))
        .map(|board| finding(place(board), "nothing holds the board when it is cut out".to_owned()))
        .collect();
    let tabs = tabs.iter().filter(|tab| mm2(tab) >= half.to_mm() * half.to_mm()).count();
    let boards = outline.contours().iter().filter(|ring| path_area(ring) > 0).count();
    if let Some(wanted) =
        settings.tabs.and_then(|wanted| usize::try_from(wanted).ok()).map(|each| each * boards)
        && findings.is_empty()
        && (1..wanted).contains(&tabs)
    {
        findings.push(finding(outline.bounds(), format!("the board is held by {tabs} of {wanted} tabs")));
    }
    findings
}

/// Twice the area of a ring in nm²: above zero where it goes round counter-clockwise, as boards do; cut-outs go round the other way.
fn path_area(ring: &[Point]) -> i128 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(a, b)| {
            i128::from(a.x.get()) * i128::from(b.y.get()) - i128::from(b.x.get()) * i128::from(a.y.get())
        })
        .sum()
}

/// In mm², what is a board and no crumb. Chosen.
const LEAST: f64 = 1.0;

/// What the deepest pass leaves, in connected pieces.
struct Left {
    all: Vec<Part>,
    tabs: Vec<Part>,
}

fn left(program: &Machining, outline: &Polygon, grid: &Grid) -> Left {
    let [mut deepest, mut groove, mut board] = [(); 3].map(|()| Spans::new(grid, 0..grid.height()));
    let depth = program.swept.iter().map(|swept| swept.depth).max().unwrap_or(Nm::ZERO);
    for swept in &program.swept {
        let pass = if swept.depth >= depth - PASS { &mut deepest } else { &mut groove };
        pass.add(&swept.shape, TAB);
    }
    board.add(&Shape::Polygon(outline.clone()), BOARD);
    let (mut all, mut tabs) = (Joiner::default(), Joiner::default());
    let rows = deepest.into_rows().zip(groove.into_rows()).zip(board.into_rows());
    for (row, ((deepest, groove), board)) in (0..).zip(rows) {
        let tab = less(&groove, &deepest);
        let mut clad = less(&board, &tab);
        clad.extend(&tab);
        clad.sort_unstable_by_key(|run| run.start);
        all.row(row, &less(&filled(&clad, STOCK, grid.width()), &deepest));
        tabs.row(row, &tab);
    }
    Left { all: all.parts(), tabs: tabs.parts() }
}
