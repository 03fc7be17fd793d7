//! Whether cuts may part a net: what is beyond doubt, at pixels much finer than the picture of the whole side.
//!
//! Most cuts that reach into copper shave a trace or a pad, where a gap is narrower than the kerf. Around each of them the copper
//! of the net is drawn without and with kerfs, these wider by a pixel all round: as many pieces as before, and no cut parts it.
//! Polygons said the same in many times the time.

use crate::board::Shape;
use crate::geometry::{Nm, Rect};
use crate::grid::Grid;
use crate::topology::NetId;

use super::Settings;
use super::hit::Hit;
use super::machining::with_radius;
use super::pieces::{Extent, Joiner, Part, Run};
use super::remains::HINT;
use super::sheet::{CUT, Sheet};
use super::spans::{Spans, less};

/// How large a window is, unless a single cut is larger. Chosen: a few pieces of a cut.
const WINDOW: Nm = Nm::from_mm(1);
/// How many halves of a kerf it reaches beyond the cuts, and its pixel: first a small window of large pixels, and others that leave less doubt
/// where that leaves some. Chosen: the first takes a tenth of the time of the last, and mostly is enough.
const LOOKS: [(i64, Nm); 3] = [(2, Nm::from_um(16)), (2, Nm::from_um(8)), (6, Nm::from_um(3))];
/// Pixels along a window at most: of one round a cut that is very long they are larger.
const MOST: i64 = 30_000;
/// Below this area, in mm², a piece at the edge of a window is nothing. Chosen: a hundredth of a millimetre square.
const NOTHING: f64 = 1e-4;

/// Whether cuts may part the copper of a net: the middle of one goes through it, or around some there are more pieces after than
/// before.
pub(super) fn may_part(sheet: &Sheet<'_>, hits: &[Hit], settings: &Settings) -> bool {
    hits.iter().any(|hit| hit.through)
        || windows(sheet, hits).into_iter().any(|rect| {
            let parts = |(halves, pitch)| {
                parts(sheet, hits[0].net, rect.inflate(sheet.half * halves), pitch, settings)
            };
            LOOKS.into_iter().all(parts)
        })
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

/// Whether within a window there are more pieces of a net after the cuts than before. Crumbs do not count, unless the window cuts
/// them off from more.
fn parts(sheet: &Sheet<'_>, net: NetId, rect: Rect, pitch: Nm, settings: &Settings) -> bool {
    let pitch = pitch.max(rect.width().max(rect.height()) / MOST);
    let Ok(grid) = Grid::covering(rect, pitch) else { return true };
    let (mut before, mut after) = (Joiner::default(), Joiner::default());
    let copper = drawn(&grid, sheet.within(net, rect));
    let wider = |index: usize| {
        let swept = sheet.cuts[index].swept;
        with_radius(&swept.shape, swept.half() + pitch)
    };
    let kerfs = drawn(&grid, sheet.places.cuts.touching(rect.inflate(pitch)).into_iter().map(wider));
    for (row, (copper, kerfs)) in (0..).zip(copper.into_rows().zip(kerfs.into_rows())) {
        before.row(row, &copper);
        // Each run with the region that it is part of, before the cuts.
        let regions = before.last().iter().map(|&(run, region)| Run { label: region, ..run });
        after.row(row, &less(&regions.collect::<Vec<_>>(), &kerfs));
    }
    let mm2 = pitch.to_mm() * pitch.to_mm();
    #[expect(clippy::cast_precision_loss, reason = "an area")]
    let counts = |pixels: u64, extent: Extent| {
        let area = pixels as f64 * mm2;
        area >= settings.crumb * HINT || (area >= NOTHING && is_at_edge(extent, &grid))
    };
    let left: Vec<(u64, Extent, u32)> = whole(&after.parts())
        .into_iter()
        .map(|(pixels, extent, region)| (pixels, extent, before.find(region)))
        .collect();
    before.parts().iter().filter(|part| counts(part.pixels, part.extent)).any(|part| {
        let own = left.iter().filter(|(_, _, piece)| *piece == part.piece);
        own.filter(|(pixels, extent, _)| counts(*pixels, *extent)).count() != 1
    })
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
