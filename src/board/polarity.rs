//! What clear polarity leaves of the copper, and exact polygon booleans.

use crate::geometry::{Polygon, Rect, RectIndex};

pub(crate) use super::boolean::of_circles;
pub use super::boolean::{
    FillRule, clean, common, difference, effort, filled, intersection, is_tangled, offset, remainder, union,
};

use super::boolean::Tangle;
use super::{FLATTEN, Feature, Shape};

/// Whether an object adds copper or takes away what was drawn before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Polarity {
    /// Adds copper.
    #[default]
    Dark,
    /// Erases the copper under it.
    Clear,
}

impl Polarity {
    /// The other one.
    #[must_use]
    pub const fn toggled(self) -> Self {
        match self {
            Self::Dark => Self::Clear,
            Self::Clear => Self::Dark,
        }
    }
}

/// The most vertices that erasing may take in, all features together, eight crossings that may be
/// counting as one. Chosen: below ten seconds of work; a plane from which ten thousand rings are
/// erased takes in a million.
pub const EFFORT: u64 = 8_000_000;

/// Why the copper of a sequence of objects cannot be worked out in reasonable time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("clear objects (LPC) overlap too much: more than {EFFORT} vertices, or too many crossings")]
pub struct TooMuch;

/// The copper that a sequence of objects leaves: every dark one less all clear ones after it.
///
/// A feature that nothing touches keeps its shape; of the others each connected piece is a polygon
/// of its own, with the axis, attributes and line of the feature it was cut from. So the work grows
/// with what is erased, and a layer without clear objects costs nothing.
///
/// # Errors
///
/// [`TooMuch`] for objects made to keep a program busy, such as thousands of planes with thousands
/// of holes each.
pub fn resolve(objects: Vec<(Feature, Polarity)>) -> Result<Vec<Feature>, TooMuch> {
    let clear: Vec<(usize, Polygon)> = objects
        .iter()
        .enumerate()
        .filter(|(_, (_, polarity))| *polarity == Polarity::Clear)
        .filter_map(|(at, (feature, _))| Some((at, feature.shape.polygon(FLATTEN)?)))
        .collect();
    if clear.is_empty() {
        return Ok(dark(objects).map(|(_, feature)| feature).collect());
    }
    let clears: Vec<Clear<'_>> = clear.iter().map(|(_, polygon)| Clear::new(polygon)).collect();
    let index = RectIndex::new(clears.iter().map(|clear| clear.bounds));
    // All is counted before anything is erased: the cheap count first.
    let mut left = Vec::with_capacity(objects.len());
    let mut cut: Vec<(Feature, Vec<usize>)> = Vec::with_capacity(objects.len());
    let mut vertices = 0;
    for (at, feature) in dark(objects) {
        let mut over = index.touching(feature.shape.bounds());
        over.retain(|&i| clear[i].0 > at && may_reach(&feature.shape, clears[i].bounds));
        vertices += over.iter().map(|&i| clears[i].weight(feature.shape.bounds())).sum::<u64>();
        if vertices > EFFORT {
            return Err(TooMuch);
        }
        cut.push((feature, over));
    }
    let mut effort = vertices;
    // Features one after another often lie under the same clear objects.
    for same in cut.chunk_by(|(_, a), (_, b)| a == b) {
        let tangle = Tangle::of(clips(&clear, &same[0].1).flat_map(Polygon::contours));
        effort += tangle.crowd() * same.len() as u64;
        if effort > EFFORT || tangle.is_too_much() {
            return Err(TooMuch);
        }
    }
    for (feature, over) in cut {
        erase(feature, clips(&clear, &over), &mut left);
    }
    Ok(left)
}

/// A clear object as it is counted.
struct Clear<'a> {
    polygon: &'a Polygon,
    bounds: Rect,
    vertices: u64,
}

impl<'a> Clear<'a> {
    fn new(polygon: &'a Polygon) -> Self {
        let vertices = polygon.contours().iter().map(|ring| ring.len() as u64).sum();
        Self { polygon, bounds: polygon.bounds(), vertices }
    }

