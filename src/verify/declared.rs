//! What a program says of itself in its comments, where it is one of ours: the tools, what it is
//! for, how the board lies. Of pcb2gcode's and FlatCAM's programs the tools alone.

use crate::board::Side;
use crate::gcode::read::{Listing, Motion, Way, lines, read, without_own_code};
use crate::geometry::{Nm, Vector};

use super::{Cutter, Program, Role};

/// A tool that comments name.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mounted {
    /// The line from which on it is in the spindle.
    pub(super) line: u32,
    pub(super) cutter: Cutter,
    /// Its number in the machine's table, where they say that.
    pub(super) number: Option<u32>,
}

/// What the comments of a program say.
#[derive(Clone, Debug, Default)]
pub(super) struct Declared {
    /// The tools, in the order in which they are mounted.
    pub(super) mounted: Vec<Mounted>,
    /// What the program is for.
    pub(super) role: Option<Role>,
    /// Where zero is: `lower-left`, `keep`, `center`.
    pub(super) origin: Option<String>,
    /// How far the board was moved from there.
    pub(super) offset: Vector,
    /// How far the board was turned, counter-clockwise in degrees.
    pub(super) degrees: f64,
    /// The line about which the board was flipped.
    pub(super) mirror: Option<Nm>,
    /// Whether FlatCAM's diameters are inches.
    are_inches: bool,
    /// The mill with which pcb2gcode mills all holes.
    mill_head: Option<Cutter>,
}

impl Declared {
    /// Reads the comments of `text`.
    pub(super) fn read(text: &str) -> Self {
        let mut declared = Self::default();
        for (comment, line) in remarks(lines(text)) {
            declared.comment(&comment, line);
        }
        declared
    }

    fn comment(&mut self, comment: &str, line: u32) {
        if self.role.is_none() && line <= TITLE {
            self.role = role(comment);
        }
        let words: Vec<&str> = comment.split_whitespace().collect();
        if comment.contains("tool ")
            && let Some(cutter) = words.iter().rev().find_map(|word| word.parse().ok())
        {
            let number = words.windows(2).filter(|pair| pair[0] == "tool");
            let number = number.filter_map(|pair| pair[1].strip_suffix(':')?.parse().ok()).next();
            self.mounted.push(Mounted { line, cutter, number });
        }
        if let Some(cutter) = self.foreign(&words) {
            self.mounted.push(Mounted { line, cutter, number: None });
        }
        match words.as_slice() {
            ["rotate", angle] => {
                let degrees = angle.strip_suffix("deg").and_then(|number| number.parse().ok());
                self.degrees = degrees.filter(|degrees: &f64| degrees.is_finite()).unwrap_or(0.0);
            }
            ["offset", way] => {
                let way: Option<Vec<Nm>> = way.split(',').map(|length| length.parse().ok()).collect();
                self.offset = match way.as_deref() {
                    Some([x, y]) => Vector::new(*x, *y),
                    _ => Vector::default(),
                };
            }
            ["origin", origin] => self.origin = Some((*origin).to_owned()),
            [.., "line", "x", "=", axis, "mm"] if comment.contains("mirrored left to right") => {
                self.mirror = format!("{axis}mm").parse().ok();
            }
            _ => {}
        }
    }

    /// The tool that other programs name in these words.
    fn foreign(&mut self, words: &[&str]) -> Option<Cutter> {
        let made = |kind: &str, diameter: &str, unit: &str| format!("{kind}:{diameter}{unit}").parse().ok();
        match words {
            // FlatCAM, which says the unit once and above.
            ["Units:", unit] => {
                self.are_inches = unit.eq_ignore_ascii_case("in");
                None
            }
            // What its programs for one tool have, which cuts so wide at its depth.
            ["TOOL", "DIAMETER:", diameter, unit] => made("endmill", diameter, &unit.to_lowercase()),
            ["MSG,", "Change", "to", "Tool", "Dia", "=", diameter, rest @ ..] => {
                let unit = if self.are_inches { "in" } else { "mm" };
                let kind = if rest.contains(&"drills") { "drill" } else { "endmill" };
                made(kind, diameter, unit)
            }
            // pcb2gcode, which writes the unit behind the number.
            ["This", "file", "uses", "a", "mill", "head", "of", diameter, ..] => {
                self.mill_head = made("endmill", diameter, "");
                self.mill_head
            }
            ["MSG,", "Change", "tool", "bit", "to", "cutter" | "mill", "diameter", diameter] => {
                made("endmill", diameter, "")
            }
            ["MSG,", "Change", "tool", "bit", "to", "drill", "size", diameter] => {
                self.mill_head.or_else(|| made("drill", diameter, ""))
            }
            _ => None,
        }
    }
}

