//! How far a picture is turned, by the directions in which most of its edges run.
//!
//! Traces and pads are drawn along the axes of a board and midway between them. Each straight edge
//! tells a direction, counted from the nearest of these eight; where most of them agree, their mean
//! is the skew. The mean is one of lines fitted to all points of an edge, so that it is finer by
//! far than a staircase of pixels shows: an edge of `n` pixels that are each off by σ is off by
//! σ √(12 ÷ n³), and counts the more the less that is.
//!
//! W. Postl, *Detection of linear oblique structures and skew scan in digitized documents*, ICPR
//! 1986, does so for lines of text by projections of the whole picture; contours are there already.

use std::f64::consts::FRAC_PI_4;

use crate::vectorize::{self, Contour};

use super::scale::Scale;

/// Edges that are shorter say nothing, in pixels. Chosen: chords of a round pad are.
const SHORTEST: f64 = 24.0;

/// What pixels leave open of an edge.
struct Grain {
    /// How far an edge may leave its points.
    tolerance: f64,
    /// How far one of its points is off, as a rule.
    noise: f64,
    /// How far both its ends together may be off.
    most: f64,
}

/// Of pixels with two values: 1 ÷ √12 in theory; one step of a staircase turns its edge by up to
/// 1.5 pixels in its length. An edge is one although it has a step.
const STAIRCASE: Grain = Grain { tolerance: 0.8, noise: 0.29, most: 2.0 };

/// Where greys tell more. Chosen.
const GREYS: Grain = Grain { tolerance: 0.25, noise: 0.08, most: 0.5 };

/// How far a long edge is off whatever its length, in radians: a hundredth of a degree. Chosen.
const SCATTER: f64 = 1.7e-4;

/// Parts of 45 degrees in which edges are counted, and how many on either side of one count with
/// it: one degree. Chosen.
const BINS: usize = 180;
const NEAR: usize = 4;

/// How far edges may be from the densest bin at first, in radians: a third of a degree, more than a
/// bin is wide. Chosen.
const FIRST: f64 = 6e-3;

/// How many edges must agree at least, with what part of the weight of all. Chosen: of 46 pictures
/// of boards laid out on a grid the edges that agree have 0.6 and more.
const LEAST: (usize, f64) = (6, 0.4);

/// The greatest error that is let pass, in radians: a twentieth of a degree. Chosen.
const DOUBT: f64 = 8.7e-4;

/// The farthest turn that is taken for a skew, in radians: 15 degrees. Chosen: past 22.5 degrees a
/// diagonal would be taken for an axis.
const FARTHEST: f64 = 0.2618;

/// The least skew that is said, in radians: a fifth of a degree, a third of a millimetre in a
/// hundred. Chosen.
pub(super) const SEEN: f64 = 3.5e-3;

/// What is as good as level, in radians: a hundredth of a degree. Chosen.
pub(super) const LEVEL: f64 = 1.7e-4;

/// What the edges of a picture say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Skew {
    /// The board is turned by so many radians, counter-clockwise; it may be so much less or more.
    Turned(f64, f64),
    /// Most edges run so far aside, in radians, that it is not known to which axis they belong.
    TooFar(f64),
    /// Edges run in all directions, or there are too few.
    Unknown,
}

/// The direction of an edge, from −½ to ½ of 45 degrees, and how much it counts.
struct Ray {
    angle: f64,
    weight: f64,
    length: f64,
}

/// The skew of contours, that of pixels with two values or of more.
pub(super) fn skew(contours: &[Contour], scale: &Scale, is_two: bool) -> Skew {
    let grain = if is_two { STAIRCASE } else { GREYS };
    let edges = contours.iter().flat_map(|contour| vectorize::edges(&contour.points, grain.tolerance));
    let edges = edges.filter(|edge| edge.length >= SHORTEST);
    let rays: Vec<Ray> = edges.map(|edge| Ray::of(&edge, scale, grain.noise)).collect();
    let all: f64 = rays.iter().map(|ray| ray.weight).sum();
    let mut angle = densest(&rays);
    let mut agreeing = (0, 0.0, 0.0);
    // The mean of those near it, of those near the mean, and so on until it stays where it is.
    for step in 0..8 {
        let slack = (FIRST / f64::from(1 << step)).max(5.0 * SCATTER);
        let (mut count, mut sum, mut squares, mut weights) = (0, 0.0, 0.0, 0.0);
        for ray in &rays {
            let off = wrapped(ray.angle - angle);
            if off.abs() <= grain.most / ray.length + slack {
                let part = off * ray.weight;
                (count, sum, squares) = (count + 1, sum + part, squares + part * part);
                weights += ray.weight;
            }
        }
        if weights <= 0.0 {
            return Skew::Unknown;
        }
        angle = wrapped(angle + sum / weights);
        agreeing = (count, weights, squares.sqrt() / weights);
    }
    let (count, weights, doubt) = agreeing;
    if count < LEAST.0 || weights < all * LEAST.1 || doubt > DOUBT {
        Skew::Unknown
    } else if angle.abs() > FARTHEST {
        Skew::TooFar(angle)
    } else {
        Skew::Turned(angle, (3.0 * doubt).max(LEVEL))
    }
}

impl Ray {
    fn of(edge: &vectorize::Edge, scale: &Scale, noise: f64) -> Self {
        let (x, y) = (edge.way.0 * scale.pixel.0, -edge.way.1 * scale.pixel.1);
        let length = edge.length;
        let variance = 12.0 * noise * noise / (length * length * length) + SCATTER * SCATTER;
        Self { angle: wrapped(libm::atan2(y, x)), weight: 1.0 / variance, length }
    }
}

/// The mean of the angles within a degree of where most weight lies.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a bin of few")]
#[expect(clippy::cast_precision_loss, reason = "a bin of few")]
fn densest(rays: &[Ray]) -> f64 {
    let mut bins = [0.0; BINS];
    for ray in rays {
        let part = ray.angle / FRAC_PI_4 + 0.5;
        bins[((part * BINS as f64) as usize).min(BINS - 1)] += ray.weight;
    }
    let near = |bin: usize| (bin + BINS - NEAR..=bin + BINS + NEAR).map(|other| (other, bins[other % BINS]));
    let weight = |bin: usize| -> f64 { near(bin).map(|(_, weight)| weight).sum() };
    let best = (0..BINS).max_by(|&a, &b| weight(a).total_cmp(&weight(b)).then(b.cmp(&a))).unwrap_or(0);
    let sum: f64 = near(best).map(|(bin, weight)| bin as f64 * weight).sum();
    let bin = sum / f64::max(weight(best), 1.0) - BINS as f64;
    wrapped(((bin + 0.5) / BINS as f64 - 0.5) * FRAC_PI_4)
}

/// An angle from the nearest multiple of 45 degrees.
fn wrapped(angle: f64) -> f64 {
    angle - (angle / FRAC_PI_4).round() * FRAC_PI_4
}
