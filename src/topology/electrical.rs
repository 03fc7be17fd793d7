//! The nets of the whole board: islands of both sides joined through plated holes. For reports
//! only; each side is isolated island by island.

use std::ops::ControlFlow;

use crate::board::diagnostic::planning;
use crate::board::{Copper, Hole, Plating, Side, Warning};
use crate::geometry::Nm;

use super::contact::{Bodies, Body};
use super::sets::DisjointSets;
use super::{NetId, Nets};

/// How far the plating of a hole is taken to reach beyond the drill.
///
/// Chosen: pads with a hole of their own are drawn with the drill's diameter, rounded to a mil's
/// tenths here and to a micrometre's there; clearances are ten times as wide.
const PLATING: Nm = Nm::from_um(10);

/// What conducts on the assembled board.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Electrical {
    /// The nets, by their first island, front before back.
    pub nets: Vec<ElectricalNet>,
}

/// Islands that conduct to each other through holes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ElectricalNet {
    /// The names (X2) on its islands, sorted, each once.
    pub names: Vec<String>,
    /// Its islands on the front.
    pub front: Vec<NetId>,
    /// Its islands on the back.
    pub back: Vec<NetId>,
    /// The holes that belong to it, as indices into the board's.
    pub holes: Vec<usize>,
}

impl Electrical {
    /// A warning for every name that is on several electrical nets: one that a wire must join, or
    /// an open circuit.
    #[must_use]
    pub fn check(&self) -> Vec<Warning> {
        let mut names: Vec<&str> = self.nets.iter().flat_map(|net| &net.names).map(String::as_str).collect();
        names.sort_unstable();
        names
            .chunk_by(|a, b| a == b)
            .filter(|same| same.len() > 1)
            .map(|same| {
                let message = format!("{} is in {} pieces that no plated hole joins", same[0], same.len());
                planning::NET_IN_PIECES.warning(message)
            })
            .collect()
    }
}

/// The electrical nets of a board with these layers and holes. Holes that may be plated are taken
/// for plated.
#[must_use]
pub fn electrical(
    front: Option<(&Copper, &Nets)>,
    back: Option<(&Copper, &Nets)>,
    holes: &[Hole],
) -> Electrical {
    let sides: Vec<_> = [front, back].into_iter().flatten().collect();
    let islands: usize = sides.iter().map(|(_, nets)| nets.nets().len()).sum();
    let mut sets = DisjointSets::new(islands);
    let mut holed: Vec<(usize, u32)> = Vec::new();
    let mut first = 0;
    for (copper, nets) in &sides {
        let bodies = Bodies::new(copper);
        for (number, hole) in holes.iter().enumerate().filter(|(_, hole)| hole.plating != Plating::NonPlated)
        {
            holed.extend(islands_at(hole, &bodies, nets).map(|island| (number, first + island.0)));
        }
        first += u32::try_from(nets.nets().len()).expect("no more nets than features");
    }
    holed.sort_unstable();
    holed.dedup();
    for same in holed.chunk_by(|a, b| a.0 == b.0) {
        for &(_, island) in same {
            sets.union(same[0].1, island);
        }
    }
    collect(&sides, &holed, sets)
}

/// The islands that the wall of `hole` touches.
fn islands_at<'a>(hole: &Hole, bodies: &'a Bodies, nets: &'a Nets) -> impl Iterator<Item = NetId> + use<'a> {
    let mut found = Vec::new();
    for wall in hole.shapes(PLATING).iter().map(Body::new) {
        let _ = bodies.index.visit(wall.bounds(), |feature| {
            if wall.touches(&bodies.bodies[feature]) {
                found.push(nets.of(feature));
            }
            ControlFlow::Continue(())
        });
    }
    found.into_iter()
}

/// The sets of islands as nets.
fn collect(sides: &[(&Copper, &Nets)], holed: &[(usize, u32)], mut sets: DisjointSets) -> Electrical {
    let mut found = Electrical::default();
    let mut of: Vec<usize> = Vec::new();
    let islands = sides.iter().flat_map(|(copper, nets)| {
        nets.nets().iter().zip(0..).map(|(net, id)| (copper.side, net, NetId(id)))
    });
    for ((side, island, id), index) in islands.zip(0_u32..) {
        let first = sets.find(index);
        if first == index {
            of.push(found.nets.len());
            found.nets.push(ElectricalNet::default());
        } else {
            of.push(of[first as usize]);
        }
        let net = &mut found.nets[of[index as usize]];
        match side {
            Side::Front => net.front.push(id),
            Side::Back => net.back.push(id),
        }
        net.names.extend(island.names.iter().cloned());
    }
    for &(hole, island) in holed {
        found.nets[of[island as usize]].holes.push(hole);
    }
    for net in &mut found.nets {
        net.names.sort_unstable();
        net.names.dedup();
        net.holes.dedup();
    }
    found
}
