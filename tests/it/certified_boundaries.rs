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

/// Unoptimised, boards with more features are left out: a picture takes its time.
const FEATURES_UNOPTIMISED: usize = 600;

/// The nodes of one that the other has not.
fn alone(one: &Boundaries, other: &Boundaries) -> Vec<Point> {
    let near = |node: &Point| other.nodes.iter().any(|known| known.distance(*node) <= NEAR);
    one.nodes.iter().filter(|node| !near(node)).copied().collect()
}

/// A layer's diagram with pixels that see its gaps.
fn diagram(layer: &Layer, nets: &Nets, pitch: Option<Nm>) -> Diagram {
    let gap = topology::smallest_gap(&layer.copper, nets);
    let least = || gap.map_or(Nm::from_um(50), |gap| gap.width / 3).clamp(Nm::from_um(5), Nm::from_um(50));
    let settings = Settings { pitch: pitch.unwrap_or_else(least), ..Settings::default() };
    Diagram::new(&layer.copper, nets, layer.outline.as_ref(), &settings).expect("a diagram")
}

#[test]
fn every_side_has_the_boundaries_that_a_picture_shows() {
    let mut wrong = Vec::new();
    for layer in real_boards::layers(FEATURES_UNOPTIMISED) {
        let nets = topology::recover(&layer.copper, Method::Contact);
        let diagram = diagram(&layer, &nets, None);
        assert_eq!(diagram.faults(), [], "{}: every edge finds its end", layer.name);
        let (found, (shown, _)) = (diagram.boundaries().0, diagram.traced());
        let off = found.length() / shown.length().max(1.0) - 1.0;
        let (more, fewer) = (alone(&found, &shown), alone(&shown, &found));
        println!("{}: {:.3} mm, {off:+.1e}, {} nodes", layer.name, found.length() / 1e6, found.nodes.len());
        if nets.nets().len() > 1 && (off.abs() > LENGTH || !more.is_empty() || !fewer.is_empty()) {
            wrong.push(format!("{}: {off:+.1e}, nodes {more:?} more, {fewer:?} fewer", layer.name));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn boundaries_are_the_same_at_any_pixel() {
    for layer in real_boards::layers(FEATURES_UNOPTIMISED) {
        let nets = topology::recover(&layer.copper, Method::Contact);
        let [fine, middle, coarse] = [5, 20, 100].map(|um| {
            let diagram = diagram(&layer, &nets, Some(Nm::from_um(um)));
            diagram.boundaries().0
        });
        assert_eq!(fine, middle, "{}: pixels of 5 and 20 µm", layer.name);
        assert_eq!(middle, coarse, "{}: pixels of 20 and 100 µm", layer.name);
    }
}
