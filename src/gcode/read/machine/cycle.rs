//! The drilling cycles, in all planes (RS274/NGC §3.5.16, LinuxCNC's G73, G74 and G98/G99, Fanuc's
//! words).
//!
//! ```text
//!   initial ───┐          ┌─── G98
//!              ┊ rapid    ┊
//!         R ───┤  ┌───────┴─── G99
//!              │  │ feed down; pecks; up again
//!         Z ───┴──┘
//! ```

use crate::gcode::read::block::Word;
use crate::gcode::read::error::ReadError;
use crate::gcode::read::expression::index;
use crate::gcode::read::listing::Way;
use crate::gcode::read::meaning::{Cycle, Distance};
use crate::geometry::Nm;

use super::place::{AXES, Target};
use super::{Machine, Run};

/// What the cycles remember from hole to hole.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Holes {
    initial: Option<Nm>,
    bottom: Option<Nm>,
    retract: Option<Nm>,
    peck: Option<Nm>,
    /// In milliseconds.
    dwell: u64,
}

/// How far G73 goes up after a peck: LinuxCNC's hundredth of an inch.
const BACK: Nm = Nm::from_um(254);
/// Holes of one line. Chosen: more than a strip of pads has.
const REPEATS: u32 = 100_000;
/// The smallest peck. Chosen: below it none is meant, and the motions would have no end.
const SMALLEST: Nm = Nm::from_um(1);

/// A hole: where, and between which levels.
struct Hole {
    over: Target,
    bottom: Nm,
    retract: Nm,
    up: Nm,
}

impl Machine {
    /// What G98 goes back to.
    pub(super) fn begin_cycle(&mut self) {
        let normal = self.modal.plane.axes()[2];
        self.holes = Holes { initial: self.axes[normal].at, ..Holes::default() };
    }

    /// A hole, of whose words this is the `first`.
    pub(super) fn drill(&mut self, run: Run<'_>, cycle: Cycle, first: Word) -> Result<(), ReadError> {
        let [a, b, normal] = self.modal.plane.axes();
        if normal != 2 || self.modal.distance == Distance::Incremental {
            self.listing.is_indirect(run.line(), "a drilling cycle in G91 or in another plane");
        }
        let incremental = self.modal.distance == Distance::Incremental;
        self.remember(run, cycle, normal, incremental)?;
        let (Some(bottom), Some(retract)) = (self.holes.bottom, self.holes.retract) else {
            return Err(run.error(first, "a drilling cycle needs Z and R"));
        };
        let level = self.axes[normal].at;
        let (bottom, retract) = if incremental {
            // As LinuxCNC and Fanuc do: from where it was before the first hole of the series.
            let from = self.known(run, normal)?;
            let retract = *self.holes.initial.get_or_insert(from) + retract;
            (retract + bottom, retract)
        } else {
            (bottom, retract)
        };
        if bottom > retract {
            return Err(run.error(first, "expected R above Z"));
        }
        let wrong = |word| run.error(word, format!("expected a number of holes from 1 to {REPEATS}"));
        let repeats = match run.block.get('L') {
            None => 1,
            Some(word) => {
                index(word.value).filter(|count| (1..=REPEATS).contains(count)).ok_or_else(|| wrong(word))?
            }
        };
        let initial = self.holes.initial.or(level).unwrap_or(retract);
        let up = if self.modal.to_initial { initial.max(retract) } else { retract };
        if level.is_none_or(|level| level < retract) {
            let mut to = self.axes.map(|axis| axis.at);
            to[normal] = Some(retract);
            self.go(run, Way::Rapid, to)?;
        }
        for _ in 0..repeats {
            let over = self.target(run)?;
            if incremental && run.block.get(AXES[normal]).is_none() && (over[a], over[b]) == (None, None) {
                return Err(run.error(first, "a hole at an unknown position"));
            }
            self.hole(run, cycle, &Hole { over, bottom, retract, up }, normal)?;
        }
        Ok(())
    }

    /// The words of a cycle that hold until others come.
    fn remember(
        &mut self,
        run: Run<'_>,
        cycle: Cycle,
        normal: usize,
        incremental: bool,
    ) -> Result<(), ReadError> {
        let system = self.modal.system;
        let origin = if incremental { Some(Nm::ZERO) } else { self.axes[normal].origin(system) };
        let unknown = || run.refuse("an unknown depth: its zero is not given");
        for letter in [AXES[normal], 'R'] {
            let Some(word) = run.block.get(letter) else { continue };
            let value = origin.ok_or_else(unknown)? + Nm::new(self.scaled(run, word)?);
            if letter == 'R' { self.holes.retract = Some(value) } else { self.holes.bottom = Some(value) }
        }
        if let Some(word) = run.block.get('Q') {
            let peck = Nm::new(self.scaled(run, word)?);
            if peck > Nm::ZERO && peck < SMALLEST {
                return Err(run.error(word, "expected pecks of a micrometre or more"));
            }
            self.holes.peck = Some(peck).filter(|&peck| peck > Nm::ZERO);
        }
        if let Some(word) = run.block.get('P') {
            self.holes.dwell = milliseconds(word.value * 1000.0);
            if matches!(cycle, Cycle::Drill { dwells: true } | Cycle::Bore { dwells: true }) {
                self.listing.waits(self.holes.dwell, run.line());
            }
        }
        Ok(())
    }

    /// Over it, down to R, through the material, up again.
    fn hole(&mut self, run: Run<'_>, cycle: Cycle, hole: &Hole, normal: usize) -> Result<(), ReadError> {
        let at = |level: Nm| {
            let mut to = hole.over;
            to[normal] = Some(level);
            to
        };
        let level = self.axes[normal].at.unwrap_or(hole.retract).max(hole.retract);
        self.go(run, Way::Rapid, at(level))?;
        self.start(run, at(hole.bottom))?;
        if level != hole.retract {
            self.go(run, Way::Rapid, at(hole.retract))?;
        }
        let pecks = matches!(cycle, Cycle::Peck | Cycle::Break);
        let step = self.holes.peck.filter(|_| pecks);
        let mut depth = hole.retract;
        while depth > hole.bottom {
            depth = step.map_or(hole.bottom, |step| (depth - step).max(hole.bottom));
            self.go(run, Way::Feed, at(depth))?;
            if depth > hole.bottom {
                let up = if cycle == Cycle::Break { (depth + BACK).min(hole.retract) } else { hole.retract };
                self.go(run, Way::Rapid, at(up))?;
            }
        }
        match cycle {
            Cycle::Drill { dwells: true } | Cycle::Bore { dwells: true } => {
                self.listing.dwell += self.holes.dwell
            }
            Cycle::Drill { .. }
            | Cycle::Bore { .. }
            | Cycle::Peck
            | Cycle::Break
            | Cycle::Tap
            | Cycle::Stop => {}
        }
        if matches!(cycle, Cycle::Bore { .. } | Cycle::Tap) {
            self.go(run, Way::Feed, at(hole.retract))?;
        }
        if self.axes[normal].at == Some(hole.up) { Ok(()) } else { self.go(run, Way::Rapid, at(hole.up)) }
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
fn milliseconds(value: f64) -> u64 {
    value.clamp(0.0, 1e12) as u64
}
