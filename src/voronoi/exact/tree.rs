//! A tree of boxes, of which sixteen are looked at in a few instructions.
//!
//! The boxes of a node lie side by side as four rows of numbers, so that a condition is one for a
//! whole row. They are of single precision round the middle of all, and as much too large as that
//! rounds: what is found is what may be meant, a few nanometres farther out.

use std::array;

use crate::geometry;
use crate::voronoi::plane::{self, Spot};

use super::form::{clockwise, unit};

/// How many boxes a node has.
const WIDTH: usize = 16;

/// An arc has no more pieces. Derived: eighths, and what is left of one.
const OF_ARC: usize = 9;

/// By how much of the largest number single precision may be wrong after a few steps. Derived: its
/// unit is 2⁻²³ of a number.
const ROUNDING: f64 = 1e-6;

/// Left, bottom, right, top.
type Bounds = [f32; 4];

/// No box.
const EMPTY: Bounds = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];

/// Boxes, and of each the number of a node below, or of a box.
struct Node {
    rows: [[f32; WIDTH]; 4],
    below: [u32; WIDTH],
}

/// Boxes of items by place.
///
/// An item may have several: a long slanted line and a large arc are known by pieces, for a box
/// round all of one would lie over much that they are far from.
pub(super) struct Tree {
    bounds: [f64; 4],
    middle: Spot,
    /// Those of boxes first, the root last.
    nodes: Vec<Node>,
    leaves: usize,
    boxes: Vec<Bounds>,
    /// Of each box the item, and how many boxes of it came before.
    pieces: Vec<(u32, u32)>,
}

/// The nearest number of single precision that is no larger.
#[expect(clippy::cast_possible_truncation, reason = "made good at once")]
fn below(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x { near.next_down() } else { near }
}

/// The nearest number of single precision that is no smaller.
fn above(x: f64) -> f32 {
    -below(-x)
}

impl Tree {
    /// The tree of the boxes of items: left, bottom, right, top.
    pub(super) fn new(items: impl Iterator<Item = Vec<[f64; 4]>>) -> Self {
        let (mut exact, mut pieces) = (Vec::new(), Vec::new());
        for (number, boxes) in (0_u32..).zip(items) {
            pieces.extend((0_u32..).take(boxes.len()).map(|before| (number, before)));
            exact.extend(boxes);
        }
        let far = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        let bounds = exact.iter().fold(far, |[a, b, c, d], &[left, bottom, right, top]| {
            [a.min(left), b.min(bottom), c.max(right), d.max(top)]
        });
        let [left, bottom, right, top] = bounds;
        let middle = Spot::new(f64::midpoint(left, right), f64::midpoint(bottom, top));
        let rounded = |&[left, bottom, right, top]: &[f64; 4]| {
            let (min, max) = (Spot::new(left, bottom) - middle, Spot::new(right, top) - middle);
            [below(min.x), below(min.y), above(max.x), above(max.y)]
        };
        let boxes: Vec<Bounds> = exact.iter().map(rounded).collect();
        let mut tree = Self { bounds, middle, nodes: Vec::new(), leaves: 0, boxes, pieces };
        let Some(sorted) = geometry::boxes(exact.into_iter()) else { return tree };
        // By place; what a level has is what the nodes of the level below hold.
        let numbers = &sorted.all_box_indices()[..tree.boxes.len()];
        let mut level: Vec<(Bounds, u32)> = Vec::with_capacity(numbers.len());
        for &number in numbers {
            level.push((tree.boxes[number], u32::try_from(number).expect("below 2³² boxes")));
        }
        drop(sorted);
        loop {
            let first = tree.nodes.len();
            tree.nodes.extend(level.chunks(WIDTH).map(Node::new));
            if first == 0 {
                tree.leaves = tree.nodes.len();
            }
            if tree.nodes.len() == first + 1 {
                return tree;
            }
            level = (0_u32..)
                .zip(&tree.nodes)
                .skip(first)
                .map(|(number, node)| (node.bounds(), number))
                .collect();
        }
    }

    /// The box round all: left, bottom, right, top.
    pub(super) const fn bounds(&self) -> [f64; 4] {
        self.bounds
    }

    /// Shows the items of which a box meets a box, each once.
    pub(super) fn visit(&self, within: [f64; 4], show: impl FnMut(u32)) {
        let [left, bottom, right, top] = within;
        let (min, max) = (Spot::new(left, bottom) - self.middle, Spot::new(right, top) - self.middle);
        let within = [below(min.x), below(min.y), above(max.x), above(max.y)];
        self.visit_where(|bounds| overlap(bounds, within), show);
    }

    /// Shows the items of which a box comes within `reach` of `p`, each once.
    pub(super) fn visit_round(&self, p: Spot, reach: f64, show: impl FnMut(u32)) {
        let (at, rounding) = self.single(p);
        let reach = above(reach + rounding + reach * ROUNDING);
        let squared_reach = reach * reach;
        self.visit_where(|bounds| squared(bounds, at) <= squared_reach, show);
    }

    /// Shows the items of which a box comes within `reach` of a chord, or of the line that it lies on
    /// and of the box round it, each once.
    pub(super) fn visit_along(&self, [from, to]: [Spot; 2], reach: f64, show: impl FnMut(u32)) {
        let ([x, y], rounding) = self.single(from);
        let [left, bottom, right, top] = plane::spanned(from - self.middle, to - self.middle);
        let reach = reach + 4.0 * (rounding + reach * ROUNDING);
        let within = [below(left - reach), below(bottom - reach), above(right + reach), above(top + reach)];
        // Of a box the middle and the extent are known twice.
        let normal = unit(clockwise(to - from)) * 0.5;
        let (a, b) = (above(normal.x), above(normal.y));
        let reach = above(reach);
        self.visit_where(
            |bounds| {
                let [left, bottom, right, top] = bounds;
                let off = a * (left + right - 2.0 * x) + b * (bottom + top - 2.0 * y);
                let extent = a.abs() * (right - left) + b.abs() * (top - bottom);
                overlap(bounds, within) & (off.abs() <= reach + extent)
            },
            show,
        );
    }

