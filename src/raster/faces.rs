//! What thin lines part: faces, and which of them lie on two sides of a line.
//!
//! Lines hang together by sides and corners, so faces do by sides alone: none leaks through where a
//! line runs aslant.

use std::collections::BTreeMap;

use super::Bits;

/// The faces that lines leave of a picture.
///
/// # Guarantees
///
/// A pixel has the number of its face, counted from one by their first pixels, row by row; zero
/// where it is of a line.
#[derive(Clone, Debug)]
pub struct Faces {
    width: usize,
    /// Row by row.
    of: Vec<u32>,
    /// How many there are.
    count: u32,
}

/// Where two faces lie on the two sides of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Meeting {
    /// How many pixels of lines have one on either side.
    pub pixels: usize,
    /// One of these, column and row: midway in the order of rows.
    pub at: (usize, usize),
}

impl Faces {
    /// The faces between `lines`.
    #[must_use]
    pub fn new(lines: &Bits) -> Self {
        let (width, height) = (lines.width(), lines.height());
        let mut is_line = vec![false; width * height];
        for (x, y) in lines.pixels() {
            is_line[y * width + x] = true;
        }
        let mut of = vec![0_u32; width * height];
        let (mut count, mut open) = (0, Vec::new());
        for first in 0..of.len() {
            if is_line[first] || of[first] != 0 {
                continue;
            }
            count += 1;
            of[first] = count;
            open.push(first);
            while let Some(at) = open.pop() {
                for next in beside(at, width, of.len()) {
                    if !is_line[next] && of[next] == 0 {
                        of[next] = count;
                        open.push(next);
                    }
                }
            }
        }
        Self { width, of, count }
    }

    /// How many faces there are.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// The face of each pixel.
    #[must_use]
    pub fn labels(&self) -> &[u32] {
        &self.of
    }

    /// The pairs of faces with a line between them, the smaller number first. Where three or more
    /// meet round a pixel they meet in a point, and that is none.
    #[must_use]
    pub fn meetings(&self) -> BTreeMap<[u32; 2], Meeting> {
        let mut found: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        for at in (0..self.of.len()).filter(|&at| self.of[at] == 0) {
            let mut round: Vec<u32> = beside(at, self.width, self.of.len())
                .map(|next| self.of[next])
                .filter(|&face| face != 0)
                .collect();
            round.sort_unstable();
            round.dedup();
            if let [a, b] = round[..] {
                found.entry([a, b]).or_default().push(at);
            }
        }
        let meeting = |pixels: Vec<usize>| {
            let at = pixels[pixels.len() / 2];
            Meeting { pixels: pixels.len(), at: (at % self.width, at / self.width) }
        };
        found.into_iter().map(|(faces, pixels)| (faces, meeting(pixels))).collect()
    }
}

/// The pixels that share a side with one, of so many in rows of `width`.
fn beside(at: usize, width: usize, count: usize) -> impl Iterator<Item = usize> {
    let column = at % width;
    let left = (column > 0).then(|| at - 1);
    let right = (column + 1 < width).then_some(at + 1);
    let below = (at + width < count).then_some(at + width);
    [at.checked_sub(width), left, right, below].into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_meet_along_lines_and_not_in_points() {
        // Four faces round a point, and one in a corner behind a line that runs aslant.
        let rows = [
            "..#....", //
            "..#....", "#######", "..#..#.", "..#.#..", "..##...",
        ];
        let lines = Bits::new(7, 6, |x, y| rows[y].as_bytes()[x] == b'#');
        let faces = Faces::new(&lines);
        assert_eq!(faces.count(), 5, "{:?}", faces.labels());
        let pairs: Vec<[u32; 2]> = faces.meetings().into_keys().collect();
        assert_eq!(pairs, [[1, 2], [1, 3], [2, 4], [2, 5], [3, 4], [4, 5]], "{:?}", faces.labels());
        let across = faces.meetings()[&[1, 2]];
        assert_eq!((across.pixels, across.at), (2, (2, 1)), "the line between the upper two");
    }
}
