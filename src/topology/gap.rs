//! The narrowest gap between two nets of a layer: what tool a board asks for.

use rayon::prelude::*;

use crate::board::Copper;
use crate::geometry::{Met, Nm};

use super::contact::{Bodies, Narrowest};
use super::nets::Gap;
use super::{NetId, Nets};

/// How many features one worker takes at least. Chosen as for contact.
const SHARE: usize = 1024;

/// How far the search looks at first. Chosen: boards have gaps of 0.1 to 0.3 mm somewhere.
const FIRST_LIMIT: Nm = Nm::from_um(250);

/// The narrowest gap between two nets of `copper`; none with fewer than two nets.
///
/// Looks within a small distance of every feature, then within twice that, until it finds a gap:
/// near-linear time. Who asks again is told at once.
#[must_use]
pub fn smallest_gap(copper: &Copper, nets: &Nets) -> Option<Gap> {
    *nets.gap.get_or_init(|| search(copper, nets))
}

fn search(copper: &Copper, nets: &Nets) -> Option<Gap> {
    if nets.nets().len() < 2 {
        return None;
    }
    let bodies = Bodies::new(copper);
    let one = one_net(&bodies, nets);
    let mut limit = FIRST_LIMIT;
    loop {
        if let Some(found) = narrowest_within(&bodies, &one, nets, limit) {
            return Some(found.gap(nets));
        }
        limit = limit * 2;
    }
}

/// The net of all features below each node of the index, where that is one.
fn one_net(bodies: &Bodies, nets: &Nets) -> Vec<Option<NetId>> {
    let tree = bodies.index.tree();
    let mut one: Vec<Option<NetId>> = Vec::with_capacity(tree.nodes());
    // What is below a node comes before it.
    for node in 0..tree.nodes() {
        let mut below = tree.below(node).map(|met| match met {
            Met::Box(feature) => Some(nets.of(feature)),
            Met::Node(below) => one[below],
        });
        let first = below.next().flatten();
        let net = first.filter(|_| below.all(|net| net == first));
        one.push(net);
    }
    one
}

/// A gap between two features.
#[derive(Clone, Copy)]
struct Found {
    place: Narrowest,
    features: (usize, usize),
}

impl Found {
    fn gap(&self, nets: &Nets) -> Gap {
        let (a, b) = (nets.of(self.features.0), nets.of(self.features.1));
        Gap { between: (a.min(b), a.max(b)), at: self.place.at, width: Nm::from_f64(self.place.width) }
    }

    /// The narrower of two; of equals the one between earlier features, whoever found it.
    fn narrower(self, other: Self) -> Self {
        let order = self.place.width.total_cmp(&other.place.width).then(self.features.cmp(&other.features));
        if order.is_le() { self } else { other }
    }
}

fn narrowest_within(bodies: &Bodies, one: &[Option<NetId>], nets: &Nets, limit: Nm) -> Option<Found> {
    let found = bodies.index.order().into_par_iter().with_min_len(SHARE).fold(
        || None,
        |mut best: Option<Found>, feature| {
            let window = bodies.bodies[feature].bounds().inflate(reach(best, limit));
            let own = nets.of(feature);
            bodies.index.visit_entered(window, |met| match met {
                // A plane has no gap to itself, however many features it is made of.
                Met::Node(node) => one[node] != Some(own),
                Met::Box(other) => {
                    if other > feature && own != nets.of(other) {
                        let (a, b) = (&bodies.bodies[feature], &bodies.bodies[other]);
                        let place = a.narrowest(b, reach(best, limit));
                        let found = place.map(|place| Found { place, features: (feature, other) });
                        best = [best, found].into_iter().flatten().reduce(Found::narrower);
                    }
                    true
                }
            });
            best
        },
    );
    found.filter_map(|best| best).reduce_with(Found::narrower)
}

/// How far to look for something no wider than `best`.
fn reach(best: Option<Found>, limit: Nm) -> Nm {
    best.map_or(limit, |best| limit.min(Nm::from_f64(best.place.width.ceil()) + Nm::new(1)))
}
