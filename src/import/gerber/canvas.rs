//! The objects drawn so far: the image, and the blocks (AB) and repeats (SR) that are open.

use std::sync::Arc as Shared;

use crate::board::polarity::Polarity;
use crate::board::{Axis, Feature, Shape};
use crate::geometry::{Arc, Circle, Nm, Point, Polygon, Rect, Vector};

use super::fault::Fault;
use super::linear::Linear;

/// An object of the image: a feature, and whether it adds or erases.
pub(super) type Object = (Feature, Polarity);

/// How deep blocks may nest. Chosen.
const DEPTH: usize = 32;

/// Why an object cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Refusal {
    /// More features than the limit, which is named.
    Features(u64),
    /// More vertices than the limit, which is named.
    Vertices(u64),
    /// Copper beyond the range of coordinates.
    Range,
    /// Blocks nested deeper than the limit.
    Depth(usize),
    /// An outline that crosses itself all over.
    Tangled,
}

impl From<Refusal> for Fault {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Features(limit) => Self::new(
                "this file expands to too many features",
                format!("at most {limit} features, repeats and blocks expanded"),
            ),
            Refusal::Vertices(limit) => Self::new(
                "this file expands to too many polygon vertices",
                format!("at most {limit} vertices, repeats and blocks expanded"),
            ),
            Refusal::Range => Self::new("this object is out of range", "copper within ±1073.741823 mm"),
            Refusal::Tangled => {
                Self::new("this outline crosses itself too often", "an outline that does not cross itself")
            }
            Refusal::Depth(limit) => {
                Self::new("blocks are nested too deep", format!("at most {limit} open %AB and %SR"))
            }
        }
    }
}

/// What an open frame is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Frame {
    /// A block aperture with this number.
    Block(u32),
    /// Copies along x and y of the file, and the steps between them.
    Repeat { copies: (u32, u32), steps: [Vector; 2] },
}

/// Collects objects.
#[derive(Debug)]
pub(super) struct Canvas {
    image: Vec<Object>,
    open: Vec<(Frame, Vec<Object>)>,
    features: Budget,
    vertices: Budget,
}

/// A limit and what is left of it.
#[derive(Clone, Copy, Debug)]
struct Budget {
    limit: u64,
    left: u64,
}

impl Budget {
    const fn new(limit: u64) -> Self {
        Self { limit, left: limit }
    }

    const fn spend(&mut self, amount: u64) -> bool {
        let left = self.left.checked_sub(amount);
        if let Some(left) = left {
            self.left = left;
        }
        left.is_some()
    }
}

impl Canvas {
    pub(super) const fn new(features: u64, vertices: u64) -> Self {
        Self {
            image: Vec::new(),
            open: Vec::new(),
            features: Budget::new(features),
            vertices: Budget::new(vertices),
        }
    }

    /// Counts `vertices` against the limit without drawing.
    pub(super) const fn charge(&mut self, vertices: u64) -> Result<(), Refusal> {
        if self.vertices.spend(vertices) { Ok(()) } else { Err(Refusal::Vertices(self.vertices.limit)) }
    }

    /// Draws an object.
    pub(super) fn push(&mut self, object: Object) -> Result<(), Refusal> {
        if !self.features.spend(1) {
            return Err(Refusal::Features(self.features.limit));
        }
        let reaches = match &object.0.shape {
            Shape::Polygon(polygon) => {
                self.charge(polygon.contours().iter().map(|ring| ring.len() as u64).sum())?;
                in_range(polygon.bounds())
            }
            Shape::Disc { center, radius } => in_range(Rect::new(*center, *center).inflate(*radius)),
            Shape::Stroke { from, to, radius } => in_range(Rect::new(*from, *to).inflate(*radius)),
            Shape::Arc { arc, .. } => {
                in_range(Rect::new(arc.center, arc.center)) && in_range(object.0.shape.bounds())
            }
        };
        if !reaches {
            return Err(Refusal::Range);
        }
        self.open.last_mut().map_or(&mut self.image, |(_, objects)| objects).push(object);
        Ok(())
    }

    /// Opens a frame.
    pub(super) fn open(&mut self, frame: Frame) -> Result<(), Refusal> {
        if self.open.len() >= DEPTH {
            return Err(Refusal::Depth(DEPTH));
        }
        self.open.push((frame, Vec::new()));
        Ok(())
    }

    /// The innermost open frame.
    pub(super) fn innermost(&self) -> Option<Frame> {
        self.open.last().map(|(frame, _)| *frame)
    }

