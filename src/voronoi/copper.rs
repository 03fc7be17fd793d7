//! The distance to copper, whatever sites boundaries were found with.
//!
//! With [`SiteKind::Core`](super::SiteKind) the picture knows distances to axes; how far the tool
//! is from copper must be asked of the copper itself, through an index of its edges.
//!
//! ```text
//!      ╭──────╴ boundary      Where a boundary goes over from the band round a trace's copper ┄ into the bisector of two axes it has a
//!    ┄┄╯┄┄┄┄┄┄┄ band          corner, which pixels show cut off. What then lies within the band goes straight away from the copper.
//!     ▓▓▓▓▓▓▓▓▓ copper
//! ```

use crate::board::Copper;
use crate::topology::Nets;

use super::near::Near;
use super::plane::Spot;
use super::seed::Sites;
use super::span::Sample;
use super::{Settings, SiteKind};

/// What lies this much within the band is there by rounding, in nanometres.
const ROUNDING: f64 = 500.0;
/// A way is halved at most so often, and ways as short as this are not, in nanometres.
const HALVINGS: u32 = 8;
const SHORT: f64 = 4_000.0;
/// How often a place is moved at most. Chosen: a corner cut off is left by less.
const TURNS: usize = 16;

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

    /// The samples of a boundary, of which none lies nearer to copper than `band` nanometres but
    /// its ends, and where there is no room.
    pub(super) fn keep_off(&self, samples: &[Sample], band: f64) -> Vec<Sample> {
        let Some((first, rest)) = samples.split_first() else { return Vec::new() };
        let mut kept = vec![self.sample(first.at)];
        for (i, next) in rest.iter().enumerate() {
            let is_end = i + 1 == rest.len();
            let next = if is_end { next.at } else { self.off(next.at, band).unwrap_or(next.at) };
            let next = self.sample(next);
            self.way(kept[kept.len() - 1], next, band, HALVINGS, &mut kept);
            kept.push(next);
        }
        kept
    }

    /// Adds what the straight way between two samples needs to keep off.
    fn way(&self, from: Sample, to: Sample, band: f64, left: u32, kept: &mut Vec<Sample>) {
        let length = (to.at - from.at).length();
        // Copper comes no faster than the way goes.
        let is_clear = from.clearance + to.clearance - length >= 2.0 * (band - ROUNDING);
        let middle = from.at.midpoint(to.at);
        if left == 0 || length < SHORT || is_clear || self.distance(middle) >= band - ROUNDING {
            return;
        }
        let Some(middle) = self.off(middle, band).map(|at| self.sample(at)) else { return };
        self.way(from, middle, band, left - 1, kept);
        kept.push(middle);
        self.way(middle, to, band, left - 1, kept);
    }

    /// The place beside `p` that is no nearer to copper than `band`; none where there is no room.
    fn off(&self, p: Spot, band: f64) -> Option<Spot> {
        let mut at = p;
        for _ in 0..TURNS {
            let reach = self.near.reach(&self.sites, at, |_| true);
            if reach.distance >= band - ROUNDING {
                return Some(at);
            }
            at = at + reach.away * (band - reach.distance);
            if (at - p).length() > band {
                return None;
            }
        }
        None
    }

    fn sample(&self, at: Spot) -> Sample {
        Sample { at, clearance: self.distance(at) }
    }

    /// The distance from `p` to the nearest copper, in nanometres; zero on it.
    pub(super) fn distance(&self, p: Spot) -> f64 {
        self.near.distance(&self.sites, p)
    }
}
