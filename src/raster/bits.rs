//! Sets of pixels in words of 64, and what lines one pixel wide in them consist of: points,
//! junctions and the ways between.

use rayon::prelude::*;

/// A set of pixels, row by row from the top.
///
/// # Guarantees
///
/// Each row begins with a word of its own; bits beyond the width are clear.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bits {
    pub(super) width: usize,
    pub(super) stride: usize,
    pub(super) words: Vec<u64>,
}

impl Bits {
    /// The pixels of which `holds` says so, given column and row.
    #[must_use]
    pub fn new(width: usize, height: usize, holds: impl Fn(usize, usize) -> bool + Sync) -> Self {
        let stride = width.div_ceil(64).max(1);
        let mut words = vec![0_u64; stride * height];
        words.par_chunks_mut(stride).enumerate().for_each(|(row, words)| {
            for column in (0..width).filter(|&column| holds(column, row)) {
                words[column / 64] |= 1 << (column % 64);
            }
        });
        Self { width, stride, words }
    }

    /// Pixels across.
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub fn height(&self) -> usize {
        self.words.len() / self.stride
    }

    /// Whether a pixel is in the set; beyond the picture none is.
    #[must_use]
    pub fn holds(&self, column: i64, row: i64) -> bool {
        let (Ok(x), Ok(y)) = (usize::try_from(column), usize::try_from(row)) else { return false };
        x < self.width && y < self.height() && self.words[y * self.stride + x / 64] >> (x % 64) & 1 == 1
    }

    /// The pixels of the set, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let stride = self.stride;
        self.words.iter().enumerate().flat_map(move |(at, &word)| {
            let (row, first) = (at / stride, at % stride * 64);
            ones(word).map(move |bit| (first + bit, row))
        })
    }

    /// The eight pixels round one, as a byte.
    #[must_use]
    pub fn around(&self, column: usize, row: usize) -> u8 {
        let (x, y) = (column.try_into().unwrap_or(i64::MAX), row.try_into().unwrap_or(i64::MAX));
        let bits = AROUND.iter().enumerate();
        bits.fold(0, |byte, (bit, &(dx, dy))| byte | u8::from(self.holds(x + dx, y + dy)) << bit)
    }

    /// The ways that lines one pixel wide go from one junction to the next, and the closed ones.
    ///
    /// From each junction as many ways are followed as meet there, to the first junction on each;
    /// what was followed is not followed again. Junctions that touch are a way apart, in each
    /// direction: so Cisolate counts.
    #[must_use]
    pub fn routes(&self) -> usize {
        let mut left = self.clone();
        let mut nodes: Vec<(Node, usize, usize)> = Vec::new();
        for (x, y) in self.pixels() {
            let kind = Node::of(self.around(x, y));
            if matches!(kind, Node::Three | Node::Four) {
                nodes.push((kind, x, y));
            }
        }
        let mut routes = 0;
        for (kind, ways) in [(Node::Three, 3), (Node::Four, 4)] {
            for &(_, x, y) in nodes.iter().filter(|node| node.0 == kind) {
                routes += (0..ways).filter(|_| self.follow(&mut left, (x, y))).count();
            }
        }
        // What no junction leads to are closed lines, and single pixels.
        for &(_, x, y) in &nodes {
            left.clear(x, y);
        }
        let rest: Vec<(usize, usize)> = left.pixels().collect();
        for (x, y) in rest {
            let is_open = left.holds_at(x, y) && self.around(x, y) != 0;
            if is_open && self.follow(&mut left, (x, y)) {
                routes += 1;
            }
        }
        routes
    }

    /// Follows the pixels that are `left` from one to the next junction, or to the end, and clears
    /// them; whether there were any.
    fn follow(&self, left: &mut Self, start: (usize, usize)) -> bool {
        /// Straight on before aslant: up, right, down, left, and between them.
        const ORDER: [usize; 8] = [1, 3, 5, 7, 2, 4, 6, 0];
        let (mut at, mut before, mut length) = (start, None, 0_usize);
        loop {
            let next = ORDER.iter().filter_map(|&bit| {
                let (dx, dy) = AROUND[bit];
                Some((
                    at.0.checked_add_signed(dx.try_into().ok()?)?,
                    at.1.checked_add_signed(dy.try_into().ok()?)?,
                ))
            });
            let fits = |&place: &(usize, usize)| {
                left.holds_at(place.0, place.1) && Some(place) != before && (place != start || length >= 2)
            };
            let Some(next) = next.into_iter().find(fits) else { break };
            (before, at) = (Some(at), next);
            length += 1;
            if matches!(Node::of(self.around(at.0, at.1)), Node::Three | Node::Four) {
                break;
            }
            left.clear(at.0, at.1);
        }
        length > 0
    }

    fn holds_at(&self, column: usize, row: usize) -> bool {
        column < self.width
            && row < self.height()
            && self.words[row * self.stride + column / 64] >> (column % 64) & 1 == 1
    }

    fn clear(&mut self, column: usize, row: usize) {
        self.words[row * self.stride + column / 64] &= !(1 << (column % 64));
    }

    pub(super) fn row(&self, row: usize) -> &[u64] {
        &self.words[row * self.stride..(row + 1) * self.stride]
    }
}

/// The pixels round one, clockwise from the upper left: columns to the right and rows down.
const AROUND: [(i64, i64); 8] = [(-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0)];

/// The bits of a word that are set.
pub(super) fn ones(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros();
        (word != 0).then(|| {
            word &= word - 1;
            bit as usize
        })
    })
}

/// What a pixel of a thin line is, by the pixels round it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    /// By itself.
    Point,
    /// On a line.
    Line,
    /// Where three lines meet.
    Three,
    /// Where four lines meet.
    Four,
}

impl Node {
    /// By the byte of [`Bits::around`]: as many lines as there are pieces round it.
    #[must_use]
    pub const fn of(around: u8) -> Self {
        // A piece begins where a pixel is set and the one before it is not.
        match (around & !around.rotate_left(1)).count_ones() {
            _ if around == 0 => Self::Point,
            3 => Self::Three,
            4 => Self::Four,
            _ => Self::Line,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_bytes_are_three_ways_as_in_the_original_table() {
        let count = |kind| (0..=u8::MAX).filter(|&byte| Node::of(byte) == kind).count();
        assert_eq!((count(Node::Three), count(Node::Four)), (56, 2), "of 256");
    }
}
