//! The distance to copper, whatever sites boundaries were found with.
//!
//! With [`SiteKind::Core`](super::SiteKind) the picture knows distances to axes; how far the tool is from copper must be asked
//! of the copper itself, through an index of its edges.

use static_aabb2d_index::{Control, StaticAABB2DIndex, StaticAABB2DIndexBuilder};

use crate::board::Copper;
use crate::topology::Nets;

use super::plane::Spot;
use super::seed::Sites;
use super::site::Form;
use super::{Settings, SiteKind};

/// The true edges of a layer's copper, by place.
pub(super) struct Edges {
    sites: Sites,
    labels: Vec<usize>,
    index: StaticAABB2DIndex<f64>,
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
        let boxes: Vec<(usize, [f64; 4])> =
            (0..sites.sites.len()).filter_map(|label| Some((label, bounds(&sites, label)?))).collect();
        let mut builder = StaticAABB2DIndexBuilder::new(boxes.len());
        for (_, [left, bottom, right, top]) in &boxes {
            builder.add(*left, *bottom, *right, *top);
        }
        let index = builder.build().ok()?;
        Some(Self { sites, labels: boxes.into_iter().map(|(label, _)| label).collect(), index })
    }

    /// The distance from `p` to the nearest copper, in nanometres; zero on it.
    pub(super) fn distance(&self, p: Spot) -> f64 {
        let mut nearest = f64::INFINITY;
        self.index.visit_neighbors(p.x, p.y, &mut |i: usize, squared: f64| {
            if squared.sqrt() >= nearest {
                return Control::Break(());
            }
            let site = &self.sites.sites[self.labels[i]];
            nearest = nearest.min(site.reach(&self.sites.rings, p).distance.max(0.0));
            Control::Continue
        });
        nearest
    }
}

/// The box round a site's edge: left, bottom, right, top; none for what has no edge of its own.
fn bounds(sites: &Sites, label: usize) -> Option<[f64; 4]> {
    let site = &sites.sites[label];
    let around = |spots: &mut dyn Iterator<Item = Spot>, radius: f64| {
        let far = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        let [left, bottom, right, top] = spots.fold(far, |[left, bottom, right, top], p| {
            [left.min(p.x), bottom.min(p.y), right.max(p.x), top.max(p.y)]
        });
        [left - radius, bottom - radius, right + radius, top + radius]
    };
    match &site.form {
        Form::Point(p) if label > 1 => Some(around(&mut [*p].into_iter(), site.radius)),
        Form::Line(a, b) => Some(around(&mut [*a, *b].into_iter(), site.radius)),
        Form::Arc { center, radius, .. } => Some(around(&mut [*center].into_iter(), radius + site.radius)),
        Form::Chain { ring, first, count } => {
            let vertices = sites.rings.ring(*ring);
            let mut run = vertices.iter().cycle().skip(*first as usize).take(*count as usize + 1).copied();
            Some(around(&mut run, 0.0))
        }
        Form::Point(_) | Form::Inside { .. } | Form::Outside => None,
    }
}
