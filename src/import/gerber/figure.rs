//! The figures that apertures are made of, and the area that a sequence of them leaves.

use std::f64::consts::PI;

use crate::board::{FLATTEN, polarity};
use crate::geometry::{Circle, Nm, Point, Polygon};

use super::linear::Linear;

/// A place relative to an aperture's origin, in nanometres.
pub(super) type Place = (f64, f64);

/// One primitive of an aperture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Primitive {
    /// Whether it adds to the aperture or erases what came before it.
    pub(super) exposed: bool,
    pub(super) figure: Figure,
}

/// What a primitive covers.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Figure {
    /// All within `outer` of `center`, less what lies within `inner`.
    Ring { center: Place, outer: f64, inner: f64 },
    /// The area inside a closed contour, by the non-zero rule.
    Contour(Vec<Place>),
}

impl Figure {
    pub(super) const fn disc(center: Place, radius: f64) -> Self {
        Self::Ring { center, outer: radius, inner: 0.0 }
    }

    /// An upright rectangle.
    pub(super) fn rectangle((x, y): Place, width: f64, height: f64) -> Self {
        let (w, h) = (width / 2.0, height / 2.0);
        Self::Contour(vec![(x - w, y - h), (x + w, y - h), (x + w, y + h), (x - w, y + h)])
    }

    /// A regular polygon with a vertex at `degrees`.
    pub(super) fn regular((x, y): Place, radius: f64, vertices: u32, degrees: f64) -> Self {
        let vertex = |i: u32| {
            let turn = Linear::rotation(degrees + 360.0 * f64::from(i) / f64::from(vertices));
            let (dx, dy) = turn.apply((radius, 0.0));
            (x + dx, y + dy)
        };
        Self::Contour((0..vertices).map(vertex).collect())
    }

    /// Turned about the origin.
    pub(super) fn rotated(self, degrees: f64) -> Self {
        if degrees.abs() <= 0.0 {
            return self;
        }
        let turn = Linear::rotation(degrees);
        match self {
            Self::Ring { center, outer, inner } => Self::Ring { center: turn.apply(center), outer, inner },
            Self::Contour(places) => Self::Contour(places.into_iter().map(|p| turn.apply(p)).collect()),
        }
    }

    /// The image under `linear` as simple contours: outer ones counter-clockwise, holes clockwise.
    fn contours(&self, linear: Linear) -> Vec<Vec<Point>> {
        match self {
            Self::Ring { center, outer, inner } => {
                let scale = linear.scale();
                let (x, y) = linear.apply(*center);
                let circle = |radius: f64| -> Vec<Point> {
                    arc((x, y), radius * scale, 0.0, 2.0 * PI).map(|(x, y)| Point::from_f64(x, y)).collect()
                };
                let hole = (*inner > 0.0).then(|| circle(*inner).into_iter().rev().collect());
                [circle(*outer)].into_iter().chain(hole).collect()
            }
            Self::Contour(_) => {
                let pieces = polarity::clean(&[self.vertices(linear)]);
                pieces.iter().flat_map(|piece| piece.contours().iter().cloned()).collect()
            }
        }
    }

    /// The circles of a ring under `linear`.
    fn circles(&self, linear: Linear) -> Vec<Circle> {
        let Self::Ring { center, outer, inner } = *self else { return Vec::new() };
        let (x, y) = linear.apply(center);
        let circle = |radius: f64| Circle {
            center: Point::from_f64(x, y),
            radius: Nm::from_f64(radius * linear.scale()),
        };
        [outer, inner].into_iter().filter(|&radius| radius > 0.0).map(circle).collect()
    }

    /// The image under `linear`, its contours as they are written.
    pub(super) fn outlines(&self, linear: Linear) -> Vec<Vec<Point>> {
        match self {
            Self::Ring { .. } => self.contours(linear),
            Self::Contour(_) => vec![self.vertices(linear)],
        }
    }

    /// Whether it crosses itself too often to be worked out.
    pub(super) fn is_tangled(&self) -> bool {
        let vertices = self.vertices(Linear::IDENTITY);
        polarity::is_tangled([&vertices].into_iter())
    }

    /// The vertices of a contour under `linear`; none of a ring.
    pub(super) fn vertices(&self, linear: Linear) -> Vec<Point> {
        let Self::Contour(places) = self else { return Vec::new() };
        let point = |&p: &Place| {
            let (x, y) = linear.apply(p);
            Point::from_f64(x, y)
        };
        places.iter().map(point).collect()
    }

    /// How far from the origin it reaches at most.
    pub(super) fn reach(&self) -> f64 {
        let far = |&(x, y): &Place| x.abs() + y.abs();
        match self {
            Self::Ring { center, outer, .. } => far(center) + outer,
            Self::Contour(places) => places.iter().map(far).fold(0.0, f64::max),
        }
    }

