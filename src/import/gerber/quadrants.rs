//! How the centre of an arc is given, and how that is taken.

use super::format::Unit;

/// How an arc's centre is given (G74, G75).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quadrants {
    /// Offsets without sign, at most a quarter.
    Single,
    /// Offsets with sign, any arc.
    Multi,
}

impl Quadrants {
    /// As people say it.
    pub(super) const fn describe(self) -> &'static str {
        match self {
            Self::Single => "G74, single quadrant",
            Self::Multi => "G75, multi quadrant",
        }
    }
}

/// How arcs are read that are given in each of three ways, and lengths without a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Reading {
    /// The unit where the file does not say it; none where its number format decides.
    pub(super) unit: Option<Unit>,
    /// After G74.
    pub(super) single: Quadrants,
    /// After G75.
    pub(super) multi: Quadrants,
    /// Before either.
    pub(super) undeclared: Quadrants,
}

impl Reading {
    /// As the specification has it, and where the file says nothing, as programs have written for
    /// thirty years.
    pub(super) const USUAL: Self =
        Self { unit: None, single: Quadrants::Single, multi: Quadrants::Multi, undeclared: Quadrants::Multi };

    pub(super) const fn of(self, declared: Option<Quadrants>) -> Quadrants {
        match declared {
            Some(Quadrants::Single) => self.single,
            Some(Quadrants::Multi) => self.multi,
            None => self.undeclared,
        }
    }
}
