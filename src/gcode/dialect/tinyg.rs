//! TinyG and its successor g2core.
//!
//! Neither holds at M0 or M6: a tool has a file of its own. G64 is their continuous mode, which
//! keeps within the junction tolerance that is set there.

use std::borrow::Cow::Borrowed;

use super::{
    ArcCheck, Arcs, Comments, Dialect, Dwell, FILES, LineNumbers, Messages, OwnCode, ProbesFrom, RAPID,
    Rapids, SPIN_UP, ToolChange, Touches,
};

/// Why no tool is touched off (`cycle_probing` of both).
const MACHINE_ZERO: &str = "its G38.2 counts from the machine's zero, which no program knows";

/// TinyG. It refuses an arc whose radii differ by a thousandth, and only then asks by how much
/// (plan_arc.c), so it gets a decimal more.
pub(super) const TINYG: Dialect = Dialect {
    name: Borrowed("tinyg"),
    about: Borrowed("TinyG"),
    extension: Borrowed("nc"),
    decimals: 5,
    arcs: Arcs::Center,
    arc_check: ArcCheck::Relative,
    rapids: Rapids::Unfed,
    rapid: RAPID,
    comments: Comments::Parentheses,
    messages: Messages::Hidden,
    dwell: Dwell::SecondsP,
    tool_change: ToolChange::Files,
    changes: FILES,
    pause: Borrowed("M0"),
    spindle: Borrowed("M3"),
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G40 G80 G90 G91.1 G94"), Borrowed("G64")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::ReportedJson,
    probes_from: ProbesFrom::Machine,
    sets_height: None,
    no_probe: Some(Borrowed(MACHINE_ZERO)),
    touch_off: None,
    condition: None,
    own: OwnCode::NONE,
};

/// g2core. Its check of radii is as Grbl's.
pub(super) const G2CORE: Dialect = Dialect {
    name: Borrowed("g2core"),
    about: Borrowed("g2core"),
    extension: Borrowed("nc"),
    decimals: 5,
    arcs: Arcs::Center,
    arc_check: ArcCheck::Absolute,
    rapids: Rapids::Unfed,
    rapid: RAPID,
    comments: Comments::Parentheses,
    messages: Messages::Msg,
    dwell: Dwell::SecondsP,
    tool_change: ToolChange::Files,
    changes: FILES,
    pause: Borrowed("M0"),
    spindle: Borrowed("M3"),
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G40 G80 G90 G91.1 G94"), Borrowed("G64")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::ReportedJson,
    probes_from: ProbesFrom::Machine,
    sets_height: None,
    no_probe: Some(Borrowed(MACHINE_ZERO)),
    touch_off: None,
    condition: None,
    own: OwnCode::NONE,
};
