//! How a side may be isolated, and what that costs.

use crate::board::Warning;
use crate::board::diagnostic::planning;
use crate::geometry::Path;
use crate::report::coupling::CouplingEntry;
use crate::report::stages::Stages;
use crate::toolpath::{Program, Section, measure};
use crate::voronoi::{Boundaries, Regions};

use super::{Settings, choice};

/// What was tried, and taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// The plans in the order in which they were tried: regions, loops, and what mixes them.
    pub tried: Vec<Tried>,
    /// Which of them was taken.
    pub taken: usize,
}

/// A plan that was tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tried {
    /// How many nets have a loop.
    pub loops: usize,
    /// How long the machine runs for it.
    pub seconds: f64,
    /// How many gaps or frames it leaves uncut that join nets.
    pub joined: usize,
}

/// How a side is isolated when some of its nets have loops.
pub(super) struct Plan {
    pub(super) regions: Regions,
    pub(super) boundaries: Boundaries,
    pub(super) coupling: Option<CouplingEntry>,
    pub(super) frame_cut: Option<Path>,
    pub(super) sections: Vec<Section>,
    pub(super) warnings: Vec<Warning>,
    pub(super) stages: Stages,
}

impl Plan {
    /// What the plan costs, with loops round so many nets.
    pub(super) fn tried(&self, loops: usize, settings: &Settings) -> Tried {
        let sections = self.sections.clone();
        let program = Program { title: String::new(), notes: Vec::new(), safe: settings.safe, sections };
        let measured = measure(&program, &settings.machine);
        let changes = f64::from(measured.tool_changes) * f64::from(settings.machine.tool_change) / 1000.0;
        let skips = settings.asked.narrow == choice::Narrow::Skip;
        let joins = |warning: &&Warning| {
            warning.is(&planning::FRAME_NOT_CUT) || (skips && warning.is(&planning::GAP_NARROWER_THAN_TOOL))
        };
        let joined = self.warnings.iter().filter(joins).count();
        Tried { loops, seconds: measured.seconds + changes, joined }
    }
}
