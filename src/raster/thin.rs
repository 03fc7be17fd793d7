//! Thinning: a set of pixels wears away from its edge until lines one pixel wide are left.
//!
//! A cellular automaton in two alternating passes. Each looks at the eight pixels round every pixel
//! of the set and deletes it where the set stays connected without it; all at once, so that neither
//! order nor threads matter. Ends of lines are deleted, too: what is left are closed lines, the
//! points where they meet, and single pixels for pieces without a hole.
//!
//! ```text
//!  bit 0 1 2      the pixels round one, clockwise from the upper left
//!      7 · 3
//!      6 5 4
//! ```
//!
//! A row is words of 64 pixels, and a pass is a boolean network over whole words: nine shifted
//! words in, one out. Rows are worked on in bands by all threads.
//!
//! # Sources
//!
//! Z. Guo, R. W. Hall, *Parallel thinning with two-subiteration algorithms*, Comm. ACM 32, 1989,
//! algorithm A1. D. E. Knuth, *The Art of Computer Programming* 4A, §7.1.3. The use for circuit
//! boards, with the patterns that delete ends: the program Cisolate, whose figures for its own
//! example this reproduces.

use rayon::prelude::*;

use super::bits::{Bits, ones};

/// Rows that a thread works on at once. Chosen: some hundred kilobytes of a wide picture.
const BAND: usize = 64;

/// What thinning leaves, and when the rest went.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thinned {
    /// The lines.
    pub left: Bits,
    /// Passes made, up to the second in a row that deleted nothing.
    pub generations: u32,
    /// By pixel, row by row: the pass that deleted it, counted from one; zero where it was not in
    /// the set, the number of all passes where it is left.
    pub ages: Vec<u16>,
}

/// Thins `set`, without the outermost pixels all round.
#[must_use]
pub fn thin(set: &Bits) -> Thinned {
    let (width, height) = (set.width, set.height());
    let mut now = Bits::new(width, height, |x, y| {
        x > 0
            && y > 0
            && x + 1 < width
            && y + 1 < height
            && set.words[y * set.stride + x / 64] >> (x % 64) & 1 == 1
    });
    let mut next = now.clone();
    let mut ages = vec![0_u16; width * height];
    for (x, y) in now.pixels() {
        ages[y * width + x] = 1;
    }
    // Rows near which nothing changed in either of the last two passes need not be looked at again.
    let mut awake = vec![true; height];
    let mut before = awake.clone();
    let (mut generations, mut idle) = (0_u32, 0);
    while idle < 2 {
        let is_even = generations % 2 == 0;
        generations += 1;
        let looked_at: Vec<bool> = awake.iter().zip(&before).map(|(awake, before)| awake | before).collect();
        let changed = pass(&now, &mut next, &looked_at, is_even);
        let age = u16::try_from(generations).unwrap_or(u16::MAX);
        (before, awake) = (awake, vec![false; height]);
        for &row in &changed {
            let near = row.saturating_sub(1)..(row + 2).min(height);
            awake[near].fill(true);
            let (old, new) = (now.row(row), next.row(row));
            for (at, (&old, &new)) in old.iter().zip(new).enumerate() {
                for bit in ones(old & !new) {
                    ages[row * width + at * 64 + bit] = age;
                }
            }
        }
        for &row in &changed {
            let range = row * now.stride..(row + 1) * now.stride;
            now.words[range.clone()].copy_from_slice(&next.words[range]);
        }
        idle = if changed.is_empty() { idle + 1 } else { 0 };
    }
    let last = u16::try_from(generations).unwrap_or(u16::MAX);
    for (x, y) in now.pixels() {
        ages[y * width + x] = last;
    }
    Thinned { left: now, generations, ages }
}

/// One pass over the rows that are `looked_at`; the rows that changed, in order.
fn pass(now: &Bits, next: &mut Bits, looked_at: &[bool], is_even: bool) -> Vec<usize> {
    let (stride, height) = (now.stride, now.height());
    let none = vec![0_u64; stride];
    let bands = next.words.par_chunks_mut(stride * BAND).enumerate();
    let changed: Vec<Vec<usize>> = bands
        .map(|(band, rows)| {
            let mut changed = Vec::new();
            for (row, out) in (band * BAND..).zip(rows.chunks_exact_mut(stride)) {
                if !looked_at[row] {
                    continue;
                }
                let above = if row > 0 { now.row(row - 1) } else { &none };
                let below = if row + 1 < height { now.row(row + 1) } else { &none };
                let here = now.row(row);
                let mut any = 0;
                for (at, out) in out.iter_mut().enumerate() {
                    let word = here[at];
                    *out = word;
                    if word != 0 {
                        let round = Round::new(above, here, below, at);
                        let kept = word & !if is_even { round.deleted() } else { round.turned().deleted() };
                        any |= kept ^ word;
                        *out = kept;
                    }
                }
                if any != 0 {
                    changed.push(row);
                }
            }
            changed
        })
        .collect();
    changed.concat()
}

/// The words of the eight pixels round each of 64.
#[derive(Clone, Copy)]
struct Round {
    nw: u64,
    n: u64,
    ne: u64,
    e: u64,
    se: u64,
    s: u64,
    sw: u64,
    w: u64,
}

impl Round {
    fn new(above: &[u64], here: &[u64], below: &[u64], at: usize) -> Self {
        let left = |row: &[u64]| row[at] << 1 | if at > 0 { row[at - 1] >> 63 } else { 0 };
        let right = |row: &[u64]| row[at] >> 1 | row.get(at + 1).map_or(0, |next| next << 63);
        Self {
            nw: left(above),
            n: above[at],
            ne: right(above),
            e: right(here),
            se: right(below),
            s: below[at],
            sw: left(below),
            w: left(here),
        }
    }

