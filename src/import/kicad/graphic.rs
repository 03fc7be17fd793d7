//! Lines, arcs, circles, rectangles, polygons and curves: of the board, of footprints, and of what
//! custom pads are made of.

use std::cmp::Ordering;

use super::curve::Curve;
use super::frame::Frame;
use super::head::kind;
use super::reader::Reader;
use super::ring::Drawing;
use super::tree::Node;
use crate::board::{Axis, Shape, polarity};
use crate::geometry::{Arc, Nm, Orientation, Point, Turn, Vector, orientation};
use crate::import::diagnostic;
use crate::import::error::Error;

/// How the outline is drawn, and whether the inside is filled.
#[derive(Clone, Copy)]
struct Pen {
    width: Nm,
    filled: bool,
}

impl Reader<'_> {
    /// What `node`, given in `frame`, draws. On the layer of the edge nothing is filled but what
    /// says so.
    pub(super) fn graphic(&mut self, node: Node<'_>, frame: &Frame, on_edge: bool) -> Result<Drawing, Error> {
        let kind = kind(node.head());
        let pen = self.pen(node, kind, on_edge)?;
        let curve = match kind {
            b"circle" => return self.circle(node, frame, pen),
            b"rect" => return self.rectangle(node, frame, pen),
            b"poly" => return self.polygon(node, frame, pen),
            b"arc" => self.arc(node, frame)?,
            b"curve" => self.bezier(node, frame)?,
            _ => {
                let (from, to) = (self.point(node, "start")?, self.point(node, "end")?);
                Curve::Line(frame.place(from), frame.place(to))
            }
        };
        Ok(curve.drawn(pen.width))
    }

    fn pen(&mut self, node: Node<'_>, kind: &[u8], on_edge: bool) -> Result<Pen, Error> {
        let stroke = node.find("stroke");
        let width = match stroke.and_then(|stroke| stroke.find("width")).or_else(|| node.find("width")) {
            Some(list) => self.length(list, 0)?,
            None => Nm::ZERO,
        };
        let style = stroke.and_then(|stroke| stroke.find("type")?.argument(0));
        if let Some(style) = style.filter(|style| !matches!(style.raw(), b"solid" | b"default"))
            && !on_edge
        {
            let message = format!("a line of style {} is read as solid", style.text());
            self.warnings.add(&diagnostic::KICAD_LINE_STYLE, node.place(), message);
        }
        let declared = node.find("fill").and_then(|fill| match fill.argument(0) {
            Some(word) => Some(word),
            None => fill.find("type").and_then(|list| list.argument(0)),
        });
        // Where nothing is told: KiCad before version 6 filled polygons, and rings without a width.
        let default = match kind {
            b"poly" => !on_edge,
            b"circle" | b"rect" => width == Nm::ZERO && !on_edge,
            _ => false,
        };
        let filled = declared.map_or(default, |word| !matches!(word.raw(), b"none" | b"no" | b"false"));
        // The edge goes round a circle, whatever is in it.
        let filled = filled && !(on_edge && kind == b"circle");
        if let Some(word) = declared.filter(|word| word.raw().ends_with(b"hatch")) {
            let message = format!("an area with fill {} is read as filled solid", word.text());
            self.warnings.add(&diagnostic::KICAD_LINE_STYLE, node.place(), message);
        }
        Ok(Pen { width, filled })
    }

    fn circle(&mut self, node: Node<'_>, frame: &Frame, pen: Pen) -> Result<Drawing, Error> {
        let center = frame.place(self.point(node, "center")?);
        let end = frame.place(self.point(node, "end")?);
        let reach = Nm::from_f64(center.distance(end));
        if pen.filled || reach == Nm::ZERO {
            let disc = Shape::Disc { center, radius: reach + pen.width / 2 };
            return Ok(vec![(disc, Axis::Flash(center))]);
        }
        let start = center + Vector::new(reach, Nm::ZERO);
        let circle = Arc { start, end: start, center, turn: Turn::CounterClockwise };
        Ok(Curve::Arc(circle).drawn(pen.width))
    }

    fn rectangle(&mut self, node: Node<'_>, frame: &Frame, pen: Pen) -> Result<Drawing, Error> {
        let (a, b) = (self.point(node, "start")?, self.point(node, "end")?);
        let corners = [a, (b.0, a.1), b, (a.0, b.1)];
        let radius = match node.find("radius") {
            Some(radius) => self.length(radius, 0)?,
            None => Nm::ZERO,
        };
        let radius = radius.min((b.0 - a.0).abs() / 2).min((b.1 - a.1).abs() / 2);
        if radius <= Nm::ZERO {
            return Ok(area(&corners.map(|corner| frame.place(corner)), pen));
        }
        Ok(enclosed(&rounded(corners, radius, frame), pen))
    }

    fn polygon(&mut self, node: Node<'_>, frame: &Frame, pen: Pen) -> Result<Drawing, Error> {
        let Some(points) = node.find("pts") else { return Err(self.lacks(node, "`(pts (xy …) …)`")) };
        let points = self.points(points, frame)?;
        if pen.filled {
            self.refuse_tangled(&points, node, "draw it in KiCad so that it does not")?;
        }
        Ok(area(&points, pen))
    }

    /// The corners in a `(pts …)`; arcs between them as lines.
    pub(super) fn points(&mut self, list: Node<'_>, frame: &Frame) -> Result<Vec<Point>, Error> {
        let mut points: Vec<Point> = Vec::new();
        for node in list.arguments().filter(|node| node.is_list()) {
            match node.head() {
                b"xy" => points.push(frame.place((self.length(node, 0)?, self.length(node, 1)?))),
                b"arc" => {
                    let curve = self.arc(node, frame)?;
                    points.push(curve.start());
                    points.extend(curve.flatten());
                }
                _ => return Err(self.lacks(node, "`(xy …)` or `(arc …)`")),
            }
        }
        points.dedup();
        Ok(points)
    }

    pub(super) fn arc(&self, node: Node<'_>, frame: &Frame) -> Result<Curve, Error> {
        let (start, end) = (frame.place(self.point(node, "start")?), frame.place(self.point(node, "end")?));
        if node.find("mid").is_some() {
            return Ok(Curve::through(start, frame.place(self.point(node, "mid")?), end));
        }
        // Until version 6, `start` is the centre and `end` where the arc begins.
        let Some(angle) = node.find("angle") else {
            return Err(self.lacks(node, "`(mid …)` or `(angle …)`"));
        };
        Ok(Curve::round(start, end, self.number(angle, 0)?))
    }

    fn bezier(&mut self, node: Node<'_>, frame: &Frame) -> Result<Curve, Error> {
        let Some(list) = node.find("pts") else {
            return Err(self.lacks(node, "`(pts …)` with four points"));
        };
        let mut corners = Vec::new();
        for corner in list.all("xy") {
            corners.push(frame.place((self.length(corner, 0)?, self.length(corner, 1)?)));
        }
        let corners: Result<[Point; 4], _> = corners.try_into();
        corners.map(Curve::bezier).map_err(|_| self.lacks(list, "four points"))
    }
}

