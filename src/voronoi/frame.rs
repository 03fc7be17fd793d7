//! What boundaries run out to where no outline is known: a lap round the copper.
//!
//! ```text
//!      ╭──────────╮        The shortest lap that keeps its distance is the hull of the copper at that distance. Its round
//!     ╱ ▐█▌    ▐██ ╲       corners are those of octagons here: lines alone, at most a twentieth of a corner's radius
//!     │   ▐████▌   │       farther out, and never nearer.
//!      ╲      ▐█▌ ╱
//!       ╰────────╯
//! ```
//!
//! Beside the rectangle that pcb2gcode and the paper's program cut round the same copper it is
//! shorter wherever a corner has none, and so are the boundaries that reach it.

use crate::board::{Copper, Shape};
use crate::geometry::{Nm, Point, Polygon, Rect, Vector};

/// The lap round copper without an outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// A rectangle, so far from the copper.
    Rectangle(Nm),
    /// The copper's convex hull, so far from it.
    Hull(Nm),
}

impl Frame {
    /// How far it keeps from the copper.
    #[must_use]
    pub const fn margin(self) -> Nm {
        match self {
            Self::Rectangle(margin) | Self::Hull(margin) => margin,
        }
    }

    /// What it encloses of `copper`, which lies within `bounds`.
    pub(super) fn enclose(self, copper: &Copper, bounds: Rect) -> Polygon {
        let rectangle = || Polygon::rectangle(bounds.inflate(self.margin()));
        match self {
            Self::Rectangle(_) => rectangle(),
            Self::Hull(margin) => hull(copper, margin).unwrap_or_else(rectangle),
        }
    }
}

/// The hull of octagons round all that sticks out of `copper`; none where that has no area.
fn hull(copper: &Copper, margin: Nm) -> Option<Polygon> {
    let shapes = || copper.features.iter().map(|feature| &feature.shape);
    // What lies within the hull of some of its points need not be looked at: nearly all (Akl and
    // Toussaint 1978).
    let far =
        |way: &Vector| shapes().map(Shape::anchor).max_by_key(|&p| ((p - Point::default()).dot(*way), p));
    let extreme: Vec<Point> = octagon(Nm::from_mm(1)).iter().filter_map(far).collect();
    let inner = Polygon::hull(extreme.iter().copied());
    let lies_within = |rect: Rect| {
        inner.as_ref().is_some_and(|inner| rect.corners().into_iter().all(|corner| inner.contains(corner)))
    };
    let sticks_out = shapes().filter(|shape| !lies_within(shape.bounds()));
    let discs = sticks_out.flat_map(corners).chain(extreme.into_iter().map(|p| (p, Nm::ZERO)));
    Polygon::hull(discs.flat_map(|(center, radius)| octagon(radius + margin).map(|way| center + way)))
}

/// Discs whose hull is that of a shape.
fn corners(shape: &Shape) -> Vec<(Point, Nm)> {
    match shape {
        Shape::Disc { center, radius } => vec![(*center, *radius)],
        Shape::Stroke { from, to, radius } => vec![(*from, *radius), (*to, *radius)],
        Shape::Arc { arc, radius } => {
            let points = std::iter::once(arc.start).chain(arc.flatten(CHORD));
            points.map(|p| (p, *radius + CHORD)).collect()
        }
        Shape::Polygon(polygon) => {
            let points = || polygon.contours().iter().flatten().copied();
            let hull = Polygon::hull(points());
            let corners = hull.map_or_else(|| points().collect(), |hull| hull.contours().concat());
            corners.into_iter().map(|p| (p, Nm::ZERO)).collect()
        }
    }
}

/// How far chords may leave an arc. Chosen: less than octagons leave circles.
const CHORD: Nm = Nm::from_um(5);

