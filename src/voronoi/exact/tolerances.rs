//! What is so small that it is nothing. Other owners are far beyond it: copper of two nets is never
//! nearer than what curves are flattened within.

/// So far off an edge it is looked whether copper lies there, in nanometres. Chosen: more than
/// rounding, less than any real gap.
pub(super) const OFF: f64 = 20.0;

/// A place so near to the end of a slab is taken for it where all that is tied stays so, in
/// nanometres. Chosen.
pub(super) const SNAP: f64 = 1.0;

/// A foot may lie so far beyond the end of a slab and count, in nanometres: far more than rounding
/// and than what makes two places one vertex, far less than any real length. Chosen.
pub(super) const SLAB: f64 = 0.05;

/// A circle that holds copper by more is no rounding, in nanometres. Chosen: a hundredth of what
/// fitting may leave; at the centre of an arc that copper lies round, ends that are rounded to
/// nanometres leave one.
pub(super) const WRONG: f64 = 20.0;

/// Feet nearer to each other than this have one direction, beside what a tie may turn them by.
/// Chosen.
pub(super) const SAME: f64 = 1e-6;

/// What comes nearer by less than this a unit of way only touches; if it enters after all, the end
/// of the step shows it. Rounding is less. Chosen.
pub(super) const FLAT: f64 = 1e-6;

/// How far from a place so far from copper two generators may be tied that part there, in
/// nanometres: what touches a circle from within leaves it by the square of the way.
pub(super) fn resolution(tie: f64, clearance: f64) -> f64 {
    (60.0 * tie * clearance).sqrt().max(SNAP)
}
