//! What one pass mills of a way: where the final depth lies below the pass before, no deeper than
//! the pass.
//!
//! ```text
//!   0 ═══╲════════════╱═══ surface
//!   low   ╲──────────╱     the pass before: what is shallower is done
//!   high    ╲━━━━━━━╱      this pass: level where the axis lies deeper
//!             ╲___╱        the axis
//! ```

use crate::geometry;
use crate::voronoi::medial::Place;

/// A place of the tip, in nanometres; the depth grows downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tip {
    pub(super) at: (f64, f64),
    pub(super) depth: f64,
}

/// A part of a way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) course: Vec<Tip>,
    /// Whether it begins where the way begins, and ends where it ends.
    pub(super) whole: [bool; 2],
}

/// The depths of a pass, and how deep the tip goes where the disc has a radius.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    /// What is no deeper is milled already, in nanometres.
    pub(super) low: f64,
    /// As deep as it goes.
    pub(super) high: f64,
    /// Half the width of the tip.
    pub(super) blunt: f64,
    /// How much wider it cuts on either side for each unit of depth.
    pub(super) flank: f64,
    /// How deep the edges of the areas lie.
    pub(super) start: f64,
    /// What would be deeper than this is left to others; none for nothing.
    pub(super) beyond: Option<f64>,
}

impl Pass {
    /// How deep the tip goes where a disc has this radius, were there no end.
    pub(super) fn depth(&self, radius: f64) -> f64 {
        self.start + (radius - self.blunt) / self.flank
    }

    /// What it mills of a way; of a loop, whose last place is the first again, no piece leads over
    /// its beginning unless all of it is one.
    pub(super) fn pieces(&self, course: &[Place], is_loop: bool) -> Vec<Piece> {
        let mut tips = self.tips(course);
        if is_loop {
            turn_to_shallowest(&mut tips);
        }
        let last = tips.len().saturating_sub(1);
        let mut pieces: Vec<Piece> = Vec::new();
        let mut is_open = false;
        for i in 0..last {
            let middle = f64::midpoint(tips[i].depth, tips[i + 1].depth);
            if middle <= self.low || self.is_left(middle) {
                is_open = false;
                continue;
            }
            if !is_open {
                pieces.push(Piece { course: vec![self.held(tips[i])], whole: [i == 0, false] });
            }
            let piece = pieces.last_mut().expect("one was just begun");
            piece.course.push(self.held(tips[i + 1]));
            piece.whole[1] = i + 1 == last;
            is_open = true;
        }
        pieces
    }

    /// Whether a place that would be so deep is left.
    pub(super) fn is_left(&self, depth: f64) -> bool {
        self.beyond.is_some_and(|beyond| depth > beyond)
    }

    /// No deeper than the pass.
    const fn held(&self, tip: Tip) -> Tip {
        Tip { depth: tip.depth.clamp(0.0, self.high), ..tip }
    }

    /// A way by its depths, with places where these are those of the pass.
    fn tips(&self, course: &[Place]) -> Vec<Tip> {
        let tip = |place: &Place| Tip { at: place.at, depth: self.depth(place.clearance) };
        let mut tips: Vec<Tip> = course.first().map(tip).into_iter().collect();
        for pair in course.windows(2) {
            let (from, to) = (tip(&pair[0]), tip(&pair[1]));
            let part = |level: f64| (level - from.depth) / (to.depth - from.depth);
            let levels = [Some(self.low), Some(self.high), self.beyond];
            let mut parts: Vec<f64> = levels.into_iter().flatten().map(part).collect();
            parts.sort_by(f64::total_cmp);
            parts.dedup();
            let crossed = parts.into_iter().filter(|part| (1e-9..1.0 - 1e-9).contains(part));
            tips.extend(crossed.map(|part| between(from, to, part)));
            tips.push(to);
        }
        tips
    }
}

/// The place a part of the way from one to another.
pub(super) fn between(from: Tip, to: Tip, part: f64) -> Tip {
    let depth = from.depth + (to.depth - from.depth) * part;
    Tip { at: geometry::between(from.at, to.at, part), depth }
}

/// Turns a loop so that it begins where it is shallowest.
fn turn_to_shallowest(tips: &mut Vec<Tip>) {
    tips.pop();
    let lowest = (0..tips.len()).min_by(|&a, &b| tips[a].depth.total_cmp(&tips[b].depth));
    tips.rotate_left(lowest.unwrap_or(0));
    tips.extend(tips.first().copied());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn course(radii: &[f64]) -> Vec<Place> {
        radii
            .iter()
            .zip(0_i32..)
            .map(|(&clearance, i)| Place { at: (f64::from(i), 0.0), clearance })
            .collect()
    }

    const PASS: Pass = Pass { low: 10.0, high: 20.0, blunt: 5.0, flank: 0.5, start: 0.0, beyond: None };

    #[test]
    fn a_pass_takes_what_is_deeper_than_the_one_before_and_goes_no_deeper_than_it_may() {
        // Depths: -10, 30, -10, 15.
        let pieces = PASS.pieces(&course(&[0.0, 20.0, 0.0, 12.5]), false);
        assert_eq!(pieces.len(), 2, "{pieces:?}");
        let depths: Vec<f64> = pieces[0].course.iter().map(|tip| tip.depth).collect();
        assert_eq!(depths, [10.0, 20.0, 20.0, 20.0, 10.0], "down, level, up");
        assert_eq!((pieces[0].whole, pieces[1].whole), ([false, false], [false, true]), "the last ends it");
    }

    #[test]
    fn what_is_wide_may_be_left() {
        let pass = Pass { beyond: Some(20.0), ..PASS };
        let pieces = pass.pieces(&course(&[0.0, 20.0, 0.0]), false);
        assert_eq!(pieces.len(), 2, "down to the edge of what is wide, and up from it: {pieces:?}");
    }

    #[test]
    fn a_loop_that_is_milled_all_round_stays_one_and_another_is_cut_where_it_is_shallow() {
        let whole = PASS.pieces(&course(&[20.0, 12.0, 20.0, 20.0]), true);
        assert_eq!((whole.len(), whole[0].whole), (1, [true, true]), "{whole:?}");
        let part = PASS.pieces(&course(&[20.0, 0.0, 20.0, 20.0]), true);
        assert_eq!((part.len(), part[0].whole), (1, [false, false]), "{part:?}");
    }
}