/// The corners of a regular octagon round a circle about zero.
fn octagon(radius: Nm) -> [Vector; 8] {
    // tan 22.5°, rounded up.
    let (far, near) = (radius, Nm::new((radius.get() * 414_214 + 999_999) / 1_000_000));
    [
        (far, near),
        (near, far),
        (-near, far),
        (-far, near),
        (-far, -near),
        (-near, -far),
        (near, -far),
        (far, -near),
    ]
    .map(|(x, y)| Vector::new(x, y))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::board::{Attributes, Axis, Feature, Side};
    use crate::geometry::{Arc, Turn};

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    fn copper(shapes: impl IntoIterator<Item = Shape>) -> Copper {
        let feature = |shape| Feature { shape, axis: Axis::Flash(Point::default()), attributes: 0, line: 1 };
        let features = shapes.into_iter().map(feature).collect();
        Copper { side: Side::Front, features, attributes: vec![Attributes::default()] }
    }

    fn enclose(frame: Frame, copper: &Copper) -> Polygon {
        frame.enclose(copper, copper.bounds().expect("copper"))
    }

    #[test]
    fn the_hull_is_shorter_than_the_rectangle_where_corners_are_bare() {
        let disc = |x, y| Shape::Disc { center: at(x, y), radius: Nm::from_mm(1) };
        let cross = copper([disc(0, 20_000), disc(20_000, 0), disc(20_000, 40_000), disc(40_000, 20_000)]);
        let margin = Nm::from_mm(1);
        let [hull, rectangle] =
            [Frame::Hull(margin), Frame::Rectangle(margin)].map(|frame| enclose(frame, &cross));
        // A square of 28.3 mm on its corner with rounded ones, beside one of 44 mm.
        assert!((rectangle.perimeter() - 176e6).abs() < 1.0, "four sides: {}", rectangle.perimeter());
        let round = 4.0 * 20e6 * std::f64::consts::SQRT_2 + std::f64::consts::TAU * 2e6;
        assert!((1.0..1.006).contains(&(hull.perimeter() / round)), "{} beside {round}", hull.perimeter());
    }

    #[test]
    fn copper_on_one_line_has_a_hull_too() {
        let [from, to] = [at(0, 0), at(9000, 0)];
        for shape in
            [Shape::Stroke { from, to, radius: Nm::ZERO }, Shape::Disc { center: from, radius: Nm::ZERO }]
        {
            let frame = enclose(Frame::Hull(Nm::from_um(100)), &copper([shape.clone()]));
            assert!(frame.contains(shape.anchor()), "{frame:?}");
        }
    }

    fn any_shape() -> impl Strategy<Value = Shape> {
        let place = || (0..30_000_i64, 0..20_000_i64).prop_map(|(x, y)| at(x, y));
        (0..4_u8, place(), place(), 1..1500_i64).prop_map(|(kind, a, b, radius)| {
            let radius = Nm::from_um(radius);
            let b = if a == b { at(31_000, 0) } else { b };
            match kind {
                0 => Shape::Disc { center: a, radius },
                1 => Shape::Stroke { from: a, to: b, radius },
                2 => {
                    let (center, turn) = (a.midpoint(b), Turn::Clockwise);
                    Shape::Arc { arc: Arc { start: a, end: b, center, turn }, radius }
                }
                _ => Shape::Polygon(Polygon::rectangle(Rect::new(a, b).inflate(radius))),
            }
        })
    }

    proptest! {
        #[test]
        fn all_copper_lies_a_margin_within_the_hull_though_most_is_not_looked_at(
            shapes in prop::collection::vec(any_shape(), 1..40),
        ) {
            let copper = copper(shapes);
            let margin = Nm::from_um(300);
            let hull = enclose(Frame::Hull(margin), &copper);
            let all = copper.features.iter().flat_map(|feature| corners(&feature.shape));
            let all = all.flat_map(|(center, radius)| octagon(radius + margin).map(|way| center + way));
            prop_assert_eq!(Polygon::hull(all), Some(hull.clone()));
            for feature in &copper.features {
                // Chords of what is round lie within it: some micrometres of the margin.
                let outline = feature.shape.polygon(Nm::from_um(5)).expect("an area");
                for &p in outline.contours().iter().flatten() {
                    let away = |(a, b): (Point, Point)| {
                        let ((ax, ay), (bx, by), (px, py)) = (a.to_f64(), b.to_f64(), p.to_f64());
                        ((bx - ax) * (py - ay) - (by - ay) * (px - ax)) / a.distance(b)
                    };
                    let least = hull.edges().map(away).fold(f64::INFINITY, f64::min);
                    prop_assert!(least >= margin.to_f64() - 3.0, "{least} nm");
                }
            }
        }
    }
}
