//! Rectangles by place: a packed R-tree.

use std::ops::ControlFlow;

use static_aabb2d_index::{Control, StaticAABB2DIndex, StaticAABB2DIndexBuilder};

use super::Rect;

/// Rectangles by place: a packed R-tree, filled once.
#[derive(Debug)]
pub(crate) struct RectIndex {
    tree: StaticAABB2DIndex<i64>,
}

/// Boxes by place, numbered as they come, each as left, bottom, right and top; none where there is
/// no box.
pub(crate) fn boxes(boxes: impl ExactSizeIterator<Item = [f64; 4]>) -> Option<StaticAABB2DIndex<f64>> {
    let mut builder = StaticAABB2DIndexBuilder::new(boxes.len());
    for [left, bottom, right, top] in boxes {
        builder.add(left, bottom, right, top);
    }
    builder.build().ok()
}

/// The box round two places.
pub(crate) fn spanned(a: (f64, f64), b: (f64, f64)) -> [f64; 4] {
    [a.0.min(b.0), a.1.min(b.1), a.0.max(b.0), a.1.max(b.1)]
}

impl RectIndex {
    /// The index of `rects`, numbered as they come.
    pub(crate) fn new(rects: impl ExactSizeIterator<Item = Rect>) -> Self {
        let mut builder = StaticAABB2DIndexBuilder::new(rects.len());
        for rect in rects {
            let (min, max) = (rect.min(), rect.max());
            builder.add(min.x.get(), min.y.get(), max.x.get(), max.y.get());
        }
        Self { tree: builder.build().expect("as many rectangles as announced") }
    }

    /// The numbers of all rectangles, neighbours close to each other: the order in which to ask
    /// about all of them.
    pub(crate) fn order(&self) -> &[usize] {
        self.tree.item_indices()
    }

    /// The numbers of all rectangles that share a point with `window`, in order.
    pub(crate) fn touching(&self, window: Rect) -> Vec<usize> {
        let mut found = Vec::new();
        let _ = self.visit(window, &mut Vec::new(), |number| {
            found.push(number);
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        found
    }

    /// Calls `visit` with the number of every rectangle that shares a point with `window`, until it
    /// breaks.
    ///
    /// `stack` is scratch memory. The order depends on the rectangles alone.
    pub(crate) fn visit(
        &self,
        window: Rect,
        stack: &mut Vec<usize>,
        mut visit: impl FnMut(usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let (min, max) = (window.min(), window.max());
        let mut visitor = |number| match visit(number) {
            ControlFlow::Continue(()) => Control::Continue,
            ControlFlow::Break(()) => Control::Break(()),
        };
        let (x0, y0, x1, y1) = (min.x.get(), min.y.get(), max.x.get(), max.y.get());
        match self.tree.visit_query_with_stack(x0, y0, x1, y1, &mut visitor, stack) {
            Control::Continue => ControlFlow::Continue(()),
            Control::Break(()) => ControlFlow::Break(()),
        }
    }
}
