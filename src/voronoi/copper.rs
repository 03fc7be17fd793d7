//! The distance to copper, whatever sites boundaries were found with.
//!
//! With [`SiteKind::Core`](super::SiteKind) the picture knows distances to axes; how far the tool is from copper must be asked
//! of the copper itself, through an index of its edges.

use crate::board::Copper;
use crate::topology::Nets;

use super::near::Near;
use super::plane::Spot;
use super::seed::Sites;
use super::{Settings, SiteKind};

/// The true edges of a layer's copper, by place.
pub(super) struct Edges {
    sites: Sites,
    near: Near,
}

impl Edges {
    /// The edges of all features that `keep` accepts; none where there are none.
    pub(super) fn new(
        copper: &Copper,
        nets: &Nets,
        settings: &Settings,
        keep: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let settings = Settings { sites: SiteKind::Copper, ..settings.clone() };
        let sites = Sites::new(copper, nets, &settings, keep);
        let near = Near::new(&sites)?;
        Some(Self { sites, near })
    }

    /// The distance from `p` to the nearest copper, in nanometres; zero on it.
    pub(super) fn distance(&self, p: Spot) -> f64 {
        self.near.distance(&self.sites, p)
    }
}
