//! A straight cut: all that is within half the kerf of a segment.

use std::cmp::Ordering;

use crate::board::Shape;
use crate::geometry::Nm;
use crate::verify::edges::{Spot, length};

/// All that is within `radius` of a segment, in nanometres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Capsule {
    from: Spot,
    way: Spot,
    /// One divided by the square of how long the way is; zero where it has no length.
    inverse: f64,
    radius: f64,
    /// How deep.
    pub(super) depth: f64,
}

impl Capsule {
    fn new(from: Spot, to: Spot, radius: f64, depth: f64) -> Self {
        let way = (to.0 - from.0, to.1 - from.1);
        let squared = square(way);
        Self { from, way, inverse: if squared > 0.0 { 1.0 / squared } else { 0.0 }, radius, depth }
    }

    /// The capsules that a cut is, so deep; of an arc chords that are `within` so far of it.
    pub(super) fn of(shape: &Shape, within: Nm, depth: Nm) -> Vec<Self> {
        let capsule =
            |from: Spot, to: Spot, radius: &Nm| Self::new(from, to, radius.to_f64(), depth.to_f64());
        match shape {
            Shape::Disc { center, radius } => vec![capsule(center.to_f64(), center.to_f64(), radius)],
            Shape::Stroke { from, to, radius } => vec![capsule(from.to_f64(), to.to_f64(), radius)],
            Shape::Arc { arc, radius } => {
                let mut from = arc.start.to_f64();
                let chord = |to: Spot| capsule(std::mem::replace(&mut from, to), to, radius);
                arc.flatten(within).map(|point| point.to_f64()).map(chord).collect()
            }
            Shape::Polygon(_) => Vec::new(),
        }
    }

    /// The way to `p` from the place of its axis nearest to it: what
    /// [`off_segment`](crate::geometry::off_segment) says, made ready for many places, which is a
    /// tenth of all that there is to do.
    pub(super) fn off(&self, p: Spot) -> Spot {
        let off = (p.0 - self.from.0, p.1 - self.from.1);
        let part = ((off.0 * self.way.0 + off.1 * self.way.1) * self.inverse).clamp(0.0, 1.0);
        (off.0 - self.way.0 * part, off.1 - self.way.1 * part)
    }

    /// How far `p` is beyond it; less than zero within.
    pub(super) fn beyond(&self, p: Spot) -> f64 {
        length(self.off(p)) - self.radius
    }

    /// How wide it is.
    pub(super) fn kerf(&self) -> f64 {
        self.radius * 2.0
    }

    /// Whether `p` is less than so far beyond it.
    pub(super) fn is_within(&self, p: Spot, beyond: f64) -> bool {
        let most = self.radius + beyond;
        most > 0.0 && square(self.off(p)) < most * most
    }

    /// Where all that is within `reach` of `p` lies of what is `more` beyond it: less where within,
    /// greater where outside, equal where across its edge.
    pub(super) fn side(&self, p: Spot, reach: f64, more: f64) -> Ordering {
        let (off, radius) = (square(self.off(p)), self.radius + more);
        if radius >= reach && off <= (radius - reach) * (radius - reach) {
            Ordering::Less
        } else if off > (radius + reach) * (radius + reach) {
            Ordering::Greater
        } else {
            Ordering::Equal
        }
    }

    /// The place so far beyond it, straight from its axis through `p`.
    pub(super) fn outwards(&self, p: Spot, beyond: f64) -> Spot {
        let (x, y) = self.off(p);
        let off = length((x, y));
        let further = self.radius + beyond - off;
        if off > 0.0 { (p.0 + x / off * further, p.1 + y / off * further) } else { (p.0 + further, p.1) }
    }

    /// Whether all of its cut that comes within `reach` of `p` is also cut by `others`, at least as
    /// deep, where they cut `more` than they do.
    ///
    /// Cut is a disc that goes along; where its middle is within the other's radius less its own of
    /// the other's axis, it lies in the other's cut. For each other that is a stretch of its axis.
    ///
    /// ```text
    ///   (+---------------+)   |---------------| within reach
    ///                         |-------|         one
    ///                              |----------| another: covered
    /// ```
    pub(super) fn is_covered(&self, p: Spot, reach: f64, others: &[Self], more: f64) -> bool {
        let stretch = |other: &Self| self.stretch(other, other.radius + more - self.radius);
        let as_deep = others.iter().filter(|other| other.depth >= self.depth);
        let mut covers: Vec<(f64, f64)> = as_deep.filter_map(stretch).collect();
        if covers.is_empty() {
            return false;
        }
        let Some((start, end)) = self.stretch(&Self::new(p, p, 0.0, 0.0), reach + self.radius) else {
            return true;
        };
        covers.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut covered = start;
        for (from, to) in covers {
            if from > covered {
                break;
            }
            covered = covered.max(to);
        }
        covered >= end
    }

