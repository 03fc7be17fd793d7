use std::borrow::Cow::Borrowed;

use super::{Arcs, Comments, Dialect, Dwell, LineNumbers, SPIN_UP, ToolChange, Touches};

/// Mach3. G91.1 because its own default for centres is a setting; G64 without a tolerance, which it does not know, would
/// round corners by the feed, so it runs in exact stop.
pub(super) const MACH3: Dialect = Dialect {
    name: Borrowed("mach3"),
    about: Borrowed("Mach3 and Mach4"),
    extension: Borrowed("tap"),
    decimals: 4,
    arcs: Arcs::Center,
    comments: Comments::Parentheses,
    dwell: Dwell::SecondsP,
    tool_change: ToolChange::M6,
    line_numbers: LineNumbers::Off,
    longest_line: 100,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G40 G49 G80 G90 G91.1 G94"), Borrowed("G61")]),
    end: Borrowed(&[Borrowed("M30")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
};
