//! How much copper each net has, and how long its edge is.

use rayon::prelude::*;
use rustc_hash::FxHashSet;

use crate::board::{Copper, Shape, polarity};
use crate::geometry::{Nm, Polygon};

use super::{Net, Nets};

/// The size of a net's copper.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// Its area, in square nanometres.
    pub area: f64,
    /// The length of its edge, that of holes in it included, in nanometres.
    pub perimeter: f64,
    /// How many pieces it has, less its holes: so many times 2πr is a loop at the distance r longer
    /// than the edge, as long as it meets nothing (Steiner's formula).
    pub turns: f64,
}

impl Extent {
    /// How wide the copper is on average: what a long strip of this area and perimeter is.
    #[must_use]
    pub fn mean_width(&self) -> f64 {
        if self.perimeter > 0.0 { 2.0 * self.area / self.perimeter } else { 0.0 }
    }

    /// The length of loops round it at the distance `radius`, in nanometres.
    #[must_use]
    pub fn loop_length(&self, radius: Nm) -> f64 {
        self.perimeter + 2.0 * std::f64::consts::PI * radius.to_f64() * self.turns
    }
}

/// How far chords may leave the arcs of the copper. Chosen: a disc of half a millimetre then has a
/// perimeter right to one part in a thousand.
const CHORDS: Nm = Nm::from_um(2);

/// Features that are joined at a time, so that not all of a large net's are polygons at once.
/// Chosen.
const PART: usize = 1024;

/// The size of each net's copper, by number. Features that overlap count once,
/// but for those of thousands that cross each other so often that no boolean is tried.
#[must_use]
pub fn extents(copper: &Copper, nets: &Nets) -> Vec<Extent> {
    nets.nets().par_iter().map(|net| extent(copper, net)).collect()
}

fn extent(copper: &Copper, net: &Net) -> Extent {
    // What is drawn a million times in one place counts once.
    let mut seen = FxHashSet::default();
    let shapes = net.features.iter().map(|&feature| &copper.features[feature as usize].shape);
    let shapes: Vec<&Shape> = shapes.filter(|&shape| seen.insert(shape)).collect();
    let joined = |polygons: Vec<Polygon>| {
        let contours = polygons.iter().flat_map(Polygon::contours);
        let is_easy = polygons.len() > 1 && !polarity::is_tangled(contours);
        if is_easy { polarity::union(&polygons) } else { polygons }
    };
    let polygons = |shapes: &[&Shape]| shapes.iter().filter_map(|shape| shape.polygon(CHORDS)).collect();
    let mut parts: Vec<Vec<Polygon>> = shapes.chunks(PART).map(|part| joined(polygons(part))).collect();
    let pieces = if parts.len() > 1 { joined(parts.concat()) } else { parts.pop().unwrap_or_default() };
    pieces.iter().fold(Extent::default(), |sum, piece| {
        let holes = u32::try_from(piece.contours().len() - 1).unwrap_or(u32::MAX);
        Extent {
            area: sum.area + piece.area_mm2() * 1e12,
            perimeter: sum.perimeter + piece.perimeter(),
            turns: sum.turns + 1.0 - f64::from(holes),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::{Attributes, Axis, Feature, Side};
    use crate::geometry::Point;
    use crate::topology::{Method, recover};

    #[test]
    fn overlapping_strokes_count_once() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let stroke = |from: Point, to: Point| Feature {
            axis: Axis::Line(from, to),
            shape: Shape::Stroke { from, to, radius: Nm::from_um(500) },
            attributes: 0,
            line: 1,
        };
        // Many times over, which must not take longer.
        let mut features = vec![stroke(at(0, 0), at(6000, 0)); 500];
        features.push(stroke(at(4000, 0), at(10_000, 0)));
        let copper = Copper { side: Side::Front, features, attributes: vec![Attributes::default()] };
        let [extent] = extents(&copper, &recover(&copper, Method::Contact))[..] else { panic!("one net") };
        // A stadium of 10 mm between the middles of its ends, 1 mm wide.
        let (area, perimeter) = (10.0 + std::f64::consts::PI / 4.0, 20.0 + std::f64::consts::PI);
        assert!((extent.area / 1e12 / area - 1.0).abs() < 2e-3, "{extent:?}");
        assert!((extent.perimeter / 1e6 / perimeter - 1.0).abs() < 1e-3, "{extent:?}");
        let grown = 20.0 + std::f64::consts::PI * 1.2;
        assert!((extent.loop_length(Nm::from_um(100)) / 1e6 / grown - 1.0).abs() < 1e-3, "{extent:?}");
        assert!((extent.mean_width() / 1e6 - 0.93).abs() < 0.02, "{extent:?}");
    }
}
