//! Words → places on the board, and what moves the zeros they count from.

use crate::gcode::read::block::{Block, Word};
use crate::gcode::read::error::ReadError;
use crate::gcode::read::expression::index;
use crate::gcode::read::frame::SYSTEMS;
use crate::gcode::read::listing::{Odd, Way};
use crate::gcode::read::meaning::{Distance, Special};
use crate::gcode::read::source::Pointer;
use crate::geometry::Nm;

use super::{Machine, Run};

/// The letters of the axes.
pub(super) const AXES: [char; 3] = ['X', 'Y', 'Z'];

/// Somewhere on the board, as far as it is known.
pub(super) type Target = [Option<Nm>; 3];

impl Machine {
    /// Where the words of a line lead.
    pub(super) fn target(&mut self, run: Run<'_>) -> Result<Target, ReadError> {
        let mut to = self.axes.map(|axis| axis.at);
        for (index, letter) in AXES.into_iter().enumerate() {
            if let Some(word) = run.block.get(letter) {
                to[index] = self.coordinate(run, index, word)?;
            }
        }
        if run.block.radius.is_some() || run.block.angle.is_some() {
            [to[0], to[1]] = self.polar(run)?;
        }
        Ok(to)
    }

    /// Where a coordinate of an axis lies.
    pub(super) fn coordinate(
        &mut self,
        run: Run<'_>,
        axis: usize,
        word: Word,
    ) -> Result<Option<Nm>, ReadError> {
        let value = Nm::new(self.scaled(run, word)?);
        self.unit_is_used(run);
        let system = self.modal.system;
        match self.modal.distance {
            Distance::Absolute => Ok(self.axes[axis].origin(system).map(|origin| origin + value)),
            Distance::Incremental => Ok(Some(self.known(run, axis)? + value)),
        }
    }

    /// Notes a length in a unit that the program has not given.
    fn unit_is_used(&mut self, run: Run<'_>) {
        if !self.modal.unit_given {
            self.modal.unit_given = true;
            let what = "neither G20 nor G21 before the first length: millimetres are assumed";
            self.listing.note(true, run.line(), what);
        }
    }

    /// Where an axis is, or at the start of a program, zero.
    pub(super) fn known(&mut self, run: Run<'_>, axis: usize) -> Result<Nm, ReadError> {
        if let Some(at) = self.axes[axis].at {
            return Ok(at);
        }
        let system = self.modal.system;
        let origin = self.axes[axis].origin(system);
        match origin.filter(|_| !self.axes[axis].sent) {
            Some(origin) => {
                let letter = AXES[axis];
                let what = format!("it begins where the machine is in {letter}: {letter}0 is assumed");
                self.listing.note(true, run.line(), what);
                self.axes[axis].at = Some(origin);
                Ok(origin)
            }
            None => Err(run.refuse("a motion from a machine position that the program does not give")),
        }
    }

    /// `@` and `^`: how far from zero in the plane, and in which direction; what is left out stays
    /// as it is.
    fn polar(&mut self, run: Run<'_>) -> Result<[Option<Nm>; 2], ReadError> {
        let word = run.block.radius.or(run.block.angle).expect("one of them was asked for");
        let system = self.modal.system;
        let (x, y) = (self.known(run, 0)?, self.known(run, 1)?);
        let origins = (self.axes[0].origin(system), self.axes[1].origin(system));
        let (Some(left), Some(bottom)) = origins else {
            return Err(run.error(word, "a zero that the program does not give"));
        };
        self.unit_is_used(run);
        self.listing.is_indirect(run.line(), "polar coordinates");
        let (dx, dy) = ((x - left).to_f64(), (y - bottom).to_f64());
        let (mut radius, mut angle) = (libm::hypot(dx, dy), libm::atan2(dy, dx));
        let adds = self.modal.distance == Distance::Incremental;
        if let Some(word) = run.block.radius {
            radius = Nm::new(self.scaled(run, word)?).to_f64() + if adds { radius } else { 0.0 };
        }
        if let Some(word) = run.block.angle {
            angle = word.value.to_radians() + if adds { angle } else { 0.0 };
        }
        let (sin, cos) = libm::sincos(angle);
        Ok([Some(left + Nm::from_f64(radius * cos)), Some(bottom + Nm::from_f64(radius * sin))])
    }

