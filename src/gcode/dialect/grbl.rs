use std::borrow::Cow::Borrowed;

use super::{Arcs, Comments, Dialect, Dwell, LineNumbers, SPIN_UP, ToolChange, Touches};

/// Grbl 1.1. It takes no `%`, no canned cycles, no G64 and no M6; a line has at most 79 characters once blanks and comments
/// are gone; `?`, `!`, `~` and bytes from 0x80 act at once, even in a comment.
pub(super) const GRBL: Dialect = Dialect {
    name: Borrowed("grbl"),
    about: Borrowed("Grbl 1.1 and its relatives"),
    extension: Borrowed("ngc"),
    decimals: 4,
    arcs: Arcs::Center,
    comments: Comments::Parentheses,
    dwell: Dwell::SecondsP,
    tool_change: ToolChange::Pause,
    line_numbers: LineNumbers::Off,
    longest_line: 79,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G90 G94")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::Reported,
};
