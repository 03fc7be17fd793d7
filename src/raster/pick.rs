//! All fragments at one pixel, nearest first: the paper's 3-D pick.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::primitive::Bounds;
use super::{Fragment, Scene};

/// A scene made ready to be asked what lies at a pixel.
///
/// A hierarchy of boxes around the primitives. Building it takes O(n log n); the first fragment of
/// a pick is found in about O(log n), and each further one costs as much, so that taking a few is
/// cheap even where every primitive reaches the pixel.
///
/// # Examples
///
/// ```
/// use voromill::raster::{Label, Picker, PixelPoint, Scene, Surface};
///
/// let mut scene = Scene::new(100, 100);
/// for (label, x) in [(1, 20), (2, 60)] {
///     scene.add(Label(label), Surface::Cone { apex: PixelPoint::from_pixels(x, 50), offset: 0.0, limit: None });
/// }
/// let labels: Vec<_> = Picker::new(&scene).pick(70, 50).map(|fragment| fragment.label.0).collect();
/// assert_eq!(labels, [2, 1], "nearest first");
/// ```
#[derive(Debug)]
pub struct Picker<'a> {
    scene: &'a Scene,
    /// A complete binary tree: the children of node i are 2 i + 1 and 2 i + 2, the leaves are the
    /// last.
    nodes: Vec<Bounds>,
    /// Primitives, as the leaves hold them: [`LEAF`] each.
    order: Vec<u32>,
    leaves: usize,
}

/// Primitives in a leaf. Chosen: about as many as cost one step down.
const LEAF: usize = 4;

impl<'a> Picker<'a> {
    /// The hierarchy of a scene.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        let bounds: Vec<_> = scene.primitives.iter().map(|primitive| primitive.shape.bounds()).collect();
        let mut order: Vec<_> = (0..).take(bounds.len()).collect();
        let leaves = bounds.len().div_ceil(LEAF).next_power_of_two();
        divide(&mut order, leaves, &bounds);
        let mut nodes = vec![Bounds::NONE; 2 * leaves - 1];
        for (leaf, members) in nodes[leaves - 1..].iter_mut().zip(order.chunks(LEAF)) {
            *leaf = members.iter().map(|&p| bounds[p as usize]).fold(Bounds::NONE, Bounds::union);
        }
        for node in (0..leaves - 1).rev() {
            nodes[node] = nodes[2 * node + 1].union(nodes[2 * node + 2]);
        }
        Self { scene, nodes, order, leaves }
    }

    /// All fragments on the pixel at a column and row, the nearest first and of equal depths the
    /// smaller label; none for a pixel beyond the largest picture.
    pub fn pick(&self, column: u32, row: u32) -> Picks<'_> {
        let mut waiting = BinaryHeap::new();
        let inside = column < Scene::MAX_SIDE && row < Scene::MAX_SIDE;
        if let (Ok(column), Ok(row), true) = (i32::try_from(column), i32::try_from(row), inside) {
            waiting.push(Entry { depth: f32::NEG_INFINITY, label: 0, what: What::Node(0) });
            return Picks { picker: self, pixel: (column, row), waiting };
        }
        Picks { picker: self, pixel: (0, 0), waiting }
    }
}

/// Sorts primitives so that each half, quarter, … lies together in the plane; leaves fill up from
/// the left.
fn divide(order: &mut [u32], leaves: usize, bounds: &[Bounds]) {
    let middle = leaves / 2 * LEAF;
    if leaves < 2 || order.len() <= middle {
        if leaves >= 2 {
            divide(order, leaves / 2, bounds);
        }
        return;
    }
    let of = |p: u32| bounds[p as usize].center();
    let extent = |axis: fn((f32, f32)) -> f32| {
        let (low, high) = order
            .iter()
            .map(|&p| axis(of(p)))
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    let axis: fn((f32, f32)) -> f32 = if extent(|c| c.0) >= extent(|c| c.1) { |c| c.0 } else { |c| c.1 };
    order.select_nth_unstable_by(middle, |&a, &b| axis(of(a)).total_cmp(&axis(of(b))).then(a.cmp(&b)));
    let (left, right) = order.split_at_mut(middle);
    divide(left, leaves / 2, bounds);
    divide(right, leaves / 2, bounds);
}

/// The fragments on a pixel, nearest first: see [`Picker::pick`].
#[derive(Debug)]
pub struct Picks<'a> {
    picker: &'a Picker<'a>,
    pixel: (i32, i32),
    waiting: BinaryHeap<Entry>,
}

impl Iterator for Picks<'_> {
    type Item = Fragment;

    fn next(&mut self) -> Option<Fragment> {
        while let Some(entry) = self.waiting.pop() {
            match entry.what {
                What::Fragment(fragment) => return Some(fragment),
                What::Node(node) => self.open(node),
            }
        }
        None
    }
}

impl Picks<'_> {
    fn open(&mut self, node: usize) {
        let Picker { scene, nodes, order, leaves } = self.picker;
        let (column, row) = self.pixel;
        if let Some(leaf) = (node + 1).checked_sub(*leaves) {
            for &primitive in order.iter().skip(leaf * LEAF).take(LEAF) {
                let primitive = &scene.primitives[primitive as usize];
                if let Some(depth) = primitive.shape.fragment(column, row) {
                    let fragment = Fragment { depth, label: primitive.label };
                    self.waiting.push(Entry {
                        depth,
                        label: fragment.label.0,
                        what: What::Fragment(fragment),
                    });
                }
            }
            return;
        }
        for child in [2 * node + 1, 2 * node + 2] {
            if let Some(depth) = nodes[child].nearest(column, row) {
                self.waiting.push(Entry { depth, label: 0, what: What::Node(child) });
            }
        }
    }
}

/// A fragment, or a node that has none nearer than `depth`.
#[derive(Debug)]
struct Entry {
    depth: f32,
    label: u32,
    what: What,
}

#[derive(Debug)]
enum What {
    Node(usize),
    Fragment(Fragment),
}

impl Entry {
    /// A node of the same depth goes before a fragment: it may hold one of a smaller label.
    fn key(&self) -> (f32, bool, u32) {
        (self.depth, matches!(self.what, What::Fragment(_)), self.label)
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b) = (self.key(), other.key());
        // The heap gives the greatest; the nearest is wanted.
        b.0.total_cmp(&a.0).then((b.1, b.2).cmp(&(a.1, a.2)))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}
