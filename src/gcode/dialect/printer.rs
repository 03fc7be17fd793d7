//! Firmwares of printers that carry a spindle: Marlin, RepRapFirmware and Klipper.
//!
//! They share one feed between G0 and G1, so every rapid says its own and the cut after it repeats
//! its. A comment begins with a semicolon. Marlin and Klipper read one command a line, make arcs of
//! chords of a millimetre (unless they are set otherwise), so they get lines, and know no M2; M400
//! waits until everything queued has been done. In Marlin and RepRapFirmware M30 deletes a file. M0
//! ends a job in RepRapFirmware and is unknown to Klipper, so that each tool has a file of its own;
//! in Marlin it waits, but only for a button.

use std::borrow::Cow::Borrowed;

use super::{
    ArcCheck, Arcs, Comments, Dialect, Dwell, FILES, LineNumbers, Messages, OwnCode, ProbesFrom, RAPID,
    Rapids, SPIN_UP, ToolChange, Touches,
};

/// Marlin 2. Its G4 counts milliseconds in P and seconds in S; its M0 shows the text behind it.
pub(super) const MARLIN: Dialect = Dialect {
    name: Borrowed("marlin"),
    about: Borrowed("Marlin 2 with SPINDLE_FEATURE"),
    extension: Borrowed("gcode"),
    decimals: 4,
    arcs: Arcs::Lines,
    arc_check: ArcCheck::Absolute,
    rapids: Rapids::Fed,
    rapid: RAPID,
    comments: Comments::Semicolon,
    messages: Messages::Hidden,
    dwell: Dwell::SecondsS,
    tool_change: ToolChange::Files,
    changes: Borrowed(&[ToolChange::Files, ToolChange::PauseWithText]),
    pause: Borrowed("M0"),
    spindle: Borrowed("M3"),
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: None,
    start: Borrowed(&[Borrowed("G17"), Borrowed("G21"), Borrowed("G90")]),
    end: Borrowed(&[Borrowed("M400")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
    probes_from: ProbesFrom::Work,
    sets_height: None,
    no_probe: Some(Borrowed(
        "only some builds of it know G38.2, none reports the probed point, and G10 retracts filament",
    )),
    touch_off: None,
    condition: Some(Borrowed("Marlin must be built with SPINDLE_FEATURE, S in turns per minute")),
    own: OwnCode::NONE,
};

/// `RepRapFirmware` 3. Without a tool that has a spindle M3 must name one.
pub(super) const REPRAPFIRMWARE: Dialect = Dialect {
    name: Borrowed("reprapfirmware"),
    about: Borrowed("RepRapFirmware 3 (Duet)"),
    extension: Borrowed("gcode"),
    decimals: 4,
    arcs: Arcs::Center,
    arc_check: ArcCheck::Absolute,
    rapids: Rapids::Fed,
    rapid: RAPID,
    comments: Comments::Semicolon,
    messages: Messages::Hidden,
    dwell: Dwell::SecondsS,
    tool_change: ToolChange::Files,
    changes: FILES,
    pause: Borrowed("M0"),
    spindle: Borrowed("M3 P0"),
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: None,
    start: Borrowed(&[Borrowed("G17"), Borrowed("G21"), Borrowed("G90"), Borrowed("G94")]),
    end: Borrowed(&[Borrowed("M2")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
    probes_from: ProbesFrom::Work,
    sets_height: None,
    no_probe: Some(Borrowed("it does not report the point that G38.2 probed")),
    touch_off: None,
    condition: Some(Borrowed("the spindle must be number 0 [M950 R0]")),
    own: OwnCode::NONE,
};

/// Klipper. G4 counts milliseconds; M3 and M5 are what its configuration makes of them.
pub(super) const KLIPPER: Dialect = Dialect {
    name: Borrowed("klipper"),
    about: Borrowed("Klipper with macros M3 and M5"),
    extension: Borrowed("gcode"),
    decimals: 4,
    arcs: Arcs::Lines,
    arc_check: ArcCheck::Absolute,
    rapids: Rapids::Fed,
    rapid: RAPID,
    comments: Comments::Semicolon,
    messages: Messages::Hidden,
    dwell: Dwell::MillisecondsP,
    tool_change: ToolChange::Files,
    changes: FILES,
    pause: Borrowed("M0"),
    spindle: Borrowed("M3"),
    line_numbers: LineNumbers::Off,
    longest_line: 90,
    blend: None,
    start: Borrowed(&[Borrowed("G21"), Borrowed("G90")]),
    end: Borrowed(&[Borrowed("M400")]),
    coolant: None,
    spin_up: SPIN_UP,
    touches: Touches::None,
    probes_from: ProbesFrom::Work,
    sets_height: None,
    no_probe: Some(Borrowed("it knows no G38.2")),
    touch_off: None,
    condition: Some(Borrowed("macros must make M3 S and M5 turn the spindle on and off")),
    own: OwnCode::NONE,
};
