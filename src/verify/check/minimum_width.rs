//! # What it checks
//!
//! How wide what is left of a net is at its narrowest, against the design: at every place where a cut reaches into it, straight
//! across. Told where less than half is left.
//!
//! # Why
//!
//! A trace of half the width carries half the current, and breaks where it narrows.
//!
//! # What it can miss
//!
//! It looks across at the deepest place of each cut, in a picture with pixels of 5 µm and 0.6 mm to each side: what
//! was wider than that is not narrow. Where the cutter's middle goes through a net, `gouge` and `open` tell of it.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::{Check, Run, Severity};
use crate::geometry::{Nm, Point, Rect};
use crate::grid::Grid;
use crate::topology::NetId;
use crate::verify::hit::Hit;
use crate::verify::report::Finding;
use crate::verify::sheet::{NETS, Sheet, Show};

pub(super) const CHECK: Check = Check {
    name: NAME,
    about: "a net left with less than half its width",
    run: Run::Isolation(|sheet, _| check(sheet)),
};

const NAME: &str = "minimum-width";

/// How far it looks. Chosen: wider than most traces.
const AROUND: Nm = Nm::from_um(600);
/// The pixel.
const PITCH: Nm = Nm::from_um(5);
/// Places of a net that are looked at, the deepest first. Chosen: a net so often cut has other findings.
const PLACES: usize = 8;

/// What is left across a place, and what was designed.
#[derive(Clone, Copy, Debug)]
struct Width {
    hit: Hit,
    left: Nm,
    designed: Nm,
}

fn check(sheet: &Sheet<'_>) -> Vec<Finding> {
    let mut nets: BTreeMap<NetId, Vec<Hit>> = BTreeMap::new();
    for hit in &sheet.hits {
        nets.entry(hit.net).or_default().push(*hit);
    }
    let nets: Vec<Vec<Hit>> = nets.into_values().collect();
    nets.into_par_iter()
        .filter_map(|hits| narrowest(sheet, hits))
        .map(|width| finding(sheet, &width))
        .collect()
}

/// The place of a net where the smallest share of its width is left, where that is less than half.
fn narrowest(sheet: &Sheet<'_>, mut hits: Vec<Hit>) -> Option<Width> {
    hits.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.cut.cmp(&b.cut)));
    let widths = hits.iter().take(PLACES).filter_map(|hit| across(sheet, hit));
    let narrow = widths.filter(|width| width.left * 2 < width.designed);
    let share = |width: &Width| width.left.to_f64() / width.designed.to_f64();
    narrow.reduce(|a, b| if share(&b) < share(&a) { b } else { a })
}

/// The widths across a net where a cut reaches into it, at a right angle to the cut.
fn across(sheet: &Sheet<'_>, hit: &Hit) -> Option<Width> {
    let swept = sheet.cuts[hit.cut].swept;
    let foot = sheet.walls.foot(hit.cut, hit.at);
    let (dx, dy) = (hit.at.x - foot.x, hit.at.y - foot.y);
    let length = foot.distance(hit.at);
    if length < 1.0 {
        return None;
    }
    let (ux, uy) = (dx.to_f64() / length, dy.to_f64() / length);
    let place = Rect::new(foot, foot).inflate(AROUND + swept.half());
    let (grid, pictures) = sheet.window(place, PITCH, 1000, &[Show::Left, Show::Design]);
    let label = hit.net.0 + NETS;
    let (x, y) = foot.to_f64();
    let at = |way: f64| Point::from_f64(x + ux * way, y + uy * way);
    let run = |labels: &[u32], from: f64, step: f64| {
        let most = (AROUND.to_f64() / step.abs()).ceil();
        let mut count = 0.0;
        while count < most && label_at(&grid, labels, at(from + step * count)) == Some(label) {
            count += 1.0;
        }
        count * step.abs()
    };
    let (face, step) = (swept.half().to_f64(), PITCH.to_f64() / 2.0);
    let left = run(pictures[0].labels(), face + step, step);
    let designed = run(pictures[1].labels(), face - hit.depth + step * 2.0, step);
    (designed + step < AROUND.to_f64()).then(|| Width {
        hit: *hit,
        left: Nm::from_f64(left),
        designed: Nm::from_f64(designed),
    })
}

fn label_at(grid: &Grid, labels: &[u32], p: Point) -> Option<u32> {
    let corner = grid.corner(0, 0);
    let (column, row) =
        ((p.x - corner.x).get() / grid.pitch().get(), (corner.y - p.y).get() / grid.pitch().get());
    let (column, row) = (usize::try_from(column).ok()?, usize::try_from(row).ok()?);
    let width = grid.width() as usize;
    (column < width).then(|| labels.get(row * width + column).copied()).flatten()
}

fn finding(sheet: &Sheet<'_>, width: &Width) -> Finding {
    let Width { hit, left, designed } = *width;
    let cut = sheet.cuts[hit.cut];
    let name = sheet.nets.label(hit.net);
    let message = format!("{name} is {left:.3} mm wide where the design has {designed:.3} mm");
    Finding {
        nets: vec![name],
        at: Some(hit.at),
        size: Some(left),
        program: Some(cut.program.file.clone()),
        line: Some(cut.swept.line),
        ..Finding::new(NAME, Severity::Warning, message)
    }
}