    /// A place in single precision, and how far from it boxes may seem to be by rounding alone.
    #[expect(clippy::cast_possible_truncation, reason = "told")]
    fn single(&self, p: Spot) -> ([f32; 2], f64) {
        let [left, bottom, right, top] = self.bounds;
        let at = p - self.middle;
        let largest = at.x.abs().max(at.y.abs()).max(right - left).max(top - bottom);
        ([at.x as f32, at.y as f32], largest * ROUNDING)
    }

    /// Shows the items of which a box meets a condition, each once. What holds two boxes meets it if
    /// either does; and of boxes in a straight row those that meet it are in a row, as with all that
    /// is convex.
    #[inline]
    fn visit_where(&self, meets: impl Fn(Bounds) -> bool, mut show: impl FnMut(u32)) {
        let Some(root) = self.nodes.len().checked_sub(1) else { return };
        let mut open = Vec::with_capacity(64);
        let mut next = Some(root);
        while let Some(number) = next {
            let node = &self.nodes[number];
            let is_leaf = number < self.leaves;
            for i in node.of(&meets) {
                let below = node.below[i] as usize;
                if !is_leaf {
                    open.push(below);
                } else if let Some(item) = self.shown(below, &meets) {
                    show(item);
                }
            }
            next = open.pop();
        }
    }

    /// The item of a box that meets a condition, if no box of it did before.
    fn shown(&self, number: usize, meets: impl Fn(Bounds) -> bool) -> Option<u32> {
        let (item, before) = self.pieces[number];
        let before = before as usize;
        // The pieces of a line are in a straight row.
        let first = number - if before < OF_ARC { before } else { 1 };
        let is_first = !self.boxes[first..number].iter().any(|&bounds| meets(bounds));
        is_first.then_some(item)
    }

    /// Shows items, some more than once, the nearer boxes first but for those together in a node,
    /// until all that are left are farther from `p` than `show` says that anything still matters.
    pub(super) fn visit_nearest(&self, p: Spot, mut show: impl FnMut(u32) -> f64) {
        let Some(root) = self.nodes.len().checked_sub(1) else { return };
        let (at, rounding) = self.single(p);
        // Farther squared than this nothing matters.
        let mut limit = f32::INFINITY;
        let mut open = Vec::with_capacity(64);
        open.push((0.0, root));
        while let Some((off, number)) = open.pop() {
            if off > limit {
                continue;
            }
            let node = &self.nodes[number];
            let before = open.len();
            let [left, bottom, right, top] = &node.rows;
            let mut offs = [0.0; WIDTH];
            for i in 0..WIDTH {
                offs[i] = squared([left[i], bottom[i], right[i], top[i]], at);
            }
            for (off, &below) in offs.into_iter().zip(&node.below) {
                if off > limit || off.is_infinite() {
                    continue;
                }
                if number >= self.leaves {
                    open.push((off, below as usize));
                    continue;
                }
                let reach = show(self.pieces[below as usize].0);
                let reach = above(reach + rounding + reach * ROUNDING);
                limit = reach * reach;
            }
            open[before..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
    }
}

impl Node {
    fn new(boxes: &[(Bounds, u32)]) -> Self {
        let bounds = |i: usize| boxes.get(i).map_or(EMPTY, |entry| entry.0);
        Self {
            rows: array::from_fn(|row| array::from_fn(|i| bounds(i)[row])),
            below: array::from_fn(|i| boxes.get(i).map_or(0, |entry| entry.1)),
        }
    }

    #[inline]
    fn bounds_of(&self, i: usize) -> Bounds {
        array::from_fn(|row| self.rows[row][i])
    }

    fn bounds(&self) -> Bounds {
        (0..WIDTH).fold(EMPTY, |[a, b, c, d], i| {
            let [left, bottom, right, top] = self.bounds_of(i);
            [a.min(left), b.min(bottom), c.max(right), d.max(top)]
        })
    }

    /// Which of its boxes meet a condition.
    #[inline]
    fn of(&self, meets: impl Fn(Bounds) -> bool) -> impl Iterator<Item = usize> {
        let [left, bottom, right, top] = &self.rows;
        let mut met = [0; WIDTH];
        for i in 0..WIDTH {
            met[i] = u8::from(meets([left[i], bottom[i], right[i], top[i]]));
        }
        let mut met = u128::from_le_bytes(met);
        std::iter::from_fn(move || {
            let first = met.trailing_zeros();
            met &= met.wrapping_sub(1);
            (first < u128::BITS).then_some(first as usize / 8)
        })
    }
}

/// Whether two boxes meet.
#[inline]
fn overlap([a, b, c, d]: Bounds, [left, bottom, right, top]: Bounds) -> bool {
    (a <= right) & (c >= left) & (b <= top) & (d >= bottom)
}

/// How far a box is from a place, squared.
#[inline]
fn squared([left, bottom, right, top]: Bounds, [x, y]: [f32; 2]) -> f32 {
    let out = |low: f32, high: f32, at: f32| {
        let (under, over) = (low - at, at - high);
        let out = if under > over { under } else { over };
        if out > 0.0 { out } else { 0.0 }
    };
    let (x, y) = (out(left, right, x), out(bottom, top, y));
    x * x + y * y
}