    /// About how many vertices it has once flattened, `scale` times as large.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "`as` saturates, as it should here"
    )]
    pub(super) fn vertex_count(&self, scale: f64) -> u64 {
        let circle = |radius: f64| 8 + (PI * (radius * scale / (2.0 * FLATTEN.to_f64())).sqrt()) as u64;
        match self {
            Self::Ring { outer, inner, .. } => circle(*outer) + circle(*inner),
            Self::Contour(places) => places.len() as u64,
        }
    }
}

/// The area that `primitives` leave when drawn in order through `linear`: one polygon a connected
/// piece.
pub(super) fn area(primitives: &[Primitive], linear: Linear) -> Vec<Polygon> {
    let mut image: Vec<Vec<Point>> = Vec::new();
    for run in primitives.chunk_by(|a, b| a.exposed == b.exposed) {
        let contours = run.iter().flat_map(|primitive| primitive.figure.contours(linear));
        if run[0].exposed {
            image.extend(contours);
            continue;
        }
        let erased = polarity::clean(&contours.collect::<Vec<_>>());
        let pieces = polarity::clean(&image);
        let left = pieces.iter().flat_map(|piece| polarity::difference(piece, &erased));
        image = left.flat_map(|piece| piece.contours().to_vec()).collect();
    }
    let circles = primitives.iter().flat_map(|primitive| primitive.figure.circles(linear));
    polarity::of_circles(polarity::clean(&image), circles.collect())
}

/// The vertices of an arc within [`FLATTEN`] of it, the start but not the end; a quarter circle is
/// met exactly, so that tangent edges touch.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
pub(super) fn arc((x, y): Place, radius: f64, start: f64, sweep: f64) -> impl Iterator<Item = Place> {
    let ratio = (FLATTEN.to_f64() / radius.max(1.0)).min(0.25);
    let quarter = (PI / 2.0 / (2.0 * libm::acos(1.0 - ratio))).ceil().max(1.0);
    let steps = (quarter * (sweep.abs() / (PI / 2.0))).ceil().max(1.0) as u32;
    (0..steps).map(move |step| {
        let angle = start + sweep * f64::from(step) / f64::from(steps);
        let (sin, cos) = libm::sincos(angle);
        (x + radius * cos, y + radius * sin)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_erasing_primitive_erases_what_came_before_it_only() {
        let on = |figure| Primitive { exposed: true, figure };
        let off = |figure| Primitive { exposed: false, figure };
        let square = |size| Figure::rectangle((0.0, 0.0), size, size);
        let pieces = area(&[on(square(10e6)), off(square(6e6)), on(square(2e6))], Linear::IDENTITY);
        let total: f64 = pieces.iter().map(Polygon::area_mm2).sum();
        assert_eq!(pieces.len(), 2, "a frame and a square in it");
        assert!((total - 68.0).abs() < 1e-9, "area {total}");
    }

    /// As KiCad writes it: an outline, a disc in each corner, and a line along each side.
    #[test]
    fn a_rounded_rectangle_remembers_its_corners() {
        let on = |figure| Primitive { exposed: true, figure };
        let corners = [(-4e5, -2e5), (4e5, -2e5), (4e5, 2e5), (-4e5, 2e5)];
        let discs = corners.map(|corner| on(Figure::disc(corner, 1e5)));
        let bars = [Figure::rectangle((0.0, 0.0), 1e6, 4e5), Figure::rectangle((0.0, 0.0), 8e5, 6e5)].map(on);
        let turned = area(&[&discs[..], &bars].concat(), Linear::IDENTITY);
        let [piece] = turned.as_slice() else { panic!("one piece: {turned:?}") };
        let circle = |(x, y): Place| Circle { center: Point::from_f64(x, y), radius: Nm::from_um(100) };
        let mut expected = corners.map(circle);
        expected.sort_unstable();
        assert_eq!(piece.circles(), expected, "and nothing else");
        let on_one = |p: &Point| expected.iter().any(|c| (c.center.distance(*p) - 1e5).abs() < 2.0);
        let ring = &piece.contours()[0];
        assert!(ring.iter().filter(|p| on_one(p)).count() * 10 > ring.len() * 8, "most lie on them");
    }

    #[test]
    fn a_circle_touches_its_tangents() {
        let pieces = area(
            &[Primitive { exposed: true, figure: Figure::disc((0.0, 0.0), 123_457.0) }],
            Linear::IDENTITY,
        );
        let bounds = pieces[0].bounds();
        assert_eq!((bounds.width().get(), bounds.height().get()), (246_914, 246_914), "exact extent");
    }
}
