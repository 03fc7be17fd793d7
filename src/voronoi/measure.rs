//! How long boundaries are, how large the regions between them, and how far places are from copper.

use crate::geometry::{Path, Point};

use super::plane::Spot;
use super::{Boundaries, Diagram, Owner, SiteKind};

impl Diagram {
    /// How far the nearest edge of copper is from `place`, in nanometres; none where distances are
    /// not to the copper's edges.
    #[must_use]
    pub fn clearance_at(&self, place: Point) -> Option<f64> {
        (self.settings.sites == SiteKind::Copper).then(|| self.certified.distance(place.into()))
    }
}

impl Boundaries {
    /// The length of all that isolates, in nanometres: what runs along the board's edge or the
    /// frame is left out.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.edges.iter().filter(|edge| !edge.is_border()).map(|edge| edge.path.length()).sum()
    }

    /// The area of each of the first `nets` nets' regions, in square nanometres.
    #[must_use]
    pub fn areas(&self, nets: usize) -> Vec<f64> {
        let mut areas = vec![0.0; nets];
        let Some(origin) = self.edges.first().map(|edge| edge.path.start) else { return areas };
        for edge in &self.edges {
            let area = swept(&edge.path, origin);
            for (owner, sign) in [(edge.left, 1.0), (edge.right, -1.0)] {
                if let Owner::Net(net) = owner
                    && let Some(sum) = areas.get_mut(net.index())
                {
                    *sum += sign * area;
                }
            }
        }
        areas
    }
}

/// The area that the line from `origin` to a point of `path` sweeps, counter-clockwise positive.
fn swept(path: &Path, origin: Point) -> f64 {
    let at = |p: Point| Spot::from(p) - Spot::from(origin);
    path.steps()
        .map(|(from, segment)| {
            let bulge = segment.arc(from).map_or(0.0, |arc| {
                let (radius, sweep) = (arc.radius(), arc.sweep());
                radius * radius / 2.0 * (sweep - libm::sin(sweep))
            });
            at(from).cross(at(segment.to())) / 2.0 + bulge
        })
        .sum()
}
