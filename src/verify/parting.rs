//! Whether cuts may part a net: what is beyond doubt, at pixels much finer than the picture of the
//! whole side.
//!
//! Most cuts that reach into copper shave a trace or a pad, where a gap is narrower than the kerf.
//! Around each of them the copper of the net is drawn without and with kerfs, these wider by a
//! pixel all round: as many pieces as before, which still go on wherever they did at the border,
//! and no cut parts it. Where that leaves a doubt all of the net is drawn so: a plane that is cut
//! at one place hangs together by others. Polygons said the same in many times the time, and of a
//! plane in fifteen times the memory.

use std::cell::LazyCell;

use crate::board::Shape;
use crate::geometry::{Nm, Rect};
use crate::grid::Grid;
use crate::topology::NetId;

use super::Settings;
use super::border::Border;
use super::hit::Hit;
use super::machining::with_radius;
use super::pieces::{Extent, Joiner, Part, Run};
use super::rest::{HINT, least};
use super::sheet::{CUT, Sheet};
use super::spans::{Spans, less};

/// How large a window is, unless a single cut is larger. Chosen: a few pieces of a cut.
const WINDOW: Nm = Nm::from_mm(1);
/// How many halves of a kerf it reaches beyond the cuts, and its pixel: first a small window of
/// large pixels, and others that leave less doubt where that leaves some. Chosen: the first takes a
/// tenth of the time of the last, and mostly is enough.
const LOOKS: [(i64, Nm); 3] = [(2, Nm::from_um(24)), (2, Nm::from_um(10)), (6, Nm::from_um(3))];
/// The pixel for all of a net, which may hang together by another way than the one that is cut.
/// Chosen: a plane's takes a tenth of the time of its polygons, and a hundredth of their memory.
const WHOLE: Nm = Nm::from_um(8);
/// Pixels along a window at most: of one round a cut that is very long they are larger.
const MOST: i64 = 30_000;
/// Rows that are held at once. Chosen: they take a few megabytes.
const BAND: u32 = 512;

/// Whether cuts may part the copper of a net, all of which lies in `place`: the middle of one goes
/// through it, or around some there are more pieces after than before; and there are more in all of
/// it, too. What is the smaller, all of it or the windows, is looked at first.
pub(super) fn may_part(sheet: &Sheet<'_>, hits: &[Hit], place: Rect, settings: &Settings) -> bool {
    let whole = place.inflate(WHOLE * 4);
    let look = |rect: Rect, pitch: Nm| parts(sheet, hits[0].net, rect, pitch, settings);
    let looks = LOOKS.map(|(halves, pitch)| (halves, pitch, LazyCell::new(move || look(whole, pitch))));
    let locally = |rect: Rect| {
        looks.iter().all(|(halves, pitch, at_whole)| {
            // Where cuts are wide, windows round many of them are all of a small net.
            rect.inflate(sheet.half * *halves).common(whole).is_some_and(|window| {
                let pieces = if window == whole { **at_whole } else { look(window, *pitch) };
                pieces == Pieces::Others
            })
        })
    };
    let windows = windows(sheet, hits);
    let area = |rect: &Rect| rect.width().to_mm() * rect.height().to_mm();
    let is_small = area(&whole) < windows.iter().map(area).sum();
    let as_one = LazyCell::new(|| look(whole, WHOLE) == Pieces::One);
    if is_small && *as_one {
        return false;
    }
    let is_parted = hits.iter().any(|hit| hit.through) || windows.into_iter().any(locally);
    is_parted && !*as_one
}

/// Windows that hold what these cuts take, each of a few cuts that follow one another.
fn windows(sheet: &Sheet<'_>, hits: &[Hit]) -> Vec<Rect> {
    let is_small = |rect: Rect| rect.width().max(rect.height()) <= WINDOW;
    let mut windows: Vec<Rect> = Vec::new();
    for rect in hits.iter().map(|hit| sheet.cuts[hit.cut].swept.shape.bounds()) {
        match windows.last_mut() {
            Some(last) if is_small(last.union(rect)) => *last = last.union(rect),
            _ => windows.push(rect),
        }
    }
    windows
}

/// What cuts make of the pieces of a net in a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pieces {
    /// It is one piece, as it was before.
    One,
    /// Each is one piece, as it was before.
    AsBefore,
    /// There are more or fewer.
    Others,
}

