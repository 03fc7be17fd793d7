//! The boundaries of the certified diagram beside those that are traced in a picture, and at any
//! pixel.

use voromill::geometry::{Nm, Point};
use voromill::topology::{self, Method, Nets};
use voromill::voronoi::{Boundaries, Diagram, Settings};

use crate::real_boards::{self, Layer};

/// Nodes without a counterpart nearer than this are alone, in nanometres.
const NEAR: f64 = 5_000.0;

/// How much the lengths may differ: a picture's curves are fitted where it sees them.
const LENGTH: f64 = 1e-4;

/// The same of loops: where two come apart, a picture shows it to a pixel. Chosen: twice what the
/// layer of the most such places has.
const LENGTH_OF_LOOPS: f64 = 4e-3;

/// Unoptimised, boards with more features are left out: a picture takes its time.
const FEATURES_UNOPTIMISED: usize = 600;

/// The nodes of one that the other has not.
fn alone(one: &Boundaries, other: &Boundaries) -> Vec<Point> {
    let near = |node: &Point| other.nodes.iter().any(|known| known.distance(*node) <= NEAR);
    one.nodes.iter().filter(|node| !near(node)).copied().collect()
}

/// A layer's diagram with pixels that see its gaps.
fn diagram(layer: &Layer, nets: &Nets, pitch: Option<Nm>, limit: Option<Nm>) -> Diagram {
    let gap = topology::smallest_gap(&layer.copper, nets);
    let least = || gap.map_or(Nm::from_um(50), |gap| gap.width / 3).clamp(Nm::from_um(5), Nm::from_um(50));
    let pitch = pitch.unwrap_or_else(least);
    let settings = Settings { pitch, limit, ..Settings::default() };
    Diagram::new(&layer.copper, nets, layer.outline.as_ref(), &settings).expect("a diagram")
}

/// What is wrong with the boundaries of a layer beside those that a picture shows.
fn difference(layer: &Layer, limit: Option<Nm>) -> Option<String> {
    let nets = topology::recover(&layer.copper, Method::Contact);
    let diagram = diagram(layer, &nets, None, limit);
    if limit.is_some() && !diagram.faults().is_empty() {
        return None;
    }
    assert_eq!(diagram.faults(), [], "{}: every edge finds its end", layer.name);
    let (found, (shown, _)) = (diagram.boundaries().0, diagram.traced());
    let off = found.length() / shown.length().max(1.0) - 1.0;
    let (more, fewer) = (alone(&found, &shown), alone(&shown, &found));
    let differs = match limit {
        None => off.abs() > LENGTH || !more.is_empty() || !fewer.is_empty(),
        // Where loops come apart a pixel decides what a picture shows.
        Some(_) => off.abs() > LENGTH_OF_LOOPS,
    };
    (differs && nets.nets().len() > 1)
        .then(|| format!("{}: {off:+.1e}, nodes {more:?} more, {fewer:?} fewer", layer.name))
}

#[test]
fn every_side_has_the_boundaries_that_a_picture_shows() {
    let layers = real_boards::layers(FEATURES_UNOPTIMISED);
    let wrong: Vec<_> = layers.filter_map(|layer| difference(&layer, None)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// At half the width of no gap, for there loops touch and a nanometre decides.
#[test]
fn every_side_has_the_loops_that_a_picture_shows() {
    let layers = real_boards::layers(FEATURES_UNOPTIMISED);
    let wrong: Vec<_> = layers.filter_map(|layer| difference(&layer, Some(Nm::new(237_300)))).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn boundaries_are_the_same_at_any_pixel() {
    for layer in real_boards::layers(FEATURES_UNOPTIMISED) {
        let nets = topology::recover(&layer.copper, Method::Contact);
        let [fine, middle, coarse] = [5, 20, 100].map(|um| {
            let diagram = diagram(&layer, &nets, Some(Nm::from_um(um)), None);
            diagram.boundaries().0
        });
        assert_eq!(fine, middle, "{}: pixels of 5 and 20 µm", layer.name);
        assert_eq!(middle, coarse, "{}: pixels of 20 and 100 µm", layer.name);
    }
}
