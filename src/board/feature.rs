//! A piece of copper: its exact shape, and the axis along which it was drawn.
//!
//! The shape decides contact and distance; the axis is kept for the paper's core medial axes.

use crate::geometry::{Arc, Circle, Nm, Point, Polygon, Rect, Turn, Vector};

use super::{FLATTEN, boolean};

/// The copper of one feature, its edge included.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// All points within `radius` of `center`.
    Disc {
        /// The middle.
        center: Point,
        /// Half the diameter; zero for a point.
        radius: Nm,
    },
    /// All points within `radius` of the line from `from` to `to`: a round aperture drawn along it,
    /// or an obround.
    Stroke {
        /// One end of the axis.
        from: Point,
        /// The other end; not `from`.
        to: Point,
        /// Half the width; zero for a bare line.
        radius: Nm,
    },
    /// All points within `radius` of an arc: a round aperture drawn along it.
    Arc {
        /// The axis.
        arc: Arc,
        /// Half the width; zero for a bare arc.
        radius: Nm,
    },
    /// Anything else: rectangles, regions, macros, and what clear polarity left. Curves are
    /// flattened within [`FLATTEN`].
    Polygon(Polygon),
}

impl Shape {
    /// A point of its copper: the middle of a disc, an end of a stroke, a corner of a polygon.
    #[must_use]
    pub fn anchor(&self) -> Point {
        match self {
            Self::Disc { center, .. } => *center,
            Self::Stroke { from, .. } => *from,
            Self::Arc { arc, .. } => arc.start,
            Self::Polygon(polygon) => polygon.contours()[0][0],
        }
    }

    /// The length of its axis in nanometres; zero for a disc and a polygon.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Self::Stroke { from, to, .. } => from.distance(*to),
            Self::Arc { arc, .. } => arc.length(),
            Self::Disc { .. } | Self::Polygon(_) => 0.0,
        }
    }

    /// The place at a fraction of its axis, from 0 to 1; for a disc and a polygon its
    /// [`anchor`](Self::anchor).
    #[must_use]
    pub fn at(&self, fraction: f64) -> Point {
        match self {
            Self::Stroke { from, to, .. } => from.toward(*to, fraction),
            Self::Arc { arc, .. } => arc.point(fraction),
            Self::Disc { .. } | Self::Polygon(_) => self.anchor(),
        }
    }

    /// A rectangle that holds it.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        match self {
            Self::Disc { center, radius } => Rect::new(*center, *center).inflate(*radius),
            Self::Stroke { from, to, radius } => Rect::new(*from, *to).inflate(*radius),
            Self::Arc { arc, radius } => arc.bounds().inflate(*radius),
            Self::Polygon(polygon) => polygon.bounds(),
        }
    }

    /// Moved by `way`.
    #[must_use]
    pub fn translated(&self, way: Vector) -> Self {
        match self {
            Self::Disc { center, radius } => Self::Disc { center: *center + way, radius: *radius },
            Self::Stroke { from, to, radius } => {
                Self::Stroke { from: *from + way, to: *to + way, radius: *radius }
            }
            Self::Arc { arc, radius } => {
                let [start, end, center] = [arc.start, arc.end, arc.center].map(|p| p + way);
                Self::Arc { arc: Arc { start, end, center, ..*arc }, radius: *radius }
            }
            Self::Polygon(polygon) => Self::Polygon(polygon.translated(way)),
        }
    }

    /// The same area as a polygon, its curves within `tolerance`; none where it has no area.
    #[must_use]
    pub fn polygon(&self, tolerance: Nm) -> Option<Polygon> {
        match *self {
            Self::Polygon(ref polygon) => Some(polygon.clone()),
            Self::Disc { radius, .. } | Self::Stroke { radius, .. } | Self::Arc { radius, .. }
                if radius <= Nm::ZERO =>
            {
                None
            }
            Self::Disc { center, radius } => Polygon::disc(center, radius, tolerance),
            Self::Stroke { from, to, radius } => {
                let ends = [from, to].map(|end| Polygon::disc(end, radius, tolerance));
                let points = ends.iter().flatten().flat_map(|end| end.contours()[0].iter().copied());
                let circles = [from, to].map(|center| Circle { center, radius });
                Polygon::hull(points).map(|hull| hull.of_circles(circles))
            }
            Self::Arc { ref arc, radius } => swept_arc(arc, radius, tolerance),
        }
    }

    /// Whether any of its area lies in `area`.
    #[must_use]
    pub fn lies_in(&self, area: &Polygon) -> bool {
        // A point of copper within the area has some of its copper around it, in the area too.
        if area.winding(self.anchor()).is_some_and(|times| times != 0) {
            return true;
        }
        let Some(near) = area.clipped(self.bounds()) else { return false };
        self.polygon(FLATTEN).is_some_and(|shape| !boolean::intersection(&shape, &near).is_empty())
    }
}

