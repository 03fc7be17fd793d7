//! Tables of coordinates: LinuxCNC's probe logs, and others with x, y and z in columns.

use super::{Format, Touches, content, numbers, touch};
use crate::gcode::level::error::MapError;

/// What LinuxCNC writes between `(PROBEOPEN …)` and `(PROBECLOSE)`: nine coordinates for each
/// touch, x y z a b c u v w, counted from the work's zero in the unit of the program; and any other
/// table of x, y and z alone (`.xyz` of bCNC and Universal Gcode Sender, Mach's logs).
pub(super) const COLUMNS: Format =
    Format { name: "lines of x, y and z, as LinuxCNC logs them", recognises, read };

fn recognises(text: &str) -> bool {
    content(text).next().and_then(|(_, line)| numbers(line)).is_some_and(|numbers| numbers.len() >= 3)
}

fn read(text: &str, _: &super::Frame) -> Result<Touches, MapError> {
    let expected = "expected x, y and z, or the nine columns of LinuxCNC, in every line";
    let mut counts: &[usize] = &[3, 9];
    let mut touches = Vec::new();
    for (line, text) in content(text) {
        touches.push(touch(line, text, counts, expected)?);
        // As many in the next.
        counts = if numbers(text).is_some_and(|numbers| numbers.len() == 9) { &[9] } else { &[3] };
    }
    Ok(touches)
}
