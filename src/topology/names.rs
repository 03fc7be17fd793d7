//! What the file says about nets (X2 `.N`), held against the copper.

use std::collections::BTreeMap;

use crate::board::{Copper, Warning};
use crate::geometry::Point;

use super::{Net, NetId, Nets};

/// A warning for every island that carries several names: a short in the design, or a net tie.
///
/// One name on several islands is no warning: they are joined on another layer or by a wire (see
/// [`islands_of_names`], and [`electrical`](super::electrical()) for those that are not).
#[must_use]
pub fn names_check(copper: &Copper, nets: &Nets) -> Vec<Warning> {
    let several = nets.nets().iter().filter(|net| net.names.len() > 1);
    several
        .map(|net| {
            let places: Vec<_> =
                net.names.iter().filter_map(|name| Some((name, place_of(copper, net, name)?))).collect();
            let names: Vec<_> =
                places.iter().map(|(name, at)| format!("{name} (at {}, {} mm)", at.x, at.y)).collect();
            let message = format!(
                "{} are one island of copper: a short in the design or a net tie; isolated as one net",
                names.join(" and ")
            );
            let warning = Warning::new("nets-joined", message).on(copper.side);
            places.last().map(|(_, at)| *at).into_iter().fold(warning, Warning::at)
        })
        .collect()
}

/// A point of the first feature of `net` that carries `name`.
fn place_of(copper: &Copper, net: &Net, name: &str) -> Option<Point> {
    let mut features = net.features.iter().map(|&index| &copper.features[index as usize]);
    let named = features.find(|feature| copper.attributes_of(feature).net.as_deref() == Some(name))?;
    Some(named.shape.anchor())
}

/// The islands that carry each name, for the names that are on several.
#[must_use]
pub fn islands_of_names(nets: &Nets) -> BTreeMap<&str, Vec<NetId>> {
    let mut islands: BTreeMap<&str, Vec<NetId>> = BTreeMap::new();
    for (net, id) in nets.nets().iter().zip(0..) {
        for name in &net.names {
            islands.entry(name).or_default().push(NetId(id));
        }
    }
    islands.retain(|_, ids| ids.len() > 1);
    islands
}
