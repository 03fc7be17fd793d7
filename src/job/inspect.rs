//! What is known of a board before anything is planned: sizes, nets, gaps, holes.

use crate::board::{Copper, Outline, Side};
use crate::import::Loaded;
use crate::report::Inspection;
use crate::report::document::{SCHEMA_VERSION, WarningEntry};
use crate::report::inspection::InspectedLayer;
use crate::report::methods::MethodsEntry;
use crate::report::prediction::PredictionEntry;
use crate::topology::{self, Electrical, Nets, Sampling};

use super::Settings;
use super::choice::Topology;
use super::describe::{drills, gap_entry, net_entries, size};
use super::plain::method;

/// What is known of a board before anything is done to it.
#[must_use]
pub fn inspect(loaded: &Loaded, settings: &Settings) -> Inspection {
    let board = &loaded.board;
    let layer = |side| {
        let copper = board.copper(side)?;
        Some((copper, topology::recover(copper, method(settings.asked.topology))))
    };
    let (front, back) = rayon::join(|| layer(Side::Front), || layer(Side::Back));
    let layers: Vec<&(&Copper, Nets)> = [&front, &back].into_iter().flatten().collect();
    let electrical = match (&front, &back) {
        (Some((front, of_front)), Some((back, of_back))) => {
            Some(topology::electrical(Some((front, of_front)), Some((back, of_back)), &board.holes))
        }
        _ => None,
    };
    let mut warnings: Vec<WarningEntry> = loaded.warnings.iter().map(WarningEntry::from).collect();
    for (copper, nets) in &layers {
        warnings.extend(topology::names_check(copper, nets).iter().map(WarningEntry::from));
    }
    warnings
        .extend(electrical.iter().flat_map(Electrical::check).map(|warning| WarningEntry::from(&warning)));
    Inspection {
        schema_version: SCHEMA_VERSION,
        board: board.name.clone(),
        size_mm: size(board),
        outline: board.outline.is_some(),
        sources: loaded.sources.clone(),
        ignored: loaded.ignored.clone(),
        layers: layers
            .into_iter()
            .map(|(copper, nets)| inspected(copper, nets, board.outline.as_ref(), settings))
            .collect(),
        electrical_nets: electrical.map(|electrical| electrical.nets.len()),
        drills: drills(&board.holes),
        warnings,
    }
}

fn inspected(copper: &Copper, nets: &Nets, outline: Option<&Outline>, settings: &Settings) -> InspectedLayer {
    let differences = (settings.asked.topology == Topology::All).then(|| {
        topology::differences(copper, Sampling::default()).expect("500 DPI is within the raster's limits")
    });
    InspectedLayer {
        side: copper.side,
        features: copper.features.len(),
        nets: net_entries(nets),
        smallest_gap: topology::smallest_gap(copper, nets).map(|gap| gap_entry(gap, nets)),
        methods: differences.map(|differences| MethodsEntry::new(copper, &differences)),
        prediction: PredictionEntry::new(copper, nets, outline, settings.kerf() / 2),
        coupling: None,
        thinning: None,
        paper: None,
    }
}