/// What the cuts make of the pieces of a net within a window. Negligible residues do not count,
/// unless the window cuts them off from more.
fn parts(sheet: &Sheet<'_>, net: NetId, rect: Rect, pitch: Nm, settings: &Settings) -> Pieces {
    let pitch = pitch.max(rect.width().max(rect.height()) / MOST);
    let Ok(grid) = Grid::covering(rect, pitch) else { return Pieces::Others };
    let (mut before, mut after) = (Joiner::default(), Joiner::default());
    let mut border = Border::default();
    let wider = |index: usize| {
        let swept = sheet.cuts[index].swept;
        with_radius(&swept.shape, swept.half() + pitch)
    };
    for top in (0..grid.height()).step_by(BAND as usize) {
        let band = grid.rows(top, BAND.min(grid.height() - top));
        let copper = drawn(&band, sheet.within(net, band.rect()));
        let near = sheet.places.cuts.touching(band.rect().inflate(pitch));
        let kerfs = drawn(&band, near.into_iter().map(wider));
        let outside = outside(sheet, &band);
        let rows = copper.into_rows().zip(kerfs.into_rows());
        for (row, (copper, kerfs)) in (top..).zip(rows) {
            let copper = match outside.get((row - top) as usize) {
                Some(outside) => less(&copper, outside),
                None => copper,
            };
            before.row(row, &copper);
            // Each run with the region that it is part of, before the cuts.
            let regions = before.last().iter().map(|&(run, region)| Run { label: region, ..run });
            let left = less(&regions.collect::<Vec<_>>(), &kerfs);
            border.row(grid.width(), &copper, &left);
            if row == 0 || row + 1 == grid.height() {
                border.side(&copper, &left);
            }
            after.row(row, &left);
        }
    }
    if border.is_lost() {
        return Pieces::Others;
    }
    let mm2 = pitch.to_mm() * pitch.to_mm();
    #[expect(clippy::cast_precision_loss, reason = "an area")]
    let area = |pixels: u64| pixels as f64 * mm2;
    let counts =
        |pixels: u64, extent: Extent| area(pixels) >= settings.crumb * HINT || is_at_edge(extent, &grid);
    let left: Vec<(u64, Extent, u32)> = whole(&after.parts())
        .into_iter()
        .filter(|(pixels, extent, _)| counts(*pixels, *extent))
        .map(|(pixels, extent, region)| (pixels, extent, before.find(region)))
        .collect();
    let before = before.parts();
    let counted: Vec<&Part> = before.iter().filter(|part| counts(part.pixels, part.extent)).collect();
    let is_whole = |part: &&Part| {
        let mut own = left.iter().filter(|(_, _, piece)| *piece == part.piece);
        // What hardly counts may be nothing, too.
        let least = least(area(part.pixels), settings);
        let is_enough =
            |&(pixels, extent, _): &(u64, Extent, u32)| area(pixels) >= least || is_at_edge(extent, &grid);
        own.next().is_some_and(is_enough) && own.next().is_none()
    };
    match counted.iter().all(is_whole) {
        true if counted.len() == 1 => Pieces::One,
        true => Pieces::AsBefore,
        false => Pieces::Others,
    }
}

/// What of each row lies beyond the board's edge; no rows where nothing does.
fn outside(sheet: &Sheet<'_>, grid: &Grid) -> Vec<Vec<Run>> {
    let ground = sheet.ground(grid.rect());
    if matches!(&ground[..], [all] if all.contours().len() == 1 && all.contours()[0].len() == 4 && all.bounds() == grid.rect())
    {
        return Vec::new();
    }
    let whole = [Run { start: 0, end: grid.width(), label: 0 }];
    let board = drawn(grid, ground.into_iter().map(Shape::Polygon));
    board.into_rows().map(|board| less(&whole, &board)).collect()
}

/// Shapes in pixels.
fn drawn(grid: &Grid, shapes: impl Iterator<Item = Shape>) -> Spans {
    let mut spans = Spans::new(grid, 0..grid.height());
    shapes.for_each(|shape| spans.add(&shape, CUT));
    spans
}

/// The pieces, whatever the labels of their parts: how many pixels, where, and one of the labels.
fn whole(parts: &[Part]) -> Vec<(u64, Extent, u32)> {
    let piece = |parts: &[Part]| {
        let extent = parts.iter().map(|part| part.extent).reduce(Extent::union);
        Some((parts.iter().map(|part| part.pixels).sum(), extent?, parts[0].label))
    };
    parts.chunk_by(|a, b| a.piece == b.piece).filter_map(piece).collect()
}

fn is_at_edge(extent: Extent, grid: &Grid) -> bool {
    let Extent { left, top, right, bottom } = extent;
    left == 0 || top == 0 || right + 1 >= grid.width() || bottom + 1 >= grid.height()
}