/// What a program that voromill wrote says of a setting in its comments, `tile` or `ignore`; none
/// where it says nothing.
///
/// A long value stands in several comments; what no comment can hold is `^` and two hexadecimal
/// digits for each byte.
#[must_use]
pub fn declared_setting(text: &str, setting: &str) -> Option<String> {
    let value = |(comment, _): (String, u32)| {
        Some(comment.strip_prefix(setting)?.strip_prefix(' ')?.trim().to_owned())
    };
    let parts: Vec<String> = remarks(lines(text).take(HEADER)).into_iter().filter_map(value).collect();
    (!parts.is_empty()).then(|| unescaped(&parts.join(" ")))
}

/// Whether a program isolates, as far as anybody or its own title says so.
#[must_use]
pub fn is_isolation(program: &Program) -> bool {
    let role = program.role.or_else(|| Declared::read(&program.text).role);
    matches!(role, Some(Role::Isolation(_)))
}

/// Whether a program says in its title that it probes the surface, and mills nothing.
#[must_use]
pub fn is_probe(text: &str) -> bool {
    let titles = remarks(lines(text).take(HEADER));
    let mut titles = titles.iter().filter(|(_, line)| *line <= TITLE);
    let sinks = |motion: &Motion| motion.way != Way::Rapid && motion.to.z.is_some_and(|z| z < Nm::ZERO);
    let cuts = |listing: Listing| listing.motions.iter().any(sinks);
    titles.any(|(title, _)| title.ends_with(" probe"))
        && read(&without_own_code(text)).is_ok_and(|listing| !cuts(listing))
}

/// The texts of a setting that is a list, each of which may have blanks; none where the program
/// says nothing.
#[must_use]
pub fn declared_list(text: &str, setting: &str) -> Vec<String> {
    let list = declared_setting(text, setting).unwrap_or_default();
    list.split_whitespace().map(unescaped).collect()
}

