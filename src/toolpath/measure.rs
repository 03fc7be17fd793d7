//! How long a program takes: a trapezoid planner like Grbl's.
//!
//! Each motion is a block with a nominal speed. At a corner the machine may keep the speed at which it would follow a small circle
//! that touches both ways and leaves the corner by the junction deviation; a backward and a forward pass make
//! every block's entry speed reachable with the acceleration, and each block then takes the time of its trapezoid (Grbl's
//! planner.c, §junction deviation).

use std::collections::BTreeMap;

use crate::geometry::{Arc, Nm};

use super::feed::Feed;
use super::machine::Machine;
use super::program::{Move, Position, Program};

/// What a program amounts to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// The length of all feeds that go sideways.
    pub cut_length: Nm,
    /// The length of all level rapids.
    pub rapid_length: Nm,
    /// How often the tool rises to the safe height.
    pub lifts: u64,
    /// How long it takes, tool changes and spinning up included.
    pub seconds: f64,
    /// The same for each tool, by number.
    pub tools: Vec<ToolStatistics>,
}

/// What one tool does.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolStatistics {
    /// Its number.
    pub number: u32,
    /// Its name.
    pub name: String,
    /// As in [`Statistics::cut_length`].
    pub cut_length: Nm,
    /// How long it moves.
    pub seconds: f64,
}

/// Measures a program on a machine.
#[must_use]
pub fn measure(program: &Program, machine: &Machine) -> Statistics {
    let mut total = Statistics::default();
    let mut tools: BTreeMap<u32, ToolStatistics> = BTreeMap::new();
    let mut at = Position { z: program.safe, ..Position::default() };
    for (index, section) in program.sections.iter().enumerate() {
        let mut planner = Planner::new(machine);
        let mut cut_length = 0.0;
        for step in &section.moves {
            let block = planner.step(at, step);
            match step {
                Move::Rapid { to } if to.z == at.z => total.rapid_length += Nm::from_f64(block),
                Move::Rapid { to } if to.z == program.safe && at.z < program.safe => total.lifts += 1,
                Move::Feed { to, .. } if to.point() == at.point() => {}
                Move::Feed { .. } | Move::Arc { .. } => cut_length += block,
                Move::Rapid { .. } | Move::Dwell { .. } => {}
            }
            at = step.to().unwrap_or(at);
        }
        let seconds = planner.finish();
        let cut_length = Nm::from_f64(cut_length);
        let entry = tools.entry(section.tool.number).or_insert_with(|| ToolStatistics {
            number: section.tool.number,
            name: section.tool.name.clone(),
            cut_length: Nm::ZERO,
            seconds: 0.0,
        });
        entry.cut_length += cut_length;
        entry.seconds += seconds;
        total.cut_length += cut_length;
        let change = if index > 0 { f64::from(machine.tool_change) } else { 0.0 };
        total.seconds += seconds + change + f64::from(machine.spin_up) / 1000.0;
    }
    total.tools = tools.into_values().collect();
    total
}

/// One motion as the planner sees it.
struct Block {
    length: f64,
    speed: f64,
    /// The most speed at its beginning that the corner before it allows.
    entry: f64,
}

/// Adds up the time of motions; whatever stops the machine empties its blocks.
struct Planner<'a> {
    machine: &'a Machine,
    acceleration: f64,
    blocks: Vec<Block>,
    /// The direction at the end of the last block.
    heading: Option<[f64; 3]>,
    seconds: f64,
}

impl<'a> Planner<'a> {
    fn new(machine: &'a Machine) -> Self {
        let acceleration = f64::from(machine.acceleration.max(1)) * 1e6;
        Self { machine, acceleration, blocks: Vec::new(), heading: None, seconds: 0.0 }
    }

    /// Takes up a motion from `at` and returns its length in nanometres.
    fn step(&mut self, at: Position, step: &Move) -> f64 {
        match *step {
            Move::Dwell { milliseconds } => {
                self.stop();
                self.seconds += f64::from(milliseconds) / 1000.0;
                0.0
            }
            Move::Rapid { to } => {
                let speed = if to.point() == at.point() { self.machine.rapid_z } else { self.machine.rapid };
                self.line(at, to, speed.nm_per_second())
            }
            Move::Feed { to, feed } => self.line(at, to, feed.nm_per_second()),
            Move::Arc { to, center, turn, feed } => {
                let arc = Arc { start: at.point(), end: to.point(), center, turn };
                let (flat, climb) = (arc.length(), (to.z - at.z).to_f64());
                let length = (flat * flat + climb * climb).sqrt();
                let speed = feed.nm_per_second().min((self.acceleration * arc.radius()).sqrt());
                let tangents = [arc.start, arc.end].map(|p| tangent(&arc, p));
                self.block(length, speed, tangents[0], tangents[1]);
                length
            }
        }
    }