    /// The same half a turn on.
    const fn turned(self) -> Self {
        let Self { nw, n, ne, e, se, s, sw, w } = self;
        Self { nw: se, n: s, ne: sw, e: w, se: nw, s: n, sw: ne, w: e }
    }

    /// The pixels that an even pass deletes.
    const fn deleted(self) -> u64 {
        self.is_edge() | self.is_end()
    }

    /// Guo and Hall's conditions: one piece of the set round the pixel, two or three pixels by the
    /// smaller of two counts, and not one of those sides that the other pass takes.
    const fn is_edge(self) -> u64 {
        let Self { nw, n, ne, e, se, s, sw, w } = self;
        // Of the four pieces that may begin at a side, exactly one does.
        let (a, b, c, d) = (!n & (ne | e), !e & (se | s), !s & (sw | w), !w & (nw | n));
        let (one, other) = ((a ^ b) & !(c | d), (c ^ d) & !(a | b));
        // Both counts of four pairs each: at least two of either, and not four of both.
        let (f, g, h, i) = (nw | n, ne | e, se | s, sw | w);
        let (j, k, l, m) = (n | ne, e | se, s | sw, w | nw);
        let two = at_least_two(f, g, h, i) & at_least_two(j, k, l, m);
        let four = f & g & h & i & j & k & l & m;
        let taken = (s | sw | !nw) & w;
        (one | other) & two & !four & !taken
    }

    /// Ends of lines that point to the lower left: a single pixel round them, or a pair side by
    /// side.
    const fn is_end(self) -> u64 {
        let Self { nw, n, ne, e, se, s, sw, w } = self;
        let rest = ne | e | se;
        let upper = nw | n;
        let lower = s | sw | w;
        let single =
            (s & !(sw | w | upper)) | (w & !(s | sw | upper)) | (sw & !(s | w | upper)) | (nw & !(n | lower));
        let pair =
            (sw & w & !(s | upper)) | (s & sw & !(w | upper)) | (nw & w & !(n | s | sw)) | (nw & n & !lower);
        (single | pair) & !rest
    }
}

const fn at_least_two(a: u64, b: u64, c: u64, d: u64) -> u64 {
    (a & b) | (c & d) | ((a | b) & (c | d))
}

#[cfg(test)]
mod tests {
    use super::super::Node;
    use super::*;

    fn drawn(rows: &[&str]) -> Bits {
        Bits::new(rows[0].len(), rows.len(), |x, y| rows[y].as_bytes()[x] == b'#')
    }

    /// Whether a pass deletes the pixel with these pixels round it, one condition after the other.
    fn is_deleted(byte: u8, is_even: bool) -> bool {
        let byte = if is_even { byte } else { byte.rotate_left(4) };
        let p = |bit: u32| byte >> (bit % 8) & 1 == 1;
        let pieces =
            [1, 3, 5, 7].into_iter().filter(|&side| !p(side) && (p(side + 1) || p(side + 2))).count();
        let pairs = |first: u32| (0..4).filter(|pair| p(first + 2 * pair) || p(first + 2 * pair + 1)).count();
        let count = pairs(0).min(pairs(1));
        let taken = (p(5) || p(6) || !p(0)) && p(7);
        let ends = [0x20, 0x80, 0x40, 0x01, 0xc0, 0x60, 0x81, 0x03];
        (pieces == 1 && (2..=3).contains(&count) && !taken) || ends.contains(&byte)
    }

    #[test]
    fn the_network_is_the_table_of_256_bytes() {
        let mut guo_hall = 0;
        for byte in 0..=u8::MAX {
            for is_even in [true, false] {
                let bit = |bit: u32| u64::from(byte >> bit & 1);
                let round = Round {
                    nw: bit(0),
                    n: bit(1),
                    ne: bit(2),
                    e: bit(3),
                    se: bit(4),
                    s: bit(5),
                    sw: bit(6),
                    w: bit(7),
                };
                let round = if is_even { round } else { round.turned() };
                assert_eq!(round.deleted() & 1 == 1, is_deleted(byte, is_even), "{byte:08b}, {is_even}");
                guo_hall += u32::from(round.is_edge() & 1 == 1 && is_even);
            }
        }
        assert_eq!(guo_hall, 37, "as many as Knuth draws");
    }

    #[test]
    fn a_ring_becomes_a_line_and_a_blob_a_point() {
        let set = drawn(&[
            ".....................",
            ".#########...........",
            ".#########..####.....",
            ".###...###..#####....",
            ".###...###..#####....",
            ".###...###...####....",
            ".#########...........",
            ".#########......####.",
            "................####.",
            ".....................",
        ]);
        let thinned = thin(&set);
        let count = |kind| {
            let is = |&(x, y): &(usize, usize)| Node::of(thinned.left.around(x, y)) == kind;
            thinned.left.pixels().filter(is).count()
        };
        assert_eq!(count(Node::Point), 2, "two blobs");
        assert!(count(Node::Line) >= 12, "and a ring: {:?}", thinned.left);
        assert_eq!(count(Node::Three), 0, "of one line");
        let holes = |bits: &Bits| (3..6).all(|y| (4..7).all(|x| !bits.holds(x, y)));
        assert!(holes(&thinned.left), "the hole is as it was");
    }
}
