//! Where copper goes on beyond a window, and whether it still does once cuts are taken from it.

use super::pieces::Run;

/// Whether each stretch of a window's border that copper crosses is still crossed somewhere.
///
/// A trace that is cut away from its middle to the border is one piece after as before; what lies
/// beyond the border tells that it is parted, and is not in the window.
#[derive(Debug, Default)]
pub(super) struct Border {
    left: Crossing,
    right: Crossing,
    lost: bool,
}

/// A stretch of a side, down to the row that was taken last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Crossing {
    /// No copper is there.
    #[default]
    None,
    /// Some was, so far.
    Gone,
    /// Some is.
    Kept,
}

impl Border {
    /// Takes the next row of a window so many pixels wide: its copper before the cuts, and after.
    pub(super) fn row(&mut self, width: u32, before: &[Run], after: &[Run]) {
        let at_left = |runs: &[Run]| runs.first().is_some_and(|run| run.start == 0);
        let at_right = |runs: &[Run]| runs.last().is_some_and(|run| run.end == width);
        self.lost |= self.left.go_on(at_left(before), at_left(after));
        self.lost |= self.right.go_on(at_right(before), at_right(after));
    }

    /// Takes what crosses the border above the first row, or below the last.
    pub(super) fn side(&mut self, before: &[Run], after: &[Run]) {
        let is_kept = |run: &Run| after.iter().any(|left| left.start < run.end && run.start < left.end);
        self.lost |= !before.iter().all(is_kept);
    }

    /// Whether some stretch is crossed no longer.
    pub(super) fn is_lost(&self) -> bool {
        self.lost || self.left == Crossing::Gone || self.right == Crossing::Gone
    }
}

impl Crossing {
    /// Goes on by a row; whether a stretch has ended that is crossed no longer.
    fn go_on(&mut self, before: bool, after: bool) -> bool {
        let is_lost = !before && *self == Self::Gone;
        *self = match before {
            false => Self::None,
            true if after || *self == Self::Kept => Self::Kept,
            true => Self::Gone,
        };
        is_lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The runs of a row of pixels.
    fn runs(row: &str) -> Vec<Run> {
        let is_copper = |column: usize| row.as_bytes()[column] == b'#';
        let begins = |&column: &usize| is_copper(column) && (column == 0 || !is_copper(column - 1));
        let end = |start: usize| (start..row.len()).find(|&column| !is_copper(column)).unwrap_or(row.len());
        let number = |column: usize| u32::try_from(column).expect("a short row");
        (0..row.len())
            .filter(begins)
            .map(|start| Run { start: number(start), end: number(end(start)), label: 0 })
            .collect()
    }

    fn is_lost(before: &[&str], after: &[&str]) -> bool {
        let mut border = Border::default();
        for (before, after) in before.iter().zip(after) {
            border.row(5, &runs(before), &runs(after));
        }
        for row in [0, before.len() - 1] {
            border.side(&runs(before[row]), &runs(after[row]));
        }
        border.is_lost()
    }

    #[test]
    fn a_trace_must_go_on_wherever_it_did() {
        let trace = [".....", "#####", "#####", "....."];
        assert!(!is_lost(&trace, &trace), "nothing is cut");
        assert!(!is_lost(&trace, &[".....", "###..", "#####", "....."]), "it is shaved");
        assert!(is_lost(&trace, &[".....", "##...", "##...", "....."]), "to the right it ends");
        assert!(is_lost(&trace, &[".....", "...##", "...##", "....."]), "to the left");
        let upright = [".##..", ".##..", ".##..", ".##.."];
        assert!(!is_lost(&upright, &[".##..", ".#...", ".#...", ".#..."]), "it is shaved");
        assert!(is_lost(&upright, &[".##..", ".##..", ".....", "....."]), "downwards it ends");
        assert!(is_lost(&upright, &[".....", ".##..", ".##..", ".##.."]), "upwards");
    }

    #[test]
    fn each_of_two_traces_must_go_on() {
        let two = ["#....", "#....", ".....", "##..."];
        assert!(is_lost(&two, &[".....", ".....", ".....", "##..."]), "the first does not");
        assert!(is_lost(&two, &["#....", "#....", ".....", ".#..."]), "the other does not");
    }
}
