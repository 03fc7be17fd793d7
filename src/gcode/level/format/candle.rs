//! Candle's `.map` files.

use super::{Format, Frame, Touch, Touches, content, exact, numbers};
use crate::gcode::level::error::MapError;

/// Candle's `.map`: x, y, width and height of the area; how many columns and rows, the lowest and
/// the highest z that it probes; how it interpolates; then the heights, row by row from the lowest
/// y, all between semicolons.
pub(super) const CANDLE: Format = Format { name: "Candle's height map", recognises, read };

/// The first three lines have four, four and three numbers, the second of them with whole numbers
/// of places.
fn recognises(text: &str) -> bool {
    let mut lines = content(text).map(|(_, line)| line.contains(';').then(|| numbers(line)).flatten());
    let mut next = || lines.next().flatten().unwrap_or_default();
    let (area, grid, interpolation) = (next(), next(), next());
    let is_count = |value: f64| value >= 2.0 && (value - value.round()).abs() < 1e-9;
    area.len() == 4
        && interpolation.len() == 3
        && matches!(grid.as_slice(), [columns, rows, _, _] if is_count(*columns) && is_count(*rows))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "recognised as at least two; `as` saturates, and the rows are counted"
)]
fn read(text: &str, _: &Frame) -> Result<Touches, MapError> {
    let mut lines = content(text);
    let mut head = || lines.next().and_then(|(_, line)| numbers(line)).unwrap_or_default();
    let (area, grid, _) = (head(), head(), head());
    let ([x, y, width, height], [columns, rows, ..]) = (area.as_slice(), grid.as_slice()) else {
        return Err(MapError::Unknown);
    };
    let mut touches = Vec::new();
    for (row, (line, text)) in lines.enumerate() {
        let heights = exact(line, text, &[*columns as usize], "expected as many heights as columns")?;
        let up = y + height * row as f64 / (rows - 1.0);
        touches.extend(
            heights.into_iter().enumerate().map(|(column, z)| Touch {
                line,
                place: [x + width * column as f64 / (columns - 1.0), up, z],
            }),
        );
    }
    let declared = (columns * rows) as usize;
    if touches.len() == declared {
        Ok(touches)
    } else {
        Err(MapError::Count { declared, found: touches.len() })
    }
}
