//! How much copper of a net cuts take away.

use std::ops::Range;

use crate::board::Shape;
use crate::geometry::{Nm, Rect};

use super::hit::Hit;
use super::ruling::Ruling;
use super::sheet::Sheet;

/// How far apart the lines are along which it is measured: a share of how large the cuts are
/// together, within bounds. Chosen: of a shaving as long as they are it is true to a few
/// thousandths, whichever way it runs.
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
    let lines = cut.first().map_or(0, |first| first.0)..cut.last().map_or(0, |last| last.0 + 1);
    let copper = ruled(&ruling, lines, sheet.within(hits[0].net, rect));
    common(&cut, &copper) * pitch.to_f64() / 1e12
}

fn ruled(ruling: &Ruling, lines: Range<i64>, shapes: impl Iterator<Item = Shape>) -> Stretches {
    let mut stretches = Vec::new();
    for shape in shapes {
        ruling.rule(&shape, lines.clone(), &mut |line, from, to| stretches.push((line, from, to)));
    }
    apart(stretches)
}

/// Line by line and from first to last, none touching another.
fn apart(mut stretches: Stretches) -> Stretches {
    // Those of a shape are in order: the stable sort merges what is.
    stretches.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2)));
    stretches.dedup_by(|next, last| {
        let touch = next.0 == last.0 && next.1 <= last.2;
        if touch {
            last.2 = last.2.max(next.2);
        }
        touch
    });
    stretches
}

/// How much of all lines both cover, in nanometres.
fn common(one: &[(i64, f64, f64)], other: &[(i64, f64, f64)]) -> f64 {
    let (mut all, mut first) = (0.0, 0);
    for &(line, from, to) in one {
        let ends_before = |next: &(i64, f64, f64)| next.0 < line || (next.0 == line && next.2 <= from);
        first += other[first..].iter().take_while(|next| ends_before(next)).count();
        let touching = other[first..].iter().take_while(|next| next.0 == line && next.1 < to);
        all += touching.map(|next| next.2.min(to) - next.1.max(from)).sum::<f64>();
    }
    all
}