/// All points within `radius` of `arc`: the sector between its two edges, and a disc at either end.
fn swept_arc(arc: &Arc, radius: Nm, tolerance: Nm) -> Option<Polygon> {
    let steps = u32::try_from(arc.chords(tolerance) * 2).unwrap_or(u32::MAX);
    let (start, sweep, (x, y)) = (arc.start_angle(), arc.sweep(), arc.center.to_f64());
    // A stroke wider than the arc's radius reaches over the centre: what lies there belongs to the
    // discs.
    let edge = |out: Nm| {
        let reach = |end: Point| (arc.center.distance(end) + out.to_f64()).max(0.0);
        let (from, to) = (reach(arc.start), reach(arc.end));
        (0..=steps).map(move |step| {
            let fraction = f64::from(step) / f64::from(steps);
            let (sin, cos) = libm::sincos(start + sweep * fraction);
            let reach = from + (to - from) * fraction;
            Point::from_f64(x + reach * cos, y + reach * sin)
        })
    };
    let (outer, mut inner): (Vec<Point>, Vec<Point>) = (edge(radius).collect(), edge(-radius).collect());
    inner.reverse();
    let mut contours = if arc.start == arc.end {
        vec![outer, inner]
    } else {
        vec![outer.into_iter().chain(inner).collect()]
    };
    if arc.turn == Turn::Clockwise {
        contours.iter_mut().for_each(|ring| ring.reverse());
    }
    let ends = [arc.start, arc.end].map(|end| Polygon::disc(end, radius, tolerance));
    contours.extend(ends.iter().flatten().map(|end| end.contours()[0].clone()));
    let around = |center: Point, radius: f64| Circle { center, radius: Nm::from_f64(radius) };
    let sides = [radius, -radius].map(|out| arc.radius() + out.to_f64());
    let sides = sides.into_iter().filter(|&side| side > 0.0).map(|side| around(arc.center, side));
    let caps = [arc.start, arc.end].map(|end| around(end, radius.to_f64()));
    let circles: Vec<Circle> = sides.chain(caps).collect();
    boolean::clean(&contours).into_iter().next().map(|polygon| polygon.of_circles(circles))
}

/// How a feature was drawn: the paper's vertices and approximate core medial axis (§III-A.1,
/// III-D).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// An aperture flashed at a point.
    Flash(Point),
    /// An aperture drawn along a line; both ends may be the same point.
    Line(Point, Point),
    /// An aperture drawn along an arc.
    Arc(Arc),
    /// A region (G36/G37): the outline itself is all there is.
    Region,
}

/// A piece of copper with what is known of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Feature {
    /// The area it covers.
    pub shape: Shape,
    /// How it was drawn. Pieces that clear polarity cut from one feature all carry its axis.
    pub axis: Axis,
    /// The index of its attribute set in [`Copper::attributes`](super::Copper::attributes).
    pub attributes: u32,
    /// The line of the file that drew it, from 1.
    pub line: u32,
}
