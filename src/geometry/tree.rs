//! A tree of boxes, sixteen of which are looked at in a few instructions.
//!
//! ```text
//!              node: left    ▏16 numbers▕        Boxes lie side by side as four rows of numbers, so that one condition is asked
//!                    bottom  ▏          ▕        of a whole row. They are of single precision about the middle of all, and
//!                    right   ▏          ▕        larger by what that rounds: what is found is all that meets a region, and some
//!                    top     ▏          ▕        of what lies up to some tens of nanometres beside it.
//! ```

use std::array;
use std::iter;
use std::ops::ControlFlow;

use static_aabb2d_index::StaticAABB2DIndexBuilder;

/// How many boxes a node has: those of the packed R-tree that it is made from.
const WIDTH: usize = 16;

/// By how much of the largest number single precision may be wrong after a few steps. Derived: its
/// unit is 2⁻²³ of a number.
const ROUNDING: f64 = 1e-6;

/// Left, bottom, right, top, round the middle of a tree.
type Bounds = [f32; 4];

/// No box.
const EMPTY: Bounds = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];

/// Boxes side by side, and of each the number of a node below, or of a box.
#[derive(Debug)]
struct Node {
    rows: [[f32; WIDTH]; 4],
    below: [u32; WIDTH],
    count: u8,
}

/// Boxes by place, numbered as they come: a packed R-tree, filled once.
#[derive(Debug, Default)]
pub(crate) struct BoxTree {
    bounds: [f64; 4],
    middle: (f64, f64),
    /// Those of boxes first, the root last.
    nodes: Vec<Node>,
    leaves: usize,
}

/// A part of a tree, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Met {
    /// A node, with all that is below it.
    Node(usize),
    /// A box.
    Box(usize),
}

/// A region of the plane, as a tree knows it.
pub(crate) trait Region {
    /// Whether a box of the tree meets it.
    fn meets(&self, bounds: Bounds) -> bool;
}

/// What lies in a rectangle.
pub(crate) struct Window(Bounds);

/// What lies within a distance of a place.
pub(crate) struct Round {
    at: [f32; 2],
    squared: f32,
}

/// What lies within a distance of a line, and round a place on it.
pub(crate) struct Swath {
    round: Round,
    /// Half of the unit normal: of a box the middle and the extent are known twice.
    normal: [f32; 2],
    reach: f32,
}

impl Region for Window {
    #[inline(always)]
    fn meets(&self, [left, bottom, right, top]: Bounds) -> bool {
        let Self([a, b, c, d]) = *self;
        (a <= right) & (c >= left) & (b <= top) & (d >= bottom)
    }
}

impl Region for Round {
    #[inline(always)]
    fn meets(&self, bounds: Bounds) -> bool {
        squared(bounds, self.at) <= self.squared
    }
}

impl Region for Swath {
    #[inline(always)]
    fn meets(&self, bounds: Bounds) -> bool {
        let [left, bottom, right, top] = bounds;
        let ([x, y], [a, b]) = (self.round.at, self.normal);
        let off = a * (left + right - 2.0 * x) + b * (bottom + top - 2.0 * y);
        let extent = a.abs() * (right - left) + b.abs() * (top - bottom);
        self.round.meets(bounds) & (off.abs() <= self.reach + extent)
    }
}

