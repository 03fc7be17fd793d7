//! Which options of a job mean something to which subcommand: the others are neither shown nor
//! taken there.
//!
//! All that read a board share the options of a job, and its settings file, so that a board is seen
//! as it will be milled. What changes nothing of what comes out would be believed to have done
//! something.

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command};
use voromill::job::{Options, Reach};

use super::Failure;
use super::given::{Given, flag, key_of};

/// The command, with the options of a job left out of the help of the subcommands to which they
/// mean nothing.
pub(super) fn hidden(command: Command) -> Command {
    command.mut_subcommands(move |sub| {
        let without_effect = without_effect(sub.get_name());
        sub.mut_args(move |argument| {
            let has_none = without_effect.iter().any(|option| option.get_id() == argument.get_id());
            if has_none { argument.hide(true) } else { argument }
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
    let is_given =
        |option: &Arg| given.value_source(option.get_id().as_str()) == Some(ValueSource::CommandLine);
    match without_effect(name).iter().find(|option| is_given(option)) {
        None => Ok(()),
        Some(option) => {
            let flag = flag(&key_of(option));
            let cause = format!("{flag} has no effect on what `voromill {name}` makes");
            Err(Failure::new(cause, "leave it out; a settings file may have it"))
        }
    }
}

/// The options of a job that change nothing of what a subcommand makes.
fn without_effect(subcommand: &str) -> Vec<Arg> {
    let reach = match subcommand {
        "isolate" => Reach::ISOLATION.and(Reach::TILING),
        "draw" => Reach::PICTURES,
        "probe" => Reach::PROBING.and(Reach::TILING),
        "carve" => Reach::CARVING,
        "pocket" => Reach::POCKETS,
        "inspect" => Reach::INSPECTION,
        _ => return Vec::new(),
    };
    let options = Given::augment_args(Command::new("options"));
    let idle = options.get_arguments().filter(|option| !Options::reach(&key_of(option)).meets(reach));
    idle.cloned().collect()
}
