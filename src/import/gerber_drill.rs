//! Drill files written in Gerber (X2 file function `Plated` or `NonPlated`): flashes are holes, strokes are slots.

use crate::board::{Axis, Feature, Hole, Shape, Warning};
use crate::geometry::{Nm, Path, Point, Segment};

use super::gerber::Image;
use super::layers;

/// The holes that `image`, read from the file `name`, draws; and a warning for what is no hole.
pub(super) fn holes(name: &str, image: &Image) -> (Vec<Hole>, Option<Warning>) {
    let plating = layers::plating(image.function.as_deref(), name);
    let mut sizes: Vec<Nm> = image.features.iter().filter_map(cutter).map(|(_, size)| size).collect();
    sizes.sort();
    sizes.dedup();
    let mut holes = Vec::new();
    let mut left_out = None::<(u32, Point)>;
    for feature in &image.features {
        let Some((path, diameter)) = cutter(feature) else {
            let at = feature.shape.bounds().min();
            left_out = Some(left_out.map_or((1, at), |(count, first)| (count + 1, first)));
            continue;
        };
        let tool = sizes.binary_search(&diameter).ok().and_then(|i| u32::try_from(i + 1).ok()).unwrap_or(0);
        holes.push(Hole { path, diameter, plating, tool, line: feature.line });
    }
    let warning = left_out.map(|(count, at)| {
        let message = format!(
            "{count} shapes of the drill file {name} are neither round nor obround, so no drill makes them"
        );
        Warning::new("not-a-hole", message).at(at)
    });
    (holes, warning)
}

/// The way and the diameter of the round cutter that makes a feature; none where no such cutter does.
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
