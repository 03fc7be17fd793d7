//! Drill files written in Gerber (X2 file function `Plated` or `NonPlated`): flashes are holes,
//! strokes are slots, and so are flashes of obrounds, as which KiCad writes slots that are turned.

use crate::board::diagnostic::count;
use crate::board::{Axis, FLATTEN, Feature, Hole, Shape, Warning};
use crate::geometry::{Nm, Path, Point, Polygon, Segment, distance_to_segment};
use crate::import::diagnostic;

use super::archive::Found;
use super::gerber::Image;
use super::layers;

/// The holes that `image`, read from `file`, draws; and a warning for what is no hole.
pub(super) fn holes(file: &Found, image: &Image) -> (Vec<Hole>, Option<Warning>) {
    let plating = layers::plating(image.function.as_deref(), &file.name);
    let mut sizes: Vec<Nm> = image.features.iter().filter_map(cutter).map(|(_, size)| size).collect();
    sizes.sort();
    sizes.dedup();
    let mut holes = Vec::new();
    let mut left_out = None::<(usize, Point, u32)>;
    for feature in &image.features {
        let Some((path, diameter)) = cutter(feature) else {
            let (shapes, at, line) = left_out.unwrap_or((0, feature.shape.bounds().min(), feature.line));
            left_out = Some((shapes + 1, at, line));
            continue;
        };
        let tool = sizes.binary_search(&diameter).ok().and_then(|i| u32::try_from(i + 1).ok()).unwrap_or(0);
        holes.push(Hole { path, diameter, plating, tool, line: feature.line });
    }
    let warning = left_out.map(|(shapes, at, line)| {
        let message = format!(
            "neither round nor obround, and so not drilled: {} of the drill file {}",
            count(shapes, "shape"),
            file.name
        );
        diagnostic::NOT_A_HOLE.warning(message).at(at).caused_by(file.at_line(line))
    });
    (holes, warning)
}

/// Whether all that `image` draws are flashes that are drilled: drawings of holes have lines and
/// letters.
pub(super) fn is_all_flashes(image: &Image) -> bool {
    let is_hole = |feature: &Feature| matches!(feature.axis, Axis::Flash(_)) && cutter(feature).is_some();
    image.features.iter().all(is_hole)
}

/// The way and the diameter of the round cutter that makes a feature; none where no such cutter
/// does.
fn cutter(feature: &Feature) -> Option<(Path, Nm)> {
    let (path, radius) = match (&feature.shape, &feature.axis) {
        (Shape::Disc { center, radius }, _) => (Path { start: *center, segments: vec![] }, *radius),
        (Shape::Stroke { from, to, radius }, _) => {
            (Path { start: *from, segments: vec![Segment::Line { to: *to }] }, *radius)
        }
        (Shape::Arc { arc, radius }, _) => {
            let segment = Segment::Arc { to: arc.end, center: arc.center, turn: arc.turn };
            (Path { start: arc.start, segments: vec![segment] }, *radius)
        }
        (Shape::Polygon(polygon), Axis::Flash(_)) => obround(polygon)?,
        (Shape::Polygon(_), Axis::Line(..) | Axis::Arc(_) | Axis::Region) => return None,
    };
    (radius > Nm::ZERO).then_some((path, radius * 2))
}

/// The middle and half the width of the obround that `polygon` is: a macro of two discs and what
/// lies between.
fn obround(polygon: &Polygon) -> Option<(Path, Nm)> {
    // How far vertices may be off: where chords cross they lie within the arc.
    let off = 2.0 * FLATTEN.to_f64();
    let ([ring], &[from, to]) = (polygon.contours(), polygon.circles()) else { return None };
    let ends = (from.center, to.center);
    let is_on = |&p: &Point| (distance_to_segment(p, ends) - from.radius.to_f64()).abs() < off;
    let segments = vec![Segment::Line { to: to.center }];
    (from.radius == to.radius && ring.iter().all(is_on))
        .then_some((Path { start: from.center, segments }, from.radius))
}
