//! Boxes by place, for judges: the tree of a library, which what they judge is not made with.

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
