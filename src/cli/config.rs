//! Where settings come from: options, then the settings file, then the defaults.

use std::path::{Path, PathBuf};

use clap::Args;
use voromill::board::Board;
use voromill::job::{Error, FILE_NAME, Length, MillProject, Options, Reach, Settings, Workbench};

use super::given::{Given, flag};
use super::input::Input;
use super::{Failure, Shared};

/// The options of a job, and where to find the rest.
#[derive(Args)]
pub(super) struct Config {
    /// Settings file [default: voromill.toml beside the board or else here, if there]
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,

    #[command(flatten)]
    given: Given,
}

impl Config {
    /// The settings for a job: the command line's, then a millproject's, then the file's, which is
    /// named if nobody has named it.
    pub(super) fn settings(&self, input: &Input, shared: Shared) -> Result<Settings, Failure> {
        self.name_file(input, shared);
        self.resolved(input, Settings::resolve)
    }

    /// The same where shapes are milled, and options count that change any of `reach`.
    pub(super) fn for_artwork(
        &self,
        input: &Input,
        reach: Reach,
        shared: Shared,
    ) -> Result<Settings, Failure> {
        self.name_file(input, shared);
        self.resolved(input, |options| Settings::for_artwork(options, reach))
    }

    /// The settings for `board`, where nothing else says how thick it is.
    pub(super) fn settings_for(&self, input: &Input, board: &Board) -> Result<Settings, Failure> {
        let of_board = Options { thickness: board.thickness.map(Length), ..Options::default() };
        self.resolved(input, |options| Settings::resolve(options.or(of_board)))
    }

    /// Says which settings file was found where none was named.
    fn name_file(&self, input: &Input, shared: Shared) {
        if let Some(found) = Self::unnamed(self.config.as_deref(), &input.paths()) {
            shared.say(&format!("settings: {}\n", found.display()));
        }
    }

    /// Fails for an option given here that the paper's program does not know.
    pub(super) fn judge_paper(&self) -> Result<(), Failure> {
        let given = self.given.0.listed();
        let Some((option, _)) = given.iter().find(|(option, _)| *option != "strategy") else { return Ok(()) };
        let cause = format!("{} has no effect with --paper", flag(option));
        Err(Failure::new(cause, "leave out one of them; of these options --paper takes only --strategy"))
    }

    /// The tools that the settings know.
    pub(super) fn workbench(&self, input: &Input) -> Result<Workbench, Failure> {
        let from_file = Self::found(self.config.as_deref(), &input.paths())?;
        Ok(Workbench::new(self.given.0.clone().or(from_file))?)
    }

    fn resolved(
        &self,
        input: &Input,
        resolve: impl FnOnce(Options) -> Result<Settings, Error>,
    ) -> Result<Settings, Failure> {
        let from_file = Self::found(self.config.as_deref(), &input.paths())?;
        let project = input.project()?;
        let given = self.given.0.clone().or(project.options.clone()).or(from_file);
        let settings = resolve(given).map_err(|error| self.explain(error, &project))?;
        self.judge(&settings)?;
        Ok(settings)
    }

    /// An error of settings, with the line of the project that said them unless they were given
    /// here.
    fn explain(&self, error: Error, project: &MillProject) -> Error {
        let is_given = |key: &str| self.given.0.listed().iter().any(|(option, _)| option == key);
        match &error {
            Error::Value { key, .. } if is_given(key) => error,
            _ => project.explain(error),
        }
    }

    /// Fails for an option that was given here and changes nothing beside the others.
    fn judge(&self, settings: &Settings) -> Result<(), Failure> {
        settings.without_effect(&self.given.0).map_or(Ok(()), |(option, hint)| {
            Err(Failure::new(format!("{} has no effect with these options", flag(option)), hint))
        })
    }

    /// What the settings file says: the one that was `named`, or one that is found; nothing where
    /// there is none.
    pub(super) fn found(named: Option<&Path>, inputs: &[PathBuf]) -> Result<Options, Failure> {
        let file = named.map(Path::to_path_buf).or_else(|| Self::unnamed(named, inputs));
        file.map_or_else(|| Ok(Options::default()), |path| read(&path))
    }

    /// The settings file where none is named: beside `inputs`, or else in the current folder.
    fn unnamed(named: Option<&Path>, inputs: &[PathBuf]) -> Option<PathBuf> {
        let beside = inputs.iter().map(|input| beside(input));
        let mut candidates = beside.chain([PathBuf::from(FILE_NAME)]);
        candidates.find(|candidate| named.is_none() && candidate.is_file())
    }
}

/// The settings file beside a board: in its folder, or in the folder that its file lies in.
fn beside(input: &Path) -> PathBuf {
    if input.is_dir() { input.join(FILE_NAME) } else { input.with_file_name(FILE_NAME) }
}

fn read(path: &Path) -> Result<Options, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| Failure::io("read", path, &error))?;
    Ok(Options::from_toml(&path.display().to_string(), &text)?)
}
