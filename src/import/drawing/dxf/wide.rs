//! Polylines with a width: square ends, tapering steps, round at their corners.

use std::f64::consts::TAU;

use super::curve::turn;
use super::frame::Frame;
use super::vertex::Vertex;
use crate::geometry::{Path, Turn};
use crate::import::drawing::{Contour, Place};

/// How many chords a whole turn has. Chosen: 2 µm at a radius of 10 mm.
const CHORDS: f64 = 180.0;

/// What the steps of a polyline cover, each by itself, all counter-clockwise; none where something
/// lies beyond the range of coordinates.
pub(super) fn contours(vertices: &[Vertex], is_closed: bool, frame: &Frame) -> Option<Vec<Path>> {
    let mut rings: Vec<Vec<Place>> = Vec::new();
    let next = vertices.iter().skip(1).chain(is_closed.then(|| &vertices[0]));
    for (from, to) in vertices.iter().zip(next) {
        rings.extend(step(from, to.at));
    }
    // Corners: half as wide as what ends there.
    let inner = if is_closed { vertices } else { vertices.get(1..vertices.len() - 1).unwrap_or_default() };
    for vertex in inner {
        let radius = vertex.widths.0 / 2.0;
        rings.push(ring(vertex.at, radius));
    }
    let made = rings.into_iter().filter(|ring| ring.len() > 2).map(|ring| {
        let mut places: Vec<Place> = ring.into_iter().map(|p| frame.place(p)).collect();
        if turn(&places) == Turn::Clockwise {
            places.reverse();
        }
        let mut contour = Contour::new(places[0]);
        places[1..].iter().for_each(|&place| contour.line(place));
        contour.close();
        contour.finish()
    });
    made.collect()
}

/// The area of one step: along its middle, half its width to either side.
fn step(from: &Vertex, to: Place) -> Option<Vec<Place>> {
    let (dx, dy) = (to.0 - from.at.0, to.1 - from.at.1);
    let chord = libm::hypot(dx, dy);
    if chord <= 0.0 || from.widths.0.max(from.widths.1) <= 0.0 {
        return None;
    }
    let half = |part: f64| (from.widths.0 + (from.widths.1 - from.widths.0) * part) / 2.0;
    if from.bulge.abs() < 1e-9 {
        let (x, y) = (-dy / chord, dx / chord);
        let beside = |p: Place, by: f64| (p.0 + x * by, p.1 + y * by);
        let (a, b) = (half(0.0), half(1.0));
        return Some(vec![beside(from.at, a), beside(from.at, -a), beside(to, -b), beside(to, b)]);
    }
    let off = (1.0 - from.bulge * from.bulge) / (4.0 * from.bulge);
    let center = (f64::midpoint(from.at.0, to.0) - dy * off, f64::midpoint(from.at.1, to.1) + dx * off);
    let radius = libm::hypot(from.at.0 - center.0, from.at.1 - center.1);
    let start = libm::atan2(from.at.1 - center.1, from.at.0 - center.0);
    let sweep = 4.0 * libm::atan(from.bulge);
    let count = (sweep.abs() / TAU * CHORDS).ceil().max(2.0);
    let side = |sign: f64| {
        let mut places = Vec::new();
        let mut at = 0.0;
        while at <= count {
            let part = at / count;
            let (sin, cos) = libm::sincos(start + sweep * part);
            let reach = (radius + half(part) * sign).max(0.0);
            places.push((center.0 + reach * cos, center.1 + reach * sin));
            at += 1.0;
        }
        places
    };
    let mut places = side(1.0);
    places.extend(side(-1.0).into_iter().rev());
    Some(places)
}

fn ring(center: Place, radius: f64) -> Vec<Place> {
    if radius <= 0.0 {
        return Vec::new();
    }
    let mut places = Vec::new();
    let mut at = 0.0;
    while at < CHORDS {
        let (sin, cos) = libm::sincos(TAU * at / CHORDS);
        places.push((center.0 + radius * cos, center.1 + radius * sin));
        at += 1.0;
    }
    places
}