    /// How many vertices of it an object with such bounds takes in, those that lie beside it
    /// counting for less.
    fn weight(&self, bounds: Rect) -> u64 {
        /// Vertices of fewer are all counted. Chosen: no fewer are worth looking at one by one.
        const MANY: u64 = 64;
        /// What a vertex beside the object costs: measured, 0.13 µs for 1 µs of one at it.
        const BESIDE: u64 = 8;
        if self.vertices < MANY || bounds.encloses(self.bounds) {
            return self.vertices;
        }
        let points = self.polygon.contours().iter().flatten();
        let within = points.filter(|&&p| bounds.contains(p)).count() as u64;
        within + (self.vertices - within) / BESIDE
    }
}

/// Whether a shape may reach what lies within `bounds`, which its own touch: a stroke aslant has
/// most of its own empty.
fn may_reach(shape: &Shape, bounds: Rect) -> bool {
    let Shape::Stroke { from, to, radius } = shape else { return true };
    let way = *to - *from;
    // Across the stroke, both have an extent.
    let (x, y) = (way.x.to_f64().abs(), way.y.to_f64().abs());
    let [offset, opposite] = [bounds.min(), bounds.max()].map(|p| p - *from);
    let middle = (offset.x + opposite.x, offset.y + opposite.y);
    let off = (way.x.to_f64() * middle.1.to_f64() - way.y.to_f64() * middle.0.to_f64()).abs() / 2.0;
    let reach = (y * bounds.width().to_f64() + x * bounds.height().to_f64()) / 2.0;
    // A nanometre more than any rounding.
    off <= reach + (radius.to_f64() + 1.0) * (x + y)
}

/// The dark objects with their places in the sequence.
fn dark(objects: Vec<(Feature, Polarity)>) -> impl Iterator<Item = (usize, Feature)> {
    let dark = |(at, (feature, polarity))| (polarity == Polarity::Dark).then_some((at, feature));
    objects.into_iter().enumerate().filter_map(dark)
}

/// The polygons of the clear objects `over` a feature.
fn clips<'a>(
    clear: &'a [(usize, Polygon)],
    over: &'a [usize],
) -> impl ExactSizeIterator<Item = &'a Polygon> + Clone {
    over.iter().map(|&i| &clear[i].1)
}

/// What `clear` leaves of `feature`, appended to `left`.
fn erase<'a>(feature: Feature, clear: impl ExactSizeIterator<Item = &'a Polygon>, left: &mut Vec<Feature>) {
    if clear.len() == 0 {
        left.push(feature);
        return;
    }
    // A bare line has no area, so there is nothing to erase.
    let Some(whole) = feature.shape.polygon(FLATTEN) else {
        left.push(feature);
        return;
    };
    let pieces = difference(&whole, clear);
    if let [piece] = pieces.as_slice()
        && piece.twice_area() == whole.twice_area()
    {
        left.push(feature);
        return;
    }
    left.extend(pieces.into_iter().map(|piece| Feature { shape: Shape::Polygon(piece), ..feature.clone() }));
}

#[cfg(test)]
mod tests {
    use super::super::Axis;
    use super::*;
    use crate::geometry::{Nm, Point, Vector, off_segment};
    use crate::topology::random;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    fn square(low: i64, high: i64) -> Polygon {
        Polygon::rectangle(Rect::new(at(low, low), at(high, high)))
    }

    fn object(polygon: Polygon, polarity: Polarity) -> (Feature, Polarity) {
        (Feature { shape: Shape::Polygon(polygon), axis: Axis::Region, attributes: 0, line: 1 }, polarity)
    }

    fn area(features: &[Feature]) -> f64 {
        let polygon = |feature: &Feature| feature.shape.polygon(FLATTEN).map_or(0.0, |p| p.area_mm2());
        features.iter().map(polygon).sum()
    }

    #[test]
    fn a_clear_object_erases_what_came_before_it_only() {
        let left = resolve(vec![
            object(square(0, 10), Polarity::Dark),
            object(square(2, 8), Polarity::Clear),
            object(square(4, 6), Polarity::Dark),
        ])
        .expect("little work");
        assert_eq!(left.len(), 2, "a ring and a square in it");
        assert!((area(&left) - 68e-6).abs() < 1e-15, "area {}", area(&left));
    }

