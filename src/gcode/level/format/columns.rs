use super::{Format, Touches, numbers, point, said};
use crate::gcode::level::error::MapError;

/// What LinuxCNC writes between `(PROBEOPEN …)` and `(PROBECLOSE)`: nine coordinates for each touch, x y z a b c u v w, counted from the
/// work's zero in the unit of the program; and any other table whose first columns are x, y and z (bCNC's `.xyz`).
pub(super) const COLUMNS: Format =
    Format { name: "lines of x, y and z, as LinuxCNC logs them", recognises, read };

fn recognises(text: &str) -> bool {
    said(text).next().and_then(|(_, line)| numbers(line)).is_some_and(|numbers| numbers.len() >= 3)
}

fn read(text: &str, _: &super::Frame) -> Result<Touches, MapError> {
    said(text).map(|(line, text)| point(line, text)).collect()
}
