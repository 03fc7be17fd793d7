//! What is left of areas beside what a mill swept: row by row, each run between two places being
//! exact.
//!
//! ```text
//!   row  ├──────┤▒▒▒▒├────────┤▒▒├──┤    areas less sweeps: runs, and runs that touch in neighbouring rows are one piece
//! ```

use rayon::prelude::*;

use crate::geometry::{Point, Polygon, merge, off_segment, spanned};
use crate::topology::DisjointSets;
use crate::verify::boxes::Tree;
use crate::verify::edges::{Edges, length};

/// A point in nanometres.
pub(super) type Spot = (f64, f64);

/// A level motion of a cylinder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep {
    pub(super) from: Spot,
    pub(super) to: Spot,
    pub(super) radius: f64,
    /// How deep the mill is, downwards.
    pub(super) depth: f64,
    /// How many motions came before.
    pub(super) order: usize,
}

impl Sweep {
    /// From where to where a row at height `y` is swept.
    fn run(&self, y: f64) -> Option<(f64, f64)> {
        let (a, b, r) = (self.from, self.to, self.radius);
        let mut run: Option<(f64, f64)> = None;
        let mut add = |x0: f64, x1: f64| {
            let (low, high) = run.unwrap_or((x0, x1));
            run = Some((low.min(x0), high.max(x1)));
        };
        for end in [a, b] {
            let off = y - end.1;
            if off.abs() <= r {
                let half = (r * r - off * off).sqrt();
                add(end.0 - half, end.0 + half);
            }
        }
        let way = (b.0 - a.0, b.1 - a.1);
        let whole = length(way);
        if whole > 0.0 {
            let out = (way.1 / whole * r, -way.0 / whole * r);
            for (p, q) in [(a.0 + out.0, a.1 + out.1), (a.0 - out.0, a.1 - out.1)]
                .map(|p| (p, (p.0 + way.0, p.1 + way.1)))
            {
                if (p.1 > y) != (q.1 > y) {
                    let x = p.0 + (y - p.1) / (q.1 - p.1) * (q.0 - p.0);
                    add(x, x);
                }
            }
        }
        run
    }

    fn holds(&self, p: Spot) -> bool {
        length(off_segment(p, self.from, self.to)) <= self.radius
    }
}

/// Level motions by depth, the deepest first, and by place.
pub(super) struct Sweeps {
    groups: Vec<Group>,
}

/// Motions about as deep as each other.
struct Group {
    sweeps: Vec<Sweep>,
    /// Each box knows the least number of a motion in it.
    tree: Option<Tree<usize>>,
    deepest: f64,
}

/// No place is so far away. In nanometres: ten metres. Chosen.
const FAR: f64 = 1e10;

/// So many motions of other depths are a group of their own, at least, and so many groups there
/// are at most. Chosen: a mill has some ten layers, and ramps between them.
const FEWEST: usize = 64;
const MOST_GROUPS: usize = 64;

impl Sweeps {
    pub(super) fn new(mut sweeps: Vec<Sweep>) -> Self {
        sweeps.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        let fewest = FEWEST.max(sweeps.len() / MOST_GROUPS);
        // Where each group begins.
        let mut starts: Vec<usize> = Vec::new();
        let mut next = 0;
        for level in sweeps.chunk_by(|a, b| a.depth.total_cmp(&b.depth).is_eq()) {
            if starts.last().is_none_or(|start| next - start >= fewest) {
                starts.push(next);
            }
            next += level.len();
        }
        let mut groups: Vec<Group> = Vec::with_capacity(starts.len());
        for start in starts.into_iter().rev() {
            let mut group = sweeps.split_off(start);
            group.shrink_to_fit();
            groups.push(Group::new(group));
        }
        groups.reverse();
        Self { groups }
    }

    /// Those of which some are no less deep than `least`.
    fn deep(&self, least: f64) -> &[Group] {
        &self.groups[..self.groups.partition_point(|group| group.deepest >= least)]
    }

