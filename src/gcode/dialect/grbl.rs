//! Grbl 1.1 and what grew out of it.
//!
//! They take no canned cycles (grblHAL does), no G64 and no `%` worth writing; a line of Grbl has
//! at most 79 characters once blanks and comments are gone; `?`, `!`, `~` and bytes from 0x80 act
//! at once, even in a comment. At an M0 within a file Grbl holds and answers nothing: no jog, no
//! G10, so that a new drill cannot be touched off, and each tool has a file of its own. M6 is error
//! 20 there, and only written to the log by FluidNC; grblHAL waits at it, and lets the operator jog
//! and set zero (protocol.c of each, system.c and gcode.c of Grbl 1.1h, `$341` of grblHAL).

use std::borrow::Cow::Borrowed;

use super::{
    ArcCheck, Arcs, Comments, Dialect, Dwell, FILES, LineNumbers, Messages, OwnCode, ProbesFrom, RAPID,
    Rapids, SPIN_UP, ToolChange, Touches,
};

/// In laser mode (`$32=1`) the spindle stops on every rapid.
const NO_LASER: &str = "the setting $32 must be 0 - in laser mode the spindle stops on rapids";

/// Grbl 1.1. Its M0 holds, so it may be asked for by who has all tools at one length.
pub(super) const GRBL: Dialect = Dialect {
    name: Borrowed("grbl"),
    about: Borrowed("Grbl 1.1"),
    extension: Borrowed("ngc"),
    decimals: 4,
    arcs: Arcs::Center,
    arc_check: ArcCheck::Absolute,
    rapids: Rapids::Unfed,
    rapid: RAPID,
    comments: Comments::Parentheses,
    messages: Messages::Hidden,
    dwell: Dwell::SecondsP,
    tool_change: ToolChange::Files,
    changes: Borrowed(&[ToolChange::Files, ToolChange::Pause]),
    pause: Borrowed("M0"),
    spindle: Borrowed("M3"),
    line_numbers: LineNumbers::Off,
    longest_line: 79,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G90 G94")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::Reported,
    probes_from: ProbesFrom::Work,
    sets_height: Some(Borrowed("G92")),
    no_probe: None,
    touch_off: None,
    condition: Some(Borrowed(NO_LASER)),
    own: OwnCode::NONE,
};

/// grblHAL.
pub(super) const GRBLHAL: Dialect = Dialect {
    name: Borrowed("grblhal"),
    about: Borrowed("grblHAL, with manual tool changes ($341)"),
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
    longest_line: 79,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G90 G91.1 G94")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::Reported,
    probes_from: ProbesFrom::Work,
    sets_height: Some(Borrowed("G92")),
    no_probe: None,
    touch_off: None,
    condition: Some(Borrowed(NO_LASER)),
    own: OwnCode::NONE,
};

/// `FluidNC`.
pub(super) const FLUIDNC: Dialect = Dialect {
    name: Borrowed("fluidnc"),
    about: Borrowed("FluidNC"),
    extension: Borrowed("ngc"),
    decimals: 4,
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
    longest_line: 79,
    blend: None,
    start: Borrowed(&[Borrowed("G17 G21 G90 G94")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::Reported,
    probes_from: ProbesFrom::Work,
    sets_height: Some(Borrowed("G92")),
    no_probe: None,
    touch_off: None,
    condition: None,
    own: OwnCode::NONE,
};
