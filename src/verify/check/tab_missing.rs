//! # What it checks
//!
//! What is cut out is held until the last: with everything cut, every board hangs together with the
//! stock round it through at least one tab. Where the program says how many tabs it was asked for,
//! fewer are told too; of what falls out of a cut-out where a tab among evenly spread ones is not
//! there, or one alone holds it.
//!
//! # Why
//!
//! A board that comes loose under a turning cutter is thrown or spoilt.
//!
//! # What it can miss
//!
//! Boards held by tape, which need none (ask for `--tabs 0`). Whether tabs are strong enough is for
//! `tab-thin` to say, whether they lie on several sides for `tab-spread`. Cut-outs without any tab:
//! what falls out of a small one needs none.

use super::{Check, Diagnostic, Run, Severity, Stage, Words};
use crate::board::diagnostic::count;
use crate::board::{Board, Shape};
use crate::geometry::{Nm, Point, Rect};
use crate::grid::Grid;
use crate::verify::Settings;
use crate::verify::contours::{Contours, Ring};
use crate::verify::pieces::{Joiner, Part};
use crate::verify::report::Finding;
use crate::verify::spans::{Spans, filled, less};

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a board cut out with nothing to hold it"),
    effect: Words::of("the board comes loose while it is cut out, and the cutter catches it"),
    advice: Words::of("ask for tabs ({tabs} 4); for a board that is held otherwise use `verify {tabs} 0`"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Cutout(check) };

const NAME: &str = "tab-missing";

/// The stock round the board.
const STOCK: u32 = 0;
/// Cut through.
const CUT: u32 = 1;
/// The board.
const BOARD: u32 = 2;

fn check(contours: &Contours<'_>, _: &Board, settings: &Settings) -> Vec<Finding> {
    if settings.tabs == Some(0) {
        return Vec::new();
    }
    let (program, line) = contours.last();
    let finding = |at: Point, severity: Severity, message: String| Finding {
        at: Some(at),
        program: program.clone(),
        line,
        ..Finding::new(NAME, severity, message)
    };
    // Somebody wanted tabs; else the board may be held by tape.
    let severity = if settings.tabs.is_some() { Severity::Error } else { Severity::Warning };
    let loose = loose(contours, settings);
    let message = "nothing holds the board when it is cut out";
    let mut findings: Vec<Finding> =
        loose.into_iter().map(|at| finding(at, severity, message.to_owned())).collect();
    let boards: Vec<_> = contours.rings.iter().filter(|ring| ring.is_board).collect();
    let tabs: usize = boards.iter().map(|ring| contours.tabs(ring, settings).count()).sum();
    let wanted = settings.tabs.and_then(|wanted| usize::try_from(wanted).ok());
    if let Some(wanted) = wanted.map(|each| each * boards.len())
        && findings.is_empty()
        && (1..wanted).contains(&tabs)
    {
        let message = format!("the board is held by {tabs} of {wanted} tabs");
        let bounds = contours.outline.bounds();
        findings.push(finding(bounds.min().midpoint(bounds.max()), Severity::Warning, message));
    }
    let inner = contours.rings.iter().filter(|ring| !ring.is_board);
    let gaps = inner.filter_map(|ring| uneven(contours, ring, settings));
    findings.extend(gaps.map(|(at, message)| finding(at, Severity::Warning, message)));
    findings
}

/// How much longer the longest way without a tab is than the next where one is not there. Chosen:
/// it is twice as long where tabs are spread evenly, and corners move them a little.
const UNEVEN: f64 = 1.7;

/// What holds too little of a piece that falls out of a cut-out, and about where a tab should be.
///
/// How many find room on a small contour nobody says; but where a program makes any it spreads them
/// evenly, and one alone holds nothing level.
fn uneven(contours: &Contours<'_>, ring: &Ring, settings: &Settings) -> Option<(Point, String)> {
    let wanted = settings.tabs.and_then(|wanted| usize::try_from(wanted).ok())?;
    let mut ways = contours.ways(ring, settings);
    if ways.is_empty() || ways.len() >= wanted {
        return None;
    }
    let tabs = ways.len();
    ways.sort_by(|a, b| b.length.total_cmp(&a.length));
    let (longest, next) = (&ways[0], ways.get(1));
    let is_uneven = next.is_none_or(|next| longest.length > next.length * UNEVEN);
    // Tabs are kept off corners and curves where there is a choice.
    let tab = settings.tab_width.unwrap_or_default() + contours.half * 2;
    let is_missing = is_uneven && ring.is_straight_in(&longest.stretch, tab.to_f64());
    let message = format!("the waste inside a cut-out is held by {}: one is missing", count(tabs, "tab"));
    is_missing.then_some((longest.stretch.middle, message))
}

/// In mm², what is a board and not a negligible residue. Chosen.
const LEAST: f64 = 1.0;

/// The middles of boards that hang together with nothing.
fn loose(contours: &Contours<'_>, settings: &Settings) -> Vec<Point> {
    // An eighth of the groove: no way through it is missed.
    let pitch = (contours.half / 4).max(Nm::from_um(10));
    let rim = contours.half * 4;
    let Ok(grid) = Grid::covering(contours.outline.bounds().inflate(rim), pitch) else { return Vec::new() };
    let parts = pieces(contours, settings, &grid);
    let mm2 = |part: &Part| super::area(usize::try_from(part.pixels).unwrap_or(usize::MAX), pitch);
    let middle = |part: &Part| {
        let corner = |column: u32, row: u32| grid.corner(i64::from(column), i64::from(row));
        let extent = part.extent;
        let place = Rect::new(corner(extent.left, extent.top), corner(extent.right + 1, extent.bottom + 1));
        place.min().midpoint(place.max())
    };
    let held = |parts: &[Part]| parts.iter().any(|part| part.extent.left == 0 || part.extent.top == 0);
    parts
        .chunk_by(|a, b| a.piece == b.piece)
        .filter(|parts| !held(parts))
        .filter_map(|parts| parts.iter().find(|part| part.label == BOARD && mm2(part) >= LEAST))
        .map(middle)
        .collect()
}

/// What is left of the stock, in connected pieces.
fn pieces(contours: &Contours<'_>, settings: &Settings, grid: &Grid) -> Vec<Part> {
    let [mut through, mut board] = [(); 2].map(|()| Spans::new(grid, 0..grid.height()));
    let swept = contours.programs.iter().flat_map(|program| &program.swept);
    for swept in swept.filter(|swept| swept.full >= settings.board) {
        through.add(&swept.shape, CUT);
    }
    board.add(&Shape::Polygon(contours.outline.clone()), BOARD);
    let mut all = Joiner::default();
    for (row, (through, board)) in (0..).zip(through.into_rows().zip(board.into_rows())) {
        all.row(row, &less(&filled(&board, STOCK, grid.width()), &through));
    }
    all.parts()
}
