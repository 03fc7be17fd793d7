//! What comes near a shape, for shapes that are asked about many times.

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::board::{Copper, Shape};
use crate::geometry::{Nm, Point};

use super::contact::{Bodies, Body, Scratch};

/// Shapes made ready to be asked what comes near another.
#[derive(Debug)]
pub struct Proximity {
    bodies: Bodies,
}

/// A feature near a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// The index of the feature or shape.
    pub feature: usize,
    /// The distance between the two in nanometres, zero where they touch.
    pub width: f64,
    /// The middle between them; where they touch, a point of both.
    pub at: Point,
}

impl Proximity {
    /// The features of `copper` by place.
    #[must_use]
    pub fn new(copper: &Copper) -> Self {
        Self { bodies: Bodies::new(copper) }
    }

    /// The same of shapes that are no copper.
    #[must_use]
    pub fn of(shapes: &[Shape]) -> Self {
        Self { bodies: Bodies::of(shapes.par_iter()) }
    }

    /// Every feature within `reach` of `shape`, by its index.
    #[must_use]
    pub fn near(&self, shape: &Shape, reach: Nm) -> Vec<Near> {
        self.near_of(shape, reach, |_| true)
    }

    /// The same of the features whose index is `wanted`.
    #[must_use]
    pub fn near_of(&self, shape: &Shape, reach: Nm, wanted: impl Fn(usize) -> bool) -> Vec<Near> {
        let body = Body::new(shape);
        let (mut found, mut scratch) = (Vec::new(), Scratch::default());
        let _ = self.bodies.index.visit(body.bounds().inflate(reach), &mut Vec::new(), |feature| {
            if !wanted(feature) {
                return ControlFlow::Continue(());
            }
            let place = body.narrowest(&self.bodies.bodies[feature], reach, &mut scratch);
            found.extend(place.map(|place| Near { feature, width: place.width, at: place.at }));
            ControlFlow::Continue(())
        });
        found.sort_unstable_by_key(|near| near.feature);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::{Axis, Feature, Side};
    use crate::geometry::{Arc, Turn};

    #[test]
    fn an_arc_whose_radius_changes_is_where_it_runs() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let arc =
            Arc { start: at(1340, 0), end: at(0, 1380), center: at(0, 0), turn: Turn::CounterClockwise };
        let shape = Shape::Arc { arc, radius: Nm::from_um(100) };
        let feature = Feature { shape, axis: Axis::Region, attributes: 0, line: 0 };
        let copper =
            Copper { side: Side::Front, features: vec![feature], attributes: vec![Default::default()] };
        let proximity = Proximity::new(&copper);
        for fraction in [0.1, 0.5, 0.9] {
            let (x, y) = arc.at(fraction);
            let outwards = 1.0 + 150_000.0 / (x * x + y * y).sqrt();
            let spot = Point::from_f64(x * outwards, y * outwards);
            let near = proximity.near(&Shape::Disc { center: spot, radius: Nm::ZERO }, Nm::from_um(100));
            let width = near.first().map(|near| near.width).expect("it is near");
            assert!((width - 50_000.0).abs() < 1_000.0, "50 µm from it at {fraction}: {width} nm");
        }
    }
}