    /// Codes that take the axis words of a line for something else than a motion.
    pub(super) fn special(&mut self, run: Run<'_>, special: Special) -> Result<(), ReadError> {
        match special {
            Special::Data => return self.data(run),
            Special::Home => return self.home(run),
            Special::Here | Special::Local => {
                self.listing.is_indirect(run.line(), "a zero offset");
                for (axis, letter) in AXES.into_iter().enumerate() {
                    let Some(word) = run.block.get(letter) else { continue };
                    let value = Nm::new(self.scaled(run, word)?);
                    self.unit_is_used(run);
                    match special {
                        Special::Local => self.axes[axis].set_shift(value),
                        _ => self.here(run, axis, value),
                    }
                }
            }
            Special::Drop { keep } => self.axes.iter_mut().for_each(|axis| axis.drop_shift(keep)),
            Special::Restore => {
                self.listing.note(true, run.line(), "G92.3 moves zero as some program before has left it");
                self.axes.iter_mut().for_each(|axis| axis.restore_shift());
            }
            Special::Ignored => self.length_offset(run)?,
        }
        Ok(())
    }

    /// Notes a tool length that shifts all heights: they are taken as they stand.
    fn length_offset(&mut self, run: Run<'_>) -> Result<(), ReadError> {
        let sets = run.block.orders.iter().any(|order| (order.letter, order.key) == ('G', 431));
        let Some(word) = run.block.get('Z').filter(|word| sets && word.value != 0.0) else { return Ok(()) };
        let by = Nm::new(self.scaled(run, word)?);
        let what = format!("G43.1 shifts all heights by {by:.3} mm: here they are taken as they stand");
        self.listing.note(true, run.line(), what);
        Ok(())
    }

    /// G92 of an axis.
    fn here(&mut self, run: Run<'_>, axis: usize, value: Nm) {
        self.zero_by_hand(run, axis, "G92");
        self.axes[axis].here(self.modal.system, value, false);
    }

    /// Notes a zero that is set where nobody knows that the tool is.
    fn zero_by_hand(&mut self, run: Run<'_>, axis: usize, code: &str) {
        if self.axes[axis].at.is_none() && !self.axes[axis].sent {
            let what = format!(
                "{code} sets zero by where the tool happens to be: a zero that was set before does not count"
            );
            self.listing.note(true, run.line(), what);
        }
    }

    /// G10: L2 sets the zero of a system from the machine's, L20 from where the tool is; L1, L10
    /// and L11 the tool table.
    fn data(&mut self, run: Run<'_>) -> Result<(), ReadError> {
        let Some(kind) = run.block.get('L') else {
            // Marlin and others: retract the filament, or a menu of the controller.
            self.listing.note(true, run.line(), "G10 without L is ignored");
            return Ok(());
        };
        self.listing.is_odd(Odd::Data, run.line());
        let which = run.block.get('P').map_or(Some(0), |word| index(word.value));
        let wrong = || run.error(kind, "expected L1, L2, L10, L11 or L20, and P from 0 to 9");
        let which = which.ok_or_else(wrong)? as usize;
        match index(kind.value) {
            Some(kind @ (1 | 10 | 11)) => {
                let what = format!("G10 L{kind} changes the tool table: lengths of tools shift heights");
                self.listing.note(true, run.line(), what);
                return Ok(());
            }
            Some(2 | 20) if which <= SYSTEMS => {}
            _ => return Err(wrong()),
        }
        if let Some(word) = run.block.get('R').filter(|word| word.value != 0.0) {
            return Err(run.error(word, "a rotated coordinate system is not supported"));
        }
        self.listing.is_indirect(run.line(), "a zero offset");
        let system = which.checked_sub(1).unwrap_or(self.modal.system);
        for (axis, letter) in AXES.into_iter().enumerate() {
            let Some(word) = run.block.get(letter) else { continue };
            let value = Nm::new(self.scaled(run, word)?);
            self.unit_is_used(run);
            if index(kind.value) == Some(2) {
                let what = "G10 L2 moves zero, wherever it was set, for the programs that come after, too";
                self.listing.note(true, run.line(), what);
                self.axes[axis].set_zero(system, value);
            } else {
                self.zero_by_hand(run, axis, "G10 L20");
                self.moves_zero(run, axis, system, value);
                self.axes[axis].here(system, value, true);
            }
        }
        Ok(())
    }

