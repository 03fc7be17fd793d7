//! Bare segments as copper without width, for what compares with a diagram of segments.

use voromill::board::{Attributes, Axis, Copper, Feature, Shape, Side};
use voromill::geometry::{Nm, Point};

/// A bare segment in nanometres: x, y, x, y.
pub(crate) type Bare = [i32; 4];

/// Each a feature.
pub(crate) fn copper(segments: &[Bare]) -> Copper {
    let at = |x: i32, y: i32| Point::new(Nm::new(i64::from(x)), Nm::new(i64::from(y)));
    let feature = |&[ax, ay, bx, by]: &Bare| {
        let (from, to) = (at(ax, ay), at(bx, by));
        let shape = Shape::Stroke { from, to, radius: Nm::ZERO };
        Feature { axis: Axis::Line(from, to), shape, attributes: 0, line: 0 }
    };
    let features = segments.iter().map(feature).collect();
    Copper { side: Side::Front, features, attributes: vec![Attributes::default()] }
}
