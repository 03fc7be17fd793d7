//! `voromill machine`: profiles of machines, and one made from a controller's own settings.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use voromill::job::{MachineChoice, PerAxis, Profile, READY, import_machine};

use super::{Failure, Shared};

/// The machines whose figures are known, and those that say theirs
///
/// A machine's profile says how far and how fast its axes go, how fast they come up to speed, what
/// its spindle turns at and what it speaks. `--machine NAME` (or a file) of the other commands
/// takes it: times are then that machine's, and programs ask no more of it than it can do.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Machine {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    /// The built-in profiles
    List,
    /// A profile as TOML, to build your own on
    Show {
        /// A name of `list`
        name: String,
    },
    /// The profile of a machine, as TOML, from what its controller says: Grbl's answer to $$, or a
    /// LinuxCNC ini file
    Import {
        /// The file; `-` for stdin
        file: PathBuf,
    },
}

const EXAMPLES: &str = "\
Examples:
  voromill machine list
  voromill machine import settings.txt > mine.toml    what the console showed after $$
  voromill machine import my-mill.ini >> voromill.toml
  voromill mill board/ -o out --machine mine.toml";

impl Machine {
    pub(super) fn run(self, _: Shared) -> Result<(), Failure> {
        match self.action {
            Action::List => super::print(&list()),
            Action::Show { name } => {
                match READY.iter().find(|(known, _)| known.eq_ignore_ascii_case(&name)) {
                    Some((_, text)) => super::print(text),
                    None => {
                        let cause = format!("no machine is called `{name}`");
                        Err(Failure::new(cause, "`voromill machine list` shows the known ones"))
                    }
                }
            }
            Action::Import { file } => super::print(&import(&file)?),
        }
    }
}

fn import(file: &Path) -> Result<String, Failure> {
    let read = |path: &Path| {
        if path == Path::new("-") {
            std::io::read_to_string(std::io::stdin())
        } else {
            std::fs::read_to_string(path)
        }
    };
    let text = read(file).map_err(|error| Failure::io("read", file, &error))?;
    let stem = file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let name = stem.filter(|stem| stem != "-").unwrap_or_else(|| "my machine".to_owned());
    let hint = "save what the console shows after `$$`, or name the configuration's .ini file";
    import_machine(&name, &text).map_err(|error| Failure::new(format!("{}: {error}", file.display()), hint))
}

fn list() -> String {
    let mut text = String::new();
    for (name, _) in READY {
        let choice: Option<MachineChoice> = name.parse().ok();
        if let Some(MachineChoice(profile)) = choice {
            let _ = write!(text, "{}", described(&profile));
        }
    }
    text
}

fn described(profile: &Profile) -> String {
    fn shown<T: std::fmt::Display>(axes: Option<&PerAxis<T>>) -> String {
        axes.map_or("unknown".to_owned(), |PerAxis([x, y, z])| format!("{x}, {y}, {z}"))
    }
    let spindle = match (profile.spindle_min, profile.spindle_max) {
        (Some(least), Some(most)) => format!("{least} to {most} rpm"),
        (None, Some(most)) => format!("up to {most} rpm"),
        (Some(least), None) => format!("from {least} rpm"),
        (None, None) => "unknown".to_owned(),
    };
    format!(
        "{}: {}\n  dialect       {}\n  travel        {}\n  rapid         {}\n  acceleration  {}\n  spindle       {spindle}\n",
        profile.name,
        profile.about,
        profile.dialect.as_ref().map_or("unknown".to_owned(), ToString::to_string),
        shown(profile.travel.as_ref()),
        shown(profile.rapid.as_ref()),
        shown(profile.acceleration.as_ref()),
    )
}
