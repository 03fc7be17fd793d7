use std::borrow::Cow::Borrowed;

use super::{Arcs, Comments, Dialect, Dwell, LineNumbers, SPIN_UP, ToolChange, Touches};

/// TinyG and g2core. G64 is their continuous mode, which keeps within the junction tolerance that is set there.
pub(super) const TINYG: Dialect = Dialect {
    name: Borrowed("tinyg"),
    about: Borrowed("TinyG and g2core"),
    extension: Borrowed("nc"),
    decimals: 4,
    arcs: Arcs::Center,
    comments: Comments::Parentheses,
    dwell: Dwell::SecondsP,
    tool_change: ToolChange::Pause,
    line_numbers: LineNumbers::Off,
    longest_line: 100,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G40 G80 G90 G94"), Borrowed("G64")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
};
