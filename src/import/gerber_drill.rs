//! Drill files written in Gerber (X2 file function `Plated` or `NonPlated`): flashes are holes,
//! strokes are slots.

use crate::board::{Axis, Feature, Hole, Shape, Warning};
use crate::geometry::{Nm, Path, Point, Segment};
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
    let mut left_out = None::<(u32, Point, u32)>;
    for feature in &image.features {
        let Some((path, diameter)) = cutter(feature) else {
            let (count, at, line) = left_out.unwrap_or((0, feature.shape.bounds().min(), feature.line));
            left_out = Some((count + 1, at, line));
            continue;
        };
        let tool = sizes.binary_search(&diameter).ok().and_then(|i| u32::try_from(i + 1).ok()).unwrap_or(0);
        holes.push(Hole { path, diameter, plating, tool, line: feature.line });
    }
    let warning = left_out.map(|(count, at, line)| {
        let message = format!(
            "{count} shapes of the drill file {} are neither round nor obround and are not drilled",
            file.name
        );
        diagnostic::NOT_A_HOLE.warning(message).at(at).caused_by(file.at_line(line))
    });
    (holes, warning)
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
        (Shape::Polygon(_), Axis::Flash(_) | Axis::Line(..) | Axis::Arc(_) | Axis::Region) => return None,
    };
    (radius > Nm::ZERO).then_some((path, radius * 2))
}