    /// From which part to which of the way along its axis is within `reach` of another's axis.
    fn stretch(&self, other: &Self, reach: f64) -> Option<(f64, f64)> {
        let off = (self.from.0 - other.from.0, self.from.1 - other.from.1);
        if reach < 0.0 || self.is_apart(other, off, reach) {
            return None;
        }
        let (way, side) = (self.way, other.way);
        let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut add = |(from, to): (f64, f64)| {
            let (from, to) = (from.max(0.0), to.min(1.0));
            if from <= to {
                (first, last) = (first.min(from), last.max(to));
            }
        };
        // What is within reach of a segment is convex: it reaches from the first to the last place
        // that is within reach of an end, or beside what is between them.
        for off in [off, (off.0 - side.0, off.1 - side.1)] {
            let (dot, outside) = (way.0 * off.0 + way.1 * off.1, square(off) - reach * reach);
            let root = dot * dot - square(way) * outside;
            if self.inverse > 0.0 && root >= 0.0 {
                let root = root.sqrt();
                add(((-dot - root) * self.inverse, (-dot + root) * self.inverse));
            } else if self.inverse <= 0.0 && outside <= 0.0 {
                add((0.0, 1.0));
            }
        }
        let length = length(side);
        if length > 0.0 {
            let along = |v: Spot| (v.0 * side.0 + v.1 * side.1) / length;
            let across = |v: Spot| (v.1 * side.0 - v.0 * side.1) / length;
            let beside = within(along(off), along(way), 0.0, length);
            let near = within(across(off), across(way), -reach, reach);
            if let (Some(beside), Some(near)) = (beside, near) {
                add((beside.0.max(near.0), beside.1.min(near.1)));
            }
        }
        (first <= last).then_some((first, last))
    }

    /// Whether boxes round their axes, `off` from each other where they begin, are apart by more
    /// than `reach`.
    fn is_apart(&self, other: &Self, off: Spot, reach: f64) -> bool {
        let apart = |off: f64, way: f64, side: f64| {
            off + way.min(0.0) > side.max(0.0) + reach || off + way.max(0.0) < side.min(0.0) - reach
        };
        apart(off.0, self.way.0, other.way.0) || apart(off.1, self.way.1, other.way.1)
    }
}

/// Where `at` + t `slope` is from `low` to `high`.
fn within(at: f64, slope: f64, low: f64, high: f64) -> Option<(f64, f64)> {
    if slope == 0.0 {
        return (low <= at && at <= high).then_some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let (one, other) = ((low - at) / slope, (high - at) / slope);
    Some((one.min(other), one.max(other)))
}

const fn square((x, y): Spot) -> f64 {
    x * x + y * y
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::topology::random;

    #[test]
    fn what_is_covered_is_what_steps_along_the_axis_say() {
        let mut random = random();
        let (mut yes, mut no) = (0, 0);
        for board in 0..20_000 {
            let mut place = || Point::new(Nm::new(random(400)), Nm::new(random(400))).to_f64();
            let cut = Capsule::new(place(), place(), 30.0, 0.0);
            let others: Vec<Capsule> = (0..4).map(|_| Capsule::new(place(), place(), 110.0, 0.0)).collect();
            let (p, reach) = (place(), 60.0);
            let steps = (0..=1000).map(|step| {
                let part = f64::from(step) / 1000.0;
                (cut.from.0 + cut.way.0 * part, cut.from.1 + cut.way.1 * part)
            });
            let near = steps.filter(|at| length((at.0 - p.0, at.1 - p.1)) <= reach + 30.0);
            // How far the place that is least covered is from being so.
            let beyond = |at: Spot| others.iter().map(|other| other.beyond(at)).fold(f64::INFINITY, f64::min);
            let Some(worst) = near.map(beyond).reduce(f64::max) else { continue };
            let is_covered = cut.is_covered(p, reach, &others, 5.0);
            if worst <= -26.0 {
                assert!(is_covered, "board {board}: all is at least {:.1} within", -worst);
                yes += 1;
            } else if worst >= -25.0 {
                assert!(!is_covered, "board {board}: a place is only {:.1} within", -worst);
                no += 1;
            }
        }
        assert!(yes > 500 && no > 500, "{yes} covered and {no} not");
    }
}
