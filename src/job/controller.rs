//! What the machine speaks, with what the options say differs.

use crate::board::Words;
use crate::gcode::Dialect;
use crate::gcode::dialect::{self, OwnCode, ToolChange, TouchOff};
use crate::geometry::{Nm, Point};
use crate::toolpath::Feed;

use super::Error;
use super::checked::travel_height;
use super::options::Complete;
use super::own_lines::OwnLines;
use super::quantity::{Length, Triple, Wait};

/// `base`, with what the options say differs.
pub(super) fn dialect(options: &Complete, base: Dialect) -> Result<Dialect, Error> {
    let tool_change = options.tool_change.unwrap_or(base.tool_change);
    if !base.changes.contains(&tool_change) {
        return Err(Error::Value { key: "tool-change", problem: unheld(tool_change, &base) });
    }
    if options.at_tool_change.is_some() && tool_change == ToolChange::Files {
        let problem = format!(
            "with the dialect {} each tool has a file of its own, and no program has a tool change",
            base.name
        );
        return Err(Error::Value { key: "at-tool-change", problem });
    }
    let lines = |own: Option<&OwnLines>| own.map_or_else(Vec::new, |own| own.lines().to_vec());
    let touch_off = options.tool_probe.map(|plate| touch_off(plate, options, &base)).transpose()?;
    Ok(Dialect {
        touch_off,
        own: OwnCode {
            before: lines(options.before.as_ref()),
            at_tool_change: lines(options.at_tool_change.as_ref()),
            after: lines(options.after.as_ref()),
        },
        spin_up: options.spin_up.map_or(base.spin_up, |Wait { milliseconds }| milliseconds),
        rapid: rapids(options).unwrap_or(base.rapid),
        tool_change,
        blend: base.blend.map(|own| options.blend.unwrap_or(own)),
        ..base
    })
}

/// How fast a person's machine goes level and straight up or down, for programs that must say it;
/// none where its profile does not.
fn rapids(options: &Complete) -> Option<[Feed; 2]> {
    let profile = options.machine.as_ref().filter(|machine| machine.0.rapid.is_some())?;
    let machine = profile.0.machine();
    Some([machine.level_rapid(), machine.rapid[2]])
}

/// The plate that tools touch, for a controller whose programs can.
fn touch_off(Triple([x, y, z]): Triple, options: &Complete, base: &Dialect) -> Result<TouchOff, Error> {
    let wrong = |problem| Err(Error::Value { key: "tool-probe", problem });
    if base.sets_height.is_none() {
        let reason =
            base.no_probe.as_deref().unwrap_or("no command is known that sets zero after touching off");
        let known = dialect::ALL.iter().filter(|dialect| dialect.sets_height.is_some());
        let known: Vec<&str> = known.map(|dialect| dialect.name.as_ref()).collect();
        return wrong(format!(
            "{} cannot touch off a tool within a program: {reason}; expected {}, or touch off by hand",
            base.name,
            known.join(" or ")
        ));
    }
    let safe = travel_height("safe-z", options.safe_z)?;
    if z.nm() < Nm::ZERO || z.nm() >= safe {
        let words =
            Words::of("a plate at {0} is invalid: expected a height from 0mm up to below {1} ({safe-z})");
        return wrong(words.with([&z, &Length(safe)]).to_string());
    }
    Ok(TouchOff { at: Point::new(x.nm(), y.nm()), height: z.nm() })
}

/// Why a way of changing tools cannot be asked for: a machine that does not stand still cuts on
/// with the tool that is in.
fn unheld(change: ToolChange, base: &Dialect) -> String {
    let word = match change {
        ToolChange::M6 => "M6",
        ToolChange::Pause => "M0",
        ToolChange::PauseWithText => "M0 with a text",
        ToolChange::Files => "the end of a program",
    };
    let held: Vec<&str> = base.changes.iter().map(|change| change.word()).collect();
    format!(
        "{} does not wait at {word} until the tool is changed: expected {}; for a controller or a sender that does, write a dialect of your own",
        base.name,
        held.join(" or ")
    )
}
