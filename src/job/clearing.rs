//! What is cleared of a board beside the gaps round its nets, as it was asked for and on each side.

use crate::board::polarity::{offset, union};
use crate::board::{Copper, FLATTEN};
use crate::geometry::{Nm, Polygon};
use crate::topology::{NetId, Nets, Pattern, called};
use crate::verify::Asked;
use crate::voronoi;

use super::area_choice::AreaChoice;
use super::distance_for::DistanceFor;
use super::options::Complete;

/// What is cleared beside the gaps round nets, in the files' coordinates.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Clearing {
    /// Nets whose regions are cleared.
    pub nets: Vec<Pattern>,
    /// Where all is.
    pub areas: Vec<AreaChoice>,
    /// Nets round which all is, and how far.
    pub distances: Vec<DistanceFor>,
    /// Where no pass clears anything.
    pub kept: Vec<AreaChoice>,
}

impl Clearing {
    /// As the options say.
    pub(super) fn of(options: &Complete) -> Self {
        Self {
            nets: options.clear_nets.clone(),
            areas: options.clear_area.clone(),
            distances: options.distance_for.clone(),
            kept: options.keep_area.clone(),
        }
    }

    /// Whether anything is cleared.
    #[must_use]
    pub const fn is_wanted(&self) -> bool {
        !self.nets.is_empty() || !self.areas.is_empty() || !self.distances.is_empty()
    }

    /// The patterns that mean nets.
    pub(super) fn patterns(&self) -> impl Iterator<Item = &Pattern> + Clone {
        self.nets.iter().chain(self.distances.iter().map(|own| &own.nets))
    }

    /// The greatest distance to which anything is cleared round copper.
    pub(super) fn farthest(&self) -> Option<Nm> {
        self.distances.iter().map(|own| own.distance.nm()).max()
    }

    /// What that means on a side, of which the finest tool cuts this kerf: as far as the middle of
    /// a cutter goes.
    pub(super) fn on(&self, copper: &Copper, nets: &Nets, kerf: Nm) -> voronoi::Clearing {
        let ids = || (0..).map(NetId).take(nets.nets().len());
        if !self.is_wanted() {
            return voronoi::Clearing { kept: polygons(&self.kept), ..voronoi::Clearing::default() };
        }
        let names: Vec<Vec<String>> = ids().map(|id| called(copper, nets, id)).collect();
        let is_any = |patterns: &[Pattern], id: NetId| {
            patterns.iter().any(|pattern| pattern.matches_any(&names[id.index()]))
        };
        let mut areas = polygons(&self.areas);
        for own in &self.distances {
            let own_nets = nets.nets().iter().zip(&names).filter(|(_, names)| own.nets.matches_any(names));
            let features = own_nets.flat_map(|(net, _)| &net.features);
            let shapes = features.map(|&feature| &copper.features[feature as usize].shape);
            let polygons: Vec<Polygon> = shapes.filter_map(|shape| shape.polygon(FLATTEN)).collect();
            let whole = union(&polygons);
            areas.extend(whole.iter().flat_map(|part| offset(part, own.distance.nm() + kerf / 2, FLATTEN)));
        }
        voronoi::Clearing {
            nets: ids().filter(|&id| is_any(&self.nets, id)).collect(),
            areas,
            kept: polygons(&self.kept),
        }
    }

    /// What a judge needs to know of it, where that stands in files and not in programs.
    pub(super) fn drawn(&self, everything: bool, tolerance: Nm) -> Option<Asked> {
        let is_drawn = |area: &AreaChoice| matches!(area, AreaChoice::Drawn { .. });
        self.areas.iter().chain(&self.kept).any(is_drawn).then(|| self.asked(everything, tolerance))
    }

    /// What a judge needs to know of it.
    #[must_use]
    pub fn asked(&self, everything: bool, tolerance: Nm) -> Asked {
        Asked {
            everything,
            areas: polygons(&self.areas),
            nets: self.nets.clone(),
            distances: self.distances.iter().map(|own| (own.nets.clone(), own.distance.nm())).collect(),
            kept: polygons(&self.kept),
            tolerance,
            unread: Vec::new(),
        }
    }
}

/// What areas cover.
fn polygons(areas: &[AreaChoice]) -> Vec<Polygon> {
    areas.iter().flat_map(AreaChoice::polygons).collect()
}
