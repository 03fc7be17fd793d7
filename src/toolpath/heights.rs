//! How high and how deep a section goes: safe height, approach, passes.

use crate::geometry::Nm;

/// How high and how deep; all above zero.
///
/// ```text
///   safe ───────────── rapid, level
///         ╎ rapid down
///   approach ╶╶╶╶╶╶╶╶╶ from here down at the plunge feed
///         │
///   0 ═══ surface ════
///   step ╶╶╶╶╶╶╶╶╶╶╶╶╶ first pass
///   cut ────────────── last pass
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heights {
    /// The height at which everything may be crossed.
    pub safe: Nm,
    /// The height down to which a rapid goes before a plunge; at most `safe`.
    pub approach: Nm,
    /// The depth of the cut below the surface, positive downwards.
    pub cut: Nm,
    /// The most that one pass (or one peck of a drill) takes; none for all at once.
    pub step: Option<Nm>,
}

impl Heights {
    /// The depths of the passes, positive downwards: as few as `step` allows, all equally thick,
    /// the last at `cut`.
    pub fn passes(&self) -> impl Iterator<Item = Nm> + use<> {
        let cut = self.cut.get();
        let count = match self.step {
            Some(step) if step > Nm::ZERO => ((cut + step.get() - 1) / step.get()).max(1),
            _ => 1,
        };
        (1..=count).map(move |pass| Nm::new(cut * pass / count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_are_even_and_end_at_the_depth() {
        let heights = |cut: i64, step: Option<i64>| Heights {
            safe: Nm::from_mm(2),
            approach: Nm::from_um(500),
            cut: Nm::new(cut),
            step: step.map(Nm::new),
        };
        let passes = |cut, step| heights(cut, step).passes().map(Nm::get).collect::<Vec<_>>();
        assert_eq!(passes(1700, Some(500)), [425, 850, 1275, 1700], "four passes of less than 500");
        assert_eq!(passes(500, Some(500)), [500], "just one");
        assert_eq!(passes(500, None), [500], "all at once");
    }
}
