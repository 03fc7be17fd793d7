//! LinuxCNC as data.

use std::borrow::Cow::Borrowed;

use crate::geometry::Nm;

use super::{
    ArcCheck, Arcs, Blend, Comments, Dialect, Dwell, LineNumbers, Messages, OwnCode, ProbesFrom, RAPID,
    Rapids, SPIN_UP, ToolChange, Touches,
};

/// LinuxCNC. G64 with a tolerance lets it blend corners by at most 5 µm, instead of stopping at
/// each or rounding without bound.
pub(super) const LINUXCNC: Dialect = Dialect {
    name: Borrowed("linuxcnc"),
    about: Borrowed("LinuxCNC 2.8 and later"),
    extension: Borrowed("ngc"),
    decimals: 4,
    arcs: Arcs::Center,
    arc_check: ArcCheck::Absolute,
    rapids: Rapids::Unfed,
    rapid: RAPID,
    comments: Comments::Parentheses,
    messages: Messages::Msg,
    dwell: Dwell::SecondsP,
    tool_change: ToolChange::M6,
    changes: Borrowed(&[ToolChange::M6, ToolChange::Files, ToolChange::Pause]),
    pause: Borrowed("M0"),
    spindle: Borrowed("M3"),
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: Some(Blend::Within(Nm::from_um(5))),
    start: Borrowed(&[Borrowed("G17 G21 G40 G49 G80 G90 G91.1 G94")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::Logged,
    probes_from: ProbesFrom::Work,
    sets_height: Some(Borrowed("G10 L20 P0")),
    no_probe: None,
    touch_off: None,
    condition: None,
    own: OwnCode::NONE,
};