    /// Notes a zero that is moved for good from where the tool is, unless a probe has found it.
    fn moves_zero(&mut self, run: Run<'_>, axis: usize, system: usize, value: Nm) {
        let is_found = self.axes[axis].found;
        let (at, origin) = (self.axes[axis].at, self.axes[axis].origin(system));
        if !is_found && at.zip(origin).is_some_and(|(at, origin)| at - value != origin) {
            let what = "G10 L20 moves zero, for the programs that come after, too";
            self.listing.note(true, run.line(), what);
        }
    }

    /// At the end: notes a zero that G92 or G52 has moved, and nothing has moved back; and motions
    /// after the motors were let go.
    pub(in crate::gcode::read) fn finish(&mut self) {
        if let Some((line, before)) = self.released
            && before < self.listing.motions.len()
        {
            let what = "M18 and M84 let go of the motors: where the tool is afterwards is not known";
            self.listing.note(true, line, what);
        }
        if self.axes.iter().any(|axis| axis.shift() != Nm::ZERO) {
            let what = "zero is moved (G92, G52) and not moved back (G92.1) at the end: programs that come after \
                        lie beside this";
            self.listing.note(true, self.line, what);
        }
    }

    /// G28 and G30: by the place that the line gives, if any, to one that only the machine knows.
    fn home(&mut self, run: Run<'_>) -> Result<(), ReadError> {
        self.listing.is_indirect(run.line(), "a machine position");
        let named = AXES.map(|letter| run.block.get(letter).is_some() || run.block.named.contains(&letter));
        let all = !named.contains(&true);
        let mut by = self.axes.map(|axis| axis.at);
        for (axis, letter) in AXES.into_iter().enumerate() {
            // From nowhere, a step leads nowhere.
            let steps = self.modal.distance == Distance::Incremental && self.axes[axis].at.is_none();
            if let Some(word) = run.block.get(letter).filter(|_| !steps) {
                by[axis] = self.coordinate(run, axis, word)?;
            }
        }
        if by != self.axes.map(|axis| axis.at) {
            self.go(run, Way::Rapid, by)?;
        }
        let what = "a machine position that the program does not give: it is assumed to be above all work";
        self.listing.note(false, run.line(), what);
        self.send(run, [0, 1, 2].map(|axis| all || named[axis]))
    }

    /// Grbl's `$H`.
    pub(in crate::gcode::read) fn home_all(
        &mut self,
        pointer: Pointer<'_>,
        block: &Block,
    ) -> Result<(), ReadError> {
        self.listing.is_indirect(pointer.line, "a machine position");
        self.send(Run { pointer, block }, [true; 3])
    }

    /// To places of the machine along some axes: up first.
    pub(super) fn send(&mut self, run: Run<'_>, which: [bool; 3]) -> Result<(), ReadError> {
        // All axes go at once: below the surface that is sideways through it.
        let is_low = self.axes[2].at.is_some_and(|z| z < Nm::ZERO) && (which[0] || which[1]);
        if is_low {
            let [x, y, z] = self.axes.map(|axis| axis.at);
            self.go(run, Way::Rapid, [x.filter(|_| !which[0]), y.filter(|_| !which[1]), z])?;
        } else if which[2] && self.axes[2].at.is_some() {
            let [x, y, _] = self.axes.map(|axis| axis.at);
            self.go(run, Way::Rapid, [x, y, None])?;
        }
        let at = self.axes.map(|axis| axis.at);
        let to = [0, 1, 2].map(|axis| at[axis].filter(|_| !which[axis]));
        if to != at {
            self.go(run, Way::Rapid, to)?;
        }
        for (axis, _) in self.axes.iter_mut().zip(which).filter(|(_, which)| *which) {
            axis.sent = true;
        }
        Ok(())
    }
}
