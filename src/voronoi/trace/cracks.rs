//! The cracks of a tile, a bit each: which of its pixels differ in owner from the pixel on their
//! left, and from the one above.

use super::crack::{Crack, Heading};
use super::pixels::Pixels;

/// A row of pixels, a bit each, from the column left of the tile to the one right of it.
type Row = u64;

/// The widest tile whose pixels have a bit each.
const WIDEST: i32 = 62;

/// The cracks round the pixels of a tile and of one pixel about it, and which of the tile's own are
/// not walked yet.
pub(super) struct Cracks {
    /// From the row above the tile to the row below it.
    rows: Vec<Pair>,
    open: Vec<Pair>,
}

/// The cracks on the left of the pixels of a row, and those above them.
#[derive(Clone, Copy, Debug, Default)]
struct Pair {
    left: Row,
    upper: Row,
}

impl Cracks {
    pub(super) fn of(pixels: &Pixels<'_>) -> Self {
        assert!(pixels.width <= WIDEST, "a tile of {} pixels has a bit for each of them", pixels.width);
        let row = |y: i32, shift: i32| {
            &pixels.owners[pixels.index(shift - 1, y)..=pixels.index(shift + pixels.width, y)]
        };
        let pair =
            |y: i32| Pair { left: unequal(row(y, -1), row(y, 0)), upper: unequal(row(y - 1, 0), row(y, 0)) };
        let rows: Vec<Pair> = (-1..=pixels.height).map(pair).collect();
        let own = ((1 << pixels.width) - 1) << 1;
        let mut open: Vec<Pair> =
            rows.iter().map(|row| Pair { left: row.left & own, upper: row.upper & own }).collect();
        let below = open.len() - 1;
        (open[0], open[below]) = (Pair::default(), Pair::default());
        Self { rows, open }
    }

    /// How many cracks meet at a corner.
    pub(super) fn degree(&self, (x, y): (i32, i32)) -> usize {
        let (above, here) = (self.rows[line(y - 1)], self.rows[line(y)]);
        let met = [has(above.left, x), has(here.left, x), has(here.upper, x - 1), has(here.upper, x)];
        met.into_iter().map(usize::from).sum()
    }

    /// Whether this is a crack of one of the tile's pixels that is not walked yet.
    pub(super) fn is_open(&self, crack: Crack) -> bool {
        let ((x, y), is_left) = crack.home();
        let row = self.open[line(y)];
        has(if is_left { row.left } else { row.upper }, x)
    }

    /// Notes that a crack is walked.
    pub(super) fn take(&mut self, crack: Crack) {
        let ((x, y), is_left) = crack.home();
        let row = &mut self.open[line(y)];
        *(if is_left { &mut row.left } else { &mut row.upper }) &= !bit(x);
    }

    /// The left and upper cracks of all the tile's pixels that are not walked yet, row by row.
    pub(super) fn open(&self) -> Vec<Crack> {
        let mut cracks = Vec::new();
        for (y, row) in (-1..).zip(&self.open) {
            let mut left = row.left | row.upper;
            while left != 0 {
                let x = i32::try_from(left.trailing_zeros()).expect("a bit of 64") - 1;
                left &= left - 1;
                if has(row.left, x) {
                    cracks.push(Crack { x, y, heading: Heading::South });
                }
                if has(row.upper, x) {
                    cracks.push(Crack { x, y, heading: Heading::East });
                }
            }
        }
        cracks
    }
}

/// Where the row of pixels `y` is kept.
#[expect(clippy::cast_sign_loss, reason = "the row above the tile is the first")]
const fn line(y: i32) -> usize {
    (y + 1) as usize
}

const fn bit(x: i32) -> Row {
    1 << (x + 1)
}

const fn has(row: Row, x: i32) -> bool {
    row & bit(x) != 0
}

/// Where two rows of owners differ.
fn unequal(one: &[u32], other: &[u32]) -> Row {
    if one == other {
        return 0;
    }
    let mut differs = [0_u8; 64];
    for ((differs, one), other) in differs.iter_mut().zip(one).zip(other) {
        *differs = u8::from(one != other);
    }
    differs.chunks_exact(8).rev().fold(0, |bits, eight| bits << 8 | packed(eight.try_into().expect("eight")))
}

/// Eight bytes of 0 or 1 as eight bits: the factor moves the i-th to bit 56 + i, and nothing else
/// to where it would count.
const fn packed(bytes: [u8; 8]) -> u64 {
    u64::from_le_bytes(bytes).wrapping_mul(0x0102_0408_1020_4080) >> 56
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_where_rows_differ_has_its_bit() {
        let plain = [7_u32; 36];
        assert_eq!(unequal(&plain, &plain), 0, "nowhere");
        for (i, j) in (0..36).flat_map(|i| (0..36).map(move |j| (i, j))) {
            let mut other = plain;
            (other[i], other[j]) = (1, 2);
            assert_eq!(unequal(&plain, &other), 1 << i | 1 << j, "at {i} and {j}");
        }
    }
}
