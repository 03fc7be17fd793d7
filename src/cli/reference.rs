//! docs/options.md: every option of every command with what it does, its unit and its default,
//! as clap has them.

use std::fmt::Write as _;

use clap::{Arg, Command};

const HEAD: &str = "\
# Options

`voromill explain --options` writes this page; a test holds it to the program. Options that several commands share are
listed once. `voromill init` writes every setting of a job into `voromill.toml`, where the same names are keys.

| value | what to write |
|---|---|
| LENGTH | a number and its unit: nm, um, mm, cm, mil or in, such as `0.2mm` or `8mil` |
| SPEED | a length per minute or second, such as `200mm/min` |
| ANGLE | degrees, such as `30deg` |
| TIME | seconds or milliseconds, such as `3s` or `200ms` |
| TOOL | `vbit:TIP:ANGLE`, `endmill:DIAMETER`, `drill:DIAMETER`, or a name that `voromill tools` lists |
| PATTERN | the name of a net, with `*` and `?` |
";

/// An option as the page shows it.
#[derive(PartialEq, Eq)]
struct Row {
    heading: String,
    option: String,
    what: String,
    default: String,
}

/// The page.
pub(super) fn page(command: &Command) -> String {
    let is_shown = |sub: &&Command| !sub.is_hide_set() && sub.get_name() != "help";
    let mut all: Vec<(Row, Vec<String>)> = Vec::new();
    for sub in command.get_subcommands().filter(is_shown) {
        let nested: Vec<&Command> = sub.get_subcommands().filter(is_shown).collect();
        let own = [(sub.get_name().to_owned(), sub)];
        let nested = nested.iter().map(|one| (format!("{} {}", sub.get_name(), one.get_name()), *one));
        for (name, command) in own.into_iter().chain(nested) {
            for row in command.get_arguments().filter(|argument| !argument.is_hide_set()).map(row) {
                match all.iter_mut().find(|(known, _)| *known == row) {
                    Some((_, commands)) => commands.push(name.clone()),
                    None => all.push((row, vec![name.clone()])),
                }
            }
        }
    }
    let mut text = HEAD.to_owned();
    let count =
        all.iter().flat_map(|(_, commands)| commands).collect::<std::collections::BTreeSet<_>>().len();
    let shared: Vec<_> = all.iter().filter(|(_, commands)| commands.len() > 1).collect();
    let mut headings: Vec<&str> = shared.iter().map(|(row, _)| row.heading.as_str()).collect();
    headings.sort_unstable();
    headings.dedup();
    for heading in headings {
        let _ = write!(text, "\n## {heading}\n\n| option | what | default | commands |\n|---|---|---|---|\n");
        for (row, commands) in shared.iter().filter(|(row, _)| row.heading == heading) {
            let commands = if commands.len() == count { "all".to_owned() } else { commands.join(", ") };
            let _ = writeln!(text, "{} {commands} |", row.cells());
        }
    }
    let mut commands: Vec<&str> = Vec::new();
    let alone = all.iter().filter(|(_, commands)| commands.len() == 1);
    for (row, of) in alone {
        if !commands.contains(&of[0].as_str()) {
            commands.push(&of[0]);
            let _ = write!(
                text,
                "\n## `voromill {}` alone\n\n| option | what | default |\n|---|---|---|\n",
                of[0]
            );
        }
        let _ = writeln!(text, "{}", row.cells());
    }
    text
}

impl Row {
    fn cells(&self) -> String {
        let cell = |text: &str| text.replace('|', "\\|");
        format!("| `{}` | {} | {} |", cell(&self.option), cell(&self.what), cell(&self.default))
    }
}

fn row(argument: &Arg) -> Row {
    let value = || {
        let names = argument.get_value_names().unwrap_or_default();
        names.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
    };
    let takes_value = argument.get_action().takes_values();
    let name = match (argument.get_long(), argument.get_short()) {
        (Some(long), Some(short)) => format!("-{short}, --{long}"),
        (Some(long), None) => format!("--{long}"),
        _ => String::new(),
    };
    let option = match (name.is_empty(), takes_value) {
        (true, _) => value(),
        (false, true) => format!("{name} {}", value()),
        (false, false) => name,
    };
    let help = argument.get_help().map(ToString::to_string).unwrap_or_default();
    let (help, said) = match help.split_once("[default: ") {
        Some((help, default)) => (help.trim().to_owned(), default.trim_end_matches(']').to_owned()),
        None => (help, String::new()),
    };
    let given: Vec<_> = argument.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    let default = if takes_value && said.is_empty() { given.join(",") } else { said };
    let possible: Vec<String> = argument
        .get_possible_values()
        .iter()
        .filter(|value| !value.is_hide_set())
        .map(|value| value.get_name().to_owned())
        .collect();
    let is_listed = takes_value && !argument.is_hide_possible_values_set() && !possible.is_empty();
    let what = if is_listed { format!("{help}: {}", possible.join(", ")) } else { help };
    let heading = argument.get_help_heading().unwrap_or("Input, and the rest").to_owned();
    Row { heading, option, what, default }
}
