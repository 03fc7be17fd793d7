//! Help in two steps: the options that people use first, and with `--help-all` every one.

use clap::{Arg, ArgAction, Command};

/// What `--help` shows of commands that have many options, beside what they read and how much they
/// say; the others show all.
const FIRST: &[(&str, &[&str])] = &[
    (
        "mill",
        &[
            "output",
            "tool",
            "depth",
            "width",
            "machine",
            "dialect",
            "feed",
            "spindle",
            "safe_z",
            "origin",
            "thickness",
            "drills",
            "cutout_tool",
            "tabs",
            "config",
        ],
    ),
    (
        "isolate",
        &["output", "side", "tool", "depth", "width", "machine", "dialect", "feed", "spindle", "safe_z"],
    ),
    ("draw", &["output", "stage", "side", "window", "pixel", "dpi", "format", "tool", "depth"]),
    ("mask", &["output", "what", "side", "gap", "clearance", "margin", "negative", "mirror", "scale", "dpi"]),
    ("inspect", &["format", "front", "back", "outline", "drill_files", "skip"]),
    ("probe", &["output", "side", "probe_grid", "probe_depth", "probe_feed", "dialect", "origin", "tile"]),
    (
        "verify",
        &["board", "tool", "side", "offset", "mirror", "rotate", "register", "thickness", "deny", "format"],
    ),
];

/// The option that shows every option.
pub(super) fn with_all(command: Command) -> Command {
    let all = Arg::new("help_all").long("help-all").global(true).action(ArgAction::HelpLong);
    command.arg(all.help("Print help with every option").display_order(super::LATE + 3))
}

/// The command, with what is used later left out of its help unless all of it was asked for.
pub(super) fn shortened(command: Command) -> Command {
    if std::env::args_os().any(|word| word == "--help-all") {
        return command;
    }
    command.mut_subcommands(|sub| {
        let name = sub.get_name().to_owned();
        let Some((_, first)) = FIRST.iter().find(|(command, _)| *command == name) else { return sub };
        let is_later = |argument: &Arg| {
            !argument.is_positional()
                && !argument.is_hide_set()
                && !argument.is_global_set()
                && !["help", "version"].contains(&argument.get_id().as_str())
                && !first.contains(&argument.get_id().as_str())
        };
        let later = sub.get_arguments().filter(|argument| is_later(argument)).count();
        let examples = sub.get_after_help().map(ToString::to_string).unwrap_or_default();
        let sub = sub.mut_args(|argument| if is_later(&argument) { argument.hide(true) } else { argument });
        sub.after_help(format!("{later} more options: voromill {name} --help-all\n\n{examples}"))
    })
}
