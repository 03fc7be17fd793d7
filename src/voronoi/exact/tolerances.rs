//! What is so small that it is nothing: one set for ordinary copper, and one for owners that may
//! lie a nanometre apart, whose corners are no larger.

use super::form::SLAB;

/// Lengths and sines below which two things are one, and how far off an edge it is asked what lies
/// there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerances {
    /// So far off an edge it is looked whether copper lies there, in nanometres.
    pub(super) off: f64,
    /// A place so near to the end of a slab is taken for it where all that is tied stays so, in
    /// nanometres.
    pub(super) snap: f64,
    /// So far beyond its end a foot may lie, in nanometres.
    pub(super) slab: f64,
    /// Feet of two owners nearer to each other than this have one direction, beside what a tie may
    /// turn them by.
    pub(super) apart: f64,
    /// A circle that holds copper by more is no rounding, in nanometres.
    pub(super) wrong: f64,
    /// What belongs to another owner than both, and comes nearer by less than this a unit of way,
    /// only touches.
    pub(super) flat: f64,
}

impl Tolerances {
    /// Those of ordinary copper. Chosen.
    const USUAL: Self = Self { off: OFF, snap: 1.0, slab: SLAB, apart: SAME, wrong: WRONG, flat: FLAT };

    /// Those where owners may be close: between them a boundary runs however near they are. Chosen;
    /// rounding is less.
    pub(super) const CLOSE: Self =
        Self { off: 0.25, snap: 0.05, slab: 1e-4, apart: 1e-9, wrong: 1.0, flat: 1e-9 };

    /// How far from a place so far from copper two generators may be tied that part there, in
    /// nanometres: what touches a circle from within leaves it by the square of the way.
    pub(super) fn resolution(&self, tie: f64, clearance: f64) -> f64 {
        (60.0 * tie * clearance).sqrt().max(self.snap)
    }
}

/// So far off an edge it is looked whether copper lies there, in nanometres. Chosen: more than
/// rounding, less than any real gap.
pub(super) const OFF: f64 = 20.0;

/// A circle that holds copper by more is no rounding, in nanometres. Chosen: a hundredth of what
/// fitting may leave; at the centre of an arc that copper lies round, ends that are rounded to
/// nanometres leave one.
const WRONG: f64 = 20.0;

impl Default for Tolerances {
    fn default() -> Self {
        Self::USUAL
    }
}

/// Feet of one owner nearer to each other than this have one direction, beside what a tie may turn
/// them by. Chosen.
pub(super) const SAME: f64 = 1e-6;

/// What comes nearer by less than this a unit of way only touches; if it enters after all, the end
/// of the step shows it. Rounding is less. Chosen.
pub(super) const FLAT: f64 = 1e-6;
