//! The picture of what is left of a side: which nets hang together in it.
//!
//! It is never whole in memory: bands of rows are worked out side by side, and joined from top to
//! bottom.

use rayon::prelude::*;

use crate::board::Shape;
use crate::geometry::Nm;
use crate::grid::Grid;

use super::machining::with_radius;
use super::pieces::{Joiner, Part, Run};
use super::ruling::Ruling;
use super::sheet::{CUT, NETS, Sheet};
use super::spans::{Spans, filled, less};

/// Rows in a band. Chosen: some times as high as a cut is wide.
const BAND: u32 = 64;
/// Bands that are held at once. Chosen: enough for any number of threads.
const BATCH: usize = 32;
/// The label of clad that belongs to no net.
const CLAD: u32 = 0;

/// In pixels, how much narrower the cuts are drawn so that nothing that hangs together is missed.
///
/// A strip of a width of √2 pixels holds a row of pixel centres that share edges, whichever way it
/// lies. A gap of any width between two cuts that are narrower by three quarters of a pixel each is
/// wider than that.
const DOUBT: f64 = 0.75;

/// How much narrower kerfs are drawn with pixels of `pitch`.
pub(super) fn narrower(pitch: Nm) -> Nm {
    Nm::from_f64(pitch.to_f64() * DOUBT)
}

/// A cut, or a feature of the copper, by its index.
#[derive(Clone, Copy)]
enum Item {
    Cut(usize),
    Feature(usize),
}

/// The connected pieces of what is left, on `grid`, with all kerfs narrower by `narrower` on either
/// side.
pub(super) fn pieces(sheet: &Sheet<'_>, grid: &Grid, narrower: Nm) -> Vec<Part> {
    let bands = bands(sheet, grid);
    let board = sheet.outline.clone().map(Shape::Polygon);
    let mut joiner = Joiner::default();
    let mut row = 0;
    for (batch, first) in bands.chunks(BATCH).zip((0..).step_by(BATCH)) {
        let draw =
            |(at, items): (usize, &Vec<Item>)| draw(sheet, grid, first + at, items, board.as_ref(), narrower);
        let drawn: Vec<Vec<Vec<Run>>> = batch.par_iter().enumerate().map(draw).collect();
        for runs in drawn.iter().flatten() {
            joiner.row(row, runs);
            row += 1;
        }
    }
    joiner.parts()
}

/// What reaches into each band.
fn bands(sheet: &Sheet<'_>, grid: &Grid) -> Vec<Vec<Item>> {
    let ruling = Ruling::rows(grid);
    let count = i64::from(grid.height().div_ceil(BAND));
    let mut bands: Vec<Vec<Item>> = (0..count).map(|_| Vec::new()).collect();
    let cuts = sheet.cuts.iter().enumerate().map(|(index, cut)| (Item::Cut(index), &cut.swept.shape));
    let features = sheet.copper.features.iter().enumerate();
    let features = features.map(|(index, feature)| (Item::Feature(index), &feature.shape));
    for (item, shape) in cuts.chain(features) {
        let lines = ruling.lines(shape);
        let band = |line: i64| line.div_euclid(i64::from(BAND));
        for band in band(lines.start).max(0)..=band(lines.end - 1).min(count - 1) {
            bands[usize::try_from(band).expect("not below zero")].push(item);
        }
    }
    bands
}

/// The rows of a band.
fn draw(
    sheet: &Sheet<'_>,
    grid: &Grid,
    band: usize,
    items: &[Item],
    outline: Option<&Shape>,
    narrower: Nm,
) -> Vec<Vec<Run>> {
    let first = u32::try_from(band).expect("few") * BAND;
    let rows = first..(first + BAND).min(grid.height());
    let [mut cut, mut nets, mut board] = [(); 3].map(|()| Spans::new(grid, rows.clone()));
    for item in items {
        match *item {
            Item::Cut(index) => {
                let swept = sheet.cuts[index].swept;
                cut.add(&with_radius(&swept.shape, (swept.floor - narrower).max(Nm::ZERO)), CUT);
            }
            Item::Feature(index) => {
                nets.add(&sheet.copper.features[index].shape, NETS + sheet.nets.of(index).0);
            }
        }
    }
    match outline {
        Some(outline) => board.add(outline, CLAD),
        None => board.fill(CLAD),
    }
    let rows = cut.into_rows().zip(nets.into_rows()).zip(board.into_rows());
    rows.map(|((cut, nets), board)| {
        let left = less(&filled(&nets, CLAD, grid.width()), &cut);
        let outside = less(&[Run { start: 0, end: grid.width(), label: 0 }], &board);
        less(&left, &outside)
    })
    .collect()
}
