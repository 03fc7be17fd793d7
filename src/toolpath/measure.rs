//! What a program amounts to on a machine: lengths, retracts, time.
//!
//! There is one estimate of time, the [planner's](super::planner): the summary, the report, the
//! page's player and the headers of programs all take theirs from here.

use std::collections::BTreeMap;

use crate::geometry::Nm;

use super::machine::Machine;
use super::planner::Planner;
use super::program::{Move, Position, Program};

/// What a program amounts to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// The length of all feeds that go sideways.
    pub cut_length: Nm,
    /// The length of all level rapids.
    pub rapid_length: Nm,
    /// How often the tool rises to the safe height.
    pub retracts: u64,
    /// How long the machine runs, spinning up included; what a person takes to change tools is not.
    pub seconds: f64,
    /// How often it waits for another tool.
    pub tool_changes: u32,
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
    // Sections of one tool are one run: the spindle turns on.
    for (index, run) in program.sections.chunk_by(|a, b| a.tool == b.tool).enumerate() {
        let mut planner = Planner::new(machine);
        let mut cut_length = 0.0;
        for planned in run.iter().flat_map(|section| &section.moves) {
            if let Some(turn) = descent(at, planned) {
                total.rapid_length += Nm::from_f64(planner.step(at, &Move::Rapid { to: turn }));
                at = turn;
            }
            let (step, block) = (planned, planner.step(at, planned));
            match step {
                Move::Rapid { to } if to.z == at.z => total.rapid_length += Nm::from_f64(block),
                Move::Rapid { to } if to.z == program.safe && at.z < program.safe => total.retracts += 1,
                Move::Feed { to, .. } if to.point() == at.point() => {}
                Move::Feed { .. } | Move::Arc { .. } => cut_length += block,
                Move::Rapid { .. } | Move::Dwell { .. } => {}
            }
            at = step.to().unwrap_or(at);
        }
        let seconds = planner.seconds();
        let cut_length = Nm::from_f64(cut_length);
        let tool = &run[0].tool;
        let entry = tools.entry(tool.number).or_insert_with(|| ToolStatistics {
            number: tool.number,
            name: tool.name.clone(),
            cut_length: Nm::ZERO,
            seconds: 0.0,
        });
        entry.cut_length += cut_length;
        entry.seconds += seconds;
        total.cut_length += cut_length;
        total.tool_changes += u32::from(index > 0);
        total.seconds += seconds + f64::from(machine.spin_up) / 1000.0;
    }
    total.tools = tools.into_values().collect();
    total
}

/// Where a rapid that is written as two turns: from the height at which a tool was changed the
/// machine goes there first, and then down.
fn descent(at: Position, step: &Move) -> Option<Position> {
    match step {
        Move::Rapid { to } if to.z < at.z && to.point() != at.point() => Some(Position { z: at.z, ..*to }),
        _ => None,
    }
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
    fn durations_read_well() {
        for (seconds, text) in [(40.2, "40 s"), (750.0, "12:30 min"), (3900.0, "1:05 h")] {
            assert_eq!(duration(seconds), text, "{seconds} s");
        }
    }
}
