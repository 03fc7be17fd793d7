//! Logs of senders to TinyG and g2core, with their JSON probe reports.

use super::{Format, Frame, Touch, Touches};
use crate::gcode::level::error::MapError;

/// The log of a sender to TinyG or g2core: `{"prb":{"e":1,"x":…,"y":…,"z":…}}` for each touch, from
/// the machine's zero.
pub(super) const JSON: Format = Format { name: "a log with TinyG's {\"prb\":…} lines", recognises, read };

const REPORT: &str = "\"prb\"";
const EXPECTED: &str = "expected {\"prb\":{\"e\":1,\"x\":1,\"y\":2,\"z\":3}}";
/// What is expected of a report with z alone.
const AXES: &str = "expected x and y, too: g2core reports the axis that moved alone; send it {\"prb\":null} after each touch, and keep the answer";

fn recognises(text: &str) -> bool {
    text.contains(REPORT)
}

/// A touch that found nothing has `e` 0, and is dropped: a place that stays untouched is a hole of
/// the grid. g2core reports the one axis that moved (`cycle_probing.cpp`, 03f725a); such a report
/// is passed over where the next has them all, as the answer to `{"prb":null}` has.
fn read(text: &str, frame: &Frame) -> Result<Touches, MapError> {
    let mut touches = Vec::new();
    let mut partial: Option<MapError> = None;
    for (line, text) in (1..).zip(text.lines()).filter(|(_, text)| text.contains(REPORT)) {
        let wrong = |expected| MapError::Line { line, text: text.trim().to_owned(), expected };
        let start = text.find('{').ok_or_else(|| wrong(EXPECTED))?;
        let mut values = serde_json::Deserializer::from_str(&text[start..]).into_iter();
        let value: serde_json::Value = values.next().and_then(Result::ok).ok_or_else(|| wrong(EXPECTED))?;
        // A response to a command has it within.
        let report = [value.pointer("/prb"), value.pointer("/r/prb")].into_iter().flatten().next();
        let report = report.ok_or_else(|| wrong(EXPECTED))?;
        let number = |key: &str| report.get(key).and_then(serde_json::Value::as_f64);
        if number("e").ok_or_else(|| wrong(EXPECTED))? < 0.5 {
            continue;
        }
        let place = match (number("x"), number("y"), number("z")) {
            (Some(x), Some(y), Some(z)) => [x, y, z],
            (_, _, Some(_)) => match partial.replace(wrong(AXES)) {
                Some(before) => return Err(before),
                None => continue,
            },
            _ => return Err(wrong(EXPECTED)),
        };
        partial = None;
        if frame.zero.is_none() {
            return Err(MapError::Zero { line });
        }
        if !place.iter().all(|value| value.abs() < 1e6) {
            return Err(wrong(EXPECTED));
        }
        touches.push(Touch { line, place });
    }
    partial.map_or(Ok(touches), Err)
}
