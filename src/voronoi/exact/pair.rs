//! Pairs: two generators and their bisector, on which the place of a foot orders all others.

use super::form::{Form, Place, clockwise, unit};
use crate::voronoi::plane::Spot;

/// Discs nearer to each other than this, in nanometres, lie all but in one place. Chosen: a tie may
/// leave a vertex a nanometre beside their bisector, and of discs a nanometre apart a foot may then
/// be turned beyond it.
const TOGETHER: f64 = 1_000.0;

/// Two generators with the space between them; one of them may be a mirror image that is nobody's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) forms: [Form; 2],
}

impl Pair {
    /// The direction of travel at `p`, with the left generator on the left.
    pub(super) fn way(&self, p: Spot) -> Spot {
        let [left, right] = self.forms;
        let turned = clockwise(right.away(p) - left.away(p));
        if turned.dot(turned) > 1e-24 { unit(turned) } else { left.away(p) }
    }

    /// The generator that orders places along the edge: 0 for the left.
    pub(super) fn main(&self, p: Spot) -> usize {
        let rank = |form: &Form| match *form {
            Form::Line { .. } => 0.0,
            Form::Circle { hollow: false, .. } => 1.0,
            // The nearer the centre, the worse.
            Form::Circle { center, radius, .. } => 3.0 - ((p - center).length() / radius).min(1.0),
        };
        usize::from(rank(&self.forms[1]) < rank(&self.forms[0]))
    }

    /// Whether places on the bisector are known by themselves and not by the directions of their
    /// feet: that of two lines, or of two discs of one size that lie all but in one place.
    pub(super) fn is_straight(&self) -> bool {
        match self.forms {
            [Form::Line { .. }, Form::Line { .. }] => true,
            [
                Form::Circle { center, radius, hollow: false, .. },
                Form::Circle { center: c, radius: r, hollow: false, .. },
            ] => radius.total_cmp(&r).is_eq() && (c - center).length() < TOGETHER,
            _ => false,
        }
    }

    /// The sense in which feet move on a side.
    pub(super) fn sense(&self, side: usize) -> f64 {
        self.forms[side].sense_on_left() * if side == 0 { 1.0 } else { -1.0 }
    }

    /// The place on the bisector whose foot on one side is given.
    pub(super) fn at(&self, side: usize, place: Place) -> Option<(Spot, f64)> {
        let (foot, normal) = self.forms[side].foot(place);
        let s = self.forms[1 - side].meet(foot, normal)?;
        Some((foot + normal * s, s))
    }
}
