//! Where coordinates lie on the board: planes, coordinate systems, moved zeros, and what nobody can
//! know of them.
//!
//! Places are told in one frame, the first coordinate system in which an axis is used. The others,
//! and the machine's own coordinates, have a known place in it only where the program says so (G10,
//! G92). What it does not say is unknown, and a cut to an unknown place is refused; a rapid up to
//! one is a retract.

use crate::geometry::Nm;

/// The plane of arcs and cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Plane {
    #[default]
    Xy,
    Zx,
    Yz,
}

impl Plane {
    /// The axes in the plane, in the order in which a turn from the first to the second is
    /// counter-clockwise, and the one across it.
    pub(super) const fn axes(self) -> [usize; 3] {
        match self {
            Self::Xy => [0, 1, 2],
            Self::Zx => [2, 0, 1],
            Self::Yz => [1, 2, 0],
        }
    }
}

/// How many coordinate systems there are: G54 to G59, G59.1 to G59.3.
pub(super) const SYSTEMS: usize = 9;

/// Where the zero of a coordinate system lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Zero {
    #[default]
    Unknown,
    /// On the board.
    Board(Nm),
    /// From the machine's zero.
    Machine(Nm),
}

/// An axis.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Axis {
    /// Where the tool is on the board.
    pub(super) at: Option<Nm>,
    zeros: [Zero; SYSTEMS],
    /// Where the machine's zero is on the board.
    machine: Option<Nm>,
    /// G92 and G52.
    shift: Nm,
    /// What they were last set to, for G92.3.
    kept: Nm,
    /// Whether a coordinate has been told in any system.
    anchored: bool,
    /// Whether a probe has just found a surface here.
    pub(super) found: bool,
    /// Whether anything was cut.
    pub(super) cut: bool,
    /// Whether it was sent to a place of the machine.
    pub(super) sent: bool,
}

impl Axis {
    /// Where the zero of a system is on the board, as moved; the first that is asked for is the
    /// board's own.
    pub(super) fn origin(&mut self, system: usize) -> Option<Nm> {
        if !self.anchored {
            self.anchored = true;
            if let Zero::Machine(zero) = self.zeros[system] {
                self.machine = Some(-zero);
            }
            self.zeros[system] = Zero::Board(Nm::ZERO);
        }
        match self.zeros[system] {
            Zero::Unknown => None,
            Zero::Board(zero) => Some(zero + self.shift),
            Zero::Machine(zero) => Some(self.machine? + zero + self.shift),
        }
    }

    /// Where a coordinate of the machine is on the board.
    pub(super) fn of_machine(&self, value: Nm) -> Option<Nm> {
        Some(self.machine? + value)
    }

    /// Says that the tool is at `value`: by moving all systems, or one for good.
    pub(super) fn here(&mut self, system: usize, value: Nm, for_good: bool) {
        let is_fresh = self.at.is_none() && !(self.cut && self.sent);
        if is_fresh || self.found {
            // What was not known, or what a probe has just found, is now told.
            self.anchored = true;
            self.at = Some(value);
            self.shift = Nm::ZERO;
            self.zeros[system] = Zero::Board(Nm::ZERO);
            return;
        }
        let origin = self.origin(system);
        match (self.at, origin) {
            (None, _) => self.zeros[system] = Zero::Unknown,
            (Some(at), Some(origin)) if !for_good => self.set_shift(self.shift + at - value - origin),
            (Some(at), _) => self.zeros[system] = Zero::Board(at - value - self.shift),
        }
    }

    /// Sets a system's zero in coordinates of the machine.
    pub(super) fn set_zero(&mut self, system: usize, value: Nm) {
        self.zeros[system] = match self.machine {
            Some(machine) => Zero::Board(machine + value),
            None => Zero::Machine(value),
        };
    }

    /// Moves all systems by so much from where they are without.
    pub(super) fn set_shift(&mut self, shift: Nm) {
        self.shift = shift;
        self.kept = shift;
    }

    /// Takes the shift away, for good or until it is restored.
    pub(super) fn drop_shift(&mut self, keep: bool) {
        self.shift = Nm::ZERO;
        if !keep {
            self.kept = Nm::ZERO;
        }
    }

    /// Takes the shift that was last set, even where none was taken away (LinuxCNC: from parameters
    /// 5211 to 5219).
    pub(super) fn restore_shift(&mut self) {
        self.shift = self.kept;
    }

    /// The shift, for the parameters that tell it.
    pub(super) const fn shift(&self) -> Nm {
        self.shift
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn mm(value: i64) -> Nm {
        Nm::from_mm(value)
    }

    #[test]
    fn systems_that_count_from_the_machine_are_known_beside_each_other() {
        let mut axis = Axis::default();
        axis.set_zero(0, mm(100));
        axis.set_zero(1, mm(150));
        assert_eq!(axis.origin(0), Some(mm(0)), "the first that is used is the board's");
        assert_eq!(axis.origin(1), Some(mm(50)), "the other lies beside it");
        assert_eq!(axis.of_machine(mm(0)), Some(mm(-100)), "and so does the machine's zero");
        assert_eq!(axis.origin(2), None, "nobody knows of a third");
    }

    #[test]
    fn a_moved_zero_moves_what_follows_and_not_the_tool() {
        let mut axis = Axis { at: Some(mm(10)), ..Axis::default() };
        axis.here(0, mm(2), false);
        assert_eq!((axis.at, axis.origin(0)), (Some(mm(10)), Some(mm(8))), "2 is at 10");
        axis.restore_shift();
        assert_eq!(axis.origin(0), Some(mm(8)), "restored, though none was taken away");
        axis.drop_shift(true);
        axis.drop_shift(true);
        assert_eq!(axis.origin(0), Some(mm(0)), "without");
        axis.restore_shift();
        assert_eq!(axis.origin(0), Some(mm(8)), "with it again");
    }

    #[test]
    fn where_nothing_was_known_or_a_probe_touched_is_what_the_program_says() {
        let mut start = Axis::default();
        start.here(0, mm(5), false);
        assert_eq!((start.at, start.origin(0)), (Some(mm(5)), Some(mm(0))), "at the start");
        let mut probed = Axis { at: Some(mm(-3)), anchored: true, found: true, ..Axis::default() };
        probed.here(0, mm(1), true);
        assert_eq!((probed.at, probed.origin(0)), (Some(mm(1)), Some(mm(0))), "after a probe");
        let mut sent = Axis { cut: true, sent: true, ..start };
        sent.at = None;
        sent.here(0, mm(0), false);
        assert_eq!(sent.origin(0), None, "at the machine's own place, after a cut");
    }
}
