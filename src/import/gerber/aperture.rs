//! Apertures (AD, specification §4.3 and §4.4) and the form each takes under the transformation in
//! force.

use std::f64::consts::PI;
use std::sync::Arc as Shared;

use crate::board::Feature;
use crate::board::polarity::{self, Polarity};
use crate::geometry::{Nm, Point, Polygon, Vector};

use super::figure::{Figure, Primitive, arc, area};
use super::linear::Linear;

/// The hole of a standard aperture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hole {
    None,
    Round(Nm),
    /// As the specification allowed until 2013.
    Rectangular(Nm, Nm),
}

/// An aperture as it was defined.
#[derive(Clone, Debug)]
pub(super) enum Template {
    Circle {
        diameter: Nm,
        hole: Hole,
    },
    Rectangle {
        width: Nm,
        height: Nm,
        hole: Hole,
    },
    Obround {
        width: Nm,
        height: Nm,
        hole: Hole,
    },
    Polygon {
        diameter: Nm,
        vertices: u32,
        rotation: f64,
        hole: Hole,
    },
    Macro {
        name: String,
        primitives: Vec<Primitive>,
    },
    /// The objects of an AB block, relative to its origin.
    Block(Shared<Vec<(Feature, Polarity)>>),
}

/// An aperture, transformed: what a flash or a draw puts down.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// A circle round the origin; radius zero for an aperture of no size.
    Disc(Nm),
    /// A circle with a hole: its pieces where it is flashed, the whole circle where it is drawn.
    Holed { pieces: Vec<Polygon>, radius: Nm },
    /// A circle drawn from −`half` to `half`.
    Obround { half: Vector, radius: Nm },
    /// Anything else: its connected pieces, none for an aperture without area, and its convex hull.
    Area { pieces: Vec<Polygon>, hull: Vec<Point> },
}

impl Template {
    /// The form under `linear`; none for a block.
    pub(super) fn form(&self, linear: Linear) -> Option<Form> {
        let scaled = |length: Nm| Nm::from_f64(length.to_f64() * linear.scale());
        Some(match self {
            Self::Block(_) => return None,
            Self::Circle { diameter, hole: Hole::None } => Form::Disc(half(scaled(*diameter))),
            Self::Circle { diameter, .. } => {
                Form::Holed { pieces: area(&self.primitives(), linear), radius: half(scaled(*diameter)) }
            }
            Self::Rectangle { width: Nm::ZERO, height: Nm::ZERO, hole: _ } => Form::Disc(Nm::ZERO),
            Self::Obround { width, height, hole: Hole::None } => {
                let (thin, long) = ((*width).min(*height), *width - *height);
                let way = if long >= Nm::ZERO {
                    Vector::new(half(long), Nm::ZERO)
                } else {
                    Vector::new(Nm::ZERO, half(-long))
                };
                match long {
                    Nm::ZERO => Form::Disc(half(scaled(thin))),
                    _ => Form::Obround { half: linear.vector(way), radius: half(scaled(thin)) },
                }
            }
            Self::Rectangle { .. } | Self::Obround { .. } | Self::Polygon { .. } => {
                Form::area(&self.primitives(), linear)
            }
            Self::Macro { primitives, .. } => match primitives.as_slice() {
                [Primitive { exposed: true, figure: Figure::Ring { center: (x, y), outer, inner } }]
                    if x.abs() + y.abs() + inner.abs() <= 0.0 =>
                {
                    Form::Disc(Nm::from_f64(outer * linear.scale()))
                }
                primitives => Form::area(primitives, linear),
            },
        })
    }

    /// A standard aperture in the terms of a macro.
    fn primitives(&self) -> Vec<Primitive> {
        const ORIGIN: (f64, f64) = (0.0, 0.0);
        let (figure, hole) = match *self {
            Self::Circle { diameter, hole } => (Figure::disc(ORIGIN, diameter.to_f64() / 2.0), hole),
            Self::Rectangle { width, height, hole } => {
                (Figure::rectangle(ORIGIN, width.to_f64(), height.to_f64()), hole)
            }
            Self::Obround { width, height, hole } => (obround(width.to_f64(), height.to_f64()), hole),
            Self::Polygon { diameter, vertices, rotation, hole } => {
                (Figure::regular(ORIGIN, diameter.to_f64() / 2.0, vertices, rotation), hole)
            }
            Self::Macro { ref primitives, .. } => return primitives.clone(),
            Self::Block(_) => return Vec::new(),
        };
        let hole = match hole {
            Hole::None => None,
            Hole::Round(diameter) => Some(Figure::disc(ORIGIN, diameter.to_f64() / 2.0)),
            Hole::Rectangular(width, height) => {
                Some(Figure::rectangle(ORIGIN, width.to_f64(), height.to_f64()))
            }
        };
        let body = Primitive { exposed: true, figure };
        let hole = hole.map(|figure| Primitive { exposed: false, figure });
        [body].into_iter().chain(hole).collect()
    }

