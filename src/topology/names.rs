//! What the file says about nets (X2 `.N`), held against the copper.

use std::collections::{BTreeMap, VecDeque};

use rustc_hash::FxHashMap;

use crate::board::diagnostic::planning;
use crate::board::{Copper, Warning};
use crate::geometry::Point;

use super::{JOINED, Net, NetId, Nets, Proximity};

/// What a net is called: its names, its number, and what all its copper is for if that is one
/// thing.
#[must_use]
pub fn called(copper: &Copper, nets: &Nets, id: NetId) -> Vec<String> {
    let net = &nets.nets()[id.index()];
    let function = |&feature: &u32| copper.attributes_of(&copper.features[feature as usize]).function.clone();
    let mut functions: Vec<Option<String>> = net.features.iter().map(function).collect();
    functions.dedup();
    let mut names = net.names.clone();
    names.push(nets.label(id));
    if let [Some(function)] = functions.as_slice() {
        names.push(function.clone());
    }
    names
}

/// A warning for every island that carries several names, a short in the design or a net tie, with
/// the places where they meet.
///
/// One name on several islands is no warning: they are joined on another layer or by a wire (see
/// [`islands_of_names`], and [`electrical`](super::electrical()) for those that are not).
#[must_use]
pub fn names_check(copper: &Copper, nets: &Nets) -> Vec<Warning> {
    let several: Vec<_> = nets.nets().iter().filter(|net| net.names.len() > 1).collect();
    if several.is_empty() {
        return Vec::new();
    }
    let proximity = Proximity::new(copper);
    several
        .into_iter()
        .map(|net| {
            let meetings = meetings(copper, net, &proximity);
            let places: Vec<_> = meetings
                .iter()
                .map(|((a, b), at)| format!("{a} meets {b} at {}, {} mm", at.x, at.y))
                .collect();
            let message = format!(
                "{} are one island of copper ({}): a short in the design or a net tie; isolated as one net",
                net.names.join(" and "),
                places.join(", ")
            );
            let warning = planning::NETS_JOINED.warning(message).on(copper.side);
            meetings.values().next().copied().into_iter().fold(warning, Warning::at)
        })
        .collect()
}

/// Where copper of one name meets copper of another, a place for each two names.
///
/// Names spread from the features that carry them, breadth first and in the order of the file, over
/// copper without one.
fn meetings<'a>(copper: &'a Copper, net: &Net, proximity: &Proximity) -> BTreeMap<(&'a str, &'a str), Point> {
    let mut names: FxHashMap<usize, &str> = FxHashMap::default();
    let mut queue = VecDeque::new();
    for feature in net.features.iter().map(|&index| index as usize) {
        if let Some(name) = copper.attributes_of(&copper.features[feature]).net.as_deref() {
            names.insert(feature, name);
            queue.push_back(feature);
        }
    }
    let mut found = BTreeMap::new();
    while let Some(feature) = queue.pop_front() {
        let name = names[&feature];
        for near in proximity.near(&copper.features[feature].shape, JOINED) {
            let other = *names.entry(near.feature).or_insert_with(|| {
                queue.push_back(near.feature);
                name
            });
            if other != name {
                found.entry((name.min(other), name.max(other))).or_insert(near.at);
            }
        }
    }
    found
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
