//! Which options of a job mean something to which subcommand: the others are neither shown nor
//! taken there.
//!
//! All that read a board share the options of a job, and its settings file, so that a board is seen
//! as it will be milled. What changes nothing of what comes out would be believed to have done
//! something.

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command};
use voromill::job::{CARVING_OPTIONS, POCKETING_OPTIONS, Part};

use super::Failure;
use super::given::Given;

/// The command, with the options of a job left out of the help of the subcommands to which they
/// mean nothing.
pub(super) fn hidden(command: Command) -> Command {
    let options = options();
    command.mut_subcommands(move |sub| {
        let (name, options) = (sub.get_name().to_owned(), options.clone());
        sub.mut_args(move |argument| {
            let has_no_effect =
                options.contains(&argument.get_id().to_string()) && !takes(&name, argument.get_id().as_str());
            if has_no_effect { argument.hide(true) } else { argument }
        })
    })
}

/// The command in which the strategy of pockets has the name that of isolation has elsewhere: that
/// one, which means nothing to pockets, is out of the way.
pub(super) fn renamed(command: Command) -> Command {
    command.mut_subcommand("pocket", |pocket| {
        pocket.mut_arg("strategy", |strategy| strategy.long("isolation-strategy").hide(true))
    })
}

/// Fails for the first option of a job that was given to a subcommand to which it means nothing.
pub(super) fn check(matches: &ArgMatches) -> Result<(), Failure> {
    let Some((name, given)) = matches.subcommand() else { return Ok(()) };
    let without_effect = options().into_iter().filter(|option| !takes(name, option));
    match without_effect
        .into_iter()
        .find(|option| given.value_source(option) == Some(ValueSource::CommandLine))
    {
        None => Ok(()),
        Some(option) => {
            let no = if matches!(option.as_str(), "frame" | "min_width") { "no-" } else { "" };
            let cause =
                format!("--{no}{} has no effect on what `voromill {name}` makes", option.replace('_', "-"));
            Err(Failure::new(cause, "leave it out; a settings file may have it"))
        }
    }
}

/// The names of a job's options.
fn options() -> Vec<String> {
    let options = Given::augment_args(Command::new("options"));
    options.get_arguments().map(|argument| argument.get_id().to_string()).collect()
}

/// Whether an option of a job changes what a subcommand makes.
fn takes(subcommand: &str, option: &str) -> bool {
    let option = option.replace('_', "-");
    let option = option.as_str();
    match subcommand {
        // How far tiles are apart unless that is said goes by the cutter between them.
        "isolate" => Part::Front.is_changed_by(option) || option == "cutout-tool",
        "draw" => {
            let drills = ["drill", "alignment", "break-through", "material", "thickness", "cutout-side"];
            !is_of_the_machine(option) && !drills.iter().any(|start| option.starts_with(start))
        }
        "probe" => {
            places(option)
                || matches!(
                    option,
                    "safe-z" | "machine" | "dialect" | "blend" | "cutout-tool" | "outline-gap"
                )
        }
        "carve" => CARVING_OPTIONS.contains(&option),
        "pocket" => CARVING_OPTIONS.contains(&option) || POCKETING_OPTIONS.contains(&option),
        // The kerf and the board's thickness decide how strongly nets are coupled.
        "inspect" => {
            matches!(option, "topology" | "outline-gap" | "tool" | "depth" | "kerf" | "thickness")
        }
        _ => true,
    }
}

/// What says how boards lie on the machine.
fn places(option: &str) -> bool {
    matches!(option, "origin" | "rotate" | "offset" | "mirror-axis" | "tile" | "tile-spacing")
}

/// What is of the text of programs, or of the machine that reads it, and not of what is cut on a
/// board.
fn is_of_the_machine(option: &str) -> bool {
    matches!(
        option,
        "spindle"
            | "spin-up"
            | "machine"
            | "dialect"
            | "blend"
            | "tool-change"
            | "tool-change-at"
            | "tool-probe"
            | "park"
            | "direction"
            | "before"
            | "after"
            | "at-tool-change"
            | "tile"
            | "tile-spacing"
            | "machine-travel"
            | "output-name"
    )
}
