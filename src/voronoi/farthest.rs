//! How far from copper any place of the board is, at most: no pass runs farther out.
//!
//! Distances change no faster than the way goes. So a square whose middle is so far from copper has
//! no place that is farther by more than half its diagonal: where that is no more than is known
//! already it is done with, else its quarters are looked at.

use crate::geometry::Nm;

use super::Diagram;
use super::plane::Spot;

/// Squares are no longer parted where their places are farther than the farthest known by no more
/// than this part of that. Chosen: a pass too many costs less than a closer look.
const SPARE: f64 = 0.5;

impl Diagram {
    /// No place within the window is farther from copper than this: half as far again as the
    /// farthest, or `step` farther, at most.
    pub(super) fn farthest(&self, step: Nm) -> Nm {
        let [low, high] = [self.border.window.min(), self.border.window.max()].map(Spot::from);
        let half = (high - low) * 0.5;
        let mut open = vec![(low + half, half)];
        let mut farthest = 0.0_f64;
        let mut bound = 0.0_f64;
        while let Some((middle, half)) = open.pop() {
            let distance = self.certified.room(middle);
            farthest = farthest.max(distance);
            let most = distance + half.length();
            if most <= farthest + (SPARE * farthest).max(step.to_f64()) {
                bound = bound.max(most);
                continue;
            }
            // Only the longer side is halved, so that pieces come to be square.
            let quarter =
                if half.x > half.y { Spot::new(half.x / 2.0, 0.0) } else { Spot::new(0.0, half.y / 2.0) };
            open.extend([middle - quarter, middle + quarter].map(|at| (at, half - quarter)));
        }
        Nm::from_f64(bound.max(farthest).ceil())
    }
}
