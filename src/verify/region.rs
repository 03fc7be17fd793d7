//! What is nearer to some nets than to all others, from within: squares, each beyond doubt.
//!
//! ```text
//!   ┌───┬─┬─┐     How far a place is from copper changes by no more than the way to it. A square whose middle is nearer to
//!   │   ├─┼─┘     these nets by twice its half diagonal lies in their region, whole; one that is farther by as much lies
//!   │   ├─┘       outside; any other is cut in four, until the squares are small.
//!   └───┘
//! ```

use rayon::prelude::*;

use crate::board::{Shape, polarity};
use crate::geometry::{Nm, Point, Polygon, Rect, Vector};
use crate::topology::NetId;

use super::sheet::Sheet;

/// The region of `nets` on a sheet, but for its edge, to which places may be as near as `fine`.
pub(super) fn region(sheet: &Sheet<'_>, nets: &[NetId], fine: Nm) -> Vec<Polygon> {
    let rect = sheet.rect();
    let side = rect.width().max(rect.height());
    let whole = Square { corner: rect.min(), side, nearest: side * 2 };
    let squares = within(sheet, nets, fine, whole);
    polarity::union(&squares.into_iter().map(Polygon::rectangle).collect::<Vec<_>>())
}

#[derive(Clone, Copy, Debug)]
struct Square {
    corner: Point,
    side: Nm,
    /// No place of it is farther from all copper.
    nearest: Nm,
}

fn within(sheet: &Sheet<'_>, nets: &[NetId], fine: Nm, square: Square) -> Vec<Rect> {
    let Square { corner, side, nearest } = square;
    let half = side / 2;
    let middle = corner + Vector::new(half, half);
    // More than half the diagonal.
    let reach = half * 3 / 2;
    let spot = Shape::Disc { center: middle, radius: Nm::ZERO };
    let (mut own, mut other) = (f64::INFINITY, f64::INFINITY);
    for near in sheet.proximity.near(&spot, nearest + reach * 2) {
        let is_own = nets.binary_search(&sheet.nets.of(near.feature)).is_ok();
        let known = if is_own { &mut own } else { &mut other };
        *known = known.min(near.width);
    }
    let sure = (reach * 2).to_f64();
    if own + sure <= other {
        return vec![Rect::new(corner, corner + Vector::new(side, side))];
    }
    if other + sure <= own || half < fine {
        return Vec::new();
    }
    let nearest = Nm::from_f64(own.min(other)) + reach;
    let corners = [(Nm::ZERO, Nm::ZERO), (half, Nm::ZERO), (Nm::ZERO, half), (half, half)];
    let quarter = |(x, y)| Square { corner: corner + Vector::new(x, y), side: side - half, nearest };
    corners.into_par_iter().flat_map(|way| within(sheet, nets, fine, quarter(way))).collect()
}
