//! The same board traced at four resolutions: paths are the same wherever the same features are
//! seen.
//!
//! What a picture sees of a boundary is which two regions it parts and which others it meets at its
//! ends. Boundaries of two pictures of which all that is the same, as often in the one as in the
//! other, must be the same curves.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use voromill::geometry::Nm;
use voromill::topology::{self, Method};
use voromill::voronoi::{Boundaries, Boundary, Diagram, Owner, Settings};

use crate::oracle::field::Spot;
use crate::oracle::polyline;
use crate::real_boards::{self, Layer};

/// Pixels of 250, 500, 1000 and 2000 DPI.
const PITCHES: [i64; 4] = [101_600, 50_800, 25_400, 12_700];
/// How far apart paths may be, in nanometres.
const APART: f64 = 2_000.0;
/// An unoptimised test looks at layers with at most so many features.
const FEATURES_UNOPTIMISED: usize = 60;

/// The regions on both sides of a boundary and those that meet at each of its ends.
type Seen = (BTreeSet<Owner>, BTreeSet<BTreeSet<Owner>>);

fn points(edge: &Boundary) -> Vec<Spot> {
    edge.path.flatten(Nm::new(50)).into_iter().map(|p| p.to_f64().into()).collect()
}

/// The curves of a picture by what is seen of them.
fn curves(found: &Boundaries) -> BTreeMap<Seen, Vec<Vec<Spot>>> {
    let mut met: Vec<BTreeSet<Owner>> = vec![BTreeSet::new(); found.nodes.len()];
    for edge in &found.edges {
        for node in edge.ends.iter().flat_map(|&(from, to)| [from, to]) {
            met[node.0 as usize].extend([edge.left, edge.right]);
        }
    }
    let seen = |edge: &Boundary| {
        let ends = edge.ends.iter().flat_map(|&(from, to)| [from, to]);
        (BTreeSet::from([edge.left, edge.right]), ends.map(|node| met[node.0 as usize].clone()).collect())
    };
    let mut curves: BTreeMap<Seen, Vec<Vec<Spot>>> = BTreeMap::new();
    for edge in found.edges.iter().filter(|edge| !edge.is_border()) {
        curves.entry(seen(edge)).or_default().push(points(edge));
    }
    curves
}

/// How far the curves of two pictures are apart where both see the same, with the place; and how
/// much of the length that is.
///
/// Within a pixel of the border nothing is compared: a boundary that runs along it leaves the board
/// where a picture sees it so.
fn compare(coarse: &Boundaries, fine: &Boundaries, pitch: i64) -> (f64, Spot, f64) {
    let border = coarse.edges.iter().filter(|edge| edge.is_border()).map(points).collect::<Vec<_>>();
    let pixel = Nm::new(pitch).to_f64();
    let (one, other) = (curves(coarse), curves(fine));
    let length = |curves: &[Vec<Spot>]| {
        let chords = curves.iter().flat_map(|curve| curve.windows(2));
        chords.map(|chord| polyline::to_chord(chord[0], chord[1], chord[1])).sum::<f64>()
    };
    let all: f64 = one.values().map(|curves| length(curves)).sum();
    let same: Vec<_> = one
        .iter()
        .filter_map(|(seen, curves)| {
            Some((curves, other.get(seen).filter(|others| others.len() == curves.len())?))
        })
        .collect();
    let compared: f64 = same.iter().map(|(curves, _)| length(curves)).sum();
    let places = same.par_iter().flat_map_iter(|(curves, others)| {
        let points = curves.iter().flat_map(|curve| polyline::points(curve, 50_000.0));
        points.map(|p| (polyline::distance(p, others), p))
    });
    let places = places.filter(|(off, p)| *off <= APART || polyline::distance(*p, &border) > pixel);
    let (off, at) = places.reduce(|| (0.0, [0.0; 2]), |a, b| if b.0 > a.0 { b } else { a });
    (off, at, compared / all)
}

#[test]
fn a_board_has_the_same_paths_at_any_resolution() {
    let mut wrong = Vec::new();
    for Layer { name, copper, outline } in real_boards::layers(FEATURES_UNOPTIMISED) {
        let nets = topology::recover(&copper, Method::Contact);
        if nets.nets().len() < 2 {
            continue;
        }
        let found = PITCHES.map(|pitch| {
            let settings = Settings { pitch: Nm::new(pitch), ..Settings::default() };
            Diagram::new(&copper, &nets, outline.as_ref(), &settings).expect("a diagram").traced().0
        });
        for (coarse, pitch) in found.iter().zip(PITCHES).take(3) {
            let (off, at, part) = compare(coarse, &found[3], pitch);
            println!(
                "{name}: {off:.0} nm apart with pixels of {pitch} nm and 12700 nm, {:.1} % compared",
                part * 100.0
            );
            if off > APART {
                wrong.push(format!("{name}: {off:.0} nm apart with pixels of {pitch} nm at {at:.0?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