    /// Whether a place was swept before a motion, no less deep than `least`.
    pub(super) fn clear(&self, p: Spot, least: f64, before: usize) -> bool {
        let is_one = |sweep: &Sweep| sweep.depth >= least && sweep.holds(p);
        // The layer above was swept as a whole.
        let mut groups = self.deep(least).iter().rev();
        groups.any(|group| group.visit([p.0, p.1, p.0, p.1], before, |sweep| !is_one(sweep)))
    }

    /// How deep a place was swept before a motion; zero where it was not.
    pub(super) fn deepest(&self, p: Spot, before: usize) -> f64 {
        let mut deepest = 0.0_f64;
        for group in &self.groups {
            if group.deepest <= deepest {
                break;
            }
            group.visit([p.0, p.1, p.0, p.1], before, |sweep| {
                if sweep.depth > deepest && sweep.holds(p) {
                    deepest = sweep.depth;
                }
                deepest < group.deepest
            });
        }
        deepest
    }

    /// The runs of a row that are swept no less deep than `least`, sorted; none meets another.
    fn row(&self, y: f64, least: f64) -> Vec<(f64, f64)> {
        let mut runs: Vec<(f64, f64)> = Vec::new();
        // Motions come with those beside them, which sweep most of the same.
        let mut add = |run: (f64, f64)| match runs.last_mut() {
            Some(last) if run.0 <= last.1 && run.1 >= last.0 => {
                *last = (last.0.min(run.0), last.1.max(run.1));
            }
            Some(_) | None => runs.push(run),
        };
        for group in self.deep(least) {
            group.visit([-FAR, y, FAR, y], usize::MAX, |sweep| {
                if let Some(run) = sweep.run(y).filter(|_| sweep.depth >= least) {
                    add(run);
                }
                true
            });
        }
        runs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        merge(&mut runs);
        runs
    }
}

impl Group {
    /// Motions, the deepest first.
    fn new(sweeps: Vec<Sweep>) -> Self {
        let reach = |sweep: &Sweep| {
            let ([left, bottom, right, top], radius) = (spanned(sweep.from, sweep.to), sweep.radius);
            ([left - radius, bottom - radius, right + radius, top + radius], sweep.order)
        };
        let tree = Tree::new(sweeps.iter().map(reach), usize::min);
        Self { deepest: sweeps[0].depth, sweeps, tree }
    }

    /// Shows motions before one that may touch a window (left, bottom, right, top), for as long as
    /// `show` says to go on; whether it was stopped.
    fn visit(&self, window: [f64; 4], before: usize, mut show: impl FnMut(&Sweep) -> bool) -> bool {
        let Some(tree) = &self.tree else { return false };
        let mut goes_on = true;
        tree.visit(|[left, bottom, right, top], &first, number| {
            let is_near = left <= window[2] && right >= window[0] && bottom <= window[3] && top >= window[1];
            let may_be = goes_on && is_near && first < before;
            if let Some(number) = number.filter(|_| may_be) {
                goes_on = show(&self.sweeps[number]);
            }
            may_be
        });
        !goes_on
    }
}

/// A connected piece of what is left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Somewhere in its longest run.
    pub(super) at: Point,
    pub(super) mm2: f64,
}

