//! Mach3 and Mach4.

use std::borrow::Cow::Borrowed;

use super::{
    ArcCheck, Arcs, Comments, Dialect, Dwell, LineNumbers, Messages, OwnCode, ProbesFrom, RAPID, Rapids,
    SPIN_UP, ToolChange, Touches,
};

/// Why its programs do not probe.
const G31: &str = "it probes with G31, and only a macro reads the probed point";

/// Mach3. G91.1 because its own default for centres is a setting; G64 without a tolerance, which it
/// does not know, would round corners by the feed, so it runs in exact stop. M30 rewinds; no file
/// is lost by it. Whether G4 counts seconds is a setting too.
pub(super) const MACH3: Dialect = Dialect {
    name: Borrowed("mach3"),
    about: Borrowed("Mach3"),
    extension: Borrowed("tap"),
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
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G40 G49 G80 G90 G91.1 G94"), Borrowed("G61")]),
    end: Borrowed(&[Borrowed("M30")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
    probes_from: ProbesFrom::Work,
    sets_height: None,
    no_probe: Some(Borrowed(G31)),
    touch_off: None,
    condition: Some(Borrowed("G4 must count seconds and M6 must stop: both are settings of the controller")),
    own: OwnCode::NONE,
};

/// Mach4, which reads the same words.
pub(super) const MACH4: Dialect = Dialect {
    name: Borrowed("mach4"),
    about: Borrowed("Mach4"),
    extension: Borrowed("tap"),
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
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G40 G49 G80 G90 G91.1 G94"), Borrowed("G61")]),
    end: Borrowed(&[Borrowed("M30")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
    probes_from: ProbesFrom::Work,
    sets_height: None,
    no_probe: Some(Borrowed(G31)),
    touch_off: None,
    condition: Some(Borrowed("G4 must count seconds and M6 must stop: both are settings of the controller")),
    own: OwnCode::NONE,
};
