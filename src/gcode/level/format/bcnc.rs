//! bCNC's `.probe` files.

use super::{Format, Touches, content, numbers, touch};
use crate::gcode::level::error::MapError;

/// bCNC's `.probe`: `xmin xmax xn`, `ymin ymax yn`, `zmin zmax feed`, then x, y and z of every
/// touch.
pub(super) const BCNC: Format = Format { name: "bCNC's probe file", recognises, read };

/// The first two lines are ranges with a number of places each.
fn recognises(text: &str) -> bool {
    let mut lines = content(text).map(|(_, line)| numbers(line));
    let mut range = || match lines.next().flatten().as_deref() {
        Some([least, most, count]) => least < most && *count >= 2.0 && (count - count.round()).abs() < 1e-9,
        _ => false,
    };
    range() && range()
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "recognised as at least two; `as` saturates"
)]
fn read(text: &str, _: &super::Frame) -> Result<Touches, MapError> {
    let mut lines = content(text);
    let count =
        lines.by_ref().take(2).filter_map(|(_, line)| numbers(line)?.last().copied()).product::<f64>();
    // How deep and how fast it was probed.
    lines.next();
    let points: Vec<_> =
        lines.map(|(line, text)| touch(line, text, &[3], "expected x, y and z")).collect::<Result<_, _>>()?;
    if points.len() == count as usize {
        Ok(points)
    } else {
        Err(MapError::Count { declared: count as usize, found: points.len() })
    }
}
