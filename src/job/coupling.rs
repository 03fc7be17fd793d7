//! How strongly the nets of a layer are coupled by what is cut.

use crate::board::{Copper, Outline};
use crate::coupling::Coupling;
use crate::coupling::strips::Substrate;
use crate::report::coupling::CouplingEntry;
use crate::topology::{self, NetId, Pattern};

use super::choice::{Sites, Strategy};
use super::{Error, Job, Layer, Settings, layer};

/// Pairs that the report of a job has. Chosen: who wants all asks `inspect`.
const STRONGEST: usize = 20;

/// The neighbours among the nets of `copper`, whatever strategy the settings have, with the nets
/// that `asked` means.
///
/// # Errors
///
/// [`Error::Voronoi`] where nothing of it lies on the board.
pub fn coupling(
    copper: &Copper,
    outline: Option<&Outline>,
    settings: &Settings,
    asked: &[Pattern],
) -> Result<CouplingEntry, Error> {
    let nets = topology::recover(copper, layer::method(settings.asked.topology));
    let (diagram, boundaries) = layer::plain(copper, &nets, outline, settings)?;
    let kerf = settings.finest_kerf();
    let substrate = Substrate::fr4(settings.thickness.to_mm());
    let found = Coupling::new(&diagram, &boundaries, &topology::extents(copper, &nets), kerf, substrate);
    let is_asked = |id: &NetId| {
        let names = topology::called(copper, &nets, *id);
        asked.iter().any(|pattern| pattern.matches_any(&names))
    };
    let asked: Vec<NetId> = (0..).map(NetId).take(nets.nets().len()).filter(is_asked).collect();
    Ok(CouplingEntry::new(&found, &nets, (kerf, substrate), None, &asked))
}

impl Job {
    /// The strongest neighbours of each layer, in their order; none for a layer whose nets are not
    /// parted by regions alone.
    #[must_use]
    pub fn couplings(&self, settings: &Settings) -> Vec<Option<CouplingEntry>> {
        let is_plain = settings.asked.strategy == Strategy::Voronoi
            && settings.asked.strategy_for.is_empty()
            && settings.sites == Sites::Copper
            && settings.limit.is_none()
            && settings.isolation.iter().all(|cutting| cutting.widening.is_none());
        self.layers
            .iter()
            .map(|layer| is_plain.then(|| self.coupling_of(layer, settings)).flatten())
            .collect()
    }

    fn coupling_of(&self, layer: &Layer, settings: &Settings) -> Option<CouplingEntry> {
        let extents = topology::extents(self.board.copper(layer.side)?, &layer.nets);
        let kerf = settings.finest_kerf();
        let substrate = Substrate::fr4(settings.thickness.to_mm());
        let found = Coupling::new(&layer.diagram, &layer.boundaries, &extents, kerf, substrate);
        Some(CouplingEntry::new(&found, &layer.nets, (kerf, substrate), Some(STRONGEST), &[]))
    }
}
