use std::borrow::Cow::Borrowed;

use super::{Arcs, Comments, Dialect, Dwell, LineNumbers, SPIN_UP, ToolChange, Touches};

/// Marlin, as printers with a spindle run it: G4 counts milliseconds in P, M0 shows its text, a comment begins with a semicolon, and
/// there is no M2. M400 waits until everything queued has been done.
pub(super) const MARLIN: Dialect = Dialect {
    name: Borrowed("marlin"),
    about: Borrowed("Marlin 2 with ARC_SUPPORT"),
    extension: Borrowed("gcode"),
    decimals: 4,
    arcs: Arcs::Center,
    comments: Comments::Semicolon,
    dwell: Dwell::MillisecondsP,
    tool_change: ToolChange::PauseWithText,
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: None,
    start: Borrowed(&[Borrowed("G17"), Borrowed("G21"), Borrowed("G90")]),
    end: Borrowed(&[Borrowed("M400")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
};