/// The pieces of areas that are not swept as deep as `least`, the largest first, seen in rows so
/// far apart.
pub(super) fn left(areas: &[Polygon], sweeps: &Sweeps, least: f64, pitch: f64) -> Vec<Piece> {
    let bounds = areas.iter().map(Polygon::bounds).reduce(crate::geometry::Rect::union);
    let Some(bounds) = bounds else { return Vec::new() };
    let edges = Edges::new(areas);
    let (bottom, top) = (bounds.min().y.to_f64(), bounds.max().y.to_f64());
    let count = rows((top - bottom) / pitch);
    // Off the grid that drawings are on.
    let height = |row: u32| bottom + (f64::from(row) + 0.381_966) * pitch;
    let found: Vec<Vec<(f64, f64)>> = (0..count)
        .into_par_iter()
        .map(|row| {
            let y = height(row);
            let mut crossings = edges.crossings(y);
            crossings.sort_by(f64::total_cmp);
            let (inside, _) = crossings.as_chunks::<2>();
            remaining(inside, &sweeps.row(y, least))
        })
        .collect();
    let mut pieces = Pieces::default();
    for (row, runs) in (0..).zip(&found) {
        pieces.add(height(row), runs, pitch);
    }
    pieces.finish()
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn rows(number: f64) -> u32 {
    number.ceil() as u32
}

/// What of some runs others leave, which are sorted and do not meet.
fn remaining(inside: &[[f64; 2]], swept: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut found = Vec::new();
    for &[from, to] in inside {
        let mut at = from;
        let first = swept.partition_point(|run| run.1 < from);
        for &(low, high) in &swept[first..] {
            if low >= to {
                break;
            }
            if low > at {
                found.push((at, low));
            }
            at = at.max(high);
        }
        if at < to {
            found.push((at, to));
        }
    }
    found
}

/// Pieces while rows are added.
#[derive(Default)]
struct Pieces {
    /// Which of them are one.
    sets: DisjointSets,
    /// The area, the longest run and its middle, of each.
    sizes: Vec<(f64, f64, Spot)>,
    /// The runs of the row before, with their pieces.
    before: Vec<(f64, f64, u32)>,
}

impl Pieces {
    fn add(&mut self, y: f64, runs: &[(f64, f64)], pitch: f64) {
        let before = std::mem::take(&mut self.before);
        let mut first = 0;
        for &(low, high) in runs {
            let piece = self.sets.push();
            self.sizes.push(((high - low) * pitch, high - low, (f64::midpoint(low, high), y)));
            while first < before.len() && before[first].1 < low {
                first += 1;
            }
            for &(_, _, other) in before[first..].iter().take_while(|run| run.0 <= high) {
                self.sets.union(piece, other);
            }
            self.before.push((low, high, piece));
        }
    }

    fn finish(self) -> Vec<Piece> {
        let mut whole: Vec<(f64, f64, Spot)> = vec![(0.0, 0.0, (0.0, 0.0)); self.sizes.len()];
        for (root, (area, run, at)) in self.sets.representatives().into_iter().zip(self.sizes) {
            let known = &mut whole[root as usize];
            let (sum, longest, place) = *known;
            *known = (sum + area, longest.max(run), if run > longest { at } else { place });
        }
        let mut found: Vec<Piece> = whole
            .into_iter()
            .filter(|&(area, ..)| area > 0.0)
            .map(|(area, _, (x, y))| Piece { at: Point::from_f64(x, y), mm2: area / 1e12 })
            .collect();
        found.sort_by(|a, b| b.mm2.total_cmp(&a.mm2).then(a.at.cmp(&b.at)));
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Nm, Rect};

    #[test]
    fn what_is_left_of_a_square_is_its_area_less_that_of_the_sweep() {
        let square =
            Polygon::rectangle(Rect::new(Point::default(), Point::new(Nm::from_mm(4), Nm::from_mm(4))));
        let sweep = Sweep { from: (1e6, 2e6), to: (3e6, 2e6), radius: 5e5, depth: 1.0, order: 0 };
        let left = left(&[square], &Sweeps::new(vec![sweep]), 1.0, 2_000.0);
        let expected = 16.0 - 2.0 - std::f64::consts::PI * 0.25;
        assert_eq!(left.len(), 1, "one piece round it");
        assert!((left[0].mm2 - expected).abs() < 0.01, "{} and {expected} mm²", left[0].mm2);
    }

    #[test]
    fn slanted_sweeps_and_pieces_apart() {
        let square =
            Polygon::rectangle(Rect::new(Point::default(), Point::new(Nm::from_mm(4), Nm::from_mm(4))));
        let sweep = Sweep { from: (-1e6, -1e6), to: (5e6, 5e6), radius: 5e5, depth: 1.0, order: 0 };
        let left = left(&[square], &Sweeps::new(vec![sweep]), 1.0, 2_000.0);
        // Two triangles with legs of 4 mm less 0.5 mm times the root of two.
        let leg = 4.0 - 0.5 * 2.0_f64.sqrt();
        assert_eq!(left.len(), 2, "one on either side: {left:?}");
        assert!(left.iter().all(|piece| (piece.mm2 - leg * leg / 2.0).abs() < 0.01), "{left:?}");
    }
}
