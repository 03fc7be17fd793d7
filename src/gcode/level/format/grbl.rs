//! Logs of senders to Grbl, with its `[PRB:…]` reports.

use super::{Format, Frame, Touch, Touches, numbers};
use crate::gcode::level::error::MapError;

/// The log of a sender to Grbl: `[PRB:x,y,z:1]` for each touch, from the machine's zero; a status
/// report with `WCO:x,y,z` says where the work's zero is. So report grblHAL, FluidNC and
/// Smoothieware, and so does Universal Gcode Sender keep them.
pub(super) const GRBL: Format = Format { name: "a log with Grbl's [PRB:…] lines", recognises, read };

const REPORT: &str = "[PRB:";
const ZERO: &str = "WCO:";

fn recognises(text: &str) -> bool {
    text.contains(REPORT)
}

/// A probe that went down and touched nothing is dropped: a place that stays untouched is a hole of
/// the grid. The zero of a touch is the one reported last before it, or else the first after it.
fn read(text: &str, frame: &Frame) -> Result<Touches, MapError> {
    let mut zero = text.lines().find_map(zero_in);
    let mut points = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        zero = zero_in(line).or(zero);
        let Some((_, report)) = line.split_once(REPORT) else { continue };
        let wrong = |expected| MapError::Line { line: number, text: line.trim().to_owned(), expected };
        let (place, touched) = report
            .split_once(']')
            .and_then(|(report, _)| report.split_once(':'))
            .and_then(|(place, touched)| Some((triple(place)?, touched)))
            .ok_or_else(|| wrong("expected [PRB:x,y,z:1]"))?;
        match touched {
            "1" => {}
            "0" => continue,
            _ => return Err(wrong("expected [PRB:x,y,z:1], or 0 for a probe that touched nothing")),
        }
        let zero = match (frame.zero, zero) {
            (Some(_), _) => [0.0; 3],
            (None, Some(zero)) => zero,
            (None, None) => return Err(MapError::Zero { line: number }),
        };
        points.push(Touch { line: number, place: [0, 1, 2].map(|axis| place[axis] - zero[axis]) });
    }
    Ok(points)
}

/// The work's zero that a status report names: `<Idle|MPos:…|WCO:0.000,1.000,2.000>`.
fn zero_in(line: &str) -> Option<[f64; 3]> {
    let (_, rest) = line.split_once(ZERO)?;
    triple(rest.split(['|', '>']).next()?)
}

fn triple(text: &str) -> Option<[f64; 3]> {
    let numbers = numbers(text)?;
    Some([*numbers.first()?, *numbers.get(1)?, *numbers.get(2)?])
}
