use std::borrow::Cow::Borrowed;

use super::{Arcs, Comments, Dialect, Dwell, LineNumbers, SPIN_UP, ToolChange, Touches};

/// Smoothieware. Its G4 takes P in seconds or milliseconds by a setting, S always in seconds; its arcs cut corners by
/// another setting, so arcs are written as lines.
pub(super) const SMOOTHIEWARE: Dialect = Dialect {
    name: Borrowed("smoothieware"),
    about: Borrowed("Smoothieware, its CNC build"),
    extension: Borrowed("gcode"),
    decimals: 4,
    arcs: Arcs::Lines,
    comments: Comments::Semicolon,
    dwell: Dwell::SecondsS,
    tool_change: ToolChange::Pause,
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G90")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
};