    #[test]
    fn what_nothing_touches_keeps_its_shape() {
        let stroke = Feature {
            shape: Shape::Stroke { from: at(0, 0), to: at(10, 10), radius: Nm::from_um(1) },
            axis: Axis::Line(at(0, 0), at(10, 10)),
            attributes: 0,
            line: 1,
        };
        // In the rectangle round the stroke, but not on the stroke.
        let clear = object(Polygon::rectangle(Rect::new(at(7, 0), at(10, 3))), Polarity::Clear);
        let left = resolve(vec![(stroke.clone(), Polarity::Dark), clear]).expect("little work");
        assert_eq!(left, vec![stroke], "still a stroke");
    }

    #[test]
    fn a_cut_in_becomes_a_hole() {
        let outline = [(0, 5), (0, 0), (10, 0), (10, 10), (0, 10), (0, 5), (3, 5)];
        let hole = [(3, 7), (7, 7), (7, 3), (3, 3), (3, 5)];
        let ring: Vec<Point> = outline.iter().chain(&hole).map(|&(x, y)| at(x, y)).collect();
        let pieces = clean(&[ring]);
        assert_eq!(pieces.len(), 1, "one piece");
        assert_eq!(pieces[0].contours().len(), 2, "an outer contour and a hole");
        assert!((pieces[0].area_mm2() - 84e-6).abs() < 1e-15, "area {}", pieces[0].area_mm2());
    }

    #[test]
    fn a_zigzag_is_tangled_and_a_plane_is_not() {
        let zigzag: Vec<Point> = (0..20_000).map(|i| at(i % 2 * 100_000, i * 7919 % 100_003)).collect();
        assert!(is_tangled([&zigzag].into_iter()), "all cross all");
        let circle = Polygon::disc(at(0, 0), Nm::from_mm(900), Nm::new(10)).expect("a circle");
        assert!(circle.contours()[0].len() > 5_000, "enough points to be looked at");
        assert!(!is_tangled(circle.contours().iter()), "no crossing at all");
    }

    #[test]
    fn growing_rounds_the_corners() {
        let grown = offset(&square(0, 1000), Nm::from_um(100), Nm::new(100));
        let expected = 1.0 + 4.0 * 0.1 + std::f64::consts::PI * 0.01;
        assert!((grown[0].area_mm2() - expected).abs() < 1e-4, "area {}", grown[0].area_mm2());
        assert!(offset(&square(0, 1000), Nm::from_um(-500), Nm::new(100)).is_empty(), "nothing is left");
    }

    /// A cutter that goes round a board along it would cut into the board where it is nearer.
    #[test]
    fn what_is_grown_is_as_far_away_everywhere() {
        let mut random = random();
        for case in 0..4000 {
            // Turned squares with a corner on each side that is all but straight.
            let (x, y) = (Nm::new(1_000_000 + random(4_000_000)), Nm::new(random(4_000_000)));
            let corners =
                [(Nm::ZERO, Nm::ZERO), (x, y), (x - y, x + y), (-y, x)].map(|(x, y)| Point::new(x, y));
            let part = 10 + random(80);
            let ring: Vec<Point> = (0..4)
                .flat_map(|i| {
                    let way = corners[(i + 1) % 4] - corners[i];
                    let mut step = |length: Nm| Nm::new(length.get() * part / 100 + random(3) - 1);
                    [corners[i], corners[i] + Vector::new(step(way.x), step(way.y))]
                })
                .collect();
            let by = Nm::new(50_000 + random(900_000));
            let square = Polygon::new(vec![ring]).expect("a square");
            let edges: Vec<_> = square.edges().map(|(a, b)| (a.to_f64(), b.to_f64())).collect();
            for by in [by, -by] {
                let wanted = by.abs().to_f64();
                let grown = offset(&square, by, Nm::new(250));
                for p in grown.iter().flat_map(Polygon::contours).flatten() {
                    let off = edges.iter().map(|&(a, b)| {
                        let (x, y) = off_segment(p.to_f64(), a, b);
                        libm::hypot(x, y)
                    });
                    let off = off.fold(f64::INFINITY, f64::min);
                    assert!((off - wanted).abs() < 400.0, "case {case}, {by:?}: {p:?} is {off} away");
                }
            }
        }
    }
}
