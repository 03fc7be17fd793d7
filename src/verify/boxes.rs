//! Boxes by place, for judges: the tree of a library, which what they judge is not made with.

use std::ops::Range;

use static_aabb2d_index::{StaticAABB2DIndex, StaticAABB2DIndexBuilder};

/// Boxes by place, numbered as they come, each as left, bottom, right and top; none where there is
/// no box.
pub(super) fn boxes(boxes: impl ExactSizeIterator<Item = [f64; 4]>) -> Option<StaticAABB2DIndex<f64>> {
    let mut builder = StaticAABB2DIndexBuilder::new(boxes.len());
    for [left, bottom, right, top] in boxes {
        builder.add(left, bottom, right, top);
    }
    builder.build().ok()
}

/// Boxes by place, of which every box of the tree knows something of all that it holds.
pub(super) struct Tree<S> {
    index: StaticAABB2DIndex<f64>,
    /// What is known of the boxes of the index, in its order.
    known: Vec<S>,
}

impl<S: Clone> Tree<S> {
    /// Boxes, numbered as they come, each as left, bottom, right and top, with what is known of it;
    /// `both` is what is known of two together. None where there is no box.
    pub(super) fn new(
        all: impl ExactSizeIterator<Item = ([f64; 4], S)> + Clone,
        both: impl Fn(S, S) -> S,
    ) -> Option<Self> {
        let index = boxes(all.clone().map(|(bounds, _)| bounds)).filter(|index| index.count() > 0)?;
        let of: Vec<S> = all.map(|(_, of)| of).collect();
        let mut known: Vec<S> = Vec::with_capacity(index.all_boxes().len());
        for (node, &number) in index.all_box_indices().iter().enumerate() {
            let parts = (node >= index.count()).then(|| &known[children(&index, node)]);
            let whole = parts.and_then(|parts| parts.iter().cloned().reduce(&both));
            known.push(whole.unwrap_or_else(|| of[number].clone()));
        }
        Some(Self { index, known })
    }

    /// Shows boxes, the whole first, with what is known of them, and the number of one that was
    /// given: what a box holds follows if `look` says so.
    pub(super) fn visit(&self, mut look: impl FnMut([f64; 4], &S, Option<usize>) -> bool) {
        let numbers = self.index.all_box_indices();
        let mut open = vec![numbers.len() - 1];
        while let Some(node) = open.pop() {
            let is_one = node < self.index.count();
            let bounds = &self.index.all_boxes()[node];
            let bounds = [bounds.min_x, bounds.min_y, bounds.max_x, bounds.max_y];
            if look(bounds, &self.known[node], is_one.then(|| numbers[node])) && !is_one {
                open.extend(children(&self.index, node));
            }
        }
    }
}

/// The boxes that one that holds others does.
fn children(index: &StaticAABB2DIndex<f64>, node: usize) -> Range<usize> {
    let first = index.all_box_indices()[node];
    let level = index.level_bounds().iter().find(|&&end| end > first);
    first..(first + index.node_size()).min(*level.expect("below the root"))
}
