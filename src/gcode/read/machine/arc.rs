//! G2 and G3: round a centre or with a radius, in any plane, once or several times, level or as a
//! helix.

use crate::gcode::read::block::Word;
use crate::gcode::read::error::ReadError;
use crate::gcode::read::expression::index;
use crate::gcode::read::frame::Plane;
use crate::gcode::read::listing::{Odd, Way};
use crate::gcode::read::meaning::Distance;
use crate::geometry::{Nm, Point, Turn};

use super::place::{AXES, Target};
use super::{Machine, Run};

/// The letters of the centre.
const CENTERS: [char; 3] = ['I', 'J', 'K'];
/// How far the ends of an arc may differ in their distance from its centre, in nanometres or as a
/// share of it: Grbl's limits.
const OFF: f64 = 5_000.0;
const OFF_SHARE: f64 = 1e-3;
/// The same for Mach3, without a share; half a nanometre is what rounding makes of it.
const OFF_MACH: f64 = 2_000.5;
/// So many turns one line may make. Chosen: more than a bore has.
const TURNS: u32 = 10_000;
/// How far a chord may leave an arc that no motion of the plane stands for, in nanometres. Chosen:
/// far below a cut's accuracy.
const SAGITTA: f64 = 1_000.0;

/// An arc in its plane, in nanometres.
struct Round {
    center: [f64; 2],
    from: [f64; 2],
    /// Signed, in radians, whole turns included.
    sweep: f64,
    radii: [f64; 2],
}

impl Machine {
    /// An arc, of whose words this is the `first`.
    pub(super) fn arc(&mut self, run: Run<'_>, turn: Turn, first: Word) -> Result<(), ReadError> {
        let plane = self.modal.plane;
        let [a, b, normal] = plane.axes();
        // The place is told first: where the zero lies is not known before.
        let _ = self.target(run)?;
        let (from_a, from_b) = (self.known(run, a)?, self.known(run, b)?);
        let to = self.target(run)?;
        let (Some(to_a), Some(to_b)) = (to[a], to[b]) else {
            return Err(run.error(first, "an arc to an unknown position: its zero is not given"));
        };
        let across = run.block.get(CENTERS[normal]).filter(|word| word.value != 0.0);
        if let Some(word) = across {
            return Err(run.error(word, "expected the centre in the plane of the arc"));
        }
        let is_told = [a, b].iter().any(|&axis| run.block.get(AXES[axis]).is_some());
        if !is_told {
            self.listing.is_odd(Odd::Endless, run.line());
        }
        if self.modal.distance == Distance::Incremental {
            self.listing.is_odd(Odd::StepArc, run.line());
        }
        let (start, end) = ([from_a.to_f64(), from_b.to_f64()], [to_a.to_f64(), to_b.to_f64()]);
        let center = match run.block.get('R') {
            Some(word) => {
                self.listing.is_odd(Odd::Radius, run.line());
                let radius = Nm::new(self.scaled(run, word)?).to_f64();
                if libm::hypot(end[0] - start[0], end[1] - start[1]) > 2.0 * radius.abs() + 1.0 {
                    self.listing.is_odd(Odd::ShortRadius, run.line());
                }
                by_radius(start, end, radius, turn).map_err(|what| run.error(word, what))?
            }
            None => self.center(run, plane, [from_a, from_b])?,
        };
        let round =
            round(start, end, center, turn, self.turns(run)?).map_err(|what| run.error(first, what))?;
        self.odd_arc(run, &round, turn, is_told && (from_a, from_b) == (to_a, to_b));
        let from = self.axes.map(|axis| axis.at);
        let rise = from[normal].zip(to[normal]).map_or(0.0, |(from, to)| (to - from).to_f64());
        let way = round.sweep.abs() * f64::midpoint(round.radii[0], round.radii[1]);
        self.inverse_feed(run, (way * way + rise * rise).sqrt())?;
        if plane == Plane::Xy {
            self.in_plane(run, &round, turn, to)
        } else {
            self.as_chords(run, &round, to)
        }
    }

    /// Counts arcs that some controllers refuse, or run otherwise.
    fn odd_arc(&mut self, run: Run<'_>, round: &Round, turn: Turn, returns: bool) {
        let [start, end] = round.radii;
        let off = (start - end).abs();
        // TinyG has the two limits of Grbl the wrong way round (plan_arc.c).
        if off < OFF && off > start * OFF_SHARE {
            self.listing.is_odd(Odd::SmallUneven, run.line());
        }
        if off > OFF_MACH {
            self.listing.is_odd(Odd::Uneven, run.line());
        }
        if returns {
            self.listing.is_odd(Odd::Circle, run.line());
            if turn == Turn::CounterClockwise {
                self.listing.is_odd(Odd::LeftCircle, run.line());
            }
        }
    }

    /// The centre by I, J and K.
    fn center(&mut self, run: Run<'_>, plane: Plane, from: [Nm; 2]) -> Result<[f64; 2], ReadError> {
        let mut center = [0.0; 2];
        for (index, axis) in plane.axes().into_iter().take(2).enumerate() {
            let word: Option<Word> = run.block.get(CENTERS[axis]);
            let system = self.modal.system;
            let at = match (word, self.modal.centers) {
                (None, Distance::Incremental) => from[index],
                (None, Distance::Absolute) => {
                    let letter = CENTERS[axis];
                    return Err(run.refuse(format!("with G90.1 an arc needs {letter}, too")));
                }
                (Some(word), Distance::Incremental) => from[index] + Nm::new(self.scaled(run, word)?),
                (Some(word), Distance::Absolute) => {
                    let origin = self.axes[axis].origin(system);
                    let unknown = || run.error(word, "an unknown centre: its zero is not given");
                    origin.ok_or_else(unknown)? + Nm::new(self.scaled(run, word)?)
                }
            };
            center[index] = at.to_f64();
        }
        Ok(center)
    }

