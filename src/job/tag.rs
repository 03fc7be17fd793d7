//! What the files of programs are called where each tool has one of its own: by what the tool is,
//! as the person who fits it reads it.

use std::fmt::Write as _;

use crate::board::Side;
use crate::gcode::dialect::ToolChange;
use crate::geometry::Nm;
use crate::toolpath::{Program, Tool, ToolKind};

use super::{Part, Settings};

/// The end of each program's file name, no two the same: the part, and in a file of its own a drill
/// with its diameter, and any other tool that is not the only one of its part.
pub(super) fn tags(planned: &[(Part, Side, Program)], settings: &Settings) -> Vec<String> {
    let mut tags: Vec<String> = Vec::with_capacity(planned.len());
    for (part, _, program) in planned {
        let alone = planned.iter().filter(|(other, ..)| other == part).count() == 1;
        let tool = program.sections.first().map(|section| &section.tool);
        let mut tag = match tool {
            Some(tool) if settings.dialect.tool_change == ToolChange::Files => tag(*part, tool, alone),
            _ => part.name().to_owned(),
        };
        if let Some(tool) = tool.filter(|_| tags.contains(&tag)) {
            // Two of a kind: as different as their numbers.
            _ = write!(tag, "-{}", tool.number);
        }
        tags.push(tag);
    }
    tags
}

fn tag(part: Part, tool: &Tool, alone: bool) -> String {
    let name = part.name();
    match tool.kind {
        // A program that drills is told by its drill even where there is one.
        ToolKind::Drill { diameter } if part == Part::Drill => format!("{name}-{}", millimetres(diameter)),
        _ if alone => name.to_owned(),
        ToolKind::Drill { diameter } => format!("{name}-drill-{}", millimetres(diameter)),
        ToolKind::EndMill { diameter } => format!("{name}-endmill-{}", millimetres(diameter)),
        ToolKind::VBit { tip, angle } => format!("{name}-vbit-{}-{angle}", millimetres(tip)),
    }
}

/// As on a drill's shank: `1.0mm`, `0.85mm`, `3.175mm`.
fn millimetres(length: Nm) -> String {
    let text = length.to_string();
    let short = text.trim_end_matches('0');
    if short.ends_with('.') { format!("{short}0mm") } else { format!("{short}mm") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Options;
    use crate::toolpath::Section;

    fn planned(part: Part, tools: &[&str]) -> Vec<(Part, Side, Program)> {
        let program = |(tool, number): (&&str, u32)| {
            let tool = Tool { number, ..tool.parse().expect("a tool") };
            let sections = vec![Section { tool, label: String::new(), moves: Vec::new() }];
            (
                part,
                Side::Front,
                Program { title: String::new(), notes: Vec::new(), safe: Nm::from_mm(2), sections },
            )
        };
        tools.iter().zip(1..).map(program).collect()
    }

    #[test]
    fn a_file_is_named_by_the_tool_that_is_to_be_fitted() {
        let settings = Settings::resolve(Options::default()).expect("the defaults");
        let mut all = planned(Part::Front, &["vbit:0.1mm:30deg"]);
        all.extend(planned(Part::Drill, &["drill:1mm", "drill:0.85mm", "endmill:1mm", "drill:1mm"]));
        all.extend(planned(Part::Cutout, &["endmill:3.175mm"]));
        let expected =
            ["front", "drill-1.0mm", "drill-0.85mm", "drill-endmill-1.0mm", "drill-1.0mm-4", "cutout"];
        assert_eq!(tags(&all, &settings), expected, "no two the same");
        let two = planned(Part::Back, &["endmill:0.5mm", "vbit:0.1mm:30deg"]);
        assert_eq!(tags(&two, &settings), ["back-endmill-0.5mm", "back-vbit-0.1mm-30deg"], "two tools");
    }
}