/// How far a box is from a place, squared.
#[inline(always)]
fn squared([left, bottom, right, top]: Bounds, [x, y]: [f32; 2]) -> f32 {
    let out = |low: f32, high: f32, at: f32| {
        let (under, over) = (low - at, at - high);
        let out = if under > over { under } else { over };
        if out > 0.0 { out } else { 0.0 }
    };
    let (x, y) = (out(left, right, x), out(bottom, top, y));
    x * x + y * y
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

/// The box round two.
fn both(a: Bounds, b: Bounds) -> Bounds {
    [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

/// Boxes with their numbers, in an order in which neighbours are close to each other.
fn sorted(boxes: &[Bounds]) -> Vec<(Bounds, u32)> {
    let mut builder = StaticAABB2DIndexBuilder::new_with_node_size(boxes.len(), WIDTH);
    for &[left, bottom, right, top] in boxes {
        builder.add(left, bottom, right, top);
    }
    let sorted = builder.build();
    let numbers = sorted.iter().flat_map(|sorted| &sorted.all_box_indices()[..boxes.len()]);
    let entry = |&number: &usize| (boxes[number], u32::try_from(number).expect("below 2³² boxes"));
    numbers.map(entry).collect()
}

/// How many nodes a tree of `boxes` has.
fn nodes_of(boxes: usize) -> usize {
    let levels =
        iter::successors(Some(boxes.div_ceil(WIDTH)), |&nodes| (nodes > 1).then(|| nodes.div_ceil(WIDTH)));
    levels.sum()
}

impl BoxTree {
    /// The tree of boxes: left, bottom, right, top.
    pub(crate) fn new(boxes: impl ExactSizeIterator<Item = [f64; 4]> + Clone) -> Self {
        let far = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        let bounds = boxes.clone().fold(far, |[a, b, c, d], [left, bottom, right, top]| {
            [a.min(left), b.min(bottom), c.max(right), d.max(top)]
        });
        let [left, bottom, right, top] = bounds;
        let middle = (f64::midpoint(left, right), f64::midpoint(bottom, top));
        let mut tree = Self { bounds, middle, nodes: Vec::new(), leaves: 0 };
        let mut level = sorted(&boxes.map(|bounds| tree.single(bounds)).collect::<Vec<Bounds>>());
        tree.nodes.reserve_exact(nodes_of(level.len()));
        while !level.is_empty() {
            let first = tree.nodes.len();
            tree.nodes.extend(level.chunks(WIDTH).map(Node::new));
            if first == 0 {
                tree.leaves = tree.nodes.len();
            }
            let is_root = tree.nodes.len() == first + 1;
            let made = (0_u32..).zip(&tree.nodes).skip(first);
            level = if is_root { Vec::new() } else { made.map(|(i, node)| (node.bounds(), i)).collect() };
        }
        tree
    }

    /// The box round all: left, bottom, right, top.
    pub(crate) const fn bounds(&self) -> [f64; 4] {
        self.bounds
    }

    /// The numbers of all boxes, neighbours close to each other.
    pub(crate) fn order(&self) -> impl Iterator<Item = usize> {
        let leaves = self.nodes[..self.leaves].iter();
        leaves.flat_map(|node| &node.below[..node.count.into()]).map(|&number| number as usize)
    }

    /// What lies in a rectangle: left, bottom, right, top.
    pub(crate) fn window(&self, within: [f64; 4]) -> Window {
        Window(self.single(within))
    }

    /// What lies within `reach` of a place.
    pub(crate) fn round(&self, p: (f64, f64), reach: f64) -> Round {
        let (at, rounding) = self.place(p);
        let reach = above(reach + rounding + reach * ROUNDING);
        Round { at, squared: reach * reach }
    }

    /// What lies within `reach` of the line of a chord, and no farther beyond its ends.
    pub(crate) fn along(&self, [from, to]: [(f64, f64); 2], reach: f64) -> Swath {
        let middle = (f64::midpoint(from.0, to.0), f64::midpoint(from.1, to.1));
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = (x * x + y * y).sqrt();
        let round = self.round(middle, reach + length / 2.0);
        let (_, rounding) = self.place(middle);
        let twice = 2.0 * length;
        let normal = if twice > 0.0 { [above(y / twice), above(-x / twice)] } else { [0.0; 2] };
        Swath { round, normal, reach: above(reach + 4.0 * (rounding + reach * ROUNDING)) }
    }

    /// A rectangle as the tree knows it, no smaller.
    fn single(&self, [left, bottom, right, top]: [f64; 4]) -> Bounds {
        let (x, y) = self.middle;
        [below(left - x), below(bottom - y), above(right - x), above(top - y)]
    }

    /// A place in single precision, and how far from it boxes may seem to be by rounding alone.
    fn place(&self, (x, y): (f64, f64)) -> ([f32; 2], f64) {
        let [left, bottom, right, top] = self.bounds;
        let (x, y) = (x - self.middle.0, y - self.middle.1);
        let largest = x.abs().max(y.abs()).max(right - left).max(top - bottom);
        ([below(x), below(y)], largest * ROUNDING)
    }

    /// Shows the boxes that meet a region, for as long as `show` goes on. The order depends on the
    /// boxes alone.
    pub(crate) fn visit<B>(
        &self,
        region: &impl Region,
        mut show: impl FnMut(usize) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let root = self.nodes.len().checked_sub(1);
        root.map_or(ControlFlow::Continue(()), |root| self.visit_below(root, region, &mut show))
    }

    /// The same of the boxes below a node.
    fn visit_below<B>(
        &self,
        number: usize,
        region: &impl Region,
        show: &mut impl FnMut(usize) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let node = &self.nodes[number];
        // A byte of each box.
        let mut met = node.meeting(region);
        while met != 0 {
            let below = node.below[met.trailing_zeros() as usize / 8] as usize;
            met &= met - 1;
            if number < self.leaves {
                show(below)?;
            } else {
                self.visit_below(below, region, show)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Shows the nodes that meet a region, and the boxes below those of which `enters` says true.
    pub(crate) fn visit_entered(&self, region: &impl Region, enters: &mut impl FnMut(Met) -> bool) {
        if let Some(root) = self.nodes.len().checked_sub(1)
            && enters(Met::Node(root))
        {
            self.enter(root, region, enters);
        }
    }

    fn enter(&self, number: usize, region: &impl Region, enters: &mut impl FnMut(Met) -> bool) {
        let node = &self.nodes[number];
        let mut met = node.meeting(region);
        while met != 0 {
            let below = node.below[met.trailing_zeros() as usize / 8] as usize;
            met &= met - 1;
            if number < self.leaves {
                enters(Met::Box(below));
            } else if enters(Met::Node(below)) {
                self.enter(below, region, enters);
            }
        }
    }

    /// How many nodes there are.
    pub(crate) const fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// What is below a node.
    pub(crate) fn below(&self, number: usize) -> impl Iterator<Item = Met> {
        let node = &self.nodes[number];
        let met = if number < self.leaves { Met::Box } else { Met::Node };
        node.below[..node.count.into()].iter().map(move |&below| met(below as usize))
    }

    /// Shows the boxes that meet a rectangle: left, bottom, right, top.
    pub(crate) fn visit_window(&self, within: [f64; 4], mut show: impl FnMut(usize)) {
        let _: ControlFlow<()> = self.visit(&self.window(within), |number| {
            show(number);
            ControlFlow::Continue(())
        });
    }

    /// Whether a box meets a rectangle: left, bottom, right, top.
    pub(crate) fn meets(&self, within: [f64; 4]) -> bool {
        self.visit(&self.window(within), ControlFlow::Break).is_break()
    }

    /// The boxes that meet a rectangle, in their order.
    pub(crate) fn within(&self, within: [f64; 4]) -> Vec<usize> {
        let mut found = Vec::new();
        self.visit_window(within, |number| found.push(number));
        found.sort_unstable();
        found
    }

    /// Shows boxes within `reach` of `p`, the nearer ones first but for those together in a node,
    /// until all that are left are farther than `show` says that anything still matters.
    pub(crate) fn visit_nearest(&self, p: (f64, f64), reach: f64, mut show: impl FnMut(usize) -> f64) {
        let Some(root) = self.nodes.len().checked_sub(1) else { return };
        let (at, rounding) = self.place(p);
        // Farther squared than this nothing matters.
        let squared = |reach: f64| {
            let reach = above(reach + rounding + reach * ROUNDING);
            reach * reach
        };
        let mut limit = squared(reach);
        let mut open = Vec::with_capacity(64);
        open.push((0.0, root));
        while let Some((off, number)) = open.pop() {
            if off > limit {
                continue;
            }
            let node = &self.nodes[number];
            let before = open.len();
            for (&off, &below) in node.offs(at).iter().zip(&node.below).take(node.count.into()) {
                if off > limit {
                    continue;
                }
                if number >= self.leaves {
                    open.push((off, below as usize));
                    continue;
                }
                limit = squared(show(below as usize));
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
            count: u8::try_from(boxes.len()).expect("no more than a node has"),
        }
    }

    fn bounds(&self) -> Bounds {
        let [left, bottom, right, top] = &self.rows;
        (0..WIDTH).fold(EMPTY, |all, i| both(all, [left[i], bottom[i], right[i], top[i]]))
    }

    /// Which of its boxes meet a region: a byte each, one where it does, the first the least.
    #[inline(always)]
    fn meeting(&self, region: &impl Region) -> u128 {
        let [left, bottom, right, top] = &self.rows;
        let mut met = [0; WIDTH];
        // A loop that compilers turn into one over lanes.
        for i in 0..WIDTH {
            met[i] = u8::from(region.meets([left[i], bottom[i], right[i], top[i]]));
        }
        u128::from_le_bytes(met) & (u128::MAX >> (u128::BITS - 8 * u32::from(self.count)))
    }

    /// How far its boxes are from a place, squared.
    #[inline(always)]
    fn offs(&self, at: [f32; 2]) -> [f32; WIDTH] {
        let [left, bottom, right, top] = &self.rows;
        let mut offs = [0.0; WIDTH];
        for i in 0..WIDTH {
            offs[i] = squared([left[i], bottom[i], right[i], top[i]], at);
        }
        offs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes by chance, up to a metre wide, most small.
    fn boxes(count: usize) -> Vec<[f64; 4]> {
        let mut state = 7;
        let mut below = |bound: u64| {
            state = crate::topology::splitmix(state);
            f64::from(u32::try_from(state % bound).expect("small"))
        };
        let mut bounds = || {
            let [x, y] = [below(1_000_000_000), below(1_000_000_000)];
            let size = if below(10) < 1.0 { 1_000_000_000 } else { 3_000_000 };
            [x, y, x + below(size), y + below(size)]
        };
        (0..count).map(|_| bounds()).collect()
    }

    fn off([left, bottom, right, top]: [f64; 4], (x, y): (f64, f64)) -> f64 {
        let (x, y) = ((left - x).max(x - right).max(0.0), (bottom - y).max(y - top).max(0.0));
        (x * x + y * y).sqrt()
    }

    fn found(tree: &BoxTree, region: &impl Region) -> Vec<usize> {
        let mut found = Vec::new();
        let _: ControlFlow<()> = tree.visit(region, |number| {
            found.push(number);
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        found
    }

    #[test]
    fn all_that_meets_a_region_is_found_once_and_little_else() {
        for count in [0, 1, 15, 16, 17, 256, 257, 3000] {
            let boxes = boxes(count);
            let tree = BoxTree::new(boxes.iter().copied());
            for place in 0_u32..60 {
                let p = (f64::from(place % 8) * 1.4e8, f64::from(place / 8) * 1.5e8);
                let reach = [0.0, 1e6, 5e7, 3e8][place as usize % 4];
                let at = |far: f64| (0..count).filter(|&i| off(boxes[i], p) <= far).collect::<Vec<_>>();
                let near = found(&tree, &tree.round(p, reach));
                assert!(at(reach).iter().all(|i| near.contains(i)), "overlooked at {p:?}");
                assert!(near.iter().all(|i| at(reach * 1.00001 + 3000.0).contains(i)), "too far from {p:?}");
                let to = (p.0 + reach, p.1 - 2.0 * reach);
                let along = found(&tree, &tree.along([p, to], reach));
                let is_near = |i: usize| {
                    (0_u8..=50).any(|part| {
                        let part = f64::from(part) / 50.0;
                        off(boxes[i], (p.0 + part * reach, p.1 - 2.0 * part * reach)) <= reach
                    })
                };
                assert!((0..count).all(|i| !is_near(i) || along.contains(&i)), "overlooked along {p:?}");
                assert!(along.windows(2).all(|pair| pair[0] < pair[1]));
                let window = [p.0 - reach, p.1, p.0, p.1 + reach];
                let within = found(&tree, &tree.window(window));
                let meets = |[a, b, c, d]: [f64; 4]| {
                    a <= window[2] && c >= window[0] && b <= window[3] && d >= window[1]
                };
                assert!((0..count).all(|i| !meets(boxes[i]) || within.contains(&i)));
                assert_eq!(tree.meets(window), !within.is_empty());
            }
        }
    }

    #[test]
    fn everywhere_is_a_window() {
        let tree = BoxTree::new(boxes(20).into_iter());
        let all = found(&tree, &tree.window([f64::MIN, f64::MIN, f64::MAX, f64::MAX]));
        assert_eq!(all, (0..20).collect::<Vec<_>>());
    }

    #[test]
    fn the_nearest_box_is_shown_before_what_is_far() {
        let boxes = boxes(2000);
        let tree = BoxTree::new(boxes.iter().copied());
        for place in 0_u32..50 {
            let p = (f64::from(place) * 2e7, f64::from(place * 37 % 50) * 2e7);
            let (mut nearest, mut shown) = (f64::INFINITY, 0);
            tree.visit_nearest(p, f64::INFINITY, |i| {
                shown += 1;
                nearest = nearest.min(off(boxes[i], p));
                nearest
            });
            let least = boxes.iter().map(|&bounds| off(bounds, p)).fold(f64::INFINITY, f64::min);
            assert!((nearest - least).abs() < 1e-3);
            assert!(shown < 1000, "{shown} were asked");
        }
    }
}
