//! Rectangles by place: a packed R-tree.

use std::ops::ControlFlow;

use super::Rect;
use super::tree::{BoxTree, Met};

/// Rectangles by place: a packed R-tree, filled once.
#[derive(Debug)]
pub(crate) struct RectIndex {
    /// Left, bottom, right, top.
    rects: Vec<[i32; 4]>,
    tree: BoxTree,
}

/// A rectangle as the index knows it, in half the memory. What lies more than two metres off is
/// drawn back to there: far beyond all coordinates, nothing touches less for it.
fn packed(rect: Rect) -> [i32; 4] {
    let (min, max) = (rect.min(), rect.max());
    let clamped = |nm: i64| nm.clamp(i32::MIN.into(), i32::MAX.into());
    [min.x, min.y, max.x, max.y].map(|nm| i32::try_from(clamped(nm.get())).expect("clamped"))
}

/// Whether two share a point.
const fn touches([a, b, c, d]: [i32; 4], [left, bottom, right, top]: [i32; 4]) -> bool {
    a <= right && c >= left && b <= top && d >= bottom
}

/// The box round two places.
pub(crate) fn spanned(a: (f64, f64), b: (f64, f64)) -> [f64; 4] {
    [a.0.min(b.0), a.1.min(b.1), a.0.max(b.0), a.1.max(b.1)]
}

impl RectIndex {
    /// The index of `rects`, numbered as they come.
    pub(crate) fn new(rects: impl ExactSizeIterator<Item = Rect>) -> Self {
        let rects: Vec<[i32; 4]> = rects.map(packed).collect();
        let tree = BoxTree::new(rects.iter().map(|rect| rect.map(f64::from)));
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
        let _ = self.visit(window, |number| {
            found.push(number);
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        found
    }

    /// Calls `visit` with the number of every rectangle that shares a point with `window`, until it
    /// breaks. The order depends on the rectangles alone.
    pub(crate) fn visit(
        &self,
        window: Rect,
        mut visit: impl FnMut(usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let near = packed(window);
        let region = self.tree.window(near.map(f64::from));
        self.tree.visit(&region, |number| {
            if touches(self.rects[number], near) { visit(number) } else { ControlFlow::Continue(()) }
        })
    }

    /// Calls `enters` with nodes of the index that may have such rectangles, and with the number of
    /// every such rectangle below those of which it says true.
    pub(crate) fn visit_entered(&self, window: Rect, mut enters: impl FnMut(Met) -> bool) {
        let near = packed(window);
        let region = self.tree.window(near.map(f64::from));
        self.tree.visit_entered(&region, &mut |met| match met {
            Met::Box(number) => touches(self.rects[number], near) && enters(met),
            Met::Node(_) => enters(met),
        });
    }

    /// The tree of its rectangles.
    pub(crate) const fn tree(&self) -> &BoxTree {
        &self.tree
    }
}