    fn line(&mut self, from: Position, to: Position, speed: f64) -> f64 {
        let way = [to.x - from.x, to.y - from.y, to.z - from.z].map(Nm::to_f64);
        let length = dot(way, way).sqrt();
        if length > 0.0 {
            let direction = way.map(|part| part / length);
            self.block(length, speed, direction, direction);
        }
        length
    }

    fn block(&mut self, length: f64, speed: f64, first: [f64; 3], last: [f64; 3]) {
        let entry = self.heading.map_or(0.0, |before| self.corner(before, first));
        let before = self.blocks.last().map_or(0.0, |block| block.speed);
        self.blocks.push(Block { length, speed, entry: entry.min(speed).min(before) });
        self.heading = Some(last);
    }

    /// The most speed round the corner between two directions.
    fn corner(&self, before: [f64; 3], after: [f64; 3]) -> f64 {
        let cos = -dot(before, after).clamp(-1.0, 1.0);
        let sin_half = (0.5 * (1.0 - cos)).sqrt();
        if sin_half > 0.999_999 {
            return f64::INFINITY;
        }
        (self.acceleration * self.machine.junction_deviation.to_f64() * sin_half / (1.0 - sin_half)).sqrt()
    }

    /// Runs all blocks to a standstill.
    fn stop(&mut self) {
        let twice = 2.0 * self.acceleration;
        let mut after = 0.0_f64;
        for block in self.blocks.iter_mut().rev() {
            block.entry = block.entry.min((after * after + twice * block.length).sqrt());
            after = block.entry;
        }
        let mut entry = 0.0;
        for index in 0..self.blocks.len() {
            let Block { length, speed, .. } = self.blocks[index];
            let reachable = (entry * entry + twice * length).sqrt();
            let exit = self.blocks.get(index + 1).map_or(0.0, |next| next.entry).min(reachable);
            self.seconds += trapezoid(length, entry, exit, speed, self.acceleration);
            entry = exit;
        }
        self.blocks.clear();
        self.heading = None;
    }

    fn finish(mut self) -> f64 {
        self.stop();
        self.seconds
    }
}

/// The time from a standstill to a standstill along `length` at `speed`: a motion between two others that turn
/// sharply.
pub(super) fn hop(length: Nm, speed: Feed, machine: &Machine) -> f64 {
    let acceleration = f64::from(machine.acceleration.max(1)) * 1e6;
    trapezoid(length.to_f64(), 0.0, 0.0, speed.nm_per_second(), acceleration)
}

/// The time along `length` from speed `entry` to speed `exit`, at most `speed` in between.
fn trapezoid(length: f64, entry: f64, exit: f64, speed: f64, acceleration: f64) -> f64 {
    let peak = (acceleration * length + (entry * entry + exit * exit) / 2.0).sqrt();
    let top = peak.min(speed).max(entry).max(exit);
    let ramps = (2.0 * top * top - entry * entry - exit * exit) / (2.0 * acceleration);
    let level = (length - ramps).max(0.0);
    (2.0 * top - entry - exit) / acceleration + level / top.max(1.0)
}

/// The direction in which an arc passes `p`, which lies on it.
fn tangent(arc: &Arc, p: crate::geometry::Point) -> [f64; 3] {
    let (radial, length) = (p - arc.center, arc.center.distance(p).max(1.0));
    let sign = if arc.sweep() > 0.0 { 1.0 } else { -1.0 };
    [-radial.y.to_f64() / length * sign, radial.x.to_f64() / length * sign, 0.0]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A time in seconds as people say it: `1:05 h`, `12:30 min`, `40 s`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates; a display figure"
)]
#[must_use]
pub fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, seconds) => format!("{minutes}:{seconds:02} min"),
        (hours, minutes, _) => format!("{hours}:{minutes:02} h"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_way_takes_its_length_over_its_speed_and_the_ramps() {
        // 100 mm at 10 mm/s and 50 mm/s²: 0.2 s up, 0.2 s down over 1 mm each, 98 mm level.
        let seconds = trapezoid(100e6, 0.0, 0.0, 10e6, 50e6);
        assert!((seconds - (0.4 + 9.8)).abs() < 1e-9, "{seconds} s");
    }

    #[test]
    fn a_short_way_never_reaches_its_speed() {
        // 1 mm at 50 mm/s²: half up and half down, 2 √(1 / 50) s.
        let seconds = trapezoid(1e6, 0.0, 0.0, 100e6, 50e6);
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
    fn durations_read_well() {
        for (seconds, text) in [(40.2, "40 s"), (750.0, "12:30 min"), (3900.0, "1:05 h")] {
            assert_eq!(duration(seconds), text, "{seconds} s");
        }
    }
}