    /// Whether a block is open.
    pub(super) fn is_in_block(&self) -> bool {
        self.open.iter().any(|(frame, _)| matches!(frame, Frame::Block(_)))
    }

    /// Closes the innermost frame, a block: its number and objects.
    pub(super) fn close_block(&mut self) -> Option<(u32, Shared<Vec<Object>>)> {
        match self.open.last() {
            Some((Frame::Block(number), _)) => {
                let number = *number;
                self.open.pop().map(|(_, objects)| (number, Shared::new(objects)))
            }
            _ => None,
        }
    }

    /// Closes the innermost frame, a repeat, and draws its copies: first along y, then along x
    /// (specification §4.12). False where none is open.
    pub(super) fn close_repeat(&mut self) -> Result<bool, Refusal> {
        let Some(Frame::Repeat { copies, steps: [along, across] }) = self.innermost() else {
            return Ok(false);
        };
        let objects = self.open.pop().map(|(_, objects)| objects).unwrap_or_default();
        if objects.is_empty() {
            return Ok(true);
        }
        // Copies in one place are one, whatever their polarity: what is drawn last there is what
        // one copy draws last.
        let distinct =
            |copies: u32, step: Vector| if step == Vector::default() { 1 } else { i64::from(copies) };
        for i in 0..distinct(copies.0, along) {
            for j in 0..distinct(copies.1, across) {
                let way = Vector::new(along.x * i + across.x * j, along.y * i + across.y * j);
                for (feature, polarity) in &objects {
                    self.push((moved(feature, Linear::IDENTITY, way), *polarity))?;
                }
            }
        }
        Ok(true)
    }

    /// What bounds the image.
    pub(super) fn bounds(&self) -> Option<Rect> {
        self.image.iter().map(|(feature, _)| feature.shape.bounds()).reduce(Rect::union)
    }

    /// The image, all frames closed.
    pub(super) fn finish(self) -> Vec<Object> {
        self.image
    }
}

fn in_range(bounds: Rect) -> bool {
    let (low, high) = (bounds.min(), bounds.max());
    low.x.min(low.y) >= Nm::MIN && high.x.max(high.y) <= Nm::MAX
}

/// `p`, unless it lies beyond the range of coordinates.
pub(super) fn in_reach(p: Point) -> Result<Point, Refusal> {
    let reaches = Nm::try_new(p.x.get()).is_ok() && Nm::try_new(p.y.get()).is_ok();
    if reaches { Ok(p) } else { Err(Refusal::Range) }
}

/// The image of `feature` under `linear`, then moved by `way`.
pub(super) fn moved(feature: &Feature, linear: Linear, way: Vector) -> Feature {
    let point = |p: Point| {
        if linear == Linear::IDENTITY {
            p + way
        } else {
            Point::default() + linear.vector(p - Point::default()) + way
        }
    };
    let length = |l: Nm| Nm::from_f64(l.to_f64() * linear.scale());
    let arc = |arc: Arc| Arc {
        start: point(arc.start),
        end: point(arc.end),
        center: point(arc.center),
        turn: if linear.mirrors() { arc.turn.reversed() } else { arc.turn },
    };
    let shape = match &feature.shape {
        Shape::Disc { center, radius } => Shape::Disc { center: point(*center), radius: length(*radius) },
        Shape::Stroke { from, to, radius } => stroke(point(*from), point(*to), length(*radius)),
        Shape::Arc { arc: axis, radius } => Shape::Arc { arc: arc(*axis), radius: length(*radius) },
        Shape::Polygon(polygon) => {
            let rings = polygon.contours().iter().map(|ring| {
                let mut ring: Vec<Point> = ring.iter().copied().map(point).collect();
                if linear.mirrors() {
                    ring.reverse();
                }
                ring
            });
            let circles = polygon
                .circles()
                .iter()
                .map(|circle| Circle { center: point(circle.center), radius: length(circle.radius) });
            let image = Polygon::new(rings.collect()).map(|image| image.of_circles(circles));
            image.map_or_else(|| feature.shape.clone(), Shape::Polygon)
        }
    };
    let axis = match feature.axis {
        Axis::Flash(at) => Axis::Flash(point(at)),
        Axis::Line(from, to) => Axis::Line(point(from), point(to)),
        Axis::Arc(axis) => Axis::Arc(arc(axis)),
        Axis::Region => Axis::Region,
    };
    Feature { shape, axis, ..*feature }
}

/// A round aperture drawn along a line, which may have no length.
pub(super) fn stroke(from: Point, to: Point, radius: Nm) -> Shape {
    if from == to { Shape::Disc { center: from, radius } } else { Shape::Stroke { from, to, radius } }
}
