//! What comes near a shape, for shapes that are asked about many times.

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::board::{Copper, Shape};
use crate::geometry::{Nm, Point, Rect, RectIndex};

use super::contact::{Bodies, Body};
use super::density::Density;
use super::stretches::{pieces, stretches};

/// Shapes made ready to be asked what comes near another.
#[derive(Debug)]
pub struct Proximity {
    bodies: Bodies,
    /// Where some are long.
    close: Option<Close>,
}

/// The rectangles that hold shapes closely.
#[derive(Debug)]
struct Close {
    index: RectIndex,
    /// Whose they are, in order.
    owners: Vec<usize>,
    /// Where there are many.
    density: Option<Density>,
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
        let shapes = copper.features.iter().map(|feature| &feature.shape);
        Self { bodies: Bodies::new(copper), close: close(shapes) }
    }

    /// The same of shapes that are no copper.
    #[must_use]
    pub fn of(shapes: &[Shape]) -> Self {
        Self { bodies: Bodies::of(shapes.par_iter()), close: close(shapes.iter()) }
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
        let bounds = body.bounds();
        let mut found = Vec::new();
        let mut look = |feature: usize| {
            let place = body.narrowest(&self.bodies.bodies[feature], reach);
            found.extend(place.map(|place| Near { feature, width: place.width, at: place.at }));
        };
        let long = stretches(shape);
        let rects = long.as_deref().unwrap_or(std::slice::from_ref(&bounds));
        if long.is_none() && self.close.is_none() {
            let _ = self.bodies.index.visit(bounds.inflate(reach), |feature| {
                if wanted(feature) {
                    look(feature);
                }
                ControlFlow::Continue(())
            });
        } else {
            self.candidates(rects, reach).into_iter().filter(|feature| wanted(*feature)).for_each(look);
        }
        found.sort_unstable_by_key(|near| near.feature);
        found
    }

    /// Whether a feature within `reach` of `shape`, of those whose index is `asked`, is `wanted`:
    /// looks no further than the first.
    #[must_use]
    pub fn any(
        &self,
        shape: &Shape,
        reach: Nm,
        asked: impl Fn(usize) -> bool,
        wanted: impl Fn(&Near) -> bool,
    ) -> bool {
        let body = Body::new(shape);
        let (index, owners) = self.index();
        let visited = index.visit(body.bounds().inflate(reach), |number| {
            let feature = owners.map_or(number, |owners| owners[number]);
            if !asked(feature) {
                return ControlFlow::Continue(());
            }
            let place = body.narrowest(&self.bodies.bodies[feature], reach);
            match place.map(|place| Near { feature, width: place.width, at: place.at }) {
                Some(near) if wanted(&near) => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        });
        visited.is_break()
    }

    /// One of the features, where it is within `reach` of `shape`.
    #[must_use]
    pub fn near_one(&self, shape: &Shape, reach: Nm, feature: usize) -> Option<Near> {
        let place = Body::new(shape).narrowest(&self.bodies.bodies[feature], reach)?;
        Some(Near { feature, width: place.width, at: place.at })
    }

    /// What is asked for features near a place, and whose its rectangles are, where they are not
    /// one for each.
    fn index(&self) -> (&RectIndex, Option<&[usize]>) {
        match &self.close {
            Some(close) => (&close.index, Some(&close.owners)),
            None => (&self.bodies.index, None),
        }
    }

    /// The features that may be within `reach` of what these rectangles hold, in order.
    fn candidates(&self, rects: &[Rect], reach: Nm) -> Vec<usize> {
        let mut candidates = Vec::new();
        for rect in rects {
            let (index, owner) = self.index();
            let _ = index.visit(rect.inflate(reach), |number| {
                candidates.push(owner.map_or(number, |owners| owners[number]));
                ControlFlow::Continue(())
            });
        }
        candidates.sort_unstable();
        candidates.dedup();
        candidates
    }

    /// The indices of all features, neighbours close to each other: where there are many, memory is
    /// read several times as fast by who asks about all of them in this order.
    #[must_use]
    pub fn order(&self) -> Vec<usize> {
        match self.index() {
            (index, None) => index.order(),
            (index, Some(owners)) => {
                let is_first = |&number: &usize| number == 0 || owners[number - 1] != owners[number];
                index.order().into_iter().filter(is_first).map(|number| owners[number]).collect()
            }
        }
    }

    /// How many features, stretches of long ones each, may be within `reach` of `shape`; counts no
    /// further than `most`.
    #[must_use]
    pub fn count(&self, shape: &Shape, reach: Nm, most: usize) -> usize {
        let (long, bounds) = (stretches(shape), shape.bounds());
        let rects = long.as_deref().unwrap_or(std::slice::from_ref(&bounds));
        rects.iter().fold(0, |count, rect| count + self.count_in(rect.inflate(reach), most - count))
    }

    /// Whether so many features, stretches of long ones each, may be within `reach` of `shape`, or
    /// of one stretch of it if it is long.
    #[must_use]
    pub fn is_crowded(&self, shape: &Shape, reach: Nm, most: usize) -> bool {
        let (long, bounds) = (pieces(shape), shape.bounds());
        let rects = long.as_deref().unwrap_or(std::slice::from_ref(&bounds));
        rects.iter().any(|rect| self.count_in(rect.inflate(reach), most) >= most)
    }

    /// How many features, stretches of long ones each, may reach into `rect`; counts no further
    /// than `most`.
    fn count_in(&self, rect: Rect, most: usize) -> usize {
        let density = self.close.as_ref().and_then(|close| close.density.as_ref());
        if most == 0 || density.is_some_and(|density| density.least(rect) >= most) {
            return most;
        }
        let mut count = 0;
        let _ = self.index().0.visit(rect, |_| {
            count += 1;
            if count < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        count
    }
}

/// Rectangles that hold shapes closely, and whose they are; none where their bounds do.
fn close<'a>(shapes: impl Iterator<Item = &'a Shape> + Clone) -> Option<Close> {
    if shapes.clone().all(|shape| stretches(shape).is_none()) {
        return None;
    }
    let (mut all, mut owners) = (Vec::new(), Vec::new());
    for (number, shape) in shapes.enumerate() {
        match stretches(shape) {
            Some(rects) => all.extend(rects),
            None => all.push(shape.bounds()),
        }
        owners.resize(all.len(), number);
    }
    let density = Density::new(&all);
    Some(Close { index: RectIndex::new(all.into_iter()), owners, density })
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
