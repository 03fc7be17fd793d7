//! How long motions take: Grbl 1.1's planner as a model (planner.c, `plan_buffer_line` and
//! `planner_recalculate`).
//!
//! ```text
//!  speed   ┌────────┐ nominal: the feed, or what the slowest axis on the way allows
//!         ╱          ╲
//!        ╱            ╲____╮ at a corner: as on a small circle that touches both ways and leaves
//!       ╱                   ╲ the corner by the junction deviation
//!  stop ──── block ────│─────── next ──▶ the last block that the buffer holds ends in a standstill
//! ```
//!
//! * A motion becomes a block whose nominal speed and acceleration are the least that an axis on
//!   its way allows.
//! * An arc becomes chords that stay within [`ARC_TOLERANCE`].
//! * While a block runs, the planner knows it and [`LOOK_AHEAD`] − 1 blocks after it, and must be
//!   able to stop at the end of the last: programs of very short motions run slower than their feed
//!   for that.
//! * Dwells, pauses and every change of the spindle let the buffer run empty: the machine stops.
//!
//! Not modelled: the rounding of targets to steps, the time that a line takes over the wire, and
//! the S-curves and blending of other controllers, for which the same model stands in.

use crate::geometry::{Arc, Nm};

use super::machine::{Acceleration, Machine};
use super::program::{Move, Position};

/// The blocks that the planner knows at once: Grbl's BLOCK_BUFFER_SIZE is 16, of which 15 are used.
const LOOK_AHEAD: usize = 15;

/// How far chords may leave an arc, in nanometres: Grbl's `$12` as it is delivered.
const ARC_TOLERANCE: f64 = 2000.0;

/// The least nominal speed, 1 mm/min, in nanometres per second: Grbl's MINIMUM_FEED_RATE.
const LEAST_SPEED: f64 = 1e6 / 60.0;

/// A direction in space, of length one.
type Direction = [f64; 3];

/// One motion as the planner sees it; nanometres and seconds.
#[derive(Clone, Copy, Debug)]
struct Block {
    length: f64,
    speed: f64,
    acceleration: f64,
    /// The square of the most speed at its beginning that the corner before it allows.
    entry: f64,
}

/// Adds up the time of motions; whatever stops the machine empties its blocks.
pub(super) struct Planner<'a> {
    machine: &'a Machine,
    blocks: Vec<Block>,
    /// The direction of the last block.
    heading: Option<Direction>,
    seconds: f64,
}

impl<'a> Planner<'a> {
    pub(super) fn new(machine: &'a Machine) -> Self {
        Self { machine, blocks: Vec::new(), heading: None, seconds: 0.0 }
    }

    /// Takes up a motion from `at` and returns its length in nanometres.
    pub(super) fn step(&mut self, at: Position, step: &Move) -> f64 {
        match *step {
            Move::Dwell { milliseconds } => {
                self.wait(milliseconds);
                0.0
            }
            Move::Rapid { to } => self.line(coordinates(at), coordinates(to), None),
            Move::Feed { to, feed } => {
                self.line(coordinates(at), coordinates(to), Some(feed.nm_per_second()))
            }
            Move::Arc { to, center, turn, feed } => {
                let arc = Arc { start: at.point(), end: to.point(), center, turn };
                self.chords(&arc, (at.z, to.z), feed.nm_per_second());
                let (flat, climb) = (arc.length(), (to.z - at.z).to_f64());
                (flat * flat + climb * climb).sqrt()
            }
        }
    }

    /// Stops, and waits.
    pub(super) fn wait(&mut self, milliseconds: u32) {
        self.stop();
        self.seconds += f64::from(milliseconds) / 1000.0;
    }

    /// An arc as Grbl divides it.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
    fn chords(&mut self, arc: &Arc, (from, to): (Nm, Nm), speed: f64) {
        let (radius, climb) = (arc.radius(), (to - from).to_f64());
        // A circle smaller than the tolerance has no such chord: `max` takes one line for what is
        // not a number.
        let half_chord = (ARC_TOLERANCE * (2.0 * radius - ARC_TOLERANCE)).sqrt();
        let count = (0.5 * arc.sweep().abs() * radius / half_chord).floor().max(1.0) as u32;
        let mut at = [arc.start.x.to_f64(), arc.start.y.to_f64(), from.to_f64()];
        for (index, (x, y)) in (1..).zip(arc.divided(count)) {
            let part = f64::from(index) / f64::from(count);
            let end = [x, y, from.to_f64() + climb * part];
            self.line(at, end, Some(speed));
            at = end;
        }
    }

    /// A line at a speed, or as fast as the axes go.
    fn line(&mut self, from: [f64; 3], to: [f64; 3], speed: Option<f64>) -> f64 {
        let way = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let length = dot(way, way).sqrt();
        if length > 0.0 {
            self.block(length, way.map(|part| part / length), speed);
        }
        length
    }

    fn block(&mut self, length: f64, direction: Direction, speed: Option<f64>) {
        let Machine { rapid, feed, .. } = self.machine;
        let rates = match speed {
            None => Some(rapid),
            Some(_) => feed.as_ref(),
        };
        let most =
            rates.map_or(f64::INFINITY, |rates| along(rates.map(|rate| rate.nm_per_second()), direction));
        let speed = speed.unwrap_or(f64::INFINITY).min(most).max(LEAST_SPEED);
        let acceleration = along(self.machine.acceleration.map(Acceleration::nm_per_s2), direction);
        let entry = match (self.heading, self.blocks.last()) {
            (Some(heading), Some(before)) => {
                let slower = before.speed.min(speed);
                self.corner(heading, direction).min(slower * slower)
            }
            _ => 0.0,
        };
        self.blocks.push(Block { length, speed, acceleration, entry });
        self.heading = Some(direction);
    }