/// The sides of a rectangle with these corners in the file, and the quarters of circles at its
/// corners: since version 10.
fn rounded(corners: [(Nm, Nm); 4], radius: Nm, frame: &Frame) -> Vec<Curve> {
    let moved = |corner: Nm, neighbour: Nm| match neighbour.cmp(&corner) {
        Ordering::Less => corner - radius,
        Ordering::Equal => corner,
        Ordering::Greater => corner + radius,
    };
    let toward = |corner: (Nm, Nm), other: (Nm, Nm)| (moved(corner.0, other.0), moved(corner.1, other.1));
    let quarter = |number: usize| {
        let [before, corner, after] = [3, 4, 5].map(|ahead| corners[(number + ahead) % 4]);
        let (start, end) = (toward(corner, before), toward(corner, after));
        let center = (start.0 + end.0 - corner.0, start.1 + end.1 - corner.1);
        let [start, corner, end, center] = [start, corner, end, center].map(|p| frame.place(p));
        let turn = match orientation(start, corner, end) {
            Orientation::Right => Turn::Clockwise,
            Orientation::Left | Orientation::Straight => Turn::CounterClockwise,
        };
        Arc { start, end, center, turn }
    };
    let quarters = [0, 1, 2, 3].map(quarter);
    let side = |arc: &Arc, next: &Arc| (arc.end != next.start).then_some(Curve::Line(arc.end, next.start));
    let pairs = quarters.iter().zip(quarters.iter().cycle().skip(1));
    pairs.flat_map(|(arc, next)| [Some(Curve::Arc(*arc)), side(arc, next)]).flatten().collect()
}

/// The closed line through `corners`, and what is in it.
fn area(corners: &[Point], pen: Pen) -> Drawing {
    let next = corners.iter().cycle().skip(1);
    let sides: Vec<Curve> = corners.iter().zip(next).map(|(&from, &to)| Curve::Line(from, to)).collect();
    enclosed(&sides, pen)
}

/// A closed line, and what is in it.
fn enclosed(sides: &[Curve], pen: Pen) -> Drawing {
    let mut drawing = Drawing::new();
    if pen.filled {
        let flat = sides.iter().flat_map(|side| std::iter::once(side.start()).chain(side.flatten()));
        let mut corners: Vec<Point> = flat.collect();
        corners.dedup();
        // Where it began.
        corners.pop();
        let pieces = if corners.len() < 3 { Vec::new() } else { polarity::clean(&[corners]) };
        drawing.extend(pieces.into_iter().map(|piece| (Shape::Polygon(piece), Axis::Region)));
    }
    if pen.width > Nm::ZERO || !pen.filled {
        drawing.extend(sides.iter().flat_map(|side| side.drawn(pen.width)));
    }
    drawing
}
