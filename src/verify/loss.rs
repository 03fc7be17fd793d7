//! How much copper of a net cuts take away.

use std::ops::Range;

use crate::board::Shape;
use crate::geometry::{Nm, Rect};

use super::hit::Hit;
use super::ruling::Ruling;
use super::sheet::Sheet;

/// How far apart the lines are along which it is measured: a share of how large the cuts are together, within bounds. Chosen: of a
/// shaving as long as they are it is true to a few thousandths, whichever way it runs.
const SHARE: i64 = 500;
const FINEST: Nm = Nm::new(250);
const COARSEST: Nm = Nm::from_um(10);

/// Stretches of lines that lie inside of something, by line.
type Stretches = Vec<(i64, f64, f64)>;

/// The copper of a net that cuts take away, in mm².
pub(super) fn lost(sheet: &Sheet<'_>, hits: &[Hit]) -> f64 {
    let kerfs = hits.iter().map(|hit| &sheet.cuts[hit.cut].swept.shape);
    let Some(rect) = kerfs.clone().map(Shape::bounds).reduce(Rect::union) else { return 0.0 };
    let pitch = ((rect.width() + rect.height()) / SHARE).max(FINEST).min(COARSEST);
    let ruling = Ruling::slanting(rect.min().midpoint(rect.max()), pitch);
    let cut = ruled(&ruling, i64::MIN..i64::MAX, kerfs.cloned());
    let lines = cut.iter().map(|(line, ..)| *line);
    let lines = lines.clone().min().unwrap_or(0)..lines.max().map_or(0, |last| last + 1);
    let copper = ruled(&ruling, lines, sheet.within(hits[0].net, rect));
    // What both cover is what each covers less what they cover together.
    let both: Stretches = cut.iter().chain(&copper).copied().collect();
    let common = length(cut) + length(copper) - length(both);
    // What a rounding leaves below nothing is nothing.
    common.max(0.0) * pitch.to_f64() / 1e12
}

fn ruled(ruling: &Ruling, lines: Range<i64>, shapes: impl Iterator<Item = Shape>) -> Stretches {
    let mut stretches = Vec::new();
    for shape in shapes {
        ruling.rule(&shape, lines.clone(), &mut |line, from, to| stretches.push((line, from, to)));
    }
    stretches
}

/// How much of all lines is covered, in nanometres.
fn length(mut stretches: Stretches) -> f64 {
    // Those of a shape are in order: the stable sort merges what is.
    stretches.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2)));
    let mut all = 0.0;
    for line in stretches.chunk_by(|a, b| a.0 == b.0) {
        let mut reached = f64::NEG_INFINITY;
        for &(_, from, to) in line {
            all += (to - from.max(reached)).max(0.0);
            reached = reached.max(to);
        }
    }
    all
}
