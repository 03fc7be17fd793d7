//! What a program says of itself: first what its operator needs, then where it comes from.

use std::fmt::Write as _;

use crate::geometry::{Arc, Nm, Point, Rect};
use crate::toolpath::{Move, Program, Tool, duration};

use super::dialect::{Dialect, TouchOff};

/// What a program says of itself before it begins: what made it, from what, how. No clock, no path,
/// no host.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    /// The program and its version: `voromill 0.1.0`.
    pub generator: String,
    /// The files it was made from.
    pub inputs: Vec<Input>,
    /// The settings that matter, by name.
    pub settings: Vec<(String, String)>,
    /// How long it will take, in seconds; none where nobody knows.
    pub seconds: Option<f64>,
}

/// A file that a program was made from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Its name without its folder.
    pub file: String,
    /// SHA-256 of what was read from it, in hexadecimal: comments and dates do not count.
    pub design: String,
}

impl Header {
    /// What it was made by, from and with, as plain text.
    pub(super) fn provenance(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if !self.generator.is_empty() {
            lines.push(format!("made by {}", self.generator));
        }
        for Input { file, design } in &self.inputs {
            let short: String = design.chars().take(12).collect();
            lines.push(format!("from {file} design {short}"));
        }
        lines.extend(self.settings.iter().flat_map(|(name, value)| setting(name, value)));
        lines
    }
}

/// A setting in lines short enough to stand each in one comment, the name before each part.
fn setting(name: &str, value: &str) -> Vec<String> {
    /// Chosen: shorter than any controller's line.
    const ROOM: usize = 70;
    let mut lines: Vec<String> = Vec::new();
    for word in escaped(value).split(' ') {
        match lines.last_mut().filter(|line| line.len() + word.len() < ROOM) {
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(format!("{name} {word}")),
        }
    }
    lines
}

/// A value whose every character survives in a comment: what does not is written as `^` and two
/// hexadecimal digits for each byte.
fn escaped(value: &str) -> String {
    let mut out = String::with_capacity(value.len());
    for byte in value.bytes() {
        if (b' '..0x7f).contains(&byte) && !b"?!~%();*#{}^".contains(&byte) {
            out.push(char::from(byte));
        } else {
            _ = write!(out, "^{byte:02X}");
        }
    }
    out
}

/// What a person wants to know before they start a program, at most ten lines: what it makes, of
/// which tools, how long, how far it goes, where zero is, what must be set.
pub(super) fn brief(program: &Program, dialect: &Dialect, header: &Header) -> Vec<String> {
    let mut lines = vec![program.title.clone()];
    lines.extend(tools(program));
    lines.extend(header.seconds.map(|seconds| format!("takes about {}", duration(seconds))));
    lines.extend(extent(program, dialect.touch_off));
    lines.extend(program.notes.iter().cloned());
    lines.extend(dialect.condition.as_deref().map(str::to_owned));
    lines
}

/// The tool to mount, or all in the order in which they are asked for.
fn tools(program: &Program) -> Option<String> {
    /// Chosen: two lines of them; the rest is told at each change.
    const MOST: usize = 6;
    let mut tools: Vec<&Tool> = program.sections.iter().map(|section| &section.tool).collect();
    tools.dedup();
    match tools.as_slice() {
        [] => None,
        [tool] => Some(format!("mount {}", named(tool))),
        several => {
            let mut named: Vec<String> =
                several.iter().take(MOST).map(|tool| format!("T{} {}", tool.number, tool.kind)).collect();
            if several.len() > MOST {
                named.push(format!("and {} more", several.len() - MOST));
            }
            Some(format!("tools: {}", named.join(", ")))
        }
    }
}

/// A tool as it is called at the machine: `tool 2: drill:0.8mm`.
pub(super) fn named(tool: &Tool) -> String {
    if tool.name == tool.kind.to_string() {
        format!("tool {}: {}", tool.number, tool.kind)
    } else {
        format!("tool {}: {} {}", tool.number, tool.name, tool.kind)
    }
}

/// How far its moves reach, arcs with all of their bow, and to the plate that tools touch.
fn extent(program: &Program, plate: Option<TouchOff>) -> Option<String> {
    let mut area = plate.map(|plate| Rect::new(plate.at, plate.at));
    let (mut at, mut lowest): (Option<Point>, Option<Nm>) = (None, None);
    for step in program.sections.iter().flat_map(|section| &section.moves) {
        let Some(to) = step.to() else { continue };
        let own = match (*step, at) {
            (Move::Arc { center, turn, .. }, Some(start)) => {
                Arc { start, end: to.point(), center, turn }.bounds()
            }
            _ => Rect::new(to.point(), to.point()),
        };
        area = Some(area.map_or(own, |area| area.union(own)));
        lowest = Some(lowest.map_or(to.z, |lowest| lowest.min(to.z)));
        at = Some(to.point());
    }
    let ((min, max), lowest) = (area.map(|area| (area.min(), area.max()))?, lowest?);
    let top = highest(program);
    Some(format!(
        "x {:.2} to {:.2}, y {:.2} to {:.2}, z {lowest:.2} to {top:.2} mm",
        min.x, max.x, min.y, max.y
    ))
}

/// The highest place that a program goes to, at least its safe height.
pub(super) fn highest(program: &Program) -> Nm {
    let moves = program.sections.iter().flat_map(|section| &section.moves);
    moves.filter_map(Move::to).map(|to| to.z).fold(program.safe, Nm::max)
}