    /// The square of the most speed round the corner between two directions.
    fn corner(&self, before: Direction, after: Direction) -> f64 {
        let cos = -dot(before, after);
        if cos > 0.999_999 {
            return 0.0;
        }
        if cos < -0.999_999 {
            return f64::INFINITY;
        }
        let aside = [after[0] - before[0], after[1] - before[1], after[2] - before[2]];
        let length = dot(aside, aside).sqrt();
        let acceleration =
            along(self.machine.acceleration.map(Acceleration::nm_per_s2), aside.map(|part| part / length));
        let sin_half = (0.5 * (1.0 - cos)).sqrt();
        acceleration * self.machine.junction_deviation.to_f64() * sin_half / (1.0 - sin_half)
    }

    /// Runs all blocks to a standstill.
    pub(super) fn stop(&mut self) {
        let blocks = std::mem::take(&mut self.blocks);
        let mut entry = 0.0;
        for (index, block) in blocks.iter().enumerate() {
            let reachable = entry + 2.0 * block.acceleration * block.length;
            let known = &blocks[index + 1..blocks.len().min(index + LOOK_AHEAD)];
            let exit = stoppable(known).min(reachable);
            self.seconds += trapezoid(block.length, (entry, exit), block.speed, block.acceleration);
            entry = exit;
        }
        self.heading = None;
    }

    /// How long it took so far, all blocks run.
    pub(super) fn seconds(&mut self) -> f64 {
        self.stop();
        self.seconds
    }
}

/// The square of the most speed at which the first of `blocks` may begin so that the machine can
/// stop at the end of the last.
fn stoppable(blocks: &[Block]) -> f64 {
    let stops = |after: f64, block: &Block| block.entry.min(after + 2.0 * block.acceleration * block.length);
    blocks.iter().rev().fold(0.0, stops)
}

/// The time along `length` between two squared speeds, at most at `speed`.
fn trapezoid(length: f64, (entry, exit): (f64, f64), speed: f64, acceleration: f64) -> f64 {
    let top = (speed * speed).min(acceleration * length + (entry + exit) / 2.0).max(entry).max(exit);
    let ramps = (2.0 * top - entry - exit) / (2.0 * acceleration);
    let level = (length - ramps).max(0.0);
    let peak = top.sqrt();
    (2.0 * peak - entry.sqrt() - exit.sqrt()) / acceleration + level / peak.max(1.0)
}

/// The time from a standstill to a standstill along `length` at `speed` (nanometres per second): a
/// motion between two others that turn sharply.
pub(super) fn hop(length: Nm, speed: f64, acceleration: Acceleration) -> f64 {
    trapezoid(length.to_f64(), (0.0, 0.0), speed, acceleration.nm_per_s2())
}

/// What all three axes' limits allow along a direction.
fn along(limits: [f64; 3], direction: Direction) -> f64 {
    let axes = limits.into_iter().zip(direction).filter(|(_, part)| *part != 0.0);
    axes.map(|(limit, part)| limit / part.abs()).fold(f64::INFINITY, f64::min)
}

fn coordinates(at: Position) -> [f64; 3] {
    [at.x, at.y, at.z].map(Nm::to_f64)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_way_takes_its_length_over_its_speed_and_the_ramps() {
        // 100 mm at 10 mm/s and 50 mm/s²: 0.2 s up, 0.2 s down over 1 mm each, 98 mm level.
        let seconds = trapezoid(100e6, (0.0, 0.0), 10e6, 50e6);
        assert!((seconds - (0.4 + 9.8)).abs() < 1e-9, "{seconds} s");
    }

    #[test]
    fn a_short_way_never_reaches_its_speed() {
        // 1 mm at 50 mm/s²: half up and half down, 2 √(1 / 50) s.
        let seconds = trapezoid(1e6, (0.0, 0.0), 100e6, 50e6);
        assert!((seconds - 2.0 * (1.0_f64 / 50.0).sqrt()).abs() < 1e-9, "{seconds} s");
    }

    #[test]
    fn straight_on_costs_nothing_and_turning_back_stops() {
        let machine = Machine::default();
        let planner = Planner::new(&machine);
        assert!(planner.corner([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]).is_infinite(), "straight on");
        assert!(planner.corner([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]) < 1.0, "back");
    }

    #[test]
    fn a_right_angle_is_taken_as_grbl_takes_it() {
        // Grbl 1.1h itself, $120 = $121 = 10 mm/s², $11 = 0.01 mm: v² = 1229.117 (mm/min)².
        let machine = Machine { acceleration: [Acceleration::from_mm_per_s2(10); 3], ..Machine::default() };
        let corner = Planner::new(&machine).corner([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let in_mm_per_min = corner * 3600.0 / 1e12;
        assert!((in_mm_per_min - 1229.117).abs() < 0.01, "{in_mm_per_min}");
    }

    #[test]
    fn a_slow_axis_slows_what_goes_its_way_alone() {
        let limits = [10.0, 10.0, 1.0];
        assert!((along(limits, [1.0, 0.0, 0.0]) - 10.0).abs() < 1e-9, "level");
        assert!((along(limits, [0.8, 0.0, 0.6]) - 1.0 / 0.6).abs() < 1e-9, "down a slope");
    }
}
