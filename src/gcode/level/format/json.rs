//! Logs of senders to TinyG and g2core, with their JSON probe reports.

use super::{Format, Frame, Touch, Touches};
use crate::gcode::level::error::MapError;

/// The log of a sender to TinyG or g2core: `{"prb":{"e":1,"x":…,"y":…,"z":…}}` for each touch, from
/// the machine's zero.
pub(super) const JSON: Format = Format { name: "a log with TinyG's {\"prb\":…} lines", recognises, read };

const REPORT: &str = "\"prb\"";

fn recognises(text: &str) -> bool {
    text.contains(REPORT)
}

/// A touch that found nothing has `e` 0, and is dropped: a place that stays untouched is a hole of
/// the grid.
fn read(text: &str, frame: &Frame) -> Result<Touches, MapError> {
    let mut touches = Vec::new();
    for (line, text) in (1..).zip(text.lines()).filter(|(_, text)| text.contains(REPORT)) {
        let wrong = || MapError::Line {
            line,
            text: text.trim().to_owned(),
            expected: "expected {\"prb\":{\"e\":1,\"x\":1,\"y\":2,\"z\":3}}",
        };
        let start = text.find('{').ok_or_else(wrong)?;
        let mut values = serde_json::Deserializer::from_str(&text[start..]).into_iter();
        let value: serde_json::Value = values.next().and_then(Result::ok).ok_or_else(wrong)?;
        // A response to a command has it within.
        let report = [value.pointer("/prb"), value.pointer("/r/prb")].into_iter().flatten().next();
        let report = report.ok_or_else(wrong)?;
        let number = |key: &str| report.get(key).and_then(serde_json::Value::as_f64);
        let place = (number("x"), number("y"), number("z"));
        let (Some(touched), (Some(x), Some(y), Some(z))) = (number("e"), place) else { return Err(wrong()) };
        if touched < 0.5 {
            continue;
        }
        if frame.zero.is_none() {
            return Err(MapError::Zero { line });
        }
        let is_sane = |value: f64| value.abs() < 1e6;
        if ![x, y, z].into_iter().all(is_sane) {
            return Err(wrong());
        }
        touches.push(Touch { line, place: [x, y, z] });
    }
    Ok(touches)
}
