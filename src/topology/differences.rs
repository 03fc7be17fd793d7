//! Where methods disagree, and why: all three on one layer.

use std::ops::ControlFlow;

use crate::board::Copper;
use crate::geometry::{Nm, Point};
use crate::grid::{Grid, GridError};

use super::contact::{Bodies, JOINED};
use super::sets::DisjointSets;
use super::{Method, NetId, Nets, Sampling, Translucency, coincidence, translucency};

/// All three methods on one layer.
#[derive(Clone, Debug)]
pub struct Differences {
    /// What Algorithm 1 found.
    pub coincidence: Nets,
    /// What Algorithm 2 found after it.
    pub translucency: Translucency,
    /// What touches.
    pub contact: Nets,
    /// What the first two missed, in this order, by net. None of the three joins what does not
    /// touch.
    pub missed: Vec<Missed>,
}

/// A place where copper touches that a method took for two nets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Missed {
    /// The method that missed it.
    pub by: Method,
    /// The features that touch, by index.
    pub features: (u32, u32),
    /// The nets they belong to, as that method has them.
    pub nets: (NetId, NetId),
    /// Where they touch.
    pub at: Point,
    /// Why it was missed.
    pub reason: Reason,
}

/// Why a method missed that copper touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reason {
    /// No vertex of one is a vertex of the other: Algorithm 1 looks at nothing else.
    NoCommonVertex,
    /// No centre of a pixel lies in both: the overlap is too thin for this resolution.
    ThinnerThanPixel,
    /// A pixel shows the overlap, in a colour that was seen before.
    ColourCollision,
}

/// Runs all three methods on `copper` and lists what the paper's two miss: for every net, as few
/// places as would join its parts.
///
/// # Errors
///
/// [`GridError`] where the pixels are too fine for the raster.
pub fn differences(copper: &Copper, sampling: Sampling) -> Result<Differences, GridError> {
    let sets = coincidence::join(copper);
    let bodies = Bodies::new(copper);
    let contact = Nets::from_sets(copper, bodies.join(&sets));
    let coincidence = Nets::from_sets(copper, sets);
    let translucency = translucency(copper, &coincidence, sampling)?;
    let search = Search { bodies: &bodies };
    let mut missed = search.missed(Method::Coincidence, &coincidence, &contact, None);
    if let Some(bounds) = copper.bounds() {
        let grid = Grid::covering(bounds, sampling.pitch)?;
        missed.extend(search.missed(Method::Translucency, &translucency.nets, &contact, Some(&grid)));
    }
    Ok(Differences { coincidence, translucency, contact, missed })
}

/// The search for touching features.
struct Search<'a> {
    bodies: &'a Bodies,
}

impl Search<'_> {
    /// What `fine` has apart and `contact` together. With a grid, overlaps that a pixel shows come
    /// first.
    fn missed(&self, by: Method, fine: &Nets, contact: &Nets, grid: Option<&Grid>) -> Vec<Missed> {
        let mut joined = DisjointSets::new(fine.nets().len());
        let mut missed = Vec::new();
        let mut found: Vec<_> = self.touching(fine, contact);
        found.sort_by_cached_key(|&pair| !grid.is_some_and(|grid| self.shows(pair, grid)));
        for (a, b) in found {
            let nets = (fine.of(a as usize), fine.of(b as usize));
            if joined.union(nets.0.0, nets.1.0) {
                let (one, other) = (&self.bodies.bodies[a as usize], &self.bodies.bodies[b as usize]);
                let at = one.meeting(other);
                let reason = match grid {
                    None => Reason::NoCommonVertex,
                    Some(grid) if self.shows((a, b), grid) => Reason::ColourCollision,
                    Some(_) => Reason::ThinnerThanPixel,
                };
                missed.push(Missed { by, features: (a, b), nets, at, reason });
            }
        }
        missed
    }

    /// The pairs of features that touch and that `fine` has apart.
    fn touching(&self, fine: &Nets, contact: &Nets) -> Vec<(u32, u32)> {
        let split = contact.nets().iter().filter(|net| {
            net.features.iter().any(|&feature| fine.of(feature as usize) != fine.of(net.features[0] as usize))
        });
        let mut found = Vec::new();
        for &feature in split.flat_map(|net| &net.features) {
            let body = &self.bodies.bodies[feature as usize];
            let _ = self.bodies.index.visit(body.bounds().inflate(JOINED), |other| {
                let number = u32::try_from(other).expect("fewer than 2³² features");
                if number > feature
                    && fine.of(feature as usize) != fine.of(other)
                    && body.is_within(&self.bodies.bodies[other], JOINED)
                {
                    found.push((feature, number));
                }
                ControlFlow::Continue(())
            });
        }
        found.sort_unstable();
        found
    }

    /// Whether the centre of any pixel lies in both features.
    fn shows(&self, (a, b): (u32, u32), grid: &Grid) -> bool {
        let (a, b) = (&self.bodies.bodies[a as usize], &self.bodies.bodies[b as usize]);
        let Some(common) = a.bounds().common(b.bounds()) else { return false };
        let (left, top, pitch) = (grid.rect().min().x, grid.rect().max().y, grid.pitch().get());
        let count = |extent: Nm| extent.get().div_euclid(pitch);
        (count(top - common.max().y)..=count(top - common.min().y)).any(|row| {
            (count(common.min().x - left)..=count(common.max().x - left)).any(|column| {
                let center = grid.center(column, row);
                a.holds(center) && b.holds(center)
            })
        })
    }
}
