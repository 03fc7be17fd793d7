//! Drill dots: round bare blobs with copper all round, which are holes, with the diameters that
//! they have.
//!
//! In a pad or in a plane: where a plane has a clearance, a pad or a hole lies in it. Measured with
//! the holes of the boards' drill files drawn into 41 pictures of layers: of 4933 dots up to the
//! widest, 4403 are found if a pad must end near them and 4906 if it need not; of the blobs in the
//! pictures without holes, 7 and 10 are taken for one.

use std::ops::RangeInclusive;

use crate::board::{Hole, Plating};
use crate::geometry::{Nm, Path};
use crate::vectorize::{Contour, Field, Inside};

use super::motion::Place;
use super::scale::Scale;

/// The smallest and the widest dot, in nanometres. Chosen: from vias to terminals; a wider opening
/// is more often a ring or a clearance than the mark for a drill.
const DIAMETERS: RangeInclusive<f64> = 0.25e6..=1.6e6;

/// The narrowest dot, in pixels, and the widest one, in parts of the lower side of the picture,
/// where it is not known how large a pixel is. Chosen.
const PIXELS: (f64, f64) = (4.0, 0.05);

/// How far a dot's edge may leave a circle: a part of its radius, and a part of a pixel.
const ROUNDNESS: (f64, f64) = (0.05, 0.55);

/// How wide the copper round a dot must be at least, as a part of its diameter. Chosen: the stroke
/// of a letter is thinner.
const ANNULUS: f64 = 0.18;

/// Directions in which the copper round a dot is measured.
const WAYS: u32 = 32;

/// Holes, and the contours without theirs.
pub(super) fn part(
    contours: Vec<Contour>,
    field: &Field,
    inside: Inside,
    scale: &Scale,
) -> (Vec<Hole>, Vec<Contour>) {
    let islands = islands(&contours, scale);
    let mut dots = Vec::new();
    let mut left = Vec::with_capacity(contours.len());
    for contour in contours {
        let dot = Dot::of(&contour, scale, &DIAMETERS);
        match dot.filter(|dot| dot.is_empty(&islands) && dot.has_copper_round(field, inside, scale)) {
            Some(dot) => dots.push(dot),
            None => left.push(contour),
        }
    }
    (drilled(dots, scale), left)
}

/// The middles of dots where it is not known how large a pixel is: in the unit of the `scale`,
/// which is about a pixel.
pub(super) fn middles(contours: &[Contour], field: &Field, inside: Inside, scale: &Scale) -> Vec<Place> {
    let islands = islands(contours, scale);
    let (columns, rows) = field.size();
    let diameters = PIXELS.0..=f64::max(columns.min(rows) * PIXELS.1, PIXELS.0);
    let dots = contours.iter().filter_map(|contour| Dot::of(contour, scale, &diameters));
    dots.filter(|dot| dot.is_empty(&islands) && dot.has_copper_round(field, inside, scale))
        .map(|dot| dot.center)
        .collect()
}

/// A place of every island: a blob that holds one is no dot.
fn islands(contours: &[Contour], scale: &Scale) -> Vec<Place> {
    let islands = contours.iter().filter(|contour| scale.area(contour) > 0.0);
    islands.filter_map(|contour| contour.points.first().map(|&p| scale.nanometres(p))).collect()
}

/// Dots of which each differs from the next by less than a quarter of a pixel are of one drill:
/// their mean, to a hundredth of a millimetre.
fn drilled(dots: Vec<Dot>, scale: &Scale) -> Vec<Hole> {
    /// In nanometres. Chosen: drills are sold by tenths of a millimetre.
    const STEP: f64 = 1e4;
    let pixel = scale.longer();
    let mut order: Vec<usize> = (0..dots.len()).collect();
    order.sort_by(|&a, &b| dots[a].radius.total_cmp(&dots[b].radius).then(a.cmp(&b)));
    let mut holes: Vec<Option<Hole>> = vec![None; dots.len()];
    let alike = |&a: &usize, &b: &usize| (dots[b].radius - dots[a].radius) * 2.0 <= pixel / 4.0;
    for (tool, group) in (1..).zip(order.chunk_by(alike)) {
        let (count, sum) =
            group.iter().fold((0.0, 0.0), |(count, sum), &at| (count + 1.0, sum + dots[at].radius * 2.0));
        let diameter = Nm::from_f64((sum / count / STEP).round() * STEP);
        for &at in group {
            holes[at] = Some(dots[at].hole(diameter, tool));
        }
    }
    holes.into_iter().flatten().collect()
}

/// A round blob, in nanometres.
struct Dot {
    center: (f64, f64),
    radius: f64,
}

impl Dot {
    /// The circle that a hole's contour is; none where it is none.
    fn of(contour: &Contour, scale: &Scale, diameters: &RangeInclusive<f64>) -> Option<Self> {
        let area = scale.area(contour) * -1e12;
        let radius = (area.max(0.0) / std::f64::consts::PI).sqrt();
        if !diameters.contains(&(radius * 2.0)) {
            return None;
        }
        let points = || contour.points.iter().map(|&p| scale.nanometres(p));
        let ends = points().zip(points().cycle().skip(1));
        let (mut x, mut y, mut twice) = (0.0, 0.0, 0.0);
        // From a point nearby, so that nothing is lost to large numbers.
        let (x0, y0) = points().next()?;
        for ((ax, ay), (bx, by)) in ends {
            let (ax, ay, bx, by) = (ax - x0, ay - y0, bx - x0, by - y0);
            let cross = ax * by - bx * ay;
            (x, y, twice) = (x + (ax + bx) * cross, y + (ay + by) * cross, twice + cross);
        }
        let center = (x0 + x / (3.0 * twice), y0 + y / (3.0 * twice));
        let most = radius * ROUNDNESS.0 + scale.longer() * ROUNDNESS.1;
        let is_round = points().all(|p| (distance(p, center) - radius).abs() <= most);
        is_round.then_some(Self { center, radius })
    }

    fn is_empty(&self, islands: &[Place]) -> bool {
        islands.iter().all(|&p| distance(p, self.center) > self.radius)
    }

    /// Whether there is copper all round, as wide as a pad has it.
    fn has_copper_round(&self, field: &Field, inside: Inside, scale: &Scale) -> bool {
        let pixel = scale.pixel.0.min(scale.pixel.1);
        let width = self.radius * 2.0 * ANNULUS;
        (0..WAYS).all(|way| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(way) / f64::from(WAYS));
            let is_copper = |reach: f64| {
                let (x, y) = (self.center.0 + cos * reach, self.center.1 + sin * reach);
                inside.holds(field, (x / scale.pixel.0, scale.height - y / scale.pixel.1))
            };
            let mut reach = self.radius + pixel;
            while reach - self.radius < width && is_copper(reach) {
                reach += pixel / 2.0;
            }
            reach - self.radius >= width
        })
    }

    fn hole(&self, diameter: Nm, tool: u32) -> Hole {
        let start = crate::geometry::Point::from_f64(self.center.0, self.center.1);
        Hole {
            path: Path { start, segments: Vec::new() },
            diameter,
            plating: Plating::Unknown,
            tool,
            line: 1,
        }
    }
}

fn distance((ax, ay): (f64, f64), (bx, by): (f64, f64)) -> f64 {
    libm::hypot(ax - bx, ay - by)
}