    /// How far from its origin it reaches at most, in nanometres.
    pub(super) fn reach(&self) -> f64 {
        match self {
            Self::Circle { diameter, .. } | Self::Polygon { diameter, .. } => diameter.to_f64(),
            Self::Rectangle { width, height, .. } | Self::Obround { width, height, .. } => {
                width.to_f64() + height.to_f64()
            }
            Self::Macro { primitives, .. } => primitives.iter().map(|p| p.figure.reach()).fold(0.0, f64::max),
            Self::Block(_) => 0.0,
        }
    }

    /// Whether a contour of it crosses itself too often to be worked out.
    pub(super) fn is_tangled(&self) -> bool {
        match self {
            Self::Macro { primitives, .. } => primitives.iter().any(|p| p.figure.is_tangled()),
            _ => false,
        }
    }

    /// About how many vertices its form has before anything is erased.
    pub(super) fn vertex_count(&self, linear: Linear) -> u64 {
        match self {
            Self::Macro { primitives, .. } => {
                primitives.iter().map(|p| p.figure.vertex_count(linear.scale())).sum()
            }
            _ => 64,
        }
    }

    /// What it takes to make its form, in vertices: each change of exposure goes over all that came
    /// before.
    pub(super) fn effort(&self, linear: Linear) -> u64 {
        let Self::Macro { primitives, .. } = self else { return 0 };
        let outlines: Vec<_> = primitives.iter().flat_map(|p| p.figure.outlines(linear)).collect();
        let runs = primitives.chunk_by(|a, b| a.exposed == b.exposed).count() as u64;
        polarity::effort(outlines.iter()).saturating_mul(runs)
    }

    /// As people say it.
    pub(super) fn describe(&self) -> String {
        let with_hole = |what: String, hole: &Hole| match hole {
            Hole::None => what,
            Hole::Round(d) => format!("{what}, hole {} mm", millimetres(*d)),
            Hole::Rectangular(w, h) => format!("{what}, hole {} × {} mm", millimetres(*w), millimetres(*h)),
        };
        match self {
            Self::Circle { diameter, hole } => {
                with_hole(format!("circle {} mm", millimetres(*diameter)), hole)
            }
            Self::Rectangle { width, height, hole } => {
                with_hole(format!("rectangle {} × {} mm", millimetres(*width), millimetres(*height)), hole)
            }
            Self::Obround { width, height, hole } => {
                with_hole(format!("obround {} × {} mm", millimetres(*width), millimetres(*height)), hole)
            }
            Self::Polygon { diameter, vertices, hole, .. } => {
                with_hole(format!("polygon of {vertices}, {} mm", millimetres(*diameter)), hole)
            }
            Self::Macro { name, .. } => format!("macro {name}"),
            Self::Block(objects) => format!("block of {} objects", objects.len()),
        }
    }
}

impl Form {
    fn area(primitives: &[Primitive], linear: Linear) -> Self {
        let pieces = area(primitives, linear);
        let points = pieces.iter().flat_map(|piece| piece.contours().iter().flatten().copied());
        let hull = Polygon::hull(points).map_or_else(
            // A rectangle of no height still draws an area when it moves across.
            || primitives.iter().filter(|p| p.exposed).flat_map(|p| p.figure.vertices(linear)).collect(),
            |hull| hull.contours()[0].clone(),
        );
        Self::Area { hull, pieces }
    }

    /// The vertices of its convex hull, round parts flattened.
    pub(super) fn hull(&self) -> Vec<Point> {
        let disc = |center: Point, radius: Nm| {
            let (x, y) = center.to_f64();
            arc((x, y), radius.to_f64(), 0.0, 2.0 * PI).map(|(x, y)| Point::from_f64(x, y))
        };
        match *self {
            Self::Disc(radius) | Self::Holed { radius, .. } => disc(Point::default(), radius).collect(),
            Self::Obround { half, radius } => {
                let ends = [Point::default() - half, Point::default() + half];
                ends.into_iter().flat_map(|end| disc(end, radius)).collect()
            }
            Self::Area { ref hull, .. } => hull.clone(),
        }
    }
}

/// A stadium.
fn obround(width: f64, height: f64) -> Figure {
    let (radius, along) = (width.min(height) / 2.0, (width - height).abs() / 2.0);
    let (dx, dy) = if width > height { (along, 0.0) } else { (0.0, along) };
    let start = if width > height { -PI / 2.0 } else { 0.0 };
    let end = if width > height { (0.0, radius) } else { (-radius, 0.0) };
    let mut places: Vec<_> = arc((dx, dy), radius, start, PI).collect();
    places.push((dx + end.0, dy + end.1));
    places.extend(arc((-dx, -dy), radius, start + PI, PI));
    places.push((-dx - end.0, -dy - end.1));
    Figure::Contour(places)
}

fn half(length: Nm) -> Nm {
    Nm::from_f64(length.to_f64() / 2.0)
}

/// Without the zeros at the end.
fn millimetres(length: Nm) -> String {
    length.to_string().trim_end_matches('0').trim_end_matches('.').to_owned()
}
