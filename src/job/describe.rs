//! A job as its report.

use std::collections::BTreeMap;

use crate::board::{Board, Hole};
use crate::geometry::Nm;
use crate::report::colours::ColoursEntry;
use crate::report::document::{
    Document, DrillEntry, Figures, GapEntry, LayerEntry, Millimetres, NetEntry, ProgramEntry, SCHEMA_VERSION,
    StrategyEntry, ToolChanges, WarningEntry,
};
use crate::topology::{Gap, NetId, Nets};

use super::pipeline::GENERATOR;
use super::{Chosen, Job, Layer, Settings, Written};

impl Job {
    /// The report on it.
    #[must_use]
    pub fn describe(&self, settings: &Settings) -> Document {
        let changes = self.tool_changes(settings);
        let document = Document {
            schema_version: SCHEMA_VERSION,
            generator: GENERATOR.to_owned(),
            board: self.board.name.clone(),
            size_mm: size(&self.board),
            sources: self.sources.clone(),
            ignored: self.ignored.clone(),
            layers: self.layers.iter().map(|layer| layer.describe(&self.board)).collect(),
            electrical_nets: self.electrical.as_ref().map(|electrical| electrical.nets.len()),
            drills: drills(&self.board.holes),
            programs: self.programs.iter().map(|program| program.describe(&self.board, settings)).collect(),
            tool_changes: changes,
            total: Figures::sum(self.programs.iter().map(|program| &program.statistics), changes),
            outputs: Vec::new(),
            verification: None,
            warnings: self.warnings.iter().map(WarningEntry::from).collect(),
            stages: Vec::new(),
            settings: settings.options().listed().into_iter().collect(),
        };
        document.with_gaps_merged(settings.finest_kerf())
    }
}

impl Job {
    /// How often another tool is fitted than the one before, through all programs.
    fn tool_changes(&self, settings: &Settings) -> ToolChanges {
        let sections = self.programs.iter().flat_map(|program| &program.program.sections);
        let tools: Vec<u32> = sections.map(|section| section.tool.number).collect();
        let count = tools.windows(2).map(|pair| u32::from(pair[0] != pair[1])).sum();
        let seconds = f64::from(count) * f64::from(settings.machine.tool_change) / 1000.0;
        ToolChanges { count, seconds }
    }
}

impl Layer {
    fn describe(&self, board: &Board) -> LayerEntry {
        LayerEntry {
            side: self.side,
            features: board.copper(self.side).map_or(0, |copper| copper.features.len()),
            nets: net_entries(&self.nets),
            translucency: self.translucency.as_ref().map(ColoursEntry::new),
            smallest_gap: self.gap.map(|gap| gap_entry(gap, &self.nets)),
            boundaries: self.boundaries.edges.iter().filter(|edge| !edge.is_border()).count(),
            vertices: self.boundaries.nodes.len(),
            boundary_length_mm: Millimetres(self.boundary_length()),
            frame_length_mm: self
                .frame_cut
                .as_ref()
                .map(|frame_cut| Millimetres(Nm::from_f64(frame_cut.length()))),
            negligible_gaps: 0,
            strategy: self.chosen.as_ref().map(strategy_entry),
            coupling: self.coupling.clone(),
        }
    }
}

impl Written {
    fn describe(&self, board: &Board, settings: &Settings) -> ProgramEntry {
        ProgramEntry {
            file: self.file_name(&board.name, settings),
            title: self.program.title.clone(),
            tools: self.program.sections.iter().map(|section| section.tool.kind.to_string()).collect(),
            figures: Figures::from(&self.statistics),
        }
    }
}

/// What was chosen between strategies.
fn strategy_entry(chosen: &Chosen) -> StrategyEntry {
    let seconds = |index: usize| {
        let tried = chosen.tried.get(index).or(chosen.tried.first());
        (tried.map_or(0.0, |tried| tried.seconds) * 10.0).round() / 10.0
    };
    StrategyEntry {
        outlined_nets: chosen.tried[chosen.taken].loops,
        seconds: seconds(chosen.taken),
        voronoi_seconds: seconds(0),
        outline_seconds: seconds(1),
        plans: chosen.tried.len(),
    }
}

/// The nets of a layer, by number.
pub(super) fn net_entries(nets: &Nets) -> Vec<NetEntry> {
    let entry = |(net, id): (&crate::topology::Net, u32)| NetEntry {
        name: nets.label(NetId(id)),
        named: !net.names.is_empty(),
        features: net.features.len(),
    };
    nets.nets().iter().zip(0..).map(entry).collect()
}

/// A gap with the names of its nets.
pub(super) fn gap_entry(gap: Gap, nets: &Nets) -> GapEntry {
    let (a, b) = gap.between;
    GapEntry { width_mm: Millimetres(gap.width), between: [nets.label(a), nets.label(b)], at: gap.at.into() }
}

/// The holes by diameter, thin ones first.
pub(super) fn drills(holes: &[Hole]) -> Vec<DrillEntry> {
    let mut by_diameter: BTreeMap<Nm, (usize, usize)> = BTreeMap::new();
    for hole in holes {
        let (plain, slots) = by_diameter.entry(hole.diameter).or_default();
        *if hole.is_slot() { slots } else { plain } += 1;
    }
    let entry = |(diameter, (holes, slots))| DrillEntry { diameter_mm: Millimetres(diameter), holes, slots };
    by_diameter.into_iter().map(entry).collect()
}

/// Width and height of a board.
pub(super) fn size(board: &Board) -> Option<[Millimetres; 2]> {
    board.bounds().map(|bounds| [Millimetres(bounds.width()), Millimetres(bounds.height())])
}
