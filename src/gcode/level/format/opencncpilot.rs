//! OpenCNCPilot's `.hmap` files.

use roxmltree::{Document, Node};

use super::{Format, Frame, Touch, Touches, numbers};
use crate::gcode::level::error::MapError;

/// OpenCNCPilot's `.hmap`: `<heightmap MinX MinY MaxX MaxY SizeX SizeY>` with a `<point X Y>` for
/// each touch, whose X and Y count columns and rows from 0 and whose text is the height. Places not
/// yet touched are left out.
pub(super) const OPENCNCPILOT: Format = Format { name: "OpenCNCPilot's height map", recognises, read };

fn recognises(text: &str) -> bool {
    text.contains("<heightmap")
}

fn read(text: &str, _: &Frame) -> Result<Touches, MapError> {
    let document = Document::parse(text.trim_start_matches('\u{feff}'))
        .map_err(|error| MapError::Xml(error.to_string()))?;
    let map = document.root_element();
    let axis = |least, most, count| {
        let (least, most, count) = (number(map, least)?, number(map, most)?, number(map, count)?);
        if count < 2.0 {
            return Err(wrong(map, "expected at least two columns and two rows in SizeX and SizeY"));
        }
        Ok::<_, MapError>((least, (most - least) / (count - 1.0), count))
    };
    let (x, y) = (axis("MinX", "MaxX", "SizeX")?, axis("MinY", "MaxY", "SizeY")?);
    let points = map.children().filter(|node| node.has_tag_name("point"));
    let points: Vec<_> = points
        .map(|node| {
            let height = node.text().and_then(one).ok_or_else(|| wrong(node, "expected a height"))?;
            let place = |name, (least, step, _): (f64, f64, f64)| Ok(least + step * number(node, name)?);
            Ok::<_, MapError>(Touch { line: line(node), place: [place("X", x)?, place("Y", y)?, height] })
        })
        .collect::<Result<_, _>>()?;
    complete(points, x.2 * y.2)
}

/// The points, if there are as many as the map is large.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates; only compared")]
fn complete(points: Touches, declared: f64) -> Result<Touches, MapError> {
    let declared = declared as usize;
    if points.len() == declared { Ok(points) } else { Err(MapError::Count { declared, found: points.len() }) }
}

fn number(node: Node<'_, '_>, name: &'static str) -> Result<f64, MapError> {
    let value = node.attribute(name).and_then(one);
    value.ok_or_else(|| wrong(node, "expected numbers in MinX, MinY, MaxX, MaxY, SizeX, SizeY, X and Y"))
}

fn one(text: &str) -> Option<f64> {
    numbers(text).and_then(|numbers| <[f64; 1]>::try_from(numbers).ok()).map(|[value]| value)
}

fn line(node: Node<'_, '_>) -> usize {
    node.document().text_pos_at(node.range().start).row as usize
}

fn wrong(node: Node<'_, '_>, expected: &'static str) -> MapError {
    let line = line(node);
    let text = node.document().input_text()[node.range()].lines().next().unwrap_or_default().to_owned();
    MapError::Line { line, text, expected }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    #[test]
    fn a_map_of_one_row_is_refused() {
        let map = |size: u32| {
            format!(
                "<heightmap MinX=\"0\" MinY=\"0\" MaxX=\"20\" MaxY=\"75\" SizeX=\"2\" SizeY=\"{size}\">\n\
                 <point X=\"0\" Y=\"0\">0</point><point X=\"1\" Y=\"0\">0</point>\n\
                 <point X=\"0\" Y=\"1\">0</point><point X=\"1\" Y=\"1\">0.1</point></heightmap>"
            )
        };
        let frame = Frame { unit: Nm::from_mm(1), zero: None };
        assert_eq!(read(&map(2), &frame).expect("a map").len(), 4, "two rows");
        let error = read(&map(1), &frame).expect_err("the way between its rows would be infinite");
        assert!(error.to_string().contains("at least two"), "{error}");
    }
}
