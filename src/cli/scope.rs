//! Which options of a job mean something to which subcommand: the others are neither shown nor
//! taken there.
//!
//! All that read a board share the options of a job, and its settings file, so that a board is seen
//! as it will be milled. What changes nothing of what comes out would be believed to have done
//! something.

use clap::parser::ValueSource;
use clap::{ArgMatches, Command, Id};
use voromill::job::{Options, Reach};

use super::Failure;
use super::given::{flag, key_of};

/// The command, with the options of a job left out of the help of the subcommands to which they
/// mean nothing.
pub(super) fn hidden(command: Command) -> Command {
    command.mut_subcommands(|sub| {
        let Some(reach) = reach(sub.get_name()) else { return sub };
        sub.mut_args(|argument| {
            let has_effect = means(reach, &key_of(argument.get_id()));
            if has_effect { argument } else { argument.hide(true) }
        })
    })
}

/// Fails for the first option of a job that was given to a subcommand to which it means nothing.
pub(super) fn check(matches: &ArgMatches) -> Result<(), Failure> {
    let Some((name, given)) = matches.subcommand() else { return Ok(()) };
    let Some(reach) = reach(name) else { return Ok(()) };
    let is_given = |id: &&Id| given.value_source(id.as_str()) == Some(ValueSource::CommandLine);
    let mut keys = given.ids().filter(is_given).map(key_of);
    match keys.find(|key| !means(reach, key)) {
        None => Ok(()),
        Some(key) => {
            let cause = format!("{} has no effect on what `voromill {name}` makes", flag(&key));
            Err(Failure::new(cause, "leave it out; a settings file may have it"))
        }
    }
}

/// What an option of a job must change to mean something to a subcommand; none where all do, or
/// none is taken.
fn reach(subcommand: &str) -> Option<Reach> {
    Some(match subcommand {
        "isolate" => Reach::ISOLATION.and(Reach::TILING),
        "draw" => Reach::PICTURES,
        "probe" => Reach::PROBING.and(Reach::TILING),
        "carve" => Reach::CARVING,
        "pocket" => Reach::POCKETS,
        "inspect" => Reach::INSPECTION,
        _ => return None,
    })
}

/// Whether the option of this key changes any of that, or is none of a job.
fn means(reach: Reach, key: &str) -> bool {
    Options::reach(key).is_none_or(|changes| changes.meets(reach))
}
