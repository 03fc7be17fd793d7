use std::ops::ControlFlow;

use crate::board::{Copper, Shape};
use crate::geometry::{Nm, Point};

use super::contact::{Bodies, Body, Scratch};

/// Copper made ready to be asked what comes near a shape that is no part of it.
#[derive(Debug)]
pub struct Proximity {
    bodies: Bodies,
}

/// A feature near a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// The index of the feature.
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
