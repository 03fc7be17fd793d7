//! Euler's formula on every real board: no boundary is lost or doubled, and every region's border
//! closes.
//!
//! Each boundary is walked along on both hands. Where it ends, the walk goes on along the boundary
//! that has the same region on that hand; it must come back to where it began, and how many such
//! walks there are is how many borders. A connected part of the graph that lies in the plane has
//! `nodes − boundaries + borders = 2`: with a boundary too few a walk has nowhere to go, and with
//! one too many the sum is wrong.

use std::collections::{BTreeMap, BTreeSet};

use voromill::geometry::{Nm, Path, Point};
use voromill::topology::{self, DisjointSets, Method};
use voromill::voronoi::{Boundaries, Boundary, Diagram, Owner, Settings};

use crate::real_boards::{self, Layer};

/// 500 DPI.
const PITCH: Nm = Nm::new(50_800);
/// An unoptimised test looks at layers with at most so many features.
const FEATURES_UNOPTIMISED: usize = 300;

/// A boundary as walked along: its number, and whether from its end to its beginning.
type Walk = (usize, bool);

/// The node that a walk ends at.
fn end(edge: &Boundary, backwards: bool) -> Option<u32> {
    edge.ends.map(|(from, to)| if backwards { from.0 } else { to.0 })
}

/// The region on the left of a walk.
fn left(edge: &Boundary, backwards: bool) -> Owner {
    if backwards { edge.right } else { edge.left }
}

/// The direction in which a walk leaves, in radians: that to where it is 30 µm off, or to the
/// farthest of one that soon comes back.
fn direction(edge: &Boundary, backwards: bool) -> f64 {
    const FAR: f64 = 30_000.0;
    let path = if backwards { Path::reversed(&edge.path) } else { edge.path.clone() };
    let off = |p: &Point| p.distance(path.start);
    let points = path.flatten(Nm::new(100));
    let crossing = points.windows(2).find(|pair| off(&pair[1]) > FAR).map(|pair| {
        let part = (FAR - off(&pair[0])) / (off(&pair[1]) - off(&pair[0]));
        let [(ax, ay), (bx, by)] = [pair[0], pair[1]].map(Point::to_f64);
        (ax + (bx - ax) * part, ay + (by - ay) * part)
    });
    let farthest = || points.iter().max_by(|a, b| off(a).total_cmp(&off(b)));
    let (ax, ay) = path.start.to_f64();
    let (bx, by) = crossing.unwrap_or_else(|| farthest().copied().unwrap_or(path.start).to_f64());
    libm::atan2(by - ay, bx - ax)
}

/// The walk that goes on where one ends: the next one clockwise of those that have the same region
/// on their left.
fn onward(found: &Boundaries, leaving: &BTreeMap<u32, Vec<Walk>>, walk: Walk) -> Option<Walk> {
    let edge = &found.edges[walk.0];
    let Some(node) = end(edge, walk.1) else { return Some(walk) };
    let owner = left(edge, walk.1);
    let same = leaving[&node].iter().filter(|next| left(&found.edges[next.0], next.1) == owner);
    let same: Vec<&Walk> = same.collect();
    match same.as_slice() {
        [] => None,
        [only] => Some(**only),
        _ => {
            let back = direction(edge, !walk.1);
            let turn = |next: &Walk| {
                let angle = back - direction(&found.edges[next.0], next.1);
                // What leads back the way that it came is the last choice: both ways round a wedge
                // that is thinner than a fit may be one line.
                let turn = angle.rem_euclid(std::f64::consts::TAU);
                if turn > 0.0 { turn } else { std::f64::consts::TAU }
            };
            same.into_iter().min_by(|a, b| turn(a).total_cmp(&turn(b))).copied()
        }
    }
}

/// What is wrong with the graph of a layer.
pub(crate) fn wrong(found: &Boundaries) -> Option<String> {
    let mut leaving: BTreeMap<u32, Vec<Walk>> = BTreeMap::new();
    let mut sets = DisjointSets::new(found.nodes.len());
    for (i, edge) in found.edges.iter().enumerate() {
        if edge.left == edge.right {
            return Some(format!("{:?} on both hands at {:?}", edge.left, edge.path.start));
        }
        if let Some((from, to)) = edge.ends {
            leaving.entry(from.0).or_default().push((i, false));
            leaving.entry(to.0).or_default().push((i, true));
            sets.union(from.0, to.0);
        }
    }
    // Nodes, boundaries and borders of each connected part.
    let mut parts: BTreeMap<u32, [i64; 3]> = BTreeMap::new();
    sets.clone().representatives().into_iter().for_each(|i| parts.entry(i).or_default()[0] += 1);
    let mut walked: BTreeSet<Walk> = BTreeSet::new();
    for (i, edge) in found.edges.iter().enumerate() {
        let Some((node, _)) = edge.ends else { continue };
        let part = sets.find(node.0);
        parts.entry(part).or_default()[1] += 1;
        for start in [(i, false), (i, true)] {
            if walked.contains(&start) {
                continue;
            }
            let mut walk = start;
            while walked.insert(walk) {
                let Some(next) = onward(found, &leaving, walk) else {
                    return Some(format!(
                        "the border of {:?} does not close at {:?}",
                        left(edge, walk.1),
                        found.edges[walk.0].path
                    ));
                };
                walk = next;
            }
            if walk != start {
                return Some(format!(
                    "two borders of {:?} run together at {:?}",
                    left(edge, start.1),
                    edge.path.start
                ));
            }
            parts.entry(part).or_default()[2] += 1;
        }
    }
    let uneven = parts.iter().find(|(_, [nodes, edges, borders])| nodes - edges + borders != 2);
    uneven.map(|(&node, counts)| {
        format!("{counts:?} nodes, boundaries and borders round {:?}", found.nodes[node as usize])
    })
}

#[test]
fn eulers_formula_holds_on_every_board() {
    let mut faults = Vec::new();
    for Layer { name, copper, outline } in real_boards::layers(FEATURES_UNOPTIMISED) {
        let nets = topology::recover(&copper, Method::Contact);
        let gap = topology::smallest_gap(&copper, &nets);
        let pitch = gap.map_or(PITCH, |gap| (gap.width / 3).max(Nm::from_um(5)).min(PITCH));
        let settings = Settings { pitch, ..Settings::default() };
        let diagram = Diagram::new(&copper, &nets, outline.as_ref(), &settings).expect("a diagram");
        let found = diagram.boundaries().expect("whole boundaries");
        println!("{name}: {} nodes, {} boundaries", found.nodes.len(), found.edges.len());
        faults.extend(wrong(&found).map(|wrong| format!("{name}: {wrong}")));
        let seen: BTreeSet<Owner> = found.edges.iter().flat_map(|edge| [edge.left, edge.right]).collect();
        let regions = seen.iter().filter(|owner| matches!(owner, Owner::Net(_))).count();
        let (aside, all) = (diagram.warnings().len(), nets.nets().len());
        if regions + aside < all {
            faults.push(format!("{name}: {regions} regions and {aside} nets left aside of {all}"));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}
