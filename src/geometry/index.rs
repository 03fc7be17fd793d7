//! Rectangles by place: a packed R-tree.

use std::ops::ControlFlow;

use super::Rect;
use super::tree::BoxTree;

/// Rectangles by place: a packed R-tree, filled once.
#[derive(Debug)]
pub(crate) struct RectIndex {
    rects: Vec<Rect>,
    tree: BoxTree,
}

/// The box round two places.
pub(crate) fn spanned(a: (f64, f64), b: (f64, f64)) -> [f64; 4] {
    [a.0.min(b.0), a.1.min(b.1), a.0.max(b.0), a.1.max(b.1)]
}

impl RectIndex {
    /// The index of `rects`, numbered as they come.
    pub(crate) fn new(rects: impl ExactSizeIterator<Item = Rect>) -> Self {
        let rects: Vec<Rect> = rects.collect();
        let tree = BoxTree::new(rects.iter().map(|rect| {
            let ((left, bottom), (right, top)) = (rect.min().to_f64(), rect.max().to_f64());
            [left, bottom, right, top]
        }));
        Self { rects, tree }
    }

    /// The numbers of all rectangles, neighbours close to each other: the order in which to ask
    /// about all of them.
    pub(crate) fn order(&self) -> Vec<usize> {
        self.tree.order().collect()
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
        let ((left, bottom), (right, top)) = (window.min().to_f64(), window.max().to_f64());
        let region = self.tree.window([left, bottom, right, top]);
        self.tree.visit(&region, stack, |number| {
            if self.rects[number].touches(window) { visit(number) } else { ControlFlow::Continue(()) }
        })
    }
}
