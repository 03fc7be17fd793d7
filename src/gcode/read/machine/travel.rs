//! Motions: which kind a line asks for, and what is known of where it goes.

use crate::gcode::read::error::ReadError;
use crate::gcode::read::listing::{Motion, Place, Way};
use crate::gcode::read::meaning::{FeedMode, Meaning, Mode, meaning};
use crate::geometry::Nm;

use super::place::{AXES, Target};
use super::{Machine, Orders, Run};

/// How many motions are followed. Chosen: a hundred times as many as a large board has.
const MOTIONS: usize = 5_000_000;

/// Heights of the machine so far below its top are above all work. Chosen: how far homing pulls
/// off, and what posts for machines that home to the top write.
const TOP: Nm = Nm::from_mm(10);

impl Machine {
    /// The kind of motion that holds from a line on.
    pub(super) fn take_mode(&mut self, orders: &Orders) {
        let Some(mode) = orders.motion else { return };
        if let (Mode::Cycle(_), false) = (mode, matches!(self.modal.mode, Mode::Cycle(_))) {
            self.begin_cycle();
        }
        self.modal.mode = mode;
    }

    /// The motion of a line, if it has one.
    pub(super) fn motion(&mut self, run: Run<'_>, orders: &Orders) -> Result<(), ReadError> {
        let block = run.block;
        // The words of a call are its own, and of a dwell without P the X that is its time.
        let calls = block.orders.iter().any(|order| meaning(order.letter, order.key) == Meaning::Call);
        let is_timed = orders.dwell && orders.motion.is_none() && block.get('P').is_none();
        if is_timed && let Some(word) = block.first("YZ") {
            return Err(run.error(word, "a dwell without P beside a coordinate: controllers differ in it"));
        }
        if is_timed || calls {
            return Ok(());
        }
        let letters = if matches!(self.modal.mode, Mode::Arc(_)) { "XYZIJKR" } else { "XYZ" };
        let Some(first) = block.first(letters).or(block.radius).or(block.angle) else { return Ok(()) };
        if let Some(line) = self.compensated {
            let what = format!("cutter compensation since line {line}: the path depends on a tool table");
            return Err(run.error(first, what));
        }
        if orders.in_machine {
            return self.in_machine(run);
        }
        match self.modal.mode {
            Mode::None => Err(run.error(first, "a coordinate before the first of G0 to G3 or a cycle")),
            Mode::Rapid => {
                let to = self.target(run)?;
                self.go(run, Way::Rapid, to)
            }
            Mode::Feed | Mode::Synchronous { .. } => self.straight(run),
            Mode::Arc(turn) => self.arc(run, turn, first),
            Mode::Cycle(cycle) => self.drill(run, cycle, first),
            Mode::Probe => self.probe(run),
            Mode::Curve(curve) => self.curve(run, curve),
        }
    }

    /// G1, G33 and G33.1.
    fn straight(&mut self, run: Run<'_>) -> Result<(), ReadError> {
        let to = self.target(run)?;
        self.start(run, to)?;
        let from = self.axes.map(|axis| axis.at);
        if let Mode::Synchronous { returns } = self.modal.mode {
            let lead = run
                .block
                .get('K')
                .ok_or_else(|| run.refuse("expected K, the feed per revolution of the spindle"))?;
            self.modal.feed = Some(self.per_turn(run, lead, self.modal.speed.unwrap_or(0))?.abs());
            self.go(run, Way::Feed, to)?;
            return if returns { self.go(run, Way::Feed, from) } else { Ok(()) };
        }
        self.inverse_feed(run, distance(from, to))?;
        self.go(run, Way::Feed, to)
    }

    /// A motion in coordinates of the machine: known where the program has told where its zero is,
    /// a retract where only Z is given and not far below the top.
    fn in_machine(&mut self, run: Run<'_>) -> Result<(), ReadError> {
        let mut to = self.axes.map(|axis| axis.at);
        let mut unknown = [false; 3];
        for (axis, letter) in AXES.into_iter().enumerate() {
            let Some(word) = run.block.get(letter) else { continue };
            let value = Nm::new(self.scaled(run, word)?);
            to[axis] = self.axes[axis].of_machine(value);
            unknown[axis] = to[axis].is_none();
        }
        self.listing.is_indirect(run.line(), "a machine position");
        let way = if self.modal.mode == Mode::Feed { Way::Feed } else { Way::Rapid };
        if !unknown.contains(&true) {
            return self.go(run, way, to);
        }
        let low = match run.block.get('Z').filter(|_| unknown[2]) {
            Some(word) => Nm::new(self.scaled(run, word)?) < -TOP,
            None => false,
        };
        if low {
            let what = "G53 with Z below machine zero: its height above the board is unknown";
            self.listing.note(true, run.line(), what);
        } else {
            let what =
                "a machine position that the program does not give: it is assumed to be above all work";
            self.listing.note(false, run.line(), what);
        }
        if way == Way::Feed && (unknown[0] || unknown[1]) && self.axes[2].at.is_none_or(|z| z < Nm::ZERO) {
            return Err(run.refuse("a cut to a machine position that the program does not give"));
        }
        self.send(run, unknown)?;
        // What is known is gone to, too.
        let rest = [0, 1, 2].map(|axis| if unknown[axis] { self.axes[axis].at } else { to[axis] });
        if rest == self.axes.map(|axis| axis.at) { Ok(()) } else { self.go(run, Way::Rapid, rest) }
    }

