//! How far from copper any place of the board is, at most: no pass runs farther out.
//!
//! Distances change no faster than the way goes. So a square whose middle is so far from copper has
//! no place that is farther by more than half its diagonal: where that is no more than is known
//! already it is done with, else its quarters are looked at.

use crate::geometry::Nm;
use crate::voronoi::Diagram;
use crate::voronoi::plane::Spot;

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::{Attributes, Axis, Copper, Feature, Shape, Side};
    use crate::geometry::Point;
    use crate::topology::{self, Method};
    use crate::voronoi::Settings;

    #[test]
    fn no_place_is_farther_and_few_are_much_nearer() {
        let disc = |x: i64, y: i64| {
            let (center, radius) = (Point::new(Nm::from_mm(x), Nm::from_mm(y)), Nm::from_mm(1));
            Feature {
                shape: Shape::Disc { center, radius },
                axis: Axis::Flash(center),
                attributes: 0,
                line: 1,
            }
        };
        let features = vec![disc(0, 0), disc(30, 0), disc(25, 22)];
        let copper = Copper { side: Side::Front, features, attributes: vec![Attributes::default()] };
        let nets = topology::recover(&copper, Method::Contact);
        let diagram = Diagram::new(&copper, &nets, None, &Settings::default()).expect("a diagram");
        let window = diagram.border.window;
        let mut most = 0.0_f64;
        for (i, j) in (0..=200_i64).flat_map(|i| (0..=200_i64).map(move |j| (i, j))) {
            let x = window.min().x + window.width() * i / 200;
            let y = window.min().y + window.height() * j / 200;
            let nearest = [(0, 0), (30, 0), (25, 22)].map(|(a, b)| {
                let (dx, dy) = ((x - Nm::from_mm(a)).to_f64(), (y - Nm::from_mm(b)).to_f64());
                (dx * dx + dy * dy).sqrt() - 1e6
            });
            most = most.max(nearest.into_iter().fold(f64::INFINITY, f64::min));
        }
        let farthest = diagram.farthest(Nm::from_um(100)).to_f64();
        assert!(farthest >= most && farthest <= 1.5 * most + 3e5, "{farthest} where {most} is the farthest");
    }
}
