//! Smoothieware as data.

use std::borrow::Cow::Borrowed;

use super::{
    ArcCheck, Arcs, Comments, Dialect, Dwell, LineNumbers, Messages, OwnCode, ProbesFrom, RAPID, Rapids,
    SPIN_UP, ToolChange, Touches,
};

/// Smoothieware. Its G4 takes P in seconds or milliseconds by a setting, S always in seconds; its
/// arcs cut corners by another setting, so arcs are written as lines. G0 has a feed of its own, 100
/// mm/min until a G0 says another. It answers M0, M1 and M6 with ok and goes on, with the drill
/// that is in: a tool has a file of its own, and who wants a program to wait gets M600, which
/// suspends it until M601.
pub(super) const SMOOTHIEWARE: Dialect = Dialect {
    name: Borrowed("smoothieware"),
    about: Borrowed("Smoothieware, its CNC build"),
    extension: Borrowed("gcode"),
    decimals: 4,
    arcs: Arcs::Lines,
    arc_check: ArcCheck::Absolute,
    rapids: Rapids::FirstFed,
    rapid: RAPID,
    comments: Comments::Semicolon,
    messages: Messages::Hidden,
    dwell: Dwell::SecondsS,
    tool_change: ToolChange::Files,
    changes: Borrowed(&[ToolChange::Files, ToolChange::Pause]),
    pause: Borrowed("M600"),
    spindle: Borrowed("M3"),
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G90 G94")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::Reported,
    probes_from: ProbesFrom::Here,
    sets_height: None,
    no_probe: Some(Borrowed("how its programs could set zero after touching off is not known")),
    touch_off: None,
    condition: None,
    own: OwnCode::NONE,
};