    /// G38.2 to G38.5 and G31: down to the board, whose surface is zero; along other axes as far as
    /// the program says.
    fn probe(&mut self, run: Run<'_>) -> Result<(), ReadError> {
        self.listing.is_indirect(run.line(), "a probe");
        if self.modal.spinning {
            let what = "it probes while the spindle turns: the tool drills into the plate, or into the board";
            self.listing.note(true, run.line(), what);
        }
        let mut to = self.target(run)?;
        let from = self.axes.map(|axis| axis.at);
        let down = to[2] != from[2] && to[2] < Some(Nm::ZERO);
        if down {
            to[2] = Some(Nm::ZERO);
            self.listing.note(
                false,
                run.line(),
                "a probe: it is assumed to touch the surface of the board at Z0",
            );
        } else {
            self.listing.note(true, run.line(), "a probe: it is assumed to go to its end");
        }
        self.go(run, Way::Feed, to)?;
        for axis in 0..3 {
            self.axes[axis].found = to[axis] != from[axis];
        }
        // Where nobody knows how high it begins, it seems to begin where it touches.
        self.axes[2].found |= run.block.get('Z').is_some();
        self.probed = to;
        Ok(())
    }

    /// What a cut needs to know of where it begins.
    pub(super) fn start(&mut self, run: Run<'_>, to: Target) -> Result<(), ReadError> {
        let at = self.axes.map(|axis| axis.at);
        let low = |z: Option<Nm>| z.is_some_and(|z| z < Nm::ZERO);
        // Straight down it goes wherever it is.
        let moves = run.block.first("XY").is_some();
        for axis in [0, 1].into_iter().filter(|_| moves) {
            if at[axis].is_none() && (low(to[2]) || low(at[2])) {
                self.known(run, axis)?;
            }
        }
        Ok(())
    }

    /// With G93 a motion of this length takes a minute divided by F.
    pub(super) fn inverse_feed(&mut self, run: Run<'_>, length: f64) -> Result<(), ReadError> {
        if self.modal.feed_mode == FeedMode::Inverse {
            self.listing.is_indirect(run.line(), "a feed that counts the time of a motion (G93)");
            let missing = || run.refuse("with G93 each line that cuts needs an F");
            let feed = self.inverse.ok_or_else(missing)?;
            // Without a way it is done at any feed above zero.
            let per_minute = Nm::from_f64(length * feed).get();
            self.modal.feed = Some(if length > 0.0 { per_minute } else { i64::from(feed > 0.0) });
        }
        Ok(())
    }

    /// Moves.
    pub(super) fn go(&mut self, run: Run<'_>, way: Way, to: Target) -> Result<(), ReadError> {
        if self.listing.motions.len() >= MOTIONS {
            return Err(
                run.refuse(format!("the program moves more than {MOTIONS} times, which is not supported"))
            );
        }
        let from = self.place();
        let unknown = |axis: usize| to[axis].is_none() && self.axes[axis].at.is_some();
        let low = to[2].or(from.z).is_none_or(|z| z < Nm::ZERO);
        if way != Way::Rapid && (unknown(0) || unknown(1)) && low {
            let what = "a cut to an unknown position: the program does not give its zero";
            return Err(run.refuse(what));
        }
        let z_lost = run.block.get('Z').is_some() && to[2].is_none() && !self.axes[2].sent;
        if way != Way::Rapid && z_lost {
            return Err(run.refuse("a cut to an unknown depth: the program does not give its zero"));
        }
        let is_sideways = (0..2).any(|axis| to[axis].is_some() && to[axis] != self.axes[axis].at);
        if is_sideways && to[2].is_none() && !self.axes[2].sent {
            let what =
                "it moves sideways before it says how high: the tool has to be above the board by then";
            self.listing.note(true, run.line(), what);
        }
        let [x, y, z] = to;
        let motion = Motion {
            way,
            from,
            to: Place { x, y, z },
            feed: self.modal.feed,
            spindle: self.spindle(),
            tool: self.tool,
            line: run.line(),
        };
        self.listing.motions.push(motion);
        for (axis, to) in self.axes.iter_mut().zip(to) {
            axis.found &= axis.at == to;
            axis.cut |= way != Way::Rapid;
            axis.sent &= to.is_none();
            axis.at = to;
        }
        Ok(())
    }
}

/// How far it is, in nanometres, along the axes that are known.
pub(super) fn distance(from: Target, to: Target) -> f64 {
    let along = |axis: usize| from[axis].zip(to[axis]).map_or(0.0, |(from, to)| (to - from).to_f64());
    let [x, y, z] = [0, 1, 2].map(along);
    (x * x + y * y + z * z).sqrt()
}
