//! How strongly the nets of a layer are coupled by what is cut.

use crate::board::{Copper, Outline};
use crate::coupling::Coupling;
use crate::coupling::strips::Substrate;
use crate::report::coupling::CouplingEntry;
use crate::topology::{self, Extent, NetId, Nets, Pattern};
use crate::voronoi::{Boundaries, Diagram};

use super::choice::{Sites, Strategy};
use super::{Error, Settings, plain};

/// Pairs that the report of a job has. Chosen: who wants all asks `inspect`.
const STRONGEST: usize = 20;

/// The neighbours among the nets of `copper`, whatever strategy the settings have, with the nets
/// that `asked` means, and which of `asked` mean one.
///
/// # Errors
///
/// [`Error::Voronoi`] where nothing of it lies on the board.
pub fn coupling(
    copper: &Copper,
    outline: Option<&Outline>,
    settings: &Settings,
    asked: &[Pattern],
) -> Result<(CouplingEntry, Vec<bool>), Error> {
    let nets = topology::recover(copper, plain::method(settings.asked.topology));
    let (diagram, boundaries) = plain::diagram(copper, &nets, outline, settings)?;
    let mut have_meant = vec![false; asked.len()];
    let mut is_asked = |id: &NetId| {
        let names = topology::called(copper, &nets, *id);
        let means: Vec<bool> = asked.iter().map(|pattern| pattern.matches_any(&names)).collect();
        have_meant.iter_mut().zip(&means).for_each(|(before, &means)| *before |= means);
        means.contains(&true)
    };
    let asked: Vec<NetId> = (0..).map(NetId).take(nets.nets().len()).filter(|id| is_asked(id)).collect();
    let extents = topology::extents(copper, &nets);
    let entry = entry(&nets, &extents, (&diagram, &boundaries), settings, (None, &asked));
    Ok((entry, have_meant))
}

impl Settings {
    /// Whether the report has the neighbours of a layer: where its nets are parted by regions
    /// alone.
    pub(super) fn couples(&self) -> bool {
        self.couplings
            && self.asked.strategy == Strategy::Voronoi
            && self.asked.strategy_for.is_empty()
            && self.sites == Sites::Copper
            && self.limit.is_none()
            && self.isolation.iter().all(|cutting| cutting.widening.is_none())
    }
}

/// The strongest neighbours among the nets of a layer that has this diagram.
pub(super) fn strongest(
    nets: &Nets,
    extents: &[Extent],
    found: (&Diagram, &Boundaries),
    settings: &Settings,
) -> CouplingEntry {
    entry(nets, extents, found, settings, (Some(STRONGEST), &[]))
}

/// The neighbours among the nets of a layer that has this diagram: so many, and the nets that are
/// asked for.
fn entry(
    nets: &Nets,
    extents: &[Extent],
    (diagram, boundaries): (&Diagram, &Boundaries),
    settings: &Settings,
    (most, asked): (Option<usize>, &[NetId]),
) -> CouplingEntry {
    let kerf = settings.finest_kerf();
    let substrate = Substrate::fr4(settings.thickness.to_mm());
    let found = Coupling::new(diagram, boundaries, extents, kerf, substrate);
    CouplingEntry::new(&found, nets, (kerf, substrate), most, asked)
}