    /// P: how often it goes round, the last time to its end.
    fn turns(&self, run: Run<'_>) -> Result<u32, ReadError> {
        let Some(word) = run.block.get('P') else { return Ok(1) };
        let turns = index(word.value).filter(|turns| (1..=TURNS).contains(turns));
        turns.ok_or_else(|| run.error(word, format!("expected a number of turns from 1 to {TURNS}")))
    }

    /// Whole turns, and what is left, as arcs.
    fn in_plane(&mut self, run: Run<'_>, round: &Round, turn: Turn, to: Target) -> Result<(), ReadError> {
        let center = Point::from_f64(round.center[0], round.center[1]);
        let whole = std::f64::consts::TAU;
        let start = self.axes.map(|axis| axis.at);
        let rise = start[2].zip(to[2]).map_or(0.0, |(from, to)| (to - from).to_f64());
        let mut done = whole;
        while done < round.sweep.abs() - 1e-9 {
            let z = start[2].map(|z| z + Nm::from_f64(rise * done / round.sweep.abs()));
            self.go(run, Way::Arc { center, turn }, [start[0], start[1], z])?;
            done += whole;
        }
        self.go(run, Way::Arc { center, turn }, to)
    }

    /// Chords, for arcs across the board.
    fn as_chords(&mut self, run: Run<'_>, round: &Round, to: Target) -> Result<(), ReadError> {
        self.listing.is_indirect(run.line(), "an arc in another plane");
        let [a, b, normal] = self.modal.plane.axes();
        let start = self.axes.map(|axis| axis.at);
        let rise = start[normal].zip(to[normal]).map_or(0.0, |(from, to)| (to - from).to_f64());
        let count = chords(round);
        for step in 1..count {
            let share = f64::from(step) / f64::from(count);
            let radius = round.radii[0] + (round.radii[1] - round.radii[0]) * share;
            let first = libm::atan2(round.from[1] - round.center[1], round.from[0] - round.center[0]);
            let (sin, cos) = libm::sincos(first + round.sweep * share);
            let mut by = to;
            by[a] = Some(Nm::from_f64(round.center[0] + radius * cos));
            by[b] = Some(Nm::from_f64(round.center[1] + radius * sin));
            by[normal] = start[normal].map(|at| at + Nm::from_f64(rise * share));
            self.go(run, Way::Feed, by)?;
        }
        self.go(run, Way::Feed, to)
    }
}

/// How many chords stay within [`SAGITTA`] of an arc.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
fn chords(round: &Round) -> u32 {
    let radius = round.radii[0].max(round.radii[1]).max(1.0);
    let step = 2.0 * libm::acos((1.0 - SAGITTA / radius).clamp(-1.0, 1.0));
    (round.sweep.abs() / step.max(1e-4)).ceil().clamp(1.0, 1e6) as u32
}

/// The arc between two places round a centre; a whole turn where it ends where it begins.
fn round(from: [f64; 2], to: [f64; 2], center: [f64; 2], turn: Turn, turns: u32) -> Result<Round, String> {
    let radius = |p: [f64; 2]| libm::hypot(p[0] - center[0], p[1] - center[1]);
    let angle = |p: [f64; 2]| libm::atan2(p[1] - center[1], p[0] - center[0]);
    let (start, end) = (radius(from), radius(to));
    let off = (start - end).abs();
    if start < 1.0 || (off > OFF && off > start * OFF_SHARE) {
        let (start, end) = (start / 1e6, end / 1e6);
        return Err(format!(
            "the arc's ends are {start:.4} mm and {end:.4} mm from its centre: expected the same above zero"
        ));
    }
    let whole = std::f64::consts::TAU;
    let ahead = match turn {
        Turn::CounterClockwise => angle(to) - angle(from),
        Turn::Clockwise => angle(from) - angle(to),
    };
    let closed = libm::hypot(to[0] - from[0], to[1] - from[1]) < 0.5;
    let ahead = if closed { whole } else { ahead.rem_euclid(whole) };
    // What a rounded angle makes of nothing is a whole turn.
    let ahead = if ahead == 0.0 { whole } else { ahead } + f64::from(turns - 1) * whole;
    let sweep = if turn == Turn::CounterClockwise { ahead } else { -ahead };
    Ok(Round { center, from, sweep, radii: [start, end] })
}

/// The centre of the arc of this radius; negative for more than half a turn (RS274/NGC §3.5.3.1).
///
/// ```text
///              c           |ac| = r, m the middle of the chord;
///            ╱ ┊ ╲         c lies left of a → b for a short turn against the clock
///          a───m───b
/// ```
fn by_radius(a: [f64; 2], b: [f64; 2], radius: f64, turn: Turn) -> Result<[f64; 2], &'static str> {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let half = libm::hypot(x, y) / 2.0;
    if half < 0.5 {
        return Err("an arc with R must end elsewhere than it begins");
    }
    if half > radius.abs() + OFF {
        return Err("the radius is smaller than half the way to the end");
    }
    let height = (radius * radius - half * half).max(0.0).sqrt();
    let left = (turn == Turn::CounterClockwise) == (radius > 0.0);
    let along = if left { height } else { -height } / (2.0 * half);
    Ok([a[0] + x / 2.0 - y * along, a[1] + y / 2.0 + x * along])
}