/// A value as it was before its characters were made fit for a comment.
fn unescaped(value: &str) -> String {
    let mut bytes = Vec::with_capacity(value.len());
    let mut rest = value.as_bytes();
    while let [first, after @ ..] = rest {
        let code = after.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
        let byte = code.filter(|_| *first == b'^').and_then(|digits| u8::from_str_radix(digits, 16).ok());
        bytes.push(byte.unwrap_or(*first));
        rest = if byte.is_some() { &after[2..] } else { after };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// What a program that voromill wrote was made from: each file with the beginning of its design's
/// hash, and the line that says so.
pub(super) fn origins(text: &str) -> Vec<(String, String, u32)> {
    let origin = |comment: &str| {
        let (file, design) = comment.strip_prefix("from ")?.rsplit_once(" design ")?;
        let is_hash = !design.is_empty() && design.bytes().all(|b| b.is_ascii_hexdigit());
        is_hash.then(|| (file.to_owned(), design.to_owned()))
    };
    let found = remarks(lines(text)).into_iter();
    found
        .filter_map(|(comment, number)| origin(&comment).map(|(file, design)| (file, design, number)))
        .collect()
}

/// In so many lines at most a program says what it was made with. Chosen: several times as many as
/// there are settings.
const HEADER: usize = 200;

/// The title stands in one of so many lines. Chosen: what sends or keeps programs puts some lines
/// of its own above it.
const TITLE: u32 = 8;

/// The title names the board and the part.
fn role(title: &str) -> Option<Role> {
    if title.ends_with(" front isolation") {
        Some(Role::Isolation(Side::Front))
    } else if title.ends_with(" back isolation") {
        Some(Role::Isolation(Side::Back))
    } else if title.ends_with(" drill") {
        Some(Role::Drilling)
    } else if title.ends_with(" alignment") {
        Some(Role::Alignment)
    } else if title.ends_with(" cutout") {
        Some(Role::Cutout)
    } else {
        None
    }
}

/// The comments of lines, each with the number of its line; one that goes on in the next line,
/// whose comment begins with `+`, is one.
fn remarks<'a>(lines: impl Iterator<Item = &'a str>) -> Vec<(String, u32)> {
    let mut found: Vec<(String, u32)> = Vec::new();
    let mut last = 0;
    for (line, number) in lines.zip(1_u32..) {
        for comment in comments(line) {
            let comment = comment.trim();
            match (found.last_mut().filter(|_| last + 1 == number), comment.strip_prefix('+')) {
                (Some((begun, _)), Some(more)) => begun.push_str(more),
                _ => found.push((comment.to_owned(), number)),
            }
            last = number;
        }
    }
    found
}

/// The comments of a line: in parentheses, or behind a semicolon; and what stands behind M0, which
/// some machines show.
fn comments(line: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = line;
    // Most lines have none: to look for bytes is quicker than for texts.
    if !line.bytes().any(|byte| matches!(byte, b'(' | b';' | b'M')) {
        return found;
    }
    while let Some(start) = rest.find(['(', ';']) {
        if rest[start..].starts_with(';') {
            found.push(&rest[start + 1..]);
            return found;
        }
        let end = rest[start..].find(')').map_or(rest.len(), |end| start + end);
        found.push(&rest[start + 1..end]);
        rest = rest.get(end + 1..).unwrap_or_default();
    }
    found.extend(line.split_once("M0 ").map(|(_, message)| message));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tools_of_other_programs_are_understood() {
        let tools = |text: &str| -> Vec<(u32, String)> {
            let declared = Declared::read(text);
            declared.mounted.iter().map(|tool| (tool.line, tool.cutter.to_string())).collect()
        };
        let flatcam = "(Units: IN)\n(Tool: 1 -> Dia: 0.04)\nT1\nM6\n\
                       (MSG, Change to Tool Dia = 0.0400 ||| Total drills for tool T1 = 5)\nM0\n\
                       (MSG, Change to Tool Dia = 0.1000)\nM0\n";
        let found = tools(flatcam);
        assert_eq!(found, [(5, "drill:1.016mm".to_owned()), (7, "endmill:2.54mm".to_owned())], "FlatCAM's");
        let one = "(Units: MM)\n(TOOL DIAMETER: 0.2155 mm)\n(TOOL DIAMETER: 0.01 IN)\n";
        let found = tools(one);
        assert_eq!(found, [(2, "endmill:0.2155mm".to_owned()), (3, "endmill:0.254mm".to_owned())]);
        let drilled = "(MSG, Change tool bit to drill size 0.04inch)\nM6\n\
                       (MSG, Change tool bit to drill size 1.30000mm)\n";
        let found = tools(drilled);
        assert_eq!(found, [(1, "drill:1.016mm".to_owned()), (3, "drill:1.3mm".to_owned())], "pcb2gcode's");
        let milled = "( This file uses a mill head of 0.80000mm to drill the 2 hole sizes. )\n\
                      (MSG, Change tool bit to drill size 1.00000mm)\n";
        let found = tools(milled);
        let mill = "endmill:0.8mm".to_owned();
        assert_eq!(found, [(1, mill.clone()), (2, mill)], "one mill for all holes");
        assert_eq!(
            tools("( This file uses a mill head of 0.03125 to drill the 1bit sizes. )\n"),
            [],
            "no unit"
        );
    }

    #[test]
    fn our_own_comments_are_understood() {
        let text = "(blinker back isolation)\n(tool vbit:0.1mm:30deg)\n(origin lower-left)\n\
                    (mirrored left to right about the vertical line x = 12.500 mm)\nG21\n(fit tool 2: endmill:1mm)\n";
        let declared = Declared::read(text);
        assert_eq!(declared.role, Some(Role::Isolation(Side::Back)), "from the title");
        assert_eq!(declared.mirror, Some(Nm::from_um(12_500)), "the axis");
        assert_eq!(declared.origin.as_deref(), Some("lower-left"), "the origin");
        let lines: Vec<u32> = declared.mounted.iter().map(|tool| tool.line).collect();
        assert_eq!(lines, [2, 6], "each from its line on");
        assert_eq!(declared_setting(text, "origin").as_deref(), Some("lower-left"), "a setting");
        let long = "(ignore NET-^28D1-K^29 A^2A)\n(ignore gr^C3^B6n)\n(made by x)\n";
        assert_eq!(
            declared_setting(long, "ignore").as_deref(),
            Some("NET-(D1-K) A* gr\u{f6}n"),
            "in parts, as it was meant"
        );
        assert_eq!(declared_setting(text, "ignore"), None, "none");
        assert_eq!(declared_list("(ignore A^5E20B ^5E5E20 C)", "ignore"), ["A B", "^20", "C"], "a list");
    }
}
