//! How a mask lies on its page: seen from which side, and stretched by how much.

use crate::board::{FLATTEN, Shape};
use crate::geometry::{Arc, Nm, Point, Polygon, Rect};

use super::sheet::{InkedNet, Sheet};

/// A mirror image, and a scale for each direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placing {
    /// Whether left and right are exchanged.
    pub mirrored: bool,
    /// How much larger it is in x and in y: what a printer or a film shrinks.
    pub scale: (f64, f64),
}

impl Placing {
    /// As it is.
    pub const AS_IT_IS: Self = Self { mirrored: false, scale: (1.0, 1.0) };

    /// The sheet placed so; the lower left corner of its page stays where it is.
    #[must_use]
    pub fn place(&self, sheet: Sheet) -> Sheet {
        if *self == Self::AS_IT_IS {
            return sheet;
        }
        let map = Map { placing: *self, area: sheet.area };
        let nets = sheet.nets.into_iter().map(|net| InkedNet {
            shapes: net.shapes.iter().filter_map(|shape| map.shape(shape)).collect(),
            ..net
        });
        let area = Rect::new(map.point(sheet.area.min()), map.point(sheet.area.max()));
        Sheet { nets: nets.collect(), area, ..sheet }
    }
}

/// A placing of a page that covers `area`.
struct Map {
    placing: Placing,
    area: Rect,
}

impl Map {
    fn point(&self, p: Point) -> Point {
        let (min, max) = (self.area.min(), self.area.max());
        let across = if self.placing.mirrored { max.x - p.x } else { p.x - min.x };
        let (x, y) = self.placing.scale;
        let step = |length: Nm, scale: f64| Nm::from_f64(length.to_f64() * scale);
        Point::new(min.x + step(across, x), min.y + step(p.y - min.y, y))
    }

    /// A shape that is round stays so where both scales are one; else it becomes a polygon.
    fn shape(&self, shape: &Shape) -> Option<Shape> {
        let (x, y) = self.placing.scale;
        #[expect(clippy::float_cmp, reason = "two numbers that were given as one")]
        let is_even = x == y;
        if !is_even && !matches!(shape, Shape::Polygon(_)) {
            return self.shape(&Shape::Polygon(shape.polygon(FLATTEN)?));
        }
        let grown = |radius: Nm| Nm::from_f64(radius.to_f64() * x);
        Some(match shape {
            Shape::Disc { center, radius } => {
                Shape::Disc { center: self.point(*center), radius: grown(*radius) }
            }
            Shape::Stroke { from, to, radius } => {
                Shape::Stroke { from: self.point(*from), to: self.point(*to), radius: grown(*radius) }
            }
            Shape::Arc { arc, radius } => {
                let [start, end, center] = [arc.start, arc.end, arc.center].map(|p| self.point(p));
                let turn = if self.placing.mirrored { arc.turn.reversed() } else { arc.turn };
                Shape::Arc { arc: Arc { start, end, center, turn }, radius: grown(*radius) }
            }
            Shape::Polygon(polygon) => Shape::Polygon(Polygon::new(self.rings(polygon))?),
        })
    }

    /// The contours of a polygon, turned so that outer ones stay counter-clockwise.
    fn rings(&self, polygon: &Polygon) -> Vec<Vec<Point>> {
        let ring = |ring: &Vec<Point>| {
            let mut placed: Vec<Point> = ring.iter().map(|&p| self.point(p)).collect();
            if self.placing.mirrored {
                placed.reverse();
            }
            placed
        };
        polygon.contours().iter().map(ring).collect()
    }
}
