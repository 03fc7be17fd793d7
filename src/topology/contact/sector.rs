//! Contact with an arc: the wedge between two circles, decided in integers.

use crate::geometry::{Arc, Point, Turn, Vector};

/// An arc as contact sees it: the points of a wedge between two circles.
///
/// An [`Arc`]'s ends are rounded to nanometres, so its two radii differ by up to 1.5 nm, and in
/// sloppy files by more. In between the radius goes evenly from one to the other; the wedge between
/// both circles holds that curve, and where the radii agree it is that curve. So contact with an
/// arc is exact if both radii are equal, and else never missed and found early by at most their
/// difference. Where that is a matter of micrometres the arc is an area of chords instead.
///
/// # Guarantees
///
/// Runs counter-clockwise; `inner ≤ outer`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sector {
    pub(super) center: Point,
    /// Where it begins.
    pub(super) start: Point,
    /// Where it ends; the start for a full circle.
    pub(super) end: Point,
    /// The smaller radius, squared.
    pub(super) inner: i64,
    /// The larger radius, squared.
    pub(super) outer: i64,
}

impl Sector {
    pub(super) fn new(arc: &Arc) -> Self {
        let (start, end) = match arc.turn {
            Turn::CounterClockwise => (arc.start, arc.end),
            Turn::Clockwise => (arc.end, arc.start),
        };
        let radii = [start, end].map(|p| (p - arc.center).length_squared());
        Self { center: arc.center, start, end, inner: radii[0].min(radii[1]), outer: radii[0].max(radii[1]) }
    }

    /// The arms of the wedge.
    fn arms(&self) -> (Vector, Vector) {
        (self.start - self.center, self.end - self.center)
    }

    /// Whether the wedge holds the direction `way` from the centre, its arms included; the centre
    /// itself is held.
    ///
    /// ```text
    ///        e         up to half a circle: left of s and right of e
    ///       ╱  way
    ///      c────s      beyond: not strictly between e and s
    /// ```
    pub(super) fn holds(&self, way: Vector) -> bool {
        let (s, e) = self.arms();
        if self.is_wide() {
            self.is_whole() || !(e.cross(way) > 0 && way.cross(s) > 0)
        } else {
            s.cross(way) >= 0 && way.cross(e) >= 0
        }
    }

    /// The same for a way between whole nanometres, which may lie `slack` nanometres beyond an arm.
    pub(super) fn nearly_holds(&self, way: (f64, f64), slack: f64) -> bool {
        let (s, e) = self.arms();
        // How far the way's end lies left of an arm.
        let left = |arm: Vector| (arm.x.to_f64() * way.1 - arm.y.to_f64() * way.0) / arm.length();
        if self.is_wide() {
            self.is_whole() || !(left(e) > slack && left(s) < -slack)
        } else {
            left(s) >= -slack && left(e) <= slack
        }
    }

    /// Whether it goes all the way round: where both arms have the same direction.
    fn is_whole(&self) -> bool {
        let (s, e) = self.arms();
        s.cross(e) == 0 && s.dot(e) >= 0
    }

    /// Whether it is more than half a circle.
    pub(super) fn is_wide(&self) -> bool {
        let (s, e) = self.arms();
        s.cross(e) < 0 || self.is_whole()
    }

    /// A wide arc as half a circle and the rest.
    pub(super) fn halves(&self) -> [Self; 2] {
        let middle = self.center + -(self.start - self.center);
        [Self { end: middle, ..*self }, Self { start: middle, ..*self }]
    }

    /// The difference of the two radii, in nanometres.
    #[expect(clippy::cast_precision_loss, reason = "a bound on a rounding")]
    pub(super) fn thickness(&self) -> f64 {
        (self.outer as f64).sqrt() - (self.inner as f64).sqrt()
    }
}
