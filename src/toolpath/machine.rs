use crate::geometry::Nm;

use super::feed::Feed;

/// What the machine can do, for the time estimate and for what a lift costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The speed of a level rapid.
    pub rapid: Feed,
    /// The speed of a rapid up or down.
    pub rapid_z: Feed,
    /// The acceleration of every axis, in mm/s².
    pub acceleration: u32,
    /// How far the planner lets a corner be cut in its thoughts: Grbl's `$11`.
    pub junction_deviation: Nm,
    /// How long the spindle takes to come up to speed, in milliseconds.
    pub spin_up: u32,
    /// How long a change of tools takes a person, in seconds.
    pub tool_change: u32,
    /// How far it can go in x, y and z; none where nobody said so.
    pub travel: Option<[Nm; 3]>,
}

/// A small desktop engraver under Grbl. Chosen: the settings that the common 3018 machines are sold with, and
/// Grbl's own junction deviation.
impl Default for Machine {
    fn default() -> Self {
        Self {
            rapid: Feed::from_mm_per_min(1500),
            rapid_z: Feed::from_mm_per_min(600),
            acceleration: 50,
            junction_deviation: Nm::from_um(10),
            spin_up: 3000,
            tool_change: 60,
            travel: None,
        }
    }
}
