//! Algorithm 3's paths: borders between differently labelled pixels, from corner to corner.
//!
//! A path begins at the first corner, row by row, that has borders left, and runs both ways from
//! there: straight on where it can, round a corner where there is but one, and it ends where it
//! meets another from the side. So at a corner of four borders two paths cross, and at one of three
//! the bar of the T runs on. Every border belongs to one path.

use std::collections::VecDeque;

/// A picture of labels, row by row.
pub(super) struct Labels {
    pub(super) labels: Vec<u32>,
    pub(super) width: u32,
    pub(super) height: u32,
}

/// A corner between pixels: column and row.
pub(super) type Corner = (i32, i32);

/// The four ways from a corner.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    North,
    South,
    West,
    East,
}

/// In the order in which they are tried.
const WAYS: [Way; 4] = [Way::North, Way::South, Way::West, Way::East];

impl Way {
    const fn bit(self) -> u8 {
        1 << self as u8
    }

    const fn back(self) -> Self {
        match self {
            Self::North => Self::South,
            Self::South => Self::North,
            Self::West => Self::East,
            Self::East => Self::West,
        }
    }

    const fn sides(self) -> [Self; 2] {
        match self {
            Self::North | Self::South => [Self::West, Self::East],
            Self::West | Self::East => [Self::North, Self::South],
        }
    }

    const fn step(self, (column, row): Corner) -> Corner {
        match self {
            Self::North => (column, row - 1),
            Self::South => (column, row + 1),
            Self::West => (column - 1, row),
            Self::East => (column + 1, row),
        }
    }
}

/// The borders that no path has taken yet: at each corner, the ways that they leave it.
struct Borders {
    ways: Vec<u8>,
    /// Corners in a row.
    width: usize,
}

/// All paths of a picture; the border of the picture itself is none.
pub(super) fn paths(labels: &Labels) -> Vec<Vec<Corner>> {
    let mut borders = Borders::new(labels);
    let mut paths = Vec::new();
    let count = |n: u32| i32::try_from(n).expect("a picture has at most 2¹⁶ pixels a side");
    for row in 0..=count(labels.height) {
        for column in 0..=count(labels.width) {
            while borders.left((column, row)) != 0 {
                paths.push(borders.path((column, row)));
            }
        }
    }
    paths
}

impl Borders {
    fn new(picture: &Labels) -> Self {
        let (columns, rows) = (picture.width as usize, picture.height as usize);
        let mut borders = Self { ways: vec![0; (columns + 1) * (rows + 1)], width: columns + 1 };
        let label = |column: usize, row: usize| picture.labels[row * columns + column];
        for row in 0..rows {
            for column in 0..columns {
                let here = label(column, row);
                let corner = row * borders.width + column;
                if column > 0 && label(column - 1, row) != here {
                    borders.ways[corner] |= Way::South.bit();
                    borders.ways[corner + borders.width] |= Way::North.bit();
                }
                if row > 0 && label(column, row - 1) != here {
                    borders.ways[corner] |= Way::East.bit();
                    borders.ways[corner + 1] |= Way::West.bit();
                }
            }
        }
        borders
    }

    #[expect(clippy::cast_sign_loss, reason = "corners are not negative")]
    const fn index(&self, (column, row): Corner) -> usize {
        row as usize * self.width + column as usize
    }

    fn left(&self, corner: Corner) -> u8 {
        self.ways[self.index(corner)]
    }

    fn has(&self, corner: Corner, way: Way) -> bool {
        self.left(corner) & way.bit() != 0
    }

    /// The path through a corner that has borders left.
    fn path(&mut self, start: Corner) -> Vec<Corner> {
        let (tail, head) = self.directions(start);
        let mut path = VecDeque::from([start]);
        if let Some(tail) = tail {
            self.follow(start, tail, |corner| path.push_front(corner));
        }
        if self.has(start, head) {
            self.follow(start, head, |corner| path.push_back(corner));
        }
        path.into()
    }

    /// Which way a path leaves its first corner, backwards (if it does) and forwards.
    fn directions(&self, start: Corner) -> (Option<Way>, Way) {
        let ways: Vec<Way> = WAYS.into_iter().filter(|&way| self.has(start, way)).collect();
        match ways[..] {
            [only] => (None, only),
            [first, second] => (Some(first), second),
            _ if self.has(start, Way::North) && self.has(start, Way::South) => (Some(Way::North), Way::South),
            _ => (Some(Way::West), Way::East),
        }
    }

    /// Takes borders from a corner on, as far as the path goes.
    fn follow(&mut self, start: Corner, first: Way, mut push: impl FnMut(Corner)) {
        let (mut at, mut way) = (start, first);
        loop {
            let next = way.step(at);
            let (from, to) = (self.index(at), self.index(next));
            self.ways[from] &= !way.bit();
            self.ways[to] &= !way.back().bit();
            push(next);
            at = next;
            let [one, other] = way.sides();
            way = match (self.has(at, way), self.has(at, one), self.has(at, other)) {
                (true, _, _) => way,
                (false, true, false) => one,
                (false, false, true) => other,
                (false, true, true) | (false, false, false) => return,
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(rows: &[&str]) -> Labels {
        let count = |n: usize| u32::try_from(n).expect("a small picture");
        Labels {
            labels: rows.iter().flat_map(|row| row.bytes().map(u32::from)).collect(),
            width: count(rows[0].len()),
            height: count(rows.len()),
        }
    }

    #[test]
    fn a_lone_net_has_one_closed_path() {
        let found = paths(&picture(&["....", ".AA.", ".A..", "...."]));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].first(), found[0].last(), "closed");
        assert_eq!(found[0].len(), 9, "eight borders: {found:?}");
    }

    #[test]
    fn the_bar_of_a_t_runs_on() {
        let found = paths(&picture(&["AABB", "AABB", "CCCC"]));
        let mut lengths: Vec<usize> = found.iter().map(|path| path.len() - 1).collect();
        lengths.sort_unstable();
        assert_eq!(lengths, [2, 4], "the stem ends at the bar: {found:?}");
    }

    #[test]
    fn paths_cross_where_four_regions_meet() {
        let found = paths(&picture(&["AABB", "AABB", "CCDD", "CCDD"]));
        assert_eq!(found.iter().map(|path| path.len() - 1).collect::<Vec<_>>(), [4, 4], "{found:?}");
    }
}
